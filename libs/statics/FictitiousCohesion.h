// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Coulomb's law by programs of the associative law in turn, in which a cohesion takes the place of friction:
/// the move of non-associative limit analysis whose price grows no faster than that of one program.
#pragma once

#include "statics/CoulombExchange.h"

#include <functional>
#include <optional>

namespace drystone
{

/// What the programs of pairByCohesion are solved and its pairs judged with.
template<int Rows, int Forces>
struct CohesionTools
{
    ProgramSolver<Rows, Forces> roughly; ///< to a hundredth, say: see there
    ProgramSolver<Rows, Forces> exactly;
    std::function<bool(CoulombPair&)> isPair; ///< whether a pair obeys the law; sets its residuals
    std::function<bool()> isOver;             ///< whether to end without a pair
    std::function<void(int round, double multiplier)> observe;
};

/// A pair as the fixed point of programs of the associative law (Gilbert, Casapulla & Ahmed 2006), in which
/// point k, that pressed with n' in the program before, has
///
///     |t| <= C + psi n + (mu - psi) n',    psi = q mu,
///
/// friction psi and the cohesion that makes it carry what Coulomb's law allows where n = n'. What slides
/// opens by psi times its slip; q falls from one to a ten-thousandth. These programs are solved roughly: near
/// the middle of the forces that are possible, where they are unique and change little from one program to
/// the next, while those at the end of a program are one choice of many, and n' never settles.
///
/// That comes to a thousandth of the law and no further, but to the mechanism. From q = 1/100 on it is taken
/// every few rounds from a program with q = 0, solved exactly, in which nothing opens as it slides. Of the
/// forces that suit it by Coulomb's law (nearestPair) those nearest to balance are taken; their pressures
/// are the next n', and so in turn while what is out of balance falls. What falls to the tolerance is a pair.
///
/// \param forces F k, whose pressures are the first n' \return none where no round has led to a pair, as
/// where the pressures of one do not carry the dead load in the next: of the published cross vault they swing
/// between two states
template<int Rows, int Forces>
std::optional<CoulombPair> pairByCohesion(const ConeProgram<Rows, Forces>& given,
                                          const Eigen::VectorXd& forces,
                                          const CohesionTools<Rows, Forces>& tools);

/// The mechanism of the program with q = 0, in which each point has the shear that Coulomb's law allows with
/// pressures n', and the forces that the law names where it opens or crushes: one program, and mostly another
/// mechanism than that of a path. What else suits it leastPair knows (CoulombExchange.h).
/// \param pressure n', one a point \return none where that program has no collapse
template<int Rows, int Forces>
std::optional<CoulombPair> mechanismOfPressures(const ConeProgram<Rows, Forces>& given,
                                                const Eigen::VectorXd& pressure,
                                                const ProgramSolver<Rows, Forces>& solve);

} // namespace drystone
