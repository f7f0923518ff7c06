// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Declares the settings of a search, and runs it by NLopt, which only this file includes.
#include "ensembles/ParameterSearch.h"

#include "dictionary/Expression.h"

#include <fmt/format.h>
#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <set>

namespace drystone
{
namespace
{

constexpr const char* insideTheCase =
    "A search changes and reads copies of the case: give a path within the case directory, relative to it.";

/// Empty when an expression of these names can be evaluated.
std::string expressionFault(const std::string& expression, const ParameterSearchSettings& settings)
{
    // A value at which hardly any expression is undefined.
    const std::vector<double> variables(settings.variables.size(), 0.5123);
    const std::vector<double> results(settings.results.size(), 0.4321);
    try
    {
        valueOf(expression, settings, variables, results);
    }
    catch (const std::invalid_argument& error)
    {
        if (std::string_view(error.what()).find("finite") != std::string_view::npos)
        {
            return {}; // undefined at this point; it may be defined elsewhere
        }
        std::string names;
        for (const auto& [name, variable] : settings.variables)
        {
            names += " " + name;
        }
        for (const auto& [name, result] : settings.results)
        {
            names += " " + name;
        }
        std::string reason = error.what();
        reason.erase(reason.find_last_not_of('.') + 1);
        return fmt::format("`{}` is not arithmetic of variables and results: {}.\n\nVariables and results:{}",
                           expression, reason, names);
    }
    return {};
}

std::string nameFault(const std::string& name, std::set<std::string>& names)
{
    if (std::string fault = faultOfName(name); !fault.empty())
    {
        return fault;
    }
    if (!names.insert(name).second)
    {
        return fmt::format("Two variables or results have the name {}: choose another one.", name);
    }
    return {};
}

nlopt_algorithm algorithmOf(SearchAlgorithm algorithm, bool hasConstraints)
{
    switch (algorithm)
    {
    case SearchAlgorithm::bisection: // is our own
        break;
    case SearchAlgorithm::DIRECT:
        return hasConstraints ? NLOPT_GN_ORIG_DIRECT : NLOPT_GN_DIRECT;
    case SearchAlgorithm::DIRECT_L:
        return hasConstraints ? NLOPT_GN_ORIG_DIRECT_L : NLOPT_GN_DIRECT_L;
    case SearchAlgorithm::CRS2_LM:
        return NLOPT_GN_CRS2_LM;
    case SearchAlgorithm::ISRES:
        return NLOPT_GN_ISRES;
    case SearchAlgorithm::ESCH:
        return NLOPT_GN_ESCH;
    case SearchAlgorithm::BOBYQA:
        return NLOPT_LN_BOBYQA;
    case SearchAlgorithm::COBYLA:
        return NLOPT_LN_COBYLA;
    case SearchAlgorithm::SBPLX:
        return NLOPT_LN_SBPLX;
    case SearchAlgorithm::NELDERMEAD:
        return NLOPT_LN_NELDERMEAD;
    case SearchAlgorithm::PRAXIS:
        return NLOPT_LN_PRAXIS;
    }
    return NLOPT_LN_COBYLA;
}

bool isBetter(const Evaluation& one, const Evaluation& other, double sign)
{
    if (one.violation != other.violation)
    {
        return one.violation < other.violation;
    }
    return sign * one.objective < sign * other.objective;
}

/// The data of NLopt's callbacks. NLopt sees variables from 0 to 1 over their bounds, so that one tolerance
/// suits all.
struct Problem
{
    const ParameterSearchSettings& settings;
    const Evaluator& evaluator;
    nlopt_opt optimiser = nullptr;
    std::optional<Evaluation> best;
    bool isInterrupted = false;
    std::exception_ptr error;

    std::vector<double> variablesAt(const double* scaled) const
    {
        std::vector<double> variables;
        for (std::size_t i = 0; i < settings.variables.size(); ++i)
        {
            const auto& [low, high] = settings.variables[i].second.bounds;
            // The bounds themselves are exact.
            variables.push_back(scaled[i] == 1 ? high : low + scaled[i] * (high - low));
        }
        return variables;
    }

