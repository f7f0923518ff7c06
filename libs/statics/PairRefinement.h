// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The last digits of a pair of forces and mechanism: Coulomb's law as equations, once it is known which
/// points stick, slide and part.
#pragma once

#include "statics/CoulombExchange.h"

namespace drystone
{

/// A pair near another one, which nearly obeys Coulomb's law. Its points stick, slide or are open as they do
/// in that, and so the law has nothing but equations: with n, t for the forces, s = (A'y)_t for the slip,
///
///     A c = f + alpha L,    L'y = 1,
///     sticks: A'y = 0;    slides: (A'y)_n = 0,  t = (C + mu n) s / |s|;    open: c as it is.
///
/// Forces are not unique, and in space a shear that is below its limit by a part d of it may be off the slip
/// by the angle sqrt(2 d), 1e-5 for 1e-10: so far interior points and paths leave it. The nearest solution is
/// found by the method of Levenberg and Marquardt (Nocedal & Wright 2006, section 10.3), which goes to a
/// solution quadratically though the equations have many. Points that pull in it are opened, those that close
/// are closed, and it is found anew. Forces of points that stick may be beyond their limits: nearestPair
/// (CoulombExchange.h) has those that are not.
/// \param slidesFrom points whose slip is less than this share of the largest rate stick
/// \param isOver called before each step; may be empty
/// \return whatever it ends with: judge it. None where a point crushes, which has no equations here, and
/// where it is over
template<int Rows, int Forces>
std::optional<CoulombPair> refinedPair(const ConeProgram<Rows, Forces>& given, const CoulombPair& pair,
                                       double slidesFrom, const std::function<bool()>& isOver = {});

} // namespace drystone
