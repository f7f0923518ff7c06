// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Settlement: what a support still carries when it gives way, and how the structure follows it.
#pragma once

#include "contact/ContactPoint.h"
#include "statics/LimitAnalysis.h"

namespace drystone
{

/// Gaps that open at the points (normal, tangent ...; in space normal, tangent1, tangent2 ...) when a support
/// moves by a unit and all blocks stay.
template<int Dim>
Eigen::VectorXd settlementGaps(const Assembly<Dim>& assembly, const std::vector<ContactPoint<Dim>>& points,
                               const SupportMovement<Dim>& movement);

/// Settlement of a support (Portioli & Cascini 2016): the least reaction R against the movement with which
/// the structure still stands. With g the gaps of a unit movement, g'c is that reaction (the work of c on g),
/// and
///
///     R = min g'c   subject to   A c = f, c in the friction cones;      z = g - A'y,
///
/// where y is the mechanism by which the blocks follow a unit movement.
/// \param program with `gap` from settlementGaps and without live load
///
/// Where the rest stands without the support R is 0, proved by forces that leave it out and by y. Where the
/// support is locked in, any force can push it against its neighbours and R has no lower bound: `unbounded`.
/// \return alpha: R [N]; mechanism: y, for a unit movement; `unstable` as in solveLimitAnalysis; of
/// `unbounded` the contact forces of a unit push
template<int Rows, int Forces>
LimitAnalysis solveSettlement(const ConeProgram<Rows, Forces>& program,
                              const InteriorPointSettings& settings = {});

} // namespace drystone
