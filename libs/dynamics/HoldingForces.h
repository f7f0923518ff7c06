// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The forces that hold the blocks within bodies together, and those that are held at rest. In this library
/// since they belong to the program of a step.
#pragma once

#include "conic/Certificate.h"
#include "dynamics/BlockGroups.h"

namespace drystone
{

/// Forces at the points within bodies, or why there are none.
struct HoldingForces
{
    bool isFound = false;
    Certificate certificate;          ///< of the balance of the blocks within the bodies
    std::vector<std::size_t> failing; ///< points of the step where forces leave their cones; none: nothing
                                      ///< is known
};

/// Finds forces c_I in the cones at the closed points within the bodies with A_I c_I = f - Mbar y - A_O c_O,
/// by which each block has its share of the motion of its body, or stays where it is. They are the nearest to
/// those of the last step, by one factorisation (conic/BalancedForces.h), no farther to the surface of the
/// cones than the margin; where these leave the cones at some points those around are found anew. Points that
/// are as good as closed, to a gap that is kept, count as closed. Certified to the tolerance of the step.
/// \param missing f - Mbar y - A_O c_O, rows of all blocks \param forces F k of the program of all blocks;
/// those within the bodies are put in where they are found
template<int Dim>
HoldingForces findHoldingForces(Step<Dim>& step, const BlockGroups<Dim>& groups, Eigen::VectorXd missing,
                                Eigen::VectorXd& forces);

} // namespace drystone
