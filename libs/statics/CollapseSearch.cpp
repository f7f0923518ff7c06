// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Paths from forces moved inwards, pairs refined, and exchanges until the multiplier falls no more.
#include "statics/CollapseSearch.h"

#include "core/Log.h"
#include "statics/FictitiousCohesion.h"
#include "statics/PairRefinement.h"
#include "statics/StepFromRest.h"

#include <algorithm>
#include <array>
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

/// Forces at the start of a path are moved inwards by this share of those for the dead load.
constexpr double inwards = 0.01;

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

/// Pairs that obey the law to this are refined, with points of less slip than each of these in turn at rest.
constexpr double nearlyPair = 2e-3;
constexpr std::array<double, 3> slidesFrom{1e-6, 1e-4, 1e-2};

/// Exchanges of forces and mechanism after a path, while each lowers the multiplier by this share.
constexpr int mostExchanges = 8;
constexpr double leastGain = 1e-7;

} // namespace

template<int Rows, int Forces>
CollapseSearch<Rows, Forces>::CollapseSearch(const Program& program, const NonAssociativeSettings& settings,
                                             const InteriorPointSettings& solver, LimitAnalysis& work)
    : followsPaths(program.points() <= mostPathPoints),
      frame(program),
      structure(program),
      given(frame.program),
      searchSettings(settings),
      solverSettings(solver),
      effort(work),
      generator(static_cast<std::mt19937::result_type>(settings.seed)),
      begin(clockTime())
{
    range.lowest = std::numeric_limits<double>::infinity();
    range.highest = -range.lowest;
    range.associative = range.lowest;
    if (work.status != CollapseStatus::optimal)
    {
        return;
    }
    range.associative = work.alpha;
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
    }
}

template<int Rows, int Forces>
bool CollapseSearch<Rows, Forces>::findRest()
{
    Program dead = given;
    dead.liveLoad.resize(0);
    const ConeSolution resting = solveRoughly(dead, startTolerance);
    restingStart.contactForce = resting.contactForce;
    return resting.status == SolveStatus::optimal;
}

template<int Rows, int Forces>
bool CollapseSearch<Rows, Forces>::isOver()
{
    if (!range.cutShortAfter)
    {
        const double taken = clockTime() - begin;
        if ((searchSettings.maximumTime && taken >= *searchSettings.maximumTime)
            || (searchSettings.isOver && searchSettings.isOver()))
        {
            range.cutShortAfter = taken;
        }
    }
    return range.cutShortAfter.has_value();
}

template<int Rows, int Forces>
bool CollapseSearch<Rows, Forces>::isCheap() const
{
    return static_cast<double>(effort.factorisations - ofStructure) * given.points() < cheapWork<Forces>;
}

template<int Rows, int Forces>
void CollapseSearch<Rows, Forces>::go(int number)
{
    ++range.starts;
    double spread = number == 0 ? firstSpread : number == 1 ? secondSpread : largestSpread * uniform();
    const int toOtherForces = lowest.exists() ? pathsToOtherForces : pathsToOtherForcesAtFirst;
    std::optional<Start> start;
    if (number == 0)
    {
        start = associativePair.exists() ? lowForces(associativePair, firstPenalty) : std::nullopt;
    }
    else if (number % toOtherForces == toOtherForces - 1)
    {
        start = otherRest();
    }
    else if (number > 1 && lowest.exists())
    {
        const double gamma = 1 + std::pow(10, -2 * uniform());
        start = lowForces(number % 2 == 1 ? lowest : latestPair, gamma);
    }
    else if (number > 1)
    {
        spread = largestSpread * uniform();
    }
    const CollapsePathSettings settings{.stiffnessSpread = spread,
                                        .seed = static_cast<unsigned>(generator())};
    const Start from = start.value_or(restingStart);
    if (!followsPaths)
    {
        range.converged += followCohesion(from);
        return;
    }
    range.converged += follow(from, settings) || (wedges && !lowest.exists() && followWedged(from, settings));
    if (lowest.exists() && Forces == 3 && !isOver())
    {
        tryPressures(number == 0 ? restingStart.contactForce : from.contactForce);
    }
}

