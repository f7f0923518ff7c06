// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Paths from forces moved inwards, and exchanges until the multiplier falls no more.
#include "statics/CollapseSearch.h"

#include "core/Log.h"
#include "statics/FictitiousCohesion.h"
#include "statics/StepFromRest.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

/// Stiffnesses of the joints differ by factors up to exp(2 spread): little on the first path, so that blocks
/// alike do not change at once, and more on others.
constexpr double firstSpread = 0.2;
constexpr double secondSpread = 0.5;
constexpr double largestSpread = 1.5;

/// With more points than these a path takes minutes; with fewer no more than the exchanges that follow, and
/// paths lead to lower multipliers.
constexpr int mostPathPoints = 4000;

/// gamma of the first path, whose mechanism is that of the associative law; later ones have 1.01 to 2.
constexpr double firstPenalty = 5;

/// Every so many paths begin with other forces for the dead load, from a random objective: those that end
/// lowest mostly do. Until one has met a collapse they are fewer, as they meet one less often.
constexpr int pathsToOtherForces = 3;
constexpr int pathsToOtherForcesAtFirst = 8;

/// Dilatancy of blocks that fall: first, and what remains of it in the pair, as a share of the tolerance.
constexpr double wedging = 3e-2;
constexpr double remainingDilatancy = 0.1;

/// Factorisations times contact points that take some two milliseconds, in space some fifty.
template<int Forces>
constexpr double cheapWork = Forces == 2 ? 15000 : 100000;

/// Tolerance of programs whose forces are nothing but a start.
constexpr double startTolerance = 1e-6;

/// And of those whose forces are to be near the middle of what is possible.
constexpr double cohesionTolerance = 1e-2;

/// Exchanges of forces and mechanism after a path, while each lowers the multiplier by this share.
constexpr int mostExchanges = 8;
constexpr double leastGain = 1e-7;

} // namespace

template<int Rows, int Forces>
CollapseSearch<Rows, Forces>::CollapseSearch(const Program& program, const NonAssociativeSettings& settings,
                                             const InteriorPointSettings& solver, LimitAnalysis& work)
    : followsPaths(program.points() <= mostPathPoints),
      frame(program),
      given(frame.program),
      searchSettings(settings),
      solverSettings(solver),
      effort(work),
      generator(static_cast<std::mt19937::result_type>(settings.seed)),
      criterion{program, frame, settings.tolerance, std::numeric_limits<double>::infinity()},
      begin(clockTime())
{
    found.range.lowest = std::numeric_limits<double>::infinity();
    found.range.highest = -found.range.lowest;
    found.range.associative = found.range.lowest;
    if (work.status != CollapseStatus::optimal)
    {
        return;
    }
    found.range.associative = work.alpha;
    LimitAnalysis own = work;
    if (Forces == 3)
    {
        // Forces that differ in the last digits would be another start, and another number of
        // factorisations.
        ofStructure = work.factorisations;
        own = solveLimitAnalysis(given, solver, &symbolicAnalysis);
        addWork(work, own);
    }
    if (own.status == CollapseStatus::optimal)
    {
        associativePair = {
            own.alpha, own.contactForce, own.mechanism / given.liveLoad.dot(own.mechanism), {}};
        criterion.most = own.alpha;
    }
}

template<int Rows, int Forces>
bool CollapseSearch<Rows, Forces>::findRest()
{
    std::optional<VectorXd> resting = restingForces(given, roughSolver(startTolerance));
    if (resting)
    {
        restingForce = std::move(*resting);
    }
    return resting.has_value();
}

template<int Rows, int Forces>
bool CollapseSearch<Rows, Forces>::isOver()
{
    if (!found.range.cutShortAfter)
    {
        const double taken = clockTime() - begin;
        if ((searchSettings.maximumTime && taken >= *searchSettings.maximumTime)
            || (searchSettings.isOver && searchSettings.isOver()))
        {
            found.range.cutShortAfter = taken;
        }
    }
    return found.range.cutShortAfter.has_value();
}

template<int Rows, int Forces>
bool CollapseSearch<Rows, Forces>::isCheap() const
{
    return static_cast<double>(effort.factorisations - ofStructure) * given.points() < cheapWork<Forces>;
}

