// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Forces that nearly obey Coulomb's law, near the least ones, by solves with a few factors alone.
#pragma once

#include "conic/ConeProgram.h"

namespace drystone
{

struct SymbolicAnalysis;

struct AlternatingDirectionsSettings
{
    double tolerance = 2e-3;     ///< on the motion, relative to how far the forces take the farthest row of y
    int maximumIterations = 400; ///< one solve each
};

/// Solves, for a program of space with inertia and rigid points without strength,
///
///     Mbar y + A c = f,    z = g + o - A'y,    K contains c,    K* contains z,    z'c = 0,
///     o_n = mu |u_t|,      u_t = (A'y - g)_t    at each point,
///
/// which is Coulomb's law (De Saxce & Feng 1998), by the method of multipliers in alternating directions
/// (Boyd et al. 2011; for contacts Tasora, Mangoni, Benatti & Garziera 2021): with w for z, in the form's
/// dimensionless cones, which are their own duals, and a penalty sigma, each iteration is
///
///     w = projection of v,   c = sigma (w - v),
///     (Mbar + sigma B B') y = f + B (sigma (g + o - w) - c),
///     v += relaxation (g + o - B'y - w),   o = |z_t|.
///
/// Begun without forces it leads to forces near the least of those that rigid points may carry, as points
/// that give way do (ContactPath.h): joints keep no pressure that nothing asks of them and that would hold
/// the blocks back. Where paths are lost, in large structures of space, that is the way to such a motion. It
/// comes within some per cent of what the step changes and then becomes slow: a program with its openings is
/// to follow.
/// \param expected motion that forces change, R b: where the iterations begin
/// \param symbolic brought up to date
/// \return what was reached, `optimal` where the motion has settled to the tolerance, else `notConverged`
/// \throws std::invalid_argument for a program of another kind
ConeSolution solveAlternatingDirections(const SpaceConeProgram& program, const Eigen::VectorXd& expected,
                                        const AlternatingDirectionsSettings& settings,
                                        SymbolicAnalysis& symbolic);

} // namespace drystone
