// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Whether joints that are stated belong to the blocks: nothing else compares the two.
#pragma once

#include "assembly/Assembly.h"

#include <string>
#include <utility>
#include <vector>

namespace drystone
{

/// A stated joint with a point that is not on both of its blocks.
struct MisplacedJoint
{
    int joint = -1;    ///< index into Assembly::statedJoints
    int block = -1;    ///< that the point is off
    Vector<3> point;   ///< [m]
    double farOff = 0; ///< how far from the surface of the block [m]
};

/// Points of stated joints lie on the surface of both blocks up to this [m]: what closed joints may be off
/// by, or, as the interfaces of files are rounded too, a hundredth of the mean block size.
double statedJointTolerance(const Assembly<3>& assembly);

/// Stated joints beyond that, each with its farthest point; the farthest first.
std::vector<MisplacedJoint> misplacedJoints(const Assembly<3>& assembly);

/// Pairs of blocks, not both fixed, that share a part of a face and have no stated joint; empty where no
/// joint is stated. Sorted.
std::vector<std::pair<int, int>> facesWithoutStatedJoint(const Assembly<3>& assembly);

/// What to say of misplaced joints, and how to repair them; empty where there are none.
std::string misplacedJointsText(const Assembly<3>& assembly);

/// What to say of faces without a stated joint; empty where there are none.
std::string facesWithoutStatedJointText(const Assembly<3>& assembly);

} // namespace drystone
