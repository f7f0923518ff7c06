// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What is known of each algorithm of a search.
#include "ensembles/SearchStage.h"

#include <algorithm>

namespace drystone
{

std::string_view nameOf(SearchAlgorithm algorithm)
{
    for (const auto& [name, value] : namesOf(algorithm))
    {
        if (value == algorithm)
        {
            return name;
        }
    }
    return {};
}

bool isGlobal(SearchAlgorithm algorithm)
{
    using enum SearchAlgorithm;
    return algorithm == DIRECT || algorithm == DIRECT_L || algorithm == CRS2_LM || algorithm == ISRES
           || algorithm == ESCH;
}

bool takesConstraints(SearchAlgorithm algorithm)
{
    using enum SearchAlgorithm;
    return algorithm == bisection || algorithm == DIRECT || algorithm == DIRECT_L || algorithm == ISRES
           || algorithm == COBYLA;
}

std::string doubtAbout(const std::vector<SearchStage>& search)
{
    const bool hasPraxis =
        std::any_of(search.begin(), search.end(),
                    [](const SearchStage& stage) { return stage.algorithm == SearchAlgorithm::PRAXIS; });
    return hasPraxis ? "PRAXIS knows no bounds: it steps beyond them, where nothing is computed, and an "
                       "optimum at a bound may be missed. Usual are BOBYQA, or SBPLX where the objective "
                       "has kinks: they keep to the bounds."
                     : "";
}

void declare(Options& options, SearchStage& stage)
{
    options.required("algorithm", stage.algorithm, "bisection, or one of NLopt").example("BOBYQA");
    options.optional("maximumEvaluations", stage.maximumEvaluations, "of the objective").atLeast(1);
    options
        .optional("tolerance", stage.tolerance,
                  "a local algorithm ends when variables change by less, as part of the width of the bounds")
        .above(0)
        .below(1);
    options.optional("objectiveTolerance", stage.objectiveTolerance, "... or the objective does").atLeast(0);
    options.optional("stopValue", stage.stopValue, "ends as soon as the objective is as good as this")
        .example("1e-9");
    options.optional("population", stage.population, "of CRS2_LM, ISRES and ESCH; 0: as NLopt chooses")
        .atLeast(0)
        .atMost(100000);
}

} // namespace drystone