template<int Rows, int Forces>
void CollapseSearch<Rows, Forces>::go(int number)
{
    ++found.range.starts;
    double spread = number == 0   ? firstSpread
                    : number == 1 ? secondSpread
                                  : largestSpread * uniform(generator);
    const int toOtherForces = found.lowest.exists() ? pathsToOtherForces : pathsToOtherForcesAtFirst;
    std::optional<CollapseStart> start;
    if (number == 0)
    {
        start = associativePair.exists() ? lowStart(associativePair, firstPenalty) : std::nullopt;
    }
    else if (number % toOtherForces == toOtherForces - 1)
    {
        start = otherRest();
    }
    else if (number > 1 && found.lowest.exists())
    {
        const double gamma = 1 + std::pow(10, -2 * uniform(generator));
        start = lowStart(number % 2 == 1 ? found.lowest : found.latest, gamma);
    }
    else if (number > 1)
    {
        spread = largestSpread * uniform(generator);
    }
    const CollapsePathSettings settings{.stiffnessSpread = spread,
                                        .seed = static_cast<unsigned>(generator())};
    const CollapseStart from = start.value_or(CollapseStart{0, restingForce});
    if (!followsPaths)
    {
        found.range.converged += followCohesion(from);
        return;
    }
    found.range.converged +=
        follow(from, settings) || (wedges && !found.lowest.exists() && followWedged(from, settings));
    if (found.lowest.exists() && Forces == 3 && !isOver())
    {
        tryPressures(number == 0 ? restingForce : from.contactForce);
    }
}

template<int Rows, int Forces>
void CollapseSearch<Rows, Forces>::takeAssociativeForces()
{
    if (!associativePair.exists())
    {
        return;
    }
    ++found.range.starts;
    std::optional<VectorXd> mechanism =
        mechanismOf<Rows, Forces>(given, associativePair.contactForce, solver());
    if (mechanism)
    {
        CoulombPair pair{associativePair.alpha, associativePair.contactForce, std::move(*mechanism), {}};
        if (take(pair))
        {
            ++found.range.converged;
            descend(std::move(pair));
        }
    }
}

template<int Rows, int Forces>
void CollapseSearch<Rows, Forces>::takeStepsFromRest()
{
    if (!associativePair.exists() || given.hasCrushing())
    {
        return;
    }
    for (const VectorXd* forces : {&associativePair.contactForce, &restingForce})
    {
        if (isOver())
        {
            return;
        }
        ++found.range.starts;
        std::optional<CoulombPair> pair = pairFromRest<Rows, Forces>(
            given, associativePair.alpha, *forces,
            [this](CoulombPair& tried) { return consider(tried, criterion, found); }, effort.factorisations,
            untilOver());
        if (pair)
        {
            ++found.range.converged;
            descend(std::move(*pair));
            return;
        }
    }
}

template<int Rows, int Forces>
ConeSolution CollapseSearch<Rows, Forces>::solve(const Program& program,
                                                 const InteriorPointSettings& settings)
{
    ConeSolution solution = solveInteriorPoint(program, settings, &symbolicAnalysis);
    addWork(effort, solution);
    return solution;
}

template<int Rows, int Forces>
ProgramSolver<Rows, Forces> CollapseSearch<Rows, Forces>::solver()
{
    // Of thousands of points, programs that rounding leaves without an answer would take a third of the time.
    InteriorPointSettings settings = solverSettings;
    settings.arithmetic = followsPaths ? solverSettings.arithmetic : Arithmetic::standard;
    return [this, settings](const Program& program) { return solve(program, settings); };
}

template<int Rows, int Forces>
ProgramSolver<Rows, Forces> CollapseSearch<Rows, Forces>::roughSolver(double tolerance)
{
    InteriorPointSettings settings = solverSettings;
    settings.tolerance = std::max(solverSettings.tolerance, tolerance);
    return [this, settings](const Program& program) { return solve(program, settings); };
}

template<int Rows, int Forces>
std::function<bool()> CollapseSearch<Rows, Forces>::untilOver()
{
    return [this] { return isOver(); };
}

template<int Rows, int Forces>
void CollapseSearch<Rows, Forces>::report(int pieces, double multiplier) const
{
    if (searchSettings.observe)
    {
        searchSettings.observe(
            {.path = found.range.starts,
             .pieces = pieces,
             .multiplier = multiplier,
             .lowest = found.lowest.exists() ? found.lowest.alpha : std::numeric_limits<double>::infinity(),
             .isPath = followsPaths});
    }
}

template<int Rows, int Forces>
CollapsePair CollapseSearch<Rows, Forces>::path(const CollapseStart& start,
                                                const CollapsePathSettings& settings)
{
    CollapsePathSettings observed = settings;
    observed.isOver = untilOver();
    observed.observe = [this](int pieces, double multiplier) { report(pieces, multiplier); };
    CollapsePair pair = followCollapsePath(given, start.contactForce, start.alpha, observed);
    addWork(effort, {pair.pieces, pair.factorisations, pair.solves});
    return pair;
}

