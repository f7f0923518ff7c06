// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Pairs of forces and mechanism that a search by Coulomb's law has met: their judgement, and which of them
/// are kept. How they are met says CollapseSearch.h.
#pragma once

#include "statics/CoulombExchange.h"
#include "statics/LimitAnalysis.h"
#include "statics/ProperFrame.h"

#include <functional>

namespace drystone
{

/// What a search has found so far.
struct FoundPairs
{
    CoulombRange range;
    CoulombPair lowest;
    CoulombPair latest;
    CoulombPair fall;            ///< the lowest, on whose mechanism the live load does no work
    CoulombPair below;           ///< the highest of those below zero
    bool isByRefinement = false; ///< all pairs are near the ends of paths, but were not met by them
};

/// What pairs are judged by. Program and frame are those of the search, and outlive this.
template<int Rows, int Forces>
struct PairCriterion
{
    const ConeProgram<Rows, Forces>& structure; ///< as it is in its own axes, in which pairs are judged
    const ProperFrame<Rows, Forces>& frame;     ///< in which forces and mechanisms of pairs are
    double tolerance;                           ///< on the residuals
    double most; ///< multiplier of the associative law in the frame, which no pair exceeds; or infinity
};

/// Judges a pair, whose residuals become those in the structure, and keeps it if it meets the tolerance.
/// \return whether it does, at a multiplier that is not below zero
template<int Rows, int Forces>
bool consider(CoulombPair& pair, const PairCriterion<Rows, Forces>& criterion, FoundPairs& found);

/// Judges blocks that fall under the dead load alone, and keeps them if they meet the tolerance at a lower
/// multiplier than those before.
template<int Rows, int Forces>
void considerFall(CoulombPair pair, const PairCriterion<Rows, Forces>& criterion, FoundPairs& found);

/// Considers a pair, or else the pair near it, which it becomes. \param solve for the programs of refinement
/// \param isOver whether no more is to be tried \return whether there is one
template<int Rows, int Forces>
bool considerRefined(CoulombPair& pair, const PairCriterion<Rows, Forces>& criterion, FoundPairs& found,
                     const ProgramSolver<Rows, Forces>& solve, const std::function<bool()>& isOver);

} // namespace drystone
