// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Declares the settings of a search.
#include "ensembles/SearchSettings.h"

#include "dictionary/Expression.h"
#include "dictionary/NamesIn.h"
#include "ensembles/Arithmetic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace drystone
{
namespace
{

/// What the algorithm of a stage can not do with the variables and constraints of a search; empty: nothing.
std::string faultOf(const SearchStage& stage, const ParameterSearchSettings& settings)
{
    const bool isBisection = stage.algorithm == SearchAlgorithm::bisection;
    if (isBisection && (settings.variables.size() != 1 || settings.constraints.empty()))
    {
        return "bisection finds where constraints cease to hold, along one variable: give it constraints, "
               "and one variable.";
    }
    if (stage.algorithm == SearchAlgorithm::BOBYQA)
    {
        for (const auto& [name, variable] : settings.variables)
        {
            if (variable.firstStep > 0.5)
            {
                return fmt::format("BOBYQA steps to both sides at first: firstStep of {} can be 0.5 at most.",
                                   name);
            }
        }
    }
    if (stage.algorithm == SearchAlgorithm::CRS2_LM && stage.population > 0
        && static_cast<std::size_t>(stage.population) <= settings.variables.size())
    {
        return fmt::format("CRS2_LM needs more points in its population than there are variables: {} or "
                           "more, or 0.",
                           settings.variables.size() + 1);
    }
    if (settings.constraints.empty() || takesConstraints(stage.algorithm))
    {
        return "";
    }
    std::vector<std::string_view> others;
    for (const auto& [name, algorithm] : namesOf(stage.algorithm))
    {
        if (takesConstraints(algorithm))
        {
            others.push_back(name);
        }
    }
    return fmt::format("{} takes no constraints.\n\nAlgorithms that do: {}", nameOf(stage.algorithm),
                       fmt::join(others, " "));
}

std::string faultOfCases(const ParameterSearchSettings& settings)
{
    const bool isFine =
        !settings.cases.empty() && std::all_of(settings.cases.begin(), settings.cases.end(), isInsideCase);
    return isFine ? ""
                  : "A search changes and reads copies of the case: give a path within the case directory, "
                    "relative to it.";
}

std::string faultOfVariables(const ParameterSearchSettings& settings)
{
    std::set<std::string> names;
    std::set<std::string> places;
    for (const auto& [name, variable] : settings.variables)
    {
        if (std::string fault = faultOfNextName(name, names); !fault.empty())
        {
            return fault;
        }
        if (std::string fault = faultOfNextEntry(variable.place, places); !fault.empty())
        {
            return fault;
        }
    }
    return names.empty() ? "There is no variable." : "";
}

std::string faultOfResults(const ParameterSearchSettings& settings)
{
    const std::vector<std::string> variables = namesIn(settings.variables);
    std::set<std::string> names(variables.begin(), variables.end());
    for (const auto& [name, result] : settings.results)
    {
        if (std::string fault = faultOfNextName(name, names); !fault.empty())
        {
            return fault;
        }
    }
    return "";
}

std::string faultOfObjective(const ParameterSearchSettings& settings)
{
    // Where all are alike any point that meets the constraints is an answer.
    const bool mayBeConstant = !settings.constraints.empty();
    return (mayBeConstant ? faultOfArithmetic : faultOfDependent)(
        settings.objective.value, namesIn(settings.variables, settings.results));
}

std::string faultOfConstraints(const ParameterSearchSettings& settings)
{
    for (const auto& [name, constraint] : settings.constraints)
    {
        if (std::string fault =
                faultOfDependent(constraint.value, namesIn(settings.variables, settings.results));
            !fault.empty())
        {
            return fault;
        }
    }
    return "";
}

std::string faultOfSearch(const ParameterSearchSettings& settings)
{
    if (settings.search.empty())
    {
        return "Give at least one algorithm.";
    }
    for (const SearchStage& stage : settings.search)
    {
        if (std::string fault = faultOf(stage, settings); !fault.empty())
        {
            return fault;
        }
    }
    return "";
}

} // namespace

void declare(Options& options, SearchVariable& variable)
{
    declare(options, variable.place);
    options.required("bounds", variable.bounds, "smallest and largest value tried").example("(0.05 0.3)");
    options.optional("start", variable.start, "where local algorithms begin; absent: the value in the file")
        .example("0.15");
    options
        .optional("firstStep", variable.firstStep, "of local algorithms, as part of the width of the bounds")
        .above(0)
        .atMost(1);
    options.check(
        "bounds",
        [&variable]
        {
            return !(variable.bounds[0] < variable.bounds[1])
                       ? "The range between these bounds is empty: give the lower one first."
                   : std::isfinite(variable.bounds[1] - variable.bounds[0])
                       ? ""
                       : "The range between these bounds is too wide for numbers: give nearer ones.";
        });
    options.check("start",
                  [&variable]
                  {
                      return !variable.start
                                     || (variable.bounds[0] <= *variable.start
                                         && *variable.start <= variable.bounds[1])
                                 ? ""
                                 : "The start lies outside the bounds: give a value between them.";
                  });
}

void declare(Options& options, SearchResult& result)
{
    declare(options, result.figure);
    options
        .optional("otherwise", result.otherwise,
                  "used where there is no finite number: the structure does not stand, or an application "
                  "failed; absent: that ends the search")
        .example("-0.1");
}

void declare(Options& options, SearchObjective& objective)
{
    options.required("goal", objective.goal, "whether the value is minimised or maximised")
        .example("minimise");
    options.required("value", objective.value, "arithmetic of variables and results").example("thickness");
}

void declare(Options& options, SearchConstraint& constraint)
{
    options.required("value", constraint.value, "arithmetic of variables and results").example("alpha");
    options.optional("atLeast", constraint.atLeast, "lower limit of the value").example("0");
    options.optional("atMost", constraint.atMost, "upper limit of the value").example("1");
    options.optional("tolerance", constraint.tolerance, "by which the limits may be missed").atLeast(0);
    options.check("value",
                  [&constraint]
                  {
                      return constraint.atLeast || constraint.atMost
                                 ? ""
                                 : "A constraint has a limit: give `atLeast` or `atMost`, or both.";
                  });
    options.check("atLeast",
                  [&constraint]
                  {
                      return constraint.atLeast && constraint.atMost
                                     && *constraint.atLeast > *constraint.atMost
                                 ? "atLeast is above atMost: nothing meets both."
                                 : "";
                  });
}

void declare(Options& options, ParameterSearchSettings& settings)
{
    options.required("applications", settings.applications, "run one after the other for each point")
        .oneOf({"blockTexture", "checkBlocks", "limitAnalysis", "contactDynamics", "incrementalDynamics"})
        .example("(blockTexture limitAnalysis)");
    options.optional("cases", settings.cases, "in which directories of the case they are run");
    options.required("variables", settings.variables, "entries that are varied; any names")
        .example("thickness");
    options.required("results", settings.results, "numbers in tables of the applications; any names")
        .example("alpha");
    options.required("objective", settings.objective, "the value to be minimised or maximised");
    options.optional("constraints", settings.constraints, "conditions that have to hold; any names")
        .example("stands");
    options.required("search", settings.search, "algorithms, each beginning with the best point so far")
        .example("( { algorithm DIRECT_L; maximumEvaluations 40; } { algorithm BOBYQA; } )");
    options.optional("seed", settings.seed, "of random numbers").atLeast(0);
    options.check("applications", [&settings]
                  { return settings.applications.empty() ? "Nothing is run: give applications." : ""; });
    options.check("cases", [&settings] { return faultOfCases(settings); });
    options.check("variables", [&settings] { return faultOfVariables(settings); });
    options.check("results", [&settings] { return faultOfResults(settings); });
    options.check("objective", [&settings] { return faultOfObjective(settings); });
    options.check("constraints", [&settings] { return faultOfConstraints(settings); });
    options.check("search", [&settings] { return faultOfSearch(settings); });
    options.question("search", [&settings] { return doubtAbout(settings.search); });
}

ParameterSearchSettings readSearchSettings(const Dictionary& dictionary)
{
    auto settings = readOptions<ParameterSearchSettings>(dictionary);
    settings.locations = EntryLocations(dictionary);
    return settings;
}

double valueOf(const std::string& expression, const ParameterSearchSettings& settings,
               const std::vector<double>& variables, const std::vector<double>& results)
{
    std::map<std::string, double> names;
    for (std::size_t i = 0; i < variables.size(); ++i)
    {
        names[settings.variables[i].first] = variables[i];
    }
    for (std::size_t i = 0; i < results.size(); ++i)
    {
        names[settings.results[i].first] = results[i];
    }
    return evaluateExpression(expression, names);
}

} // namespace drystone