template<int Rows, int Forces>
std::optional<CollapseStart> CollapseSearch<Rows, Forces>::otherRest()
{
    const std::optional<VectorXd> other = randomRestingForces(given, generator, roughSolver(startTolerance));
    return other ? std::optional(movedInwards(0, *other, restingForce)) : std::nullopt;
}

template<int Rows, int Forces>
std::optional<CollapseStart> CollapseSearch<Rows, Forces>::lowStart(const CoulombPair& pair, double gamma)
{
    const std::optional<CollapseStart> low = lowForces(given, pair, gamma, roughSolver(startTolerance));
    return low ? std::optional(movedInwards(low->alpha, low->contactForce, restingForce)) : std::nullopt;
}

template<int Rows, int Forces>
bool CollapseSearch<Rows, Forces>::take(CoulombPair& pair)
{
    return considerRefined(pair, criterion, found, solver(), untilOver());
}

template<int Rows, int Forces>
bool CollapseSearch<Rows, Forces>::takeMechanism(CoulombPair& pair)
{
    std::optional<VectorXd> mechanism = mechanismOf<Rows, Forces>(given, pair.contactForce, solver());
    if (mechanism)
    {
        pair.mechanism = std::move(*mechanism);
    }
    return mechanism && take(pair);
}

template<int Rows, int Forces>
bool CollapseSearch<Rows, Forces>::followCohesion(const CollapseStart& start)
{
    const CohesionTools<Rows, Forces> tools{
        roughSolver(cohesionTolerance), solver(),
        [this](CoulombPair& pair) { return consider(pair, criterion, found); }, untilOver(),
        [this](int round, double multiplier) { report(round, multiplier); }};
    std::optional<CoulombPair> pair = pairByCohesion<Rows, Forces>(given, start.contactForce, tools);
    if (pair)
    {
        descend(std::move(*pair));
    }
    return pair.has_value();
}

template<int Rows, int Forces>
bool CollapseSearch<Rows, Forces>::follow(const CollapseStart& start, const CollapsePathSettings& settings)
{
    CollapsePair ofPath = path(start, settings);
    const double power = given.liveLoad.dot(ofPath.mechanism);
    if (ofPath.end == PathEnd::fall)
    {
        considerFall({ofPath.multiplier, ofPath.contactForce, ofPath.mechanism, {}}, criterion, found);
    }
    if ((ofPath.end != PathEnd::collapse && ofPath.end != PathEnd::unfinished) || power == 0)
    {
        return false;
    }
    CoulombPair pair{ofPath.multiplier, std::move(ofPath.contactForce), ofPath.mechanism / power, {}};
    if (!take(pair) && !(takesMechanisms && takeMechanism(pair)))
    {
        return false;
    }
    descend(std::move(pair));
    return true;
}

template<int Rows, int Forces>
bool CollapseSearch<Rows, Forces>::followWedged(const CollapseStart& start, CollapsePathSettings settings)
{
    settings.dilatancy = wedging;
    settings.finalDilatancy = remainingDilatancy * searchSettings.tolerance;
    if (follow(start, settings))
    {
        return true;
    }
    if (!associativePair.exists())
    {
        return false;
    }
    const CollapseStart near =
        movedInwards(associativePair.alpha, associativePair.contactForce, restingForce);
    CollapsePathSettings little = settings;
    little.dilatancy = settings.finalDilatancy;
    return follow(near, settings) || follow(near, little);
}

template<int Rows, int Forces>
void CollapseSearch<Rows, Forces>::tryPressures(const VectorXd& contactForce)
{
    std::optional<CoulombPair> pair =
        mechanismOfPressures<Rows, Forces>(given, contactForce(Eigen::seq(0, Eigen::last, Forces)), solver());
    if (pair)
    {
        descend(std::move(*pair));
    }
}

template<int Rows, int Forces>
void CollapseSearch<Rows, Forces>::descend(CoulombPair pair)
{
    double highest = std::numeric_limits<double>::infinity();
    for (int round = 0; round < mostExchanges && !isOver(); ++round)
    {
        std::optional<LeastPair> least = leastPair<Rows, Forces>(given, pair, solver());
        if (!least || !(least->pair.alpha < highest) || !consider(least->pair, criterion, found))
        {
            return;
        }
        highest = least->pair.alpha - leastGain * std::abs(least->pair.alpha);
        std::optional<VectorXd> other = otherMechanism<Rows, Forces>(given, *least, solver());
        if (!other)
        {
            return;
        }
        pair = {least->pair.alpha, std::move(least->pair.contactForce), std::move(*other), {}};
    }
}

template class CollapseSearch<3, 2>;
template class CollapseSearch<6, 3>;

} // namespace drystone
