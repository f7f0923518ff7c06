// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The line of thrust through the blocks of a plane structure, as pictures draw it.
#pragma once

#include "io/JointForces.h"

namespace drystone
{

/// A part of the line of thrust within one block.
struct ThrustSegment
{
    Vector<2> from = Vector<2>::Zero(); ///< centre of pressure of a joint [m]
    Vector<2> to =
        Vector<2>::Zero(); ///< that of the block's other joint, or where its forces are gathered [m]
    double force = 0;      ///< of the joint [N]
};

/// Connects the centres of pressure of the joints of each free block. A block between two joints has one
/// segment from the one to the other, which is the line of thrust of an arch. In a block of more joints, as
/// in a wall, there is one line from each joint to the mean of their centres weighted by their forces, so
/// that what is drawn stays within a convex block. Joints that carry less than `least` of the largest force
/// are left out. \param free whether each block is free
std::vector<ThrustSegment> thrustSegments(const std::vector<JointForce<2>>& joints,
                                          const std::vector<bool>& free, double least = 1e-3);

} // namespace drystone