template<int Rows, int Forces>
void CollapseSearch<Rows, Forces>::takeAssociativeForces()
{
    if (!associativePair.exists())
    {
        return;
    }
    ++range.starts;
    std::optional<VectorXd> mechanism =
        mechanismOf<Rows, Forces>(given, associativePair.contactForce, solver());
    if (mechanism)
    {
        CoulombPair pair{associativePair.alpha, associativePair.contactForce, std::move(*mechanism), {}};
        if (take(pair))
        {
            ++range.converged;
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
    for (const VectorXd* forces : {&associativePair.contactForce, &restingStart.contactForce})
    {
        if (isOver())
        {
            return;
        }
        ++range.starts;
        std::optional<CoulombPair> pair = pairFromRest<Rows, Forces>(
            given, associativePair.alpha, *forces, [this](CoulombPair& tried) { return consider(tried); },
            effort.factorisations, [this] { return isOver(); });
        if (pair)
        {
            ++range.converged;
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
ConeSolution CollapseSearch<Rows, Forces>::solveRoughly(const Program& program, double tolerance)
{
    InteriorPointSettings settings = solverSettings;
    settings.tolerance = std::max(solverSettings.tolerance, tolerance);
    return solve(program, settings);
}

template<int Rows, int Forces>
void CollapseSearch<Rows, Forces>::report(int pieces, double multiplier) const
{
    if (searchSettings.observe)
    {
        searchSettings.observe(
            {.path = range.starts,
             .pieces = pieces,
             .multiplier = multiplier,
             .lowest = lowest.exists() ? lowest.alpha : std::numeric_limits<double>::infinity(),
             .isPath = followsPaths});
    }
}

template<int Rows, int Forces>
CollapsePair CollapseSearch<Rows, Forces>::path(const Start& start, const CollapsePathSettings& settings)
{
    CollapsePathSettings observed = settings;
    observed.isOver = [this] { return isOver(); };
    observed.observe = [this](int pieces, double multiplier) { report(pieces, multiplier); };
    CollapsePair pair = followCollapsePath(given, start.contactForce, start.alpha, observed);
    addWork(effort, {pair.pieces, pair.factorisations, pair.solves});
    return pair;
}

template<int Rows, int Forces>
double CollapseSearch<Rows, Forces>::uniform()
{
    return static_cast<double>(generator()) / 4294967296.0;
}

template<int Rows, int Forces>
typename CollapseSearch<Rows, Forces>::Start
CollapseSearch<Rows, Forces>::movedInwards(double alpha, const VectorXd& contactForce) const
{
    return {(1 - inwards) * alpha, (1 - inwards) * contactForce + inwards * restingStart.contactForce};
}

template<int Rows, int Forces>
auto CollapseSearch<Rows, Forces>::otherRest() -> std::optional<Start>
{
    Program dead = given;
    dead.liveLoad.resize(0);
    dead.gap = VectorXd::Zero(Forces * given.points());
    for (int point = 0; point < given.points(); ++point)
    {
        const double weight = std::pow(10, -2 * uniform());
        dead.gap[Forces * point] = weight;
        for (int shear = 1; shear < Forces; ++shear)
        {
            dead.gap[Forces * point + shear] = 0.3 * weight * (2 * uniform() - 1);
        }
    }
    const ConeSolution other = solveRoughly(dead, startTolerance);
    return other.status == SolveStatus::optimal ? std::optional(movedInwards(0, other.contactForce))
                                                : std::nullopt;
}

template<int Rows, int Forces>
auto CollapseSearch<Rows, Forces>::lowForces(const CoulombPair& pair, double gamma) -> std::optional<Start>
{
    Program reversed = given;
    reversed.liveLoad = -given.liveLoad;
    reversed.gap = VectorXd::Zero(Forces * given.points());
    const VectorXd closing = applyTransposed(given, pair.mechanism);
    for (int point = 0; point < given.points(); ++point)
    {
        const double slip = closing.template segment<Forces - 1>(Forces * point + 1).norm();
        reversed.gap[Forces * point] = gamma
                                       * (given.friction[static_cast<std::size_t>(point)] * slip
                                          + std::max(0.0, -closing[Forces * point]));
    }
    const ConeSolution low = solveRoughly(reversed, startTolerance);
    return low.status == SolveStatus::optimal ? std::optional(movedInwards(-low.multiplier, low.contactForce))
                                              : std::nullopt;
}

template<int Rows, int Forces>
CoulombResiduals CollapseSearch<Rows, Forces>::judged(const CoulombPair& pair, double liveWork) const
{
    const CoulombPair turned = frame.inGiven(pair);
    return coulombResiduals(structure, turned.alpha, turned.contactForce, turned.mechanism, liveWork);
}

template<int Rows, int Forces>
bool CollapseSearch<Rows, Forces>::consider(CoulombPair& pair)
{
    pair.alpha = std::min(pair.alpha, associativePair.alpha); // which it exceeds by rounding alone
    pair.residuals = judged(pair, 1);
    if (!(pair.residuals.worst() <= searchSettings.tolerance))
    {
        return false;
    }
    // Below zero the mechanism would be driven by the dead load, which is carried where loading begins. At
    // zero, as where a stone that hangs at an edge turns about it, nothing drives it.
    if (pair.alpha < (std::isfinite(range.associative) ? searchSettings.tolerance * range.associative : 0))
    {
        if (!below.exists() || pair.alpha > below.alpha)
        {
            below = pair;
        }
        return false;
    }
    range.lowest = std::min(range.lowest, pair.alpha);
    range.highest = std::max(range.highest, pair.alpha);
    latestPair = pair;
    if (!(pair.alpha >= lowest.alpha))
    {
        lowest = pair;
    }
    return true;
}

template<int Rows, int Forces>
void CollapseSearch<Rows, Forces>::considerFall(const CollapsePair& found)
{
    CoulombPair pair{found.multiplier, found.contactForce, found.mechanism, {}};
    pair.residuals = judged(pair, 0);
    if (pair.alpha >= 0 && pair.residuals.worst() <= searchSettings.tolerance && pair.alpha < fall.alpha)
    {
        range.fall = pair.alpha;
        fall = std::move(pair);
    }
}

template<int Rows, int Forces>
bool CollapseSearch<Rows, Forces>::take(CoulombPair& pair)
{
    const bool isFirst = !lowest.exists();
    if (consider(pair))
    {
        isByRefinement = false;
        return true;
    }
    const bool isRefined = refine(pair);
    isByRefinement = isByRefinement || (isRefined && isFirst);
    return isRefined;
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
bool CollapseSearch<Rows, Forces>::refine(CoulombPair& pair)
{
    const double worst = pair.residuals.worst();
    if (!(worst <= nearlyPair) || worst <= searchSettings.tolerance) // of which one is below zero
    {
        return false;
    }
    for (const double slides : slidesFrom)
    {
        std::optional<CoulombPair> refined =
            refinedPair<Rows, Forces>(given, pair, slides, [this] { return isOver(); });
        if (!refined)
        {
            return false;
        }
        if (consider(*refined))
        {
            pair = std::move(*refined);
            return true;
        }
        // Where the mechanism is right the forces that suit it are many, not all of them within their
        // limits.
        std::optional<CoulombPair> within = refined->residuals.flow <= searchSettings.tolerance
                                                ? nearestPair<Rows, Forces>(given, *refined, solver())
                                                : std::nullopt;
        if (within && consider(*within))
        {
            pair = std::move(*within);
            return true;
        }
    }
    return false;
}

template<int Rows, int Forces>
bool CollapseSearch<Rows, Forces>::followCohesion(const Start& start)
{
    const CohesionTools<Rows, Forces> tools{
        [this](const Program& program) { return solveRoughly(program, cohesionTolerance); }, solver(),
        [this](CoulombPair& pair) { return consider(pair); }, [this] { return isOver(); },
        [this](int round, double multiplier) { report(round, multiplier); }};
    std::optional<CoulombPair> pair = pairByCohesion<Rows, Forces>(given, start.contactForce, tools);
    if (pair)
    {
        descend(std::move(*pair));
    }
    return pair.has_value();
}

template<int Rows, int Forces>
bool CollapseSearch<Rows, Forces>::follow(const Start& start, const CollapsePathSettings& settings)
{
    CollapsePair found = path(start, settings);
    if (found.end == PathEnd::fall)
    {
        considerFall(found);
    }
    const double power = given.liveLoad.dot(found.mechanism);
    if ((found.end != PathEnd::collapse && found.end != PathEnd::unfinished) || power == 0)
    {
        return false;
    }
    CoulombPair pair{found.multiplier, std::move(found.contactForce), found.mechanism / power, {}};
    if (!take(pair) && !(takesMechanisms && takeMechanism(pair)))
    {
        return false;
    }
    descend(std::move(pair));
    return true;
}

template<int Rows, int Forces>
bool CollapseSearch<Rows, Forces>::followWedged(const Start& start, CollapsePathSettings settings)
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
    const Start near = movedInwards(associativePair.alpha, associativePair.contactForce);
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
        if (!least || !(least->pair.alpha < highest) || !consider(least->pair))
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
