// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Runs a search by NLopt, which only this file includes.
#include "ensembles/ParameterSearch.h"

#include <fmt/format.h>
#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>

namespace drystone
{
namespace
{

nlopt_algorithm algorithmOf(SearchAlgorithm algorithm)
{
    switch (algorithm)
    {
    case SearchAlgorithm::bisection: // is our own
        break;
    case SearchAlgorithm::DIRECT:
        return NLOPT_GN_DIRECT;
    case SearchAlgorithm::DIRECT_L:
        return NLOPT_GN_DIRECT_L;
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

/// The variant of an algorithm that knows constraints, where it has one of its own.
nlopt_algorithm withConstraints(nlopt_algorithm algorithm)
{
    return algorithm == NLOPT_GN_DIRECT     ? NLOPT_GN_ORIG_DIRECT
           : algorithm == NLOPT_GN_DIRECT_L ? NLOPT_GN_ORIG_DIRECT_L
                                            : algorithm;
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
    std::optional<Evaluation> best = {};
    bool isInterrupted = false;
    std::exception_ptr error = {};
    /// Points that the stage may look at, and has: some algorithms go on beyond what they are given.
    int mostPoints = std::numeric_limits<int>::max();
    int points = 0;
    int requests = 0;     ///< of the stage, for the objective and constraints
    int calls = 0;        ///< of the stage for the objective, all within the bounds
    int beyondBounds = 0; ///< points outside the bounds that the stage has spent evaluations on
    std::vector<double> lastPoint = {};

    bool isExhausted() const { return points > mostPoints; }

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

    /// At the second request at the earliest: stopped at the first, NLopt's DIRECT reads what it has not set.
    void stop() const
    {
        if (optimiser && requests > 1)
        {
            nlopt_force_stop(optimiser);
        }
    }

    std::optional<Evaluation> at(const double* scaled)
    {
        ++requests;
        if (isInterrupted || error || isExhausted())
        {
            stop();
            return {}; // some algorithms request further points for a while
        }
        std::vector<double> point(scaled, scaled + settings.variables.size());
        if (point != lastPoint && ++points > mostPoints)
        {
            stop();
            return {};
        }
        lastPoint = std::move(point);
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
    ++problem.calls;
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

/// Whether the objective of a point lies between those of two others, to rounding.
bool isBetween(const Evaluation& found, const Evaluation& one, const Evaluation& other)
{
    const auto [low, high] = std::minmax(one.objective, other.objective);
    const double rounding = 1e-9 * std::max(std::abs(low), std::abs(high));
    return found.objective >= low - rounding && found.objective <= high + rounding;
}

/// Halves the range between a feasible point and an infeasible one with the better objective, beginning with
/// the bounds. The objective has to grow, or fall, all along the range.
SearchEnd bisect(const SearchStage& stage, Problem& problem)
{
    const double sign = problem.settings.objective.sign();
    const auto at = [&](double place) { return problem.at(&place); };
    const auto stopped = [&]
    {
        if (problem.error)
        {
            std::rethrow_exception(problem.error);
        }
        return problem.isExhausted() ? SearchEnd::evaluations : SearchEnd::interrupted;
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
        const auto middle = at(0.5);
        return !middle                               ? stopped()
               : isBetween(*middle, *atLow, *atHigh) ? SearchEnd::converged
                                                     : SearchEnd::notMonotone;
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
        const auto between = at(middle);
        if (!between)
        {
            return stopped();
        }
        if (!isBetween(*between, *atLow, *atHigh))
        {
            return SearchEnd::notMonotone;
        }
        (between->violation > 0 ? missing : meeting) = middle;
    }
    return SearchEnd::converged;
}

/// NLopt's algorithm of a stage, with the objective, bounds, constraints and ends. \param limits of the
/// constraints, which the algorithm refers to
std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimiserOf(const SearchStage& stage, Problem& problem,
                                                                   unsigned count, std::vector<Limit>& limits)
{
    const ParameterSearchSettings& settings = problem.settings;
    const nlopt_algorithm algorithm = algorithmOf(stage.algorithm);
    std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimiser(
        nlopt_create(settings.constraints.empty() ? algorithm : withConstraints(algorithm), count),
        nlopt_destroy);
    nlopt_set_min_objective(optimiser.get(), objectiveOf, &problem);
    nlopt_set_lower_bounds1(optimiser.get(), 0);
    nlopt_set_upper_bounds1(optimiser.get(), 1);
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
        for (unsigned i = 0; i < count; ++i)
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
    return optimiser;
}

SearchEnd endOf(nlopt_result result)
{
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
        return SearchEnd::converged;
    default:
        return SearchEnd::failed;
    }
}

/// \return how the stage ended
SearchEnd carryOut(const SearchStage& stage, Problem& problem, std::vector<double> scaled)
{
    problem.points = 0;
    problem.requests = 0;
    problem.calls = 0;
    problem.beyondBounds = 0;
    problem.mostPoints = stage.maximumEvaluations;
    if (stage.algorithm == SearchAlgorithm::bisection)
    {
        return bisect(stage, problem);
    }
    std::vector<Limit> limits;
    const auto optimiser = optimiserOf(stage, problem, static_cast<unsigned>(scaled.size()), limits);
    problem.optimiser = optimiser.get();
    double least = 0;
    const nlopt_result result = nlopt_optimize(optimiser.get(), scaled.data(), &least);
    if (stage.algorithm == SearchAlgorithm::PRAXIS) // NLopt answers for points outside, and counts them
    {
        problem.beyondBounds = std::max(0, nlopt_get_numevals(optimiser.get()) - problem.calls);
    }
    // The end point of a local algorithm, which need not be the best point it visited.
    const bool isChecked = !isGlobal(stage.algorithm) && !problem.settings.constraints.empty();
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
    const SearchEnd end = problem.isExhausted() ? SearchEnd::evaluations : endOf(result);
    const bool isAstray = last && last->violation > problem.best->violation;
    return end == SearchEnd::converged && isAstray ? SearchEnd::astray : end;
}

} // namespace

Evaluation evaluate(const ParameterSearchSettings& settings, std::vector<double> variables,
                    std::vector<double> results)
{
    Evaluation found;
    found.variables = std::move(variables);
    found.results = std::move(results);
    const auto value = [&](const std::string& expression, const std::string& entry)
    {
        try
        {
            return valueOf(expression, settings, found.variables, found.results);
        }
        catch (const std::invalid_argument& error)
        {
            throw FatalIOError(
                fmt::format("`{}` of system/parameterSearchDict has no value at a point that the "
                            "search came to ({}): {}.",
                            expression, fmt::join(found.variables, " "), error.what()),
                settings.locations.of(entry));
        }
    };
    found.objective = value(settings.objective.value, "objective/value");
    for (const auto& [name, constraint] : settings.constraints)
    {
        const double at = value(constraint.value, "constraints/" + name + "/value");
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
    Problem problem{.settings = settings, .evaluator = remembering};
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
        outcome.beyondBounds = problem.beyondBounds;
        if (outcome.end == SearchEnd::interrupted || outcome.end == SearchEnd::failed)
        {
            break;
        }
        from = problem.best->variables;
    }
    return outcome;
}

} // namespace drystone
