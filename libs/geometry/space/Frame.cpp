// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The frame of a plane, one for contact points and patches, so that shear means the same everywhere.
#include "geometry/space/Frame.h"

#include <Eigen/Geometry>

#include <cmath>

namespace drystone
{

Eigen::Matrix3d frameOf(const Vector<3>& normal)
{
    Eigen::Matrix3d frame;
    frame.col(0) = normal;
    const double horizontal = std::hypot(normal.x(), normal.y());
    // A face that is level but for rounding has no horizontal direction of its own.
    frame.col(1) = horizontal > 1e-6 ? Vector<3>(-normal.y() / horizontal, normal.x() / horizontal, 0)
                                     : (Vector<3>::UnitX() - normal.x() * normal).normalized();
    frame.col(2) = normal.cross(frame.col(1));
    return frame;
}

} // namespace drystone
