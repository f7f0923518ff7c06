// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Steps in which a part of the blocks provably rests: the program of the others alone, `selection
/// automatic`.
#pragma once

#include "dynamics/Step.h"

namespace drystone
{

/// Solves the step with the blocks that hardly move held as one body with the ground, and proves that this is
/// a solution of the whole. With y_R = 0 of the blocks held, R, the program of the others, M, is
///
///     Mbar_M y_M + A_M c_M = f_M,    z_M = g_M - A_M'y_M,
///
/// c_M the forces of the points that touch a block of M. Together with forces c_R in the cones of the closed
/// points among R and the ground that balance what is left, A_R c_R = f_R - (A c_M)_R, it is a solution of
/// the program of all blocks: each of the conditions of optimality belongs to one of the two, z_R = g_R >= 0
/// and g_R'c_R = 0 among them; y is unique. By Coulomb's law it is one, too, as nothing slides among R. Its
/// certificate is the larger of those of the two parts, with the tolerance of every step. c_R is found from
/// the forces of the last step by one factorisation (conic/BalancedForces.h), no farther to the surface of
/// the cones than the margin.
///
/// Which blocks are held is a guess, from their velocities, that the proof does not depend on; where it is
/// not proved it is tried again with more blocks awake. Not where impacts are instants of their own, which
/// take all blocks together, nor with points that give way or have strengths, nor by Coulomb's law in space,
/// whose iterations end within a part of what the step does, so that two ways to it differ. \return whether
/// `solved.result` is the step; otherwise it is to be solved with all blocks
template<int Dim>
bool solveAwake(Step<Dim>& step);

} // namespace drystone
