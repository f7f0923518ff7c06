// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Plane sides by a quotient; the round one of a point that sticks in space by the length of a line in a
/// disc.
#include "conic/coulomb/PathExit.h"

#include <algorithm>
#include <limits>

namespace drystone
{

template<int Forces>
PathExit<Forces> firstExit(const std::vector<SlidingLaw>& laws, const std::vector<PointState<Forces>>& states,
                           const std::vector<PieceSides<Forces>>& sides, const Eigen::VectorXd& w,
                           const Eigen::VectorXd& rate, double sense, double farthest,
                           const PathExit<Forces>& last)
{
    using Force = Eigen::Matrix<double, Forces, 1>;
    constexpr int most = 3; // sides of a piece that are plane
    int found = -1;
    int foundSide = 0;
    double length = farthest;
    for (int point = 0; point < static_cast<int>(laws.size()); ++point)
    {
        const Force trial = w.template segment<Forces>(Forces * point);
        const Force change = sense * rate.template segment<Forces>(Forces * point);
        const PieceSides<Forces>& of = sides[static_cast<std::size_t>(point)];
        for (int i = 0; i < of.count; ++i)
        {
            const PieceSide<Forces>& side = of.side[static_cast<std::size_t>(i)];
            const double growth = side.normal.dot(change);
            const double inside = -(side.normal.dot(trial) + side.offset);
            if (growth > 0 && inside < length * growth
                && !(point == last.point && side.normal == -last.side.normal))
            {
                found = point;
                foundSide = i;
                length = std::max(0.0, inside / growth);
            }
        }
        if constexpr (Forces > 2)
        {
            const PointState<Forces>& state = states[static_cast<std::size_t>(point)];
            const ShearLimit limit = shearLimit(laws[static_cast<std::size_t>(point)], state);
            const bool cameIn = point == last.point && !last.side.normal.template tail<2>().isZero(0);
            const DiscPlace place = cameIn ? DiscPlace::rim : DiscPlace::inside;
            const double toRound = state.sticks() && limit.isThere()
                                       ? lengthInDisc(limit, trial, change, place)
                                       : std::numeric_limits<double>::infinity();
            if (toRound < length)
            {
                found = point;
                foundSide = most;
                length = toRound;
            }
        }
    }
    if (found < 0)
    {
        return {-1, {}, length};
    }
    const auto at = static_cast<std::size_t>(found);
    if constexpr (Forces > 2)
    {
        if (foundSide == most)
        {
            const Force on = w.template segment<Forces>(Forces * found)
                             + sense * length * rate.template segment<Forces>(Forces * found);
            return {found, roundSide(shearLimit(laws[at], states[at]), states[at], on), length};
        }
    }
    return {found, sides[at].side[static_cast<std::size_t>(foundSide)], length};
}

template PathExit<2> firstExit(const std::vector<SlidingLaw>&, const std::vector<PointState<2>>&,
                               const std::vector<PieceSides<2>>&, const Eigen::VectorXd&,
                               const Eigen::VectorXd&, double, double, const PathExit<2>&);
template PathExit<3> firstExit(const std::vector<SlidingLaw>&, const std::vector<PointState<3>>&,
                               const std::vector<PieceSides<3>>&, const Eigen::VectorXd&,
                               const Eigen::VectorXd&, double, double, const PathExit<3>&);

} // namespace drystone
