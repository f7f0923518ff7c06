// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The algorithms of searches: an entry of the list `search` of system/parameterSearchDict.
#pragma once

#include "dictionary/Options.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// Algorithms of NLopt, by NLopt's names without the first two letters, and one of our own. The global ones
/// search the whole range; the local ones start from the best point known.
enum class SearchAlgorithm
{
    bisection,  ///< of one variable: the end of the range in which constraints hold
    DIRECT,     ///< divides the bounds into boxes; global
    DIRECT_L,   ///< the same, nearer to the best box; global
    CRS2_LM,    ///< random population with local mutation; global
    ISRES,      ///< evolution, with constraints; global
    ESCH,       ///< evolution; global
    BOBYQA,     ///< quadratic models; local
    COBYLA,     ///< linear models, with constraints; local
    SBPLX,      ///< simplex on subspaces, for functions that are not smooth; local
    NELDERMEAD, ///< simplex; local
    PRAXIS      ///< principal axes; local
};
inline std::array<std::pair<std::string_view, SearchAlgorithm>, 11> namesOf(SearchAlgorithm)
{
    using enum SearchAlgorithm;
    return {{{"bisection", bisection},
             {"DIRECT", DIRECT},
             {"DIRECT_L", DIRECT_L},
             {"CRS2_LM", CRS2_LM},
             {"ISRES", ISRES},
             {"ESCH", ESCH},
             {"BOBYQA", BOBYQA},
             {"COBYLA", COBYLA},
             {"SBPLX", SBPLX},
             {"NELDERMEAD", NELDERMEAD},
             {"PRAXIS", PRAXIS}}};
}
std::string_view nameOf(SearchAlgorithm algorithm);
bool isGlobal(SearchAlgorithm algorithm);
bool takesConstraints(SearchAlgorithm algorithm);

/// One algorithm of a sequence, each of which begins with the best point of those before it.
struct SearchStage
{
    SearchAlgorithm algorithm = SearchAlgorithm::BOBYQA;
    int maximumEvaluations = 200;
    double tolerance = 1e-6; ///< a local search ends when variables change by less [width of the bounds]
    double objectiveTolerance = 0;   ///< ... or the objective does
    std::optional<double> stopValue; ///< ends as soon as the objective is as good as this
    int population = 0;              ///< of CRS2_LM, ISRES and ESCH; 0: NLopt's choice
};
void declare(Options& options, SearchStage& stage);

/// What is to be known of the algorithms of a search; empty: nothing.
std::string doubtAbout(const std::vector<SearchStage>& search);

} // namespace drystone
