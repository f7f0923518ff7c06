// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Iterates on a program until one of the ends.
#include "conic/interiorPoint/Loop.h"

#include "core/Log.h"
#include "core/Threads.h"

#include <cmath>
#include <cstdio>
#include <limits>

namespace drystone
{
namespace
{

/// Iterations that begin near a solution, or inside, end soon or not at all; steps shorter than so much show
/// early that they will not: near a solution in space the first of them does (TUNING.md).
constexpr int mostFromNear = 30;
template<int Rows>
constexpr int mostShortSteps = Rows == 3 ? 3 : 0;
constexpr int mostFromInterior = 60;
constexpr int mostShortStepsFromInterior = 6;
constexpr double shortStep = 0.2;

/// Steps shorter than so much, so many in a row, are not followed by longer ones: a force or an opening has
/// come too near zero.
constexpr double standstill = 1e-3;
constexpr int mostStandstills = 4;

/// Newton's step removes as much of what is missing from the balance as it is long. Steps that are nearly
/// whole and leave more than this share of it show that the Schur system is not solved to any digit.
constexpr double wholeStep = 0.9;
constexpr double shareLeft = 0.5;
constexpr int mostStalls = 5;

/// Complementarity from which on iterates of steps in time are kept, and how many times more than in the last
/// of them, and than is allowed, is missing from a balance that is lost.
constexpr double firmUntil = 1e-9;
constexpr double lostBalance = 30;

/// A compliance bends the path of complementarities below this share of it.
constexpr double bentBelow = 1e-2;

constexpr double fullCorrection = 0.9; ///< a correction gets at least this weight when steps are long

/// Part of the way to the boundary that is gone at least; with rays the more, the nearer the end. A round
/// cone that comes nearer to its surface than its neighbours bends the scaled space so that steps become
/// short.
constexpr double partOfWay = 0.99;
constexpr double partOfWayOfRounds = 0.98;

/// Solves that a factorisation must cost, in multiplications, for all correctors to be tried; else half of
/// them are (Gondzio 1996 goes by the same ratio).
constexpr double expensiveFactorisation = 30;

/// A solution of which nothing has been heard for so long says on the log how far it is [s].
constexpr double longSilence = 5;
/// And one that takes longer than this shows it on a terminal [s].
constexpr double shortSilence = 1;

/// Says how far a solution is that takes long: the complementarity falls by about the same factor in each
/// iteration, from what it was at first to the tolerance.
class LongSolution
{
public:
    void iterated(int iteration, double now, double tolerance)
    {
        first = iteration == 0 ? now : first;
        const double seconds = clockTime() - start;
        if (seconds < shortSilence)
        {
            return;
        }
        const double done = std::log(first / now);
        const double toDo = std::log(now / tolerance);
        if (seconds - heard > longSilence)
        {
            heard = seconds;
            line.clear();
            info("    iteration {}: complementarity {:.1e} of {:.1e}{}", iteration, now, tolerance,
                 done > 0 && toDo > 0 ? ", about " + durationText(seconds * toDo / done) + " left" : "");
            std::fflush(stdout); // for those who follow the log
        }
        line.update(done > 0 && toDo > 0 ? done / (done + toDo) : 0, fmt::format("iteration {}", iteration));
    }

private:
    Progress line;
    double start = clockTime();
    double heard = 0; ///< after the start [s]
    double first = 0; ///< complementarity
};

} // namespace

template<int Rows, class Scalar>
InteriorPointLoop<Rows, Scalar>::InteriorPointLoop(const Form<Rows>& form, SchurSystem<Rows, Scalar>& system,
                                                   const InteriorPointSettings& settings, Sought sought)
    : state(form, settings, sought), newton(state, system), trace(settings.trace)
{
}

template<int Rows, class Scalar>
bool InteriorPointLoop<Rows, Scalar>::run(Start from, const Centring& centring)
{
    if (trace)
    {
        trace->runs.push_back({from == Start::unit ? "unit forces" : "least squares", {}, Ending::noStart});
    }
    if (!startFrom(from, state, newton))
    {
        end = Ending::noStart;
        return false;
    }
    return iterate(centring, Passed::kept, state.settings.maximumIterations,
                   state.settings.maximumIterations);
}

template<int Rows, class Scalar>
bool InteriorPointLoop<Rows, Scalar>::runNear(const Eigen::VectorXd& s, const Eigen::VectorXd& y,
                                              double error)
{
    if constexpr (std::is_same_v<Scalar, double>)
    {
        if (trace)
        {
            trace->runs.push_back({"near the last solution", {}, Ending::noStart});
        }
        newton.begin(0);
        startNear(s, y, error, state);
        return iterate(narrow, Passed::left, std::min(mostFromNear, state.settings.maximumIterations),
                       mostShortSteps<Rows>);
    }
    return false;
}

template<int Rows, class Scalar>
bool InteriorPointLoop<Rows, Scalar>::runInside(Iterate<double> interior, const Eigen::VectorXd& displacement)
{
    if constexpr (std::is_same_v<Scalar, double>)
    {
        if (trace)
        {
            trace->runs.push_back({"inside, from the last program", {}, Ending::noStart});
        }
        iteration = 0;
        newton.begin(0);
        if (startInside(std::move(interior), displacement, state))
        {
            return iterate(wide, Passed::kept, std::min(mostFromInterior, state.settings.maximumIterations),
                           mostShortStepsFromInterior);
        }
    }
    end = Ending::noStart;
    return false;
}

template<int Rows, class Scalar>
bool InteriorPointLoop<Rows, Scalar>::iterate(const Centring& centring, Passed whatIsPassed,
                                              int mostIterations, int shortStepsAllowed)
{
    passed = {};
    firm = {};
    stalls = 0;
    standstills = 0;
    expected = std::numeric_limits<double>::infinity();
    primal = dual = 0;
    LongSolution longSolution;
    std::optional<Ending> ended;
    for (iteration = 0; !(ended = findEnd(whatIsPassed, mostIterations)); ++iteration, ++iterationsOfAllRuns)
    {
        keepBalance();
        {
            const PhaseTimer timer(trace, Phase::factorise);
            if (!newton.factorise())
            {
                ended = Ending::notDefinite;
                break;
            }
        }
        seekForcesOfLoadAlone();
        const double sigma = centre(centring);
        correctTowards(centring, sigma);
        if (std::min(primal, dual) < shortStep && --shortStepsAllowed < 0)
        {
            ended = Ending::shortSteps;
            break;
        }
        standstills = std::max(primal, dual) < standstill ? standstills + 1 : 0;
        if (standstills == mostStandstills)
        {
            ended = Ending::shortSteps;
            break;
        }
        move();
        longSolution.iterated(iteration, state.mu, state.tolerance());
    }
    end = *ended;
    if (trace)
    {
        trace->runs.back().ending = end;
    }
    return end == Ending::converged;
}

/// Measures the iterate and looks for a reason to end.
template<int Rows, class Scalar>
std::optional<Ending> InteriorPointLoop<Rows, Scalar>::findEnd(Passed whatIsPassed, int mostIterations)
{
    const PhaseTimer timer(trace, Phase::residuals);
    state.measure();
    if (trace)
    {
        trace->runs.back().lines.push_back({iteration, state.mu, state.missing(),
                                            largestOf(state.residuals.opening), leading(state.at.alpha),
                                            std::min(1.0, primal), std::min(1.0, dual)});
    }
    const double missing = state.missing();
    stalls += missing > expected && missing > state.tolerance() * state.forceSize();
    if (!std::isfinite(state.mu))
    {
        return Ending::runsOff;
    }
    if (!state.form.hasInertia() && state.isFalling(possibleFall))
    {
        return Ending::falls;
    }
    if (state.sought == Sought::solution && leading(state.at.alpha) > possiblyUnlimited)
    {
        return Ending::grows;
    }
    if (state.diverges(iteration))
    {
        return Ending::runsOff;
    }
    if (whatIsPassed == Passed::kept && state.form.hasInertia() && passed.s.size() == 0
        && state.mu <= complementarityOfInterior)
    {
        passed = state.at;
    }
    if (state.isConverged()
        || (newton.mayRepairBalance() && state.isBalanceMissing() && newton.repairBalance()))
    {
        return Ending::converged;
    }
    if (stalls > mostStalls)
    {
        return Ending::stalled;
    }
    return iteration == mostIterations ? std::optional(Ending::tooManyIterations) : std::nullopt;
}

/// Steps in time end where D = s^2/mu of forces that press leaves no digit to the inertia added to it in the
/// Schur system. From the last iterate that was balanced a compliance of the cones bounds D.
template<int Rows, class Scalar>
void InteriorPointLoop<Rows, Scalar>::keepBalance()
{
    constexpr double compliance = regularisation<Scalar>.compliance;
    if (!state.form.hasInertia() || newton.isCompliant() || state.mu > firmUntil)
    {
        return;
    }
    const double aim = state.tolerance() * state.objectiveSize() / static_cast<double>(state.cones.degree());
    if (!(aim > bentBelow * compliance))
    {
        return;
    }
    const double missing = state.missing();
    if (firm.s.size() > 0 && missing > lostBalance * std::max(firmMissing, state.tolerance()))
    {
        state.at = std::move(firm);
        firm = {};
        state.measure();
        newton.begin(compliance);
        return;
    }
    firm = state.at;
    firmMissing = missing;
}

/// Forces of later iterates are too near the surface of their cones.
template<int Rows, class Scalar>
void InteriorPointLoop<Rows, Scalar>::seekForcesOfLoadAlone()
{
    if (std::is_same_v<Scalar, double> && state.form.hasMultiplier() && state.cones.degree() > 0
        && forcesOfLoad.size() == 0 && iteration <= 1 && state.sought == Sought::solution)
    {
        forcesOfLoad = newton.forcesOfLoadAlone(iteration);
    }
}

template<int Rows, class Scalar>
void InteriorPointLoop<Rows, Scalar>::measureSteps()
{
    newton.scaling.scale(state.cones, step.s, step.z, scaledStep);
    using Step = StepOfCones<AbreastInDoubles<Scalar>>;
    const auto& frames = newton.scaling.frames;
    primal = stepToBoundary(state.cones, frames,
                            Step{asDoubles(state.at.s), asDoubles(step.s), asDoubles(scaledStep.forces)});
    dual = stepToBoundary(state.cones, frames,
                          Step{asDoubles(state.at.z), asDoubles(step.z), asDoubles(scaledStep.openings)});
    if (state.form.hasInertia())
    {
        primal = dual = std::min(primal, dual); // y stands in the balance too
    }
}

/// The predictor, and Mehrotra's corrector. \return sigma
template<int Rows, class Scalar>
double InteriorPointLoop<Rows, Scalar>::centre(const Centring& centring)
{
    const PhaseTimer timer(trace, Phase::predict);
    newton.predict(step);
    measureSteps();
    const double primalHere = std::min(1.0, primal);
    const double dualHere = std::min(1.0, dual);
    const double muAfter = state.complementarityOf(state.at.s + Scalar(primalHere) * step.s,
                                                   state.at.z + Scalar(dualHere) * step.z);
    // Complementarity must not run ahead of the balance, or the balance can no longer be repaired: no further
    // than the tolerance requires.
    const double enough =
        0.02 * state.settings.tolerance * state.objectiveSize() / static_cast<double>(state.cones.degree());
    const double sigma =
        std::max(centring.partOfCube * std::pow(muAfter / state.mu, 3), std::min(1.0, enough / state.mu));
    pull = mehrotraPull(state, newton.scaling, step, scaledStep, sigma);
    newton.correct(pull, correction);
    addCorrection(primalHere * dualHere, centring.largestLoss);
    return sigma;
}

/// Gondzio's correctors.
template<int Rows, class Scalar>
void InteriorPointLoop<Rows, Scalar>::correctTowards(const Centring& centring, double sigma)
{
    const PhaseTimer timer(trace, Phase::correct);
    const int correctors = newton.factorisationOverSolve() < expensiveFactorisation
                               ? (state.settings.correctors + 1) / 2
                               : state.settings.correctors;
    const double aim = std::max(centring.aim * sigma, centring.leastAim) * state.mu;
    for (int corrector = 0; corrector < correctors && std::min(primal, dual) < centring.longStep; ++corrector)
    {
        const double primalAsked = std::min(1.0, centring.relativeGrowth * primal + centring.stepGrowth);
        const double dualAsked = std::min(1.0, centring.relativeGrowth * dual + centring.stepGrowth);
        pull = gondzioPull(state, newton.scaling, step, scaledStep, primalAsked, dualAsked, centring, aim);
        newton.correct(pull, correction);
        if (!addCorrection(std::min(primalAsked * dualAsked, fullCorrection), centring.largestLoss))
        {
            break;
        }
    }
}

/// Adds the correction in hand to the step, with the weights from `least` to 1 that allow the longest steps:
/// a corrector is made for a step that may turn out too long. \return whether it was worth adding
template<int Rows, class Scalar>
bool InteriorPointLoop<Rows, Scalar>::addCorrection(double least, double largestLoss)
{
    newton.scaling.scale(state.cones, correction.s, correction.z, scaledCorrection);
    using Step = StepOfCones<AbreastInDoubles<Scalar>>;
    const auto collect =
        [&](const Vector& x, const Vector& dx, const auto& scaled, const Vector& c, const auto& scaledC)
    {
        const auto& from = asDoubles(x);
        blocking.collect(state.cones, newton.scaling.frames, Step{from, asDoubles(dx), asDoubles(scaled)},
                         Step{from, asDoubles(c), asDoubles(scaledC)}, least);
    };
    blocking.clear();
    collect(state.at.s, step.s, scaledStep.forces, correction.s, scaledCorrection.forces);
    Weight forces;
    Weight openings;
    if (!state.form.hasInertia())
    {
        forces = blocking.best(least);
        blocking.clear();
    }
    collect(state.at.z, step.z, scaledStep.openings, correction.z, scaledCorrection.openings);
    openings = blocking.best(least);
    if (state.form.hasInertia())
    {
        forces = openings;
    }
    if (forces.step < largestLoss * std::min(1.0, primal)
        || openings.step < largestLoss * std::min(1.0, dual))
    {
        return false;
    }
    forParts(step.s.size(),
             [&](long begin, long past)
             {
                 const long count = past - begin;
                 step.s.segment(begin, count) += Scalar(forces.weight) * correction.s.segment(begin, count);
                 step.z.segment(begin, count) += Scalar(openings.weight) * correction.z.segment(begin, count);
             });
    step.alpha += Scalar(forces.weight) * correction.alpha;
    step.y += Scalar(openings.weight) * correction.y;
    scaledStep.add(scaledCorrection, forces.weight, openings.weight);
    primal = forces.step;
    dual = openings.step;
    return true;
}

template<int Rows, class Scalar>
void InteriorPointLoop<Rows, Scalar>::move()
{
    const PhaseTimer timer(trace, Phase::move);
    const double nearly = state.cones.rounds > 0 ? partOfWayOfRounds : std::max(partOfWay, 1 - state.mu);
    const double primalPart = std::min(1.0, nearly * primal);
    const double dualPart = std::min(1.0, nearly * dual);
    expected =
        primalPart >= wholeStep ? shareLeft * state.missing() : std::numeric_limits<double>::infinity();
    state.at.s += Scalar(primalPart) * step.s;
    state.at.alpha += Scalar(primalPart) * step.alpha;
    state.at.y += Scalar(dualPart) * step.y;
    state.at.z += Scalar(dualPart) * step.z;
    keepInside(state.cones, state.at.s);
    keepInside(state.cones, state.at.z);
}

template class InteriorPointLoop<3, double>;
template class InteriorPointLoop<6, double>;
template class InteriorPointLoop<3, DoubleDouble>;
template class InteriorPointLoop<6, DoubleDouble>;

} // namespace drystone
