// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Time steps of few bodies in the plane that end on nearly the faces of the cones on which they begin, as of
/// columns that rock in one piece: a dense system of a few numbers in place of a form and its factor. In this
/// library because it solves a cone program.
#pragma once

#include "conic/ConeProgram.h"

#include <optional>

namespace drystone
{

/// Whether a program has no more bodies and points than are solved so.
bool areFew(const PlaneConeProgram& program);

/// Solves a program of the plane with inertia by the rays of the friction cones that are active. Each point
/// has the rays d = (1, mu) and (1, -mu), the normal alone without friction. With B = A D, s >= 0 the forces
/// along rays and a set of them that carry,
///
///     Mbar y + B s = f,    B' y = D' g    over the set,
///
/// the change of s from forces s0 follows from (B' Mbar^-1 B) ds = B' y0 - D' g with y0 = Mbar^-1 (f - B s0).
/// Rays whose force becomes negative then leave the set, and others that overlap, D' g - B' y < 0, join it,
/// until it is right: the primal-dual active set method, which is semismooth Newton's (Hintermueller, Ito &
/// Kunisch 2003).
/// \param program without multiplier, strength or compliance
/// \param start of which the forces say where to begin
/// \param tolerance of the certificate
/// \return nothing where bodies or points are not few, forces are not unique or the set does not
/// settle; else the solution, `optimal` by its certificate
std::optional<ConeSolution> solveByActiveRays(const PlaneConeProgram& program, const ConeSolution& start,
                                              double tolerance);

} // namespace drystone