    void stop() const
    {
        if (optimiser)
        {
            nlopt_force_stop(optimiser);
        }
    }

    std::optional<Evaluation> at(const double* scaled)
    {
        if (isInterrupted || error)
        {
            return {}; // some algorithms request further points for a while
        }
        try
        {
            std::optional<Evaluation> found = evaluator(variablesAt(scaled));
            if (!found)
            {
                isInterrupted = true;
                stop();
            }
            else if (!best || isBetter(*found, *best, settings.objective.sign()))
            {
                best = found;
            }
            return found;
        }
        catch (...)
        {
            // Not through NLopt's C code.
            error = std::current_exception();
            stop();
            return {};
        }
    }
};

double objectiveOf(unsigned, const double* scaled, double*, void* data)
{
    auto& problem = *static_cast<Problem*>(data);
    const auto found = problem.at(scaled);
    return found ? problem.settings.objective.sign() * found->objective
                 : std::numeric_limits<double>::infinity();
}

/// One limit of a constraint, negative where it holds.
struct Limit
{
    Problem* problem = nullptr;
    std::size_t constraint = 0;
    double sign = 1;
    double value = 0;
};

double missOf(unsigned, const double* scaled, double*, void* data)
{
    const auto& limit = *static_cast<Limit*>(data);
    const auto found = limit.problem->at(scaled);
    return found ? limit.sign * (found->constraints[limit.constraint] - limit.value)
                 : std::numeric_limits<double>::infinity();
}

/// Halves the range between a feasible point and an infeasible one with the better objective, beginning with
/// the bounds.
SearchEnd bisect(const SearchStage& stage, Problem& problem)
{
    const double sign = problem.settings.objective.sign();
    int evaluations = 0;
    const auto at = [&](double place)
    {
        ++evaluations;
        return problem.at(&place);
    };
    const auto stopped = [&]
    {
        if (problem.error)
        {
            std::rethrow_exception(problem.error);
        }
        return SearchEnd::interrupted;
    };
    const auto atLow = at(0);
    const auto atHigh = atLow ? at(1) : atLow;
    if (!atHigh)
    {
        return stopped();
    }
    const bool isLowBetter = sign * atLow->objective < sign * atHigh->objective;
    const Evaluation& better = isLowBetter ? *atLow : *atHigh;
    const Evaluation& worse = isLowBetter ? *atHigh : *atLow;
    if (better.violation == 0)
    {
        return SearchEnd::converged;
    }
    if (worse.violation > 0)
    {
        return SearchEnd::failed;
    }
    double missing = isLowBetter ? 0 : 1;
    double meeting = 1 - missing;
    while (std::abs(missing - meeting) > stage.tolerance)
    {
        const double middle = (missing + meeting) / 2;
        if (middle == missing || middle == meeting)
        {
            break;
        }
        if (evaluations >= stage.maximumEvaluations)
        {
            return SearchEnd::evaluations;
        }
        const auto between = at(middle);
        if (!between)
        {
            return stopped();
        }
        (between->violation > 0 ? missing : meeting) = middle;
    }
    return SearchEnd::converged;
}

/// \return how the stage ended
SearchEnd carryOut(const SearchStage& stage, Problem& problem, std::vector<double> scaled)
{
    if (stage.algorithm == SearchAlgorithm::bisection)
    {
        return bisect(stage, problem);
    }
    const ParameterSearchSettings& settings = problem.settings;
    const auto count = static_cast<unsigned>(scaled.size());
    const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimiser(
        nlopt_create(algorithmOf(stage.algorithm, !settings.constraints.empty()), count), nlopt_destroy);
    problem.optimiser = optimiser.get();
    nlopt_set_min_objective(optimiser.get(), objectiveOf, &problem);
    nlopt_set_lower_bounds1(optimiser.get(), 0);
    nlopt_set_upper_bounds1(optimiser.get(), 1);
    std::vector<Limit> limits;
    limits.reserve(2 * settings.constraints.size());
    for (std::size_t i = 0; i < settings.constraints.size(); ++i)
    {
        const SearchConstraint& constraint = settings.constraints[i].second;
        const auto add = [&](double sign, double value)
        {
            limits.push_back({&problem, i, sign, value});
            nlopt_add_inequality_constraint(optimiser.get(), missOf, &limits.back(), constraint.tolerance);
        };
        if (constraint.atLeast)
        {
            add(-1, *constraint.atLeast);
        }
        if (constraint.atMost)
        {
            add(1, *constraint.atMost);
        }
    }
    nlopt_set_maxeval(optimiser.get(), stage.maximumEvaluations);
    if (!isGlobal(stage.algorithm))
    {
        nlopt_set_xtol_abs1(optimiser.get(), stage.tolerance);
        nlopt_set_ftol_abs(optimiser.get(), stage.objectiveTolerance);
        std::vector<double> steps;
        for (std::size_t i = 0; i < scaled.size(); ++i)
        {
            steps.push_back(settings.variables[i].second.firstStep);
        }
        nlopt_set_initial_step(optimiser.get(), steps.data());
    }
    if (stage.stopValue)
    {
        nlopt_set_stopval(optimiser.get(), settings.objective.sign() * *stage.stopValue);
    }
    if (stage.population > 0)
    {
        nlopt_set_population(optimiser.get(), static_cast<unsigned>(stage.population));
    }
    nlopt_srand(static_cast<unsigned long>(settings.seed));

    double least = 0;
    const nlopt_result result = nlopt_optimize(optimiser.get(), scaled.data(), &least);
    // The end point of a local algorithm, which need not be the best point it visited.
    const bool isChecked = !isGlobal(stage.algorithm) && !settings.constraints.empty();
    const auto last = isChecked ? problem.at(scaled.data()) : std::nullopt;
    problem.optimiser = nullptr;
    if (problem.error)
    {
        std::rethrow_exception(problem.error);
    }
    if (problem.isInterrupted)
    {
        return SearchEnd::interrupted;
    }
    switch (result)
    {
    case NLOPT_MAXEVAL_REACHED:
        return SearchEnd::evaluations;
    case NLOPT_SUCCESS:
    case NLOPT_STOPVAL_REACHED:
    case NLOPT_FTOL_REACHED:
    case NLOPT_XTOL_REACHED:
    // Steps have become as small as rounding: no improvement is possible.
    case NLOPT_ROUNDOFF_LIMITED:
        return last && last->violation > problem.best->violation ? SearchEnd::astray : SearchEnd::converged;
    default:
        return SearchEnd::failed;
    }
}

} // namespace

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
    options.check("bounds",
                  [&variable]
                  {
                      return variable.bounds[0] < variable.bounds[1]
                                 ? ""
                                 : "The range between these bounds is empty: give the lower one first.";
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

void declare(Options& options, SearchStage& stage)
{
    options.required("algorithm", stage.algorithm, "of NLopt").example("BOBYQA");
    options.optional("maximumEvaluations", stage.maximumEvaluations, "of the objective").atLeast(1);
    options
        .optional("tolerance", stage.tolerance,
                  "a local algorithm ends when variables change by less, as part of the width of the bounds")
        .atLeast(0);
    options.optional("objectiveTolerance", stage.objectiveTolerance, "... or the objective does").atLeast(0);
    options.optional("stopValue", stage.stopValue, "ends as soon as the objective is as good as this")
        .example("1e-9");
    options.optional("population", stage.population, "of CRS2_LM, ISRES and ESCH; 0: as NLopt chooses")
        .atLeast(0)
        .atMost(100000);
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
    options.check("cases",
                  [&settings]
                  {
                      const bool isFine =
                          !settings.cases.empty()
                          && std::all_of(settings.cases.begin(), settings.cases.end(), isInsideCase);
                      return isFine ? "" : insideTheCase;
                  });
    options.check("variables",
                  [&settings]() -> std::string
                  {
                      std::set<std::string> names;
                      for (const auto& [name, variable] : settings.variables)
                      {
                          if (std::string fault = nameFault(name, names); !fault.empty())
                          {
                              return fault;
                          }
                      }
                      return names.empty() ? "There is no variable." : "";
                  });
    options.check("results",
                  [&settings]() -> std::string
                  {
                      std::set<std::string> names;
                      for (const auto& [name, variable] : settings.variables)
                      {
                          names.insert(name);
                      }
                      for (const auto& [name, result] : settings.results)
                      {
                          if (std::string fault = nameFault(name, names); !fault.empty())
                          {
                              return fault;
                          }
                      }
                      return "";
                  });
    options.check("objective", [&settings] { return expressionFault(settings.objective.value, settings); });
    options.check("constraints",
                  [&settings]() -> std::string
                  {
                      for (const auto& [name, constraint] : settings.constraints)
                      {
                          if (std::string fault = expressionFault(constraint.value, settings); !fault.empty())
                          {
                              return fault;
                          }
                      }
                      return "";
                  });
    options.check("search",
                  [&settings]() -> std::string
                  {
                      if (settings.search.empty())
                      {
                          return "Give at least one algorithm.";
                      }
                      for (const SearchStage& stage : settings.search)
                      {
                          const bool isBisection = stage.algorithm == SearchAlgorithm::bisection;
                          if (isBisection && (settings.variables.size() != 1 || settings.constraints.empty()))
                          {
                              return "bisection finds where constraints cease to hold, along one variable: "
                                     "give it constraints, and one variable.";
                          }
                          if (!settings.constraints.empty() && !takesConstraints(stage.algorithm))
                          {
                              return fmt::format(
                                  "{} takes no constraints.\n\nAlgorithms that do: COBYLA DIRECT "
                                  "DIRECT_L ISRES",
                                  nameOf(stage.algorithm));
                          }
                      }
                      return "";
                  });
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

Evaluation evaluate(const ParameterSearchSettings& settings, std::vector<double> variables,
                    std::vector<double> results)
{
    Evaluation found;
    found.variables = std::move(variables);
    found.results = std::move(results);
    const auto value = [&](const std::string& expression)
    {
        try
        {
            return valueOf(expression, settings, found.variables, found.results);
        }
        catch (const std::invalid_argument& error)
        {
            throw FatalError(
                fmt::format("`{}` of system/parameterSearchDict has no value at a point that the "
                            "search came to ({}): {}.",
                            expression, fmt::join(found.variables, " "), error.what()));
        }
    };
    found.objective = value(settings.objective.value);
    for (const auto& [name, constraint] : settings.constraints)
    {
        const double at = value(constraint.value);
        found.constraints.push_back(at);
        const double miss = std::max(constraint.atLeast ? *constraint.atLeast - at : 0.0,
                                     constraint.atMost ? at - *constraint.atMost : 0.0);
        found.violation = std::max(found.violation, miss > constraint.tolerance ? miss : 0.0);
    }
    return found;
}

SearchOutcome searchBest(const ParameterSearchSettings& settings, const std::vector<double>& start,
                         const Evaluator& evaluator)
{
    int evaluations = 0;
    const Evaluator counting = [&](const std::vector<double>& variables)
    {
        ++evaluations;
        return evaluator(variables);
    };
    // NLopt requests objective and constraints of a point one after the other.
    std::optional<Evaluation> last;
    const Evaluator remembering = [&](const std::vector<double>& variables)
    {
        if (!last || last->variables != variables)
        {
            last = counting(variables);
        }
        return last;
    };
    SearchOutcome outcome;
    Problem problem{settings, remembering, nullptr, {}, false, {}};
    std::vector<double> from = start;
    for (const SearchStage& stage : settings.search)
    {
        std::vector<double> scaled;
        for (std::size_t i = 0; i < from.size(); ++i)
        {
            const auto& [low, high] = settings.variables[i].second.bounds;
            scaled.push_back(std::clamp((from[i] - low) / (high - low), 0.0, 1.0));
        }
        evaluations = 0;
        outcome.end = carryOut(stage, problem, scaled);
        outcome.stages.emplace_back(stage.algorithm, evaluations);
        outcome.best = problem.best;
        if (outcome.end == SearchEnd::interrupted || outcome.end == SearchEnd::failed)
        {
            break;
        }
        from = problem.best->variables;
    }
    return outcome;
}

} // namespace drystone
