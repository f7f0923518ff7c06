// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/interiorPoint/StepLength.h"

#include "core/Threads.h"

namespace drystone
{

double stepToBoundary(const ConeRanges& cones, const std::vector<ConeFrame>& frames, const StepOfCones& step)
{
    return 1 / std::max(steepestOf(cones, step.x, step.dx, frames, step.scaled), 1 / farthestStep);
}

double Blocking::Round::at(double weight) const
{
    return ConeSteepness{offset.plus + weight * slope.plus, offset.minus + weight * slope.minus,
                         offset.across + weight * slope.across}
        .steepest();
}

void Blocking::clear()
{
    found.lines.clear();
    found.floor = 1 / farthestStep;
    rounds.clear();
}

void Blocking::collectRays(const StepOfCones& step, const StepOfCones& correction, double least,
                           Eigen::Index begin, Eigen::Index end, Found& found)
{
    const Eigen::VectorXd& x = step.x;
    const Eigen::VectorXd& dx = step.dx;
    const Eigen::VectorXd& c = correction.dx;
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

void Blocking::collect(const ConeRanges& cones, const std::vector<ConeFrame>& frames, const StepOfCones& step,
                       const StepOfCones& correction, double least)
{
    if (partsOf(cones.rays) == 1)
    {
        collectRays(step, correction, least, 0, cones.rays, found);
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
                     collectRays(step, correction, least, begin, end, part);
                 });
        for (const Found& part : parts)
        {
            found.lines.insert(found.lines.end(), part.lines.begin(), part.lines.end());
            found.floor = std::max(found.floor, part.floor);
        }
    }
    for (std::size_t round = 0; round < frames.size(); ++round)
    {
        const auto at = static_cast<Eigen::Index>(3 * round);
        const Round line{steepness(frames[round], step.scaled.segment<3>(at)),
                         steepness(frames[round], correction.scaled.segment<3>(at))};
        // Convex: nowhere between above both ends.
        if (std::max(line.at(1), line.at(least)) > found.floor)
        {
            rounds.push_back(line);
        }
    }
}

Weight Blocking::best(double least) const
{
    constexpr int intervals = 12;
    Weight best;
    for (int interval = 0; interval <= intervals; ++interval)
    {
        const double weight = 1 - (1 - least) * interval / intervals;
        double steepest = 1 / farthestStep;
        for (const Line& line : found.lines)
        {
            steepest = std::max(steepest, line.offset + weight * line.slope);
        }
        for (const Round& round : rounds)
        {
            steepest = std::max(steepest, round.at(weight));
        }
        if (1 / steepest > best.step * (1 + 1e-9))
        {
            best = {weight, 1 / steepest};
        }
    }
    return best;
}

} // namespace drystone
