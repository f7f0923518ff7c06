// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where a contact path leaves its piece of the law. Internal to ContactPath.
#pragma once

#include "conic/coulomb/SlidingLaw.h"

#include <vector>

namespace drystone
{

/// Which point leaves its piece, through which side of it, and after which way.
template<int Forces>
struct PathExit
{
    int point = -1; ///< none
    PieceSide<Forces> side;
    double length = 0; ///< of the way to it, in t; of no point all that the path may go
};

/// The first point to leave its piece along w + s rate.
/// \param states of each point \param sides of the states \param w F k \param rate of w, by t \param sense
/// 1 or -1, in which t goes \param farthest that it may go \param last where the path came in
template<int Forces>
PathExit<Forces> firstExit(const std::vector<SlidingLaw>& laws, const std::vector<PointState<Forces>>& states,
                           const std::vector<PieceSides<Forces>>& sides, const Eigen::VectorXd& w,
                           const Eigen::VectorXd& rate, double sense, double farthest,
                           const PathExit<Forces>& last);

extern template PathExit<2> firstExit(const std::vector<SlidingLaw>&, const std::vector<PointState<2>>&,
                                      const std::vector<PieceSides<2>>&, const Eigen::VectorXd&,
                                      const Eigen::VectorXd&, double, double, const PathExit<2>&);
extern template PathExit<3> firstExit(const std::vector<SlidingLaw>&, const std::vector<PointState<3>>&,
                                      const std::vector<PieceSides<3>>&, const Eigen::VectorXd&,
                                      const Eigen::VectorXd&, double, double, const PathExit<3>&);

} // namespace drystone
