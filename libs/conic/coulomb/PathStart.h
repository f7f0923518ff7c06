// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where a contact path begins: the pieces of the law that known forces are on. Internal to ContactPath.
#pragma once

#include "conic/coulomb/SlidingLaw.h"

#include <vector>

namespace drystone
{

/// A place of the path that has given forces. F: forces a point, k: points.
template<int Forces>
struct PathStart
{
    Eigen::VectorXd w;                      ///< w0 with law(w0) = c0, F k
    std::vector<PointState<Forces>> states; ///< of each point
};

/// States and w0 of forces: of what they leave open, such as how far an open point is from closing, as near
/// as may be to what the displacements of the start say.
/// \param force c0, F k \param ofDisplacement k (A'y - g), F k
template<int Forces>
PathStart<Forces> pathStart(const std::vector<SlidingLaw>& laws, const Eigen::VectorXd& force,
                            Eigen::VectorXd ofDisplacement);

extern template PathStart<2> pathStart<2>(const std::vector<SlidingLaw>&, const Eigen::VectorXd&,
                                          Eigen::VectorXd);
extern template PathStart<3> pathStart<3>(const std::vector<SlidingLaw>&, const Eigen::VectorXd&,
                                          Eigen::VectorXd);

} // namespace drystone
