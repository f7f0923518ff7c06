// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Block Gauss-Seidel solver for programs with inertia: the usual method of the field, for low accuracy.
#pragma once

#include "conic/ConeProgram.h"

namespace drystone
{

/// Keys of `solver gaussSeidel;`.
struct GaussSeidelSettings
{
    double tolerance = 1e-4;       ///< on every figure of the certificate
    int maximumIterations = 10000; ///< sweeps over the contact points allowed
};

/// Solves a program with inertia (a time step), plane or in space, one contact point after the other (block
/// non-linear Gauss-Seidel: Jourdan, Alart & Jean 1998, here with the associative law). With
/// y = Mbar^-1 (f - A c) the forces alone are left,
///
///     minimise  1/2 c' W c + (g - A' Mbar^-1 f)' c   over c in K,     W = A' Mbar^-1 A,
///
/// and each point in turn gets the force that is best for it while all others stand,
///
///     minimise  1/2 c_k' W_kk c_k + b_k' c_k   over |t| <= mu n,     b_k = z_k - W_kk c_k (before),
///
/// which is solved exactly. Sweeps go up and down in turn. Nothing is factorised: a sweep costs a few
/// products with A, but their number grows with the number of blocks that forces must pass through, with the
/// ratio of masses, and without limit where forces are not unique. Use it for loose tolerances, or to see
/// what loose tolerances do.
///
/// The balance of forces and the cones hold to rounding at any time; what is missing shows as overlap (dual
/// residual) and gap of the certificate.
///
/// \param start contact forces to begin with (F k), or empty; displacements are not looked at
/// \return `optimal` when the certificate meets the tolerance, otherwise `notConverged` with the last forces
/// \throws std::invalid_argument for a program without inertia, with a multiplier or, in space, with
/// strengths
template<int Rows, int Forces>
ConeSolution solveGaussSeidel(const ConeProgram<Rows, Forces>& program, const ConeSolution& start,
                              const GaussSeidelSettings& settings = {});

/// The least 1/2 c' W c + b' c in a friction cone |t| <= mu n. \param W symmetric positive definite
Eigen::Vector2d leastInCone(const Eigen::Matrix2d& W, const Eigen::Vector2d& b, double mu);
Eigen::Vector3d leastInCone(const Eigen::Matrix3d& W, const Eigen::Vector3d& b, double mu);

/// Likewise in what a point of the plane with strengths can carry.
Eigen::Vector2d leastInSet(const Eigen::Matrix2d& W, const Eigen::Vector2d& b, double mu,
                           const Strength& strength);

} // namespace drystone
