// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a search for collapses by Coulomb's law proves, and what it leaves open.
#include "functionObjects/CoulombRangeLog.h"

#include "core/Error.h"
#include "core/Log.h"
#include "functionObjects/LimitAnalysisTables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

/// Which collapses were found, or that there is none, as far as it is proved.
void printCollapses(const CoulombRange& range, const LimitAnalysis& result)
{
    constexpr int manyStarts = 10;
    if (range.converged > 0)
    {
        info("Coulomb's law: lowest of the collapses found, alpha {} to {} ({} of {} starts converged{}); "
             "associative, {} bound: {}",
             alphaText(range.lowest), alphaText(range.highest), range.converged, range.starts,
             range.starts < manyStarts ? ", of which more may find lower ones" : "",
             result.isReversed ? "a lower" : "an upper", alphaText(range.associative));
    }
    else if (isProvedUnbounded(result))
    {
        info("Coulomb's law: provably no collapse, as joints without friction carry any multiple of the live "
             "load");
    }
    else if (result.status == CollapseStatus::unbounded)
    {
        info("Coulomb's law: no collapse found ({} starts), which proves none: {}", range.starts,
             std::isfinite(range.safe)
                 ? fmt::format("any has a multiplier of at {} {}, that of joints without friction",
                               result.isReversed ? "most" : "least", alphaText(range.safe))
                 : "more starts may find one");
    }
    else
    {
        info("Coulomb's law: no collapse found on which the live load does work ({} starts); its multiplier "
             "is at {} that of the associative law, {}{}",
             range.starts, result.isReversed ? "least" : "most", alphaText(range.associative),
             std::isfinite(range.safe)
                 ? fmt::format(", and at {} that of joints without friction, {}",
                               result.isReversed ? "most" : "least", alphaText(range.safe))
                 : "");
    }
}

} // namespace

std::string questionOfLowest(const CoulombRange& range)
{
    constexpr double farBelow = 0.1;
    if (range.converged == 0 || !std::isfinite(range.associative)
        || !(std::abs(range.lowest) < farBelow * std::abs(range.associative)))
    {
        return "";
    }
    return fmt::format(
        "The lowest is {:.1g} of the associative multiplier: see whether its mechanism is one of real "
        "joints. In space a block that turns about one of its corners may need no load, as "
        "all its pressure can stand on that corner, a point, and not on a face.",
        std::abs(range.lowest / range.associative));
}

void printCoulombRange(const CoulombRange& range, const LimitAnalysis& result)
{
    printCollapses(range, result);
    if (const std::string question = questionOfLowest(range); !question.empty())
    {
        info("{}", question);
    }
    if (range.cutShortAfter)
    {
        info("The search was ended by maximumTime after {:.3g} s, before all was tried: {}",
             *range.cutShortAfter,
             range.converged > 0 ? "lower collapses may exist" : "that none was found says little");
    }
    const double sign = result.isReversed ? -1 : 1;
    if (sign * range.fall < sign * range.lowest)
    {
        info("Blocks may fall under the dead load alone from alpha {} on: with other forces at rest, or as "
             "joints beside them are relieved.",
             alphaText(range.fall));
    }
    if (result.status == CollapseStatus::optimal && sign * result.alpha < 0)
    {
        info("The multiplier is {} zero: some forces at rest let the dead load alone drive this mechanism, "
             "while others carry it.",
             result.isReversed ? "above" : "below");
    }
}

template<int Dim>
void printCutShort(const LimitAnalysisCase<Dim>& structure, const std::vector<LimitAnalysis>& results)
{
    if (structure.cutShort == 0)
    {
        return;
    }
    const std::size_t searches = std::max(results.size(), structure.envelope.size());
    const bool isWithoutPair =
        std::any_of(results.begin(), results.end(),
                    [](const LimitAnalysis& result)
                    { return isCutShort(result) && result.status == CollapseStatus::upperBound; })
        || std::any_of(structure.envelope.begin(), structure.envelope.end(),
                       [](const PositionResult& position)
                       { return position.status == CollapseStatus::upperBound; });
    printWarning(
        fmt::format("maximumTime has ended {} for collapses by Coulomb's law before all was tried: {}. Raise "
                    "it, or remove it, to search on.",
                    searches > 1 ? fmt::format("{} of {} searches", structure.cutShort, searches)
                                 : "the search",
                    !isWithoutPair  ? "lower ones than those found may exist"
                    : searches == 1 ? "none was found until then, and no more is known than what the "
                                      "associative law says"
                                    : "where none was found no more is known than what the associative law "
                                      "says, and elsewhere lower ones may exist"),
        structure.solutionLocations.of("nonAssociative/maximumTime"));
}

template void printCutShort(const LimitAnalysisCase<2>& structure, const std::vector<LimitAnalysis>& results);
template void printCutShort(const LimitAnalysisCase<3>& structure, const std::vector<LimitAnalysis>& results);

} // namespace drystone
