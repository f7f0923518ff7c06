// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Forces that a search for collapses by Coulomb's law starts from: all carry the dead load, and differ in
/// what else they suit.
#pragma once

#include "statics/CoulombExchange.h"

#include <optional>
#include <random>

namespace drystone
{

/// Forces and what they carry in addition to the dead load.
struct CollapseStart
{
    double alpha = 0;
    Eigen::VectorXd contactForce;
};

/// In [0, 1), the same on every machine.
double uniform(std::mt19937& generator);

/// A start off the limits of its joints. \param resting forces for the dead load, of which a share comes in
CollapseStart movedInwards(double alpha, const Eigen::VectorXd& contactForce, const Eigen::VectorXd& resting);

/// Forces for the dead load alone. \return none where there are no such
template<int Rows, int Forces>
std::optional<Eigen::VectorXd> restingForces(const ConeProgram<Rows, Forces>& given,
                                             const ProgramSolver<Rows, Forces>& solve);

/// Forces for the dead load with little pressure at random points, not moved inwards.
/// \return none where that program is not solved
template<int Rows, int Forces>
std::optional<Eigen::VectorXd> randomRestingForces(const ConeProgram<Rows, Forces>& given,
                                                   std::mt19937& generator,
                                                   const ProgramSolver<Rows, Forces>& solve);

/// Forces of a low multiplier that suit the mechanism of a pair, not moved inwards: those of the program with
/// the penalty gamma (NonAssociative.h). \return none where that program is not solved
template<int Rows, int Forces>
std::optional<CollapseStart> lowForces(const ConeProgram<Rows, Forces>& given, const CoulombPair& pair,
                                       double gamma, const ProgramSolver<Rows, Forces>& solve);

} // namespace drystone
