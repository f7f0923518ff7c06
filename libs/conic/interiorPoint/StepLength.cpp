// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Few cones can block: those are kept as functions of the weight, and a few weights tried, four abreast.
#include "conic/interiorPoint/StepLength.h"

#include "core/Threads.h"

#include <array>

namespace drystone
{

template<class Number>
Number Blocking::Round<Number>::at(const Number& weight) const
{
    return ConeSteepness<Number>{offset.plus + weight * slope.plus, offset.minus + weight * slope.minus,
                                 offset.across + weight * slope.across}
        .steepest();
}

void Blocking::clear()
{
    found.lines.clear();
    found.floor = 1 / farthestStep;
    rounds.clear();
}

void Blocking::collectRays(const Eigen::VectorXd& x, const Eigen::VectorXd& dx, const Eigen::VectorXd& c,
                           double least, Eigen::Index begin, Eigen::Index end, Found& found)
{
    const auto add = [&](double offset, double slope)
    {
        const double one = offset + slope;
        const double other = offset + least * slope;
        if (std::max(one, other) > found.floor)
        {
            found.lines.push_back({offset, slope});
            found.floor = std::max(found.floor, std::min(one, other));
        }
    };
    constexpr int lanes = 4; // looked at together: few rays block
    using Lanes = Eigen::Array<double, lanes, 1>;
    Eigen::Index ray = begin;
    for (; ray + lanes <= end; ray += lanes)
    {
        const Lanes slope = -c.segment<lanes>(ray).array();
        const Lanes offset = -dx.segment<lanes>(ray).array();
        const Lanes most = (offset + slope).max(offset + least * slope);
        if ((most - found.floor * x.segment<lanes>(ray).array()).maxCoeff() > 0)
        {
            for (int lane = 0; lane < lanes; ++lane)
            {
                add(offset[lane] / x[ray + lane], slope[lane] / x[ray + lane]);
            }
        }
    }
    for (; ray < end; ++ray)
    {
        add(-dx[ray] / x[ray], -c[ray] / x[ray]);
    }
}

template<class Number>
void Blocking::collect(const ConeRanges& cones, const std::vector<ConeFrame<Number>>& frames,
                       const StepOfCones<Number>& step, const StepOfCones<Number>& correction, double least)
{
    if (partsOf(cones.rays) == 1)
    {
        collectRays(step.x, step.dx, correction.dx, least, 0, cones.rays, found);
    }
    else
    {
        // Lines below the floor of others are kept: they change no maximum.
        parts.resize(static_cast<std::size_t>(partsOf(cones.rays)));
        forParts(cones.rays,
                 [&](long begin, long end)
                 {
                     Found& part = parts[static_cast<std::size_t>(begin / entriesOfTask)];
                     part.lines.clear();
                     part.floor = found.floor;
                     collectRays(step.x, step.dx, correction.dx, least, begin, end, part);
                 });
        for (const Found& part : parts)
        {
            found.lines.insert(found.lines.end(), part.lines.begin(), part.lines.end());
            found.floor = std::max(found.floor, part.floor);
        }
    }
    for (std::size_t pack = 0; pack < frames.size(); ++pack)
    {
        const Round<Number> of{steepness(frames[pack], step.scaled[pack]),
                               steepness(frames[pack], correction.scaled[pack])};
        // Convex: nowhere between above both ends.
        const Number most = larger(of.at(1), of.at(least));
        for (int one = 0; one < countOf<Number>; ++one)
        {
            if (oneOf(most, one) > found.floor)
            {
                const auto here = [one](const ConeSteepness<Number>& all) -> ConeSteepness<double> {
                    return {oneOf(all.plus, one), oneOf(all.minus, one), oneOf(all.across, one)};
                };
                rounds.push_back({here(of.offset), here(of.slope)});
            }
        }
    }
}

template void Blocking::collect(const ConeRanges&, const std::vector<ConeFrame<FourDoubles>>&,
                                const StepOfCones<FourDoubles>&, const StepOfCones<FourDoubles>&, double);
template void Blocking::collect(const ConeRanges&, const std::vector<ConeFrame<double>>&,
                                const StepOfCones<double>&, const StepOfCones<double>&, double);

Weight Blocking::best(double least) const
{
    // Four weights at a time, from 1 down.
    constexpr int intervals = 12;
    constexpr int packs = intervals / countOf<FourDoubles> + 1;
    std::array<FourDoubles, packs> weights;
    std::array<FourDoubles, packs> steepest;
    for (int pack = 0; pack < packs; ++pack)
    {
        const FourDoubles interval = FourDoubles(0, 1, 2, 3) + countOf<FourDoubles> * pack;
        weights[pack] = 1 - (1 - least) * interval / intervals;
        steepest[pack] = 1 / farthestStep;
    }
    const auto limit = [&](const auto& steepnessAt)
    {
        for (int pack = 0; pack < packs; ++pack)
        {
            steepest[pack] = larger(steepest[pack], steepnessAt(weights[pack]));
        }
    };
    for (const Line& line : found.lines)
    {
        limit([&line](const FourDoubles& weight) { return line.offset + weight * line.slope; });
    }
    for (const Round<double>& round : rounds)
    {
        const auto all = [](const ConeSteepness<double>& one) -> ConeSteepness<FourDoubles> {
            return {one.plus, one.minus, one.across};
        };
        const Round<FourDoubles> copies{all(round.offset), all(round.slope)};
        limit([&copies](const FourDoubles& weight) { return copies.at(weight); });
    }
    Weight best;
    for (int interval = 0; interval <= intervals; ++interval)
    {
        const int pack = interval / countOf<FourDoubles>;
        const int one = interval % countOf<FourDoubles>;
        const double step = 1 / steepest[pack][one];
        if (step > best.step * (1 + 1e-9))
        {
            best = {weights[pack][one], step};
        }
    }
    return best;
}

} // namespace drystone
