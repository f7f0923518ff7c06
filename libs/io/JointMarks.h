// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which joints of a mechanism turn and which slide, and where: the marks of its picture.
#pragma once

#include "contact/ContactPoint.h"
#include "io/Mechanism.h"

#include <vector>

namespace drystone
{

enum class JointMotion
{
    hinge,  ///< the blocks part, but stay together along a line or at a corner
    sliding ///< they slide on each other
};

struct JointMark
{
    JointMotion motion = JointMotion::hinge;
    int block = -1, neighbour = -1; ///< as of the contact points
    /// As built, in the plane with z = 0 [m]: of a hinge the two ends of its line, or one corner; of a
    /// sliding joint the corners of its convex hull, in order round it, in the plane its two ends.
    std::vector<Vector<3>> points;
};

/// The joints whose blocks move relative to each other by the mechanism, faster than 1e-3 of the fastest
/// pair. At a point with the opening n and the slip t (rates of the blocks apart, to first order) they stay
/// together where both are slower than that, slide where n <= mu |t|, and part elsewhere. A joint with points
/// that stay together and others that part is a hinge; one without the former that has sliding points slides;
/// what parts altogether has no mark.
/// \param points those of one joint follow each other \param friction mu of each
template<int Dim>
std::vector<JointMark> jointMarks(const Assembly<Dim>& assembly, const std::vector<ContactPoint<Dim>>& points,
                                  const std::vector<double>& friction,
                                  const std::type_identity_t<Rates<Dim>>& rates);

} // namespace drystone
