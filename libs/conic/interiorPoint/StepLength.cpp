// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/interiorPoint/StepLength.h"

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
    lines.clear();
    rounds.clear();
    floor = 1 / farthestStep;
}

void Blocking::collect(const ConeRanges& cones, const std::vector<ConeFrame>& frames, const StepOfCones& step,
                       const StepOfCones& correction, double least)
{
    const Eigen::VectorXd& x = step.x;
    const Eigen::VectorXd& dx = step.dx;
    const Eigen::VectorXd& c = correction.dx;
    const auto add = [&](double offset, double slope)
    {
        const double one = offset + slope;
        const double other = offset + least * slope;
        if (std::max(one, other) > floor)
        {
            lines.push_back({offset, slope});
            floor = std::max(floor, std::min(one, other));
        }
    };
    constexpr int lanes = 4; // looked at together: few rays block
    using Lanes = Eigen::Array<double, lanes, 1>;
    Eigen::Index ray = 0;
    for (; ray + lanes <= cones.rays; ray += lanes)
    {
        const Lanes slope = -c.segment<lanes>(ray).array();
        const Lanes offset = -dx.segment<lanes>(ray).array();
        const Lanes most = (offset + slope).max(offset + least * slope);
        if ((most - floor * x.segment<lanes>(ray).array()).maxCoeff() > 0)
        {
            for (int lane = 0; lane < lanes; ++lane)
            {
                add(offset[lane] / x[ray + lane], slope[lane] / x[ray + lane]);
            }
        }
    }
    for (; ray < cones.rays; ++ray)
    {
        add(-dx[ray] / x[ray], -c[ray] / x[ray]);
    }
    for (std::size_t round = 0; round < frames.size(); ++round)
    {
        const auto at = static_cast<Eigen::Index>(3 * round);
        const Round line{steepness(frames[round], step.scaled.segment<3>(at)),
                         steepness(frames[round], correction.scaled.segment<3>(at))};
        // Convex: nowhere between above both ends.
        if (std::max(line.at(1), line.at(least)) > floor)
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
        for (const Line& line : lines)
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
