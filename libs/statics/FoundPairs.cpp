// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Residuals of pairs in the axes of the structure, and the lowest of those that meet the tolerance.
#include "statics/FoundPairs.h"

#include "statics/PairRefinement.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

/// Pairs that obey the law to this are refined, with points of less slip than each of these in turn at rest.
constexpr double nearlyPair = 2e-3;
constexpr std::array<double, 3> restingSlips{1e-6, 1e-4, 1e-2};

/// How far a pair is from the law, in the structure. \param liveWork what the live load's work has to be
template<int Rows, int Forces>
CoulombResiduals judged(const CoulombPair& pair, const PairCriterion<Rows, Forces>& criterion,
                        double liveWork)
{
    const CoulombPair turned = criterion.frame.inGiven(pair);
    return coulombResiduals(criterion.structure, turned.alpha, turned.contactForce, turned.mechanism,
                            liveWork);
}

/// Takes the pair to its last digits, where it is near one. \return whether that is one
template<int Rows, int Forces>
bool refine(CoulombPair& pair, const PairCriterion<Rows, Forces>& criterion, FoundPairs& found,
            const ProgramSolver<Rows, Forces>& solve, const std::function<bool()>& isOver)
{
    const ConeProgram<Rows, Forces>& given = criterion.frame.program;
    const double worst = pair.residuals.worst();
    if (!(worst <= nearlyPair) || worst <= criterion.tolerance) // of which one is below zero
    {
        return false;
    }
    for (const double slip : restingSlips)
    {
        std::optional<CoulombPair> refined = refinedPair<Rows, Forces>(given, pair, slip, isOver);
        if (!refined)
        {
            return false;
        }
        if (consider(*refined, criterion, found))
        {
            pair = std::move(*refined);
            return true;
        }
        // Where the mechanism is right the forces that suit it are many, not all of them within their
        // limits.
        std::optional<CoulombPair> within = refined->residuals.flow <= criterion.tolerance
                                                ? nearestPair<Rows, Forces>(given, *refined, solve)
                                                : std::nullopt;
        if (within && consider(*within, criterion, found))
        {
            pair = std::move(*within);
            return true;
        }
    }
    return false;
}

} // namespace

template<int Rows, int Forces>
bool consider(CoulombPair& pair, const PairCriterion<Rows, Forces>& criterion, FoundPairs& found)
{
    pair.alpha = std::min(pair.alpha, criterion.most); // which it exceeds by rounding alone
    pair.residuals = judged(pair, criterion, 1);
    if (!(pair.residuals.worst() <= criterion.tolerance))
    {
        return false;
    }
    // Below zero the mechanism would be driven by the dead load, which is carried where loading begins. At
    // zero, as where a stone that hangs at an edge turns about it, nothing drives it.
    CoulombRange& range = found.range;
    if (pair.alpha < (std::isfinite(range.associative) ? criterion.tolerance * range.associative : 0))
    {
        if (!found.below.exists() || pair.alpha > found.below.alpha)
        {
            found.below = pair;
        }
        return false;
    }
    range.lowest = std::min(range.lowest, pair.alpha);
    range.highest = std::max(range.highest, pair.alpha);
    found.latest = pair;
    if (!(pair.alpha >= found.lowest.alpha))
    {
        found.lowest = pair;
    }
    return true;
}

template<int Rows, int Forces>
void considerFall(CoulombPair pair, const PairCriterion<Rows, Forces>& criterion, FoundPairs& found)
{
    pair.residuals = judged(pair, criterion, 0);
    if (pair.alpha >= 0 && pair.residuals.worst() <= criterion.tolerance && pair.alpha < found.fall.alpha)
    {
        found.range.fall = pair.alpha;
        found.fall = std::move(pair);
    }
}

template<int Rows, int Forces>
bool considerRefined(CoulombPair& pair, const PairCriterion<Rows, Forces>& criterion, FoundPairs& found,
                     const ProgramSolver<Rows, Forces>& solve, const std::function<bool()>& isOver)
{
    const bool isFirst = !found.lowest.exists();
    if (consider(pair, criterion, found))
    {
        found.isByRefinement = false;
        return true;
    }
    const bool isRefined = refine(pair, criterion, found, solve, isOver);
    found.isByRefinement = found.isByRefinement || (isRefined && isFirst);
    return isRefined;
}

template bool consider(CoulombPair& pair, const PairCriterion<3, 2>& criterion, FoundPairs& found);
template bool consider(CoulombPair& pair, const PairCriterion<6, 3>& criterion, FoundPairs& found);
template void considerFall(CoulombPair pair, const PairCriterion<3, 2>& criterion, FoundPairs& found);
template void considerFall(CoulombPair pair, const PairCriterion<6, 3>& criterion, FoundPairs& found);
template bool considerRefined(CoulombPair& pair, const PairCriterion<3, 2>& criterion, FoundPairs& found,
                              const ProgramSolver<3, 2>& solve, const std::function<bool()>& isOver);
template bool considerRefined(CoulombPair& pair, const PairCriterion<6, 3>& criterion, FoundPairs& found,
                              const ProgramSolver<6, 3>& solve, const std::function<bool()>& isOver);

} // namespace drystone
