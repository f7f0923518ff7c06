// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analysis of the part of a large structure that its live load reaches, with a proof that no mechanism
/// reaches farther: `selection automatic`.
#pragma once

#include "conic/BalancedForces.h"
#include "statics/LimitAnalysis.h"

namespace drystone
{

/// How a structure carries its dead load, kept from one live load to the next.
template<int Rows, int Forces>
struct CarriedDeadLoad
{
    Eigen::VectorXd load;         ///< f, rows of each free block; empty: nothing is known
    Eigen::VectorXd contactForce; ///< c_D, of each contact point [N]; empty: this load is not carried
    std::optional<ForceChanges<Rows, Forces>> changes; ///< of c_D; made when they are needed
};

/// Limit analysis in small programs, where the live load acts on some blocks only.
///
/// 1. Forces c_D that carry the dead load of the whole structure, inside their cones; found once for all live
///    loads.
/// 2. The blocks that the live load acts on, and some about them, with all others held as one with the
///    ground. Its mechanism, extended by zero, is one of the whole: the points that it opens are all in this
///    program. So alpha of the whole is not larger.
/// 3. The least change of c_D that carries alpha times live load in addition; far from the live load it is
///    small.
/// 4. The blocks that the mechanism leaves at rest, and more of them about it, under what the
///    blocks that move give them, and what the forces of 3 give them from beyond. If forces balance this,
///    they are, with those of 2 where blocks move and those of 3 beyond, forces of the whole under the same
///    alpha, and so alpha of the whole is not smaller.
///
/// The answer has the certificate of the program of the whole (Certificate.h), like any other. Where the live
/// load acts on too much, or no part up to a third of the blocks stands for the whole, nothing is returned
/// and the whole is to be solved.
/// \param program of the whole \param carried is brought up to date \param kept of programs of the whole,
/// see solveLimitAnalysis
/// \return the answer, its simulated blocks those of 2; or nothing
template<int Rows, int Forces>
std::optional<LimitAnalysis>
analyseReachedPart(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                   CarriedDeadLoad<Rows, Forces>& carried, SymbolicAnalysis& kept);

} // namespace drystone
