// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The balance of bodies that touch like the branches of a tree: what every pair gives each other follows
/// from the loads beyond it, one pair after another, without a factor of the whole. In this library because
/// it is of a cone program's forces only.
#pragma once

#include "conic/ConeProgram.h"

#include <optional>
#include <vector>

namespace drystone
{

/// A pair of bodies that touch, seen from the one that has no other pair once those before it in the list are
/// gone.
struct TreeBranch
{
    int begin; ///< of its points
    int end;
    int body;  ///< the outer one
    int other; ///< -1: it is fixed
};

/// The columns of a point that are one body's, which is at it.
template<int Rows, int Forces>
const Eigen::Matrix<double, Rows, Forces>& columnsOn(const ConeColumns<Rows, Forces>& columns, int body)
{
    return columns.first == body ? columns.onFirst : columns.onSecond;
}

/// The pairs of bodies, from the leaves inwards. \return nothing where they close a ring, through what is
/// fixed too, so that forces in it are not known from the loads alone
template<int Rows, int Forces>
std::optional<std::vector<TreeBranch>> branchesOfTree(const ConeProgram<Rows, Forces>& program);

/// As nearestForces (BalancedForces.h), of bodies that touch like a tree: the resultants between each pair
/// follow from the balance, and the forces at its points are those with these resultants that are nearest to
/// the known ones. \param program without multiplier; its inertia, gaps and strengths are not looked at
/// \param branches of the program \param near F k \param tolerance of the balance, of the largest entry of
/// the load \return F k; empty where none balance the load of an outer body. What is not looked at: whether
/// forces are in their cones, and the balance of bodies that are nobody's outer one
template<int Rows, int Forces>
Eigen::VectorXd nearestForcesInTree(const ConeProgram<Rows, Forces>& program,
                                    const std::vector<TreeBranch>& branches, const Eigen::VectorXd& near,
                                    double tolerance);

} // namespace drystone
