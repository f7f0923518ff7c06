// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The proofs of the interior point: an optimum to the certificate, or that there is none, by programs of
/// their own.
#include "conic/InteriorPoint.h"

#include "conic/AugmentedLagrangian.h"
#include "conic/Certificate.h"
#include "conic/UpperBounds.h"
#include "conic/form/Form.h"
#include "conic/interiorPoint/SolveOnce.h"
#include "conic/interiorPoint/Trace.h"
#include "core/Log.h"

#include <limits>
#include <stdexcept>

namespace drystone
{
namespace
{

/// A solution and the worst figure of what proves it.
struct Proved
{
    ConeSolution solution;
    double worst = std::numeric_limits<double>::infinity();
};

/// As `solveOnce`, to a certificate: what the scaled residuals promise, the certificate may miss by a little
/// (others are the largest of its terms), and what proves nothing at one tolerance may do so at a tighter
/// one. Then it is solved again, ten times as well, where that is not hopeless. \param worst figure of the
/// certificate of a solution \return the last solution, with all the work counted
template<int Rows, int Forces, class Worst>
Proved solveToCertificate(const ConeProgram<Rows, Forces>& program, InteriorPointSettings settings,
                          const Aim& aim, SymbolicAnalysis& symbolic, const Worst& worst,
                          const ConeSolution* near = nullptr)
{
    constexpr int attempts = 3;
    constexpr double hopeless = 1e4; // times the tolerance
    const double tolerance = settings.tolerance;
    Proved proved;
    proved.solution = solveOnce(program, settings, aim, symbolic, near);
    proved.worst = worst(proved.solution);
    if (proved.solution.status == SolveStatus::notConverged && proved.worst <= tolerance)
    {
        proved.solution.status = SolveStatus::optimal; // whatever has ended the iterations
    }
    for (int attempt = 1; attempt < attempts && proved.solution.status == SolveStatus::optimal
                          && proved.worst > tolerance && proved.worst <= hopeless * tolerance;
         ++attempt)
    {
        settings.tolerance /= 10;
        Proved better;
        better.solution = solveOnce(program, settings, aim, symbolic);
        better.worst = worst(better.solution);
        if (better.solution.status != SolveStatus::optimal && better.worst > tolerance)
        {
            addWork(proved.solution, better.solution);
            break; // beyond what rounding allows
        }
        addWork(better.solution, proved.solution);
        proved = std::move(better);
        proved.solution.status = SolveStatus::optimal;
    }
    return proved;
}

/// Any forces that balance the load will do: y = 0 completes them.
template<int Rows, int Forces>
bool isBalanceAlone(const ConeProgram<Rows, Forces>& program)
{
    return !program.hasMultiplier() && !program.hasInertia() && program.gap.size() == 0;
}

/// The worst figure of the certificate of an optimum, which the solution is completed for.
template<int Rows, int Forces>
double worstOfOptimum(const ConeProgram<Rows, Forces>& program, ConeSolution& found)
{
    if (isBalanceAlone(program))
    {
        found.displacement.setZero();
    }
    return certifyOptimal(program, found).worst();
}

/// The least r with r + A c = f + alpha L. Without gaps: whether forces balance a load does not depend on
/// them.
template<int Rows, int Forces>
ConeProgram<Rows, Forces> fallProgram(const ConeProgram<Rows, Forces>& program)
{
    ConeProgram<Rows, Forces> moving = withUnitInertia(program);
    moving.gap.resize(0);
    return moving;
}

/// Where rounding may have ended the iterations: the same in extended precision, its optimum or the proof
/// that there is none. \param solution gets the work, and what is answered with its status
template<int Rows, int Forces>
void answerInExtendedPrecision(const ConeProgram<Rows, Forces>& program,
                               const InteriorPointSettings& settings, SymbolicAnalysis& symbolic,
                               ConeSolution& solution)
{
    if (!mayBeExtended(program, settings, symbolic))
    {
        return;
    }
    Proved proved = solveToCertificate(program, settings, {Sought::solution, 0, Numbers::extended}, symbolic,
                                       [&](ConeSolution& found) { return worstOfOptimum(program, found); });
    addWork(solution, proved.solution);
    if (proved.worst <= settings.tolerance)
    {
        solution.status = SolveStatus::optimal;
        solution.multiplier = proved.solution.multiplier;
        solution.contactForce = std::move(proved.solution.contactForce);
        solution.displacement = std::move(proved.solution.displacement);
        return;
    }
    if (program.hasInertia() || proved.solution.status == SolveStatus::unbounded)
    {
        return;
    }
    const Proved moved = solveToCertificate(
        fallProgram(program), settings, {Sought::fall, 0, Numbers::extended}, symbolic,
        [&](const ConeSolution& found) { return certifyInfeasible(program, found.displacement).worst(); });
    addWork(solution, moved.solution);
    if (moved.worst <= settings.tolerance)
    {
        solution.status = SolveStatus::infeasible;
        solution.displacement = moved.solution.displacement;
    }
}

/// Where r of the least-squares program does not vanish but is small, its y is good for a proof only if it is
/// exact to the square of r: that takes an active set. Loads out of balance by 1e-5 of their size at best are
/// so distinguished from such as are carried.
/// \param moving the program with unit inertia \param moved its solution, nearly
template<int Rows, int Forces>
void answerExactly(const ConeProgram<Rows, Forces>& program, const ConeProgram<Rows, Forces>& moving,
                   const ConeSolution& moved, const InteriorPointSettings& settings,
                   SymbolicAnalysis& symbolic, ConeSolution& solution)
{
    ConeSolution exact =
        solveAugmentedLagrangian(moving, moved, exactSettings(settings.maximumIterations), &symbolic);
    addWork(solution, exact);
    if (certifyInfeasible(program, exact.displacement).worst() <= settings.tolerance)
    {
        solution.status = SolveStatus::infeasible;
        solution.displacement = std::move(exact.displacement);
        return;
    }
    exact.displacement.setZero();
    if (certifyOptimal(program, exact).worst() <= settings.tolerance)
    {
        solution.status = SolveStatus::optimal;
        solution.contactForce = std::move(exact.contactForce);
        solution.displacement = std::move(exact.displacement);
    }
}

/// Where the interior point has not reached the tolerance: the multiplier by upper bounds, if there is one,
/// in programs small enough for some hundred factorisations.
template<int Rows, int Forces>
void boundMultiplier(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                     ConeSolution& solution)
{
    constexpr int mostPoints = 5000;
    if (!hasUpperBounds(program) || program.points() > mostPoints)
    {
        return;
    }
    ConeSolution bounded =
        solveByUpperBounds(program, solution.multiplier, settings.tolerance, settings.maximumIterations);
    addWork(solution, bounded);
    if (bounded.status == SolveStatus::optimal)
    {
        solution.status = SolveStatus::optimal;
        solution.multiplier = bounded.multiplier;
        solution.contactForce = std::move(bounded.contactForce);
        solution.displacement = std::move(bounded.displacement);
    }
}

/// Forces that carry the live load alone are the ray; they grow without limit where crushing sets none.
/// \param solution gets the work, and the ray and its status where there is one \return whether there is
template<int Rows, int Forces>
bool proveUnbounded(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                    SymbolicAnalysis& symbolic, ConeSolution& solution)
{
    ConeProgram<Rows, Forces> live = liveLoadAlone(program);
    live.strength.clear();
    for (int point = 0; program.hasStrength() && point < program.points(); ++point)
    {
        if (program.strength[point].isBounded())
        {
            live.contacts[point].onFirst.setZero();
            live.contacts[point].onSecond.setZero();
        }
    }
    Proved carried =
        solveToCertificate(live, settings, {Sought::carried}, symbolic,
                           [&](ConeSolution& found)
                           {
                               for (int point = 0; program.hasStrength() && point < program.points(); ++point)
                               {
                                   if (program.strength[point].isBounded())
                                   {
                                       found.contactForce.template segment<Forces>(Forces * point).setZero();
                                   }
                               }
                               return certifyUnbounded(program, found.contactForce).worst();
                           });
    addWork(solution, carried.solution);
    if (!(carried.worst <= settings.tolerance))
    {
        return false;
    }
    solution.status = SolveStatus::unbounded;
    solution.contactForce = std::move(carried.solution.contactForce);
    return true;
}

/// Whether forces balance the loads at a large multiplier. \param solution gets the work
template<int Rows, int Forces>
bool isLargeMultiplierCarried(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                              SymbolicAnalysis& symbolic, ConeSolution& solution)
{
    const ConeProgram<Rows, Forces> loaded = atLargeMultiplier(program);
    const Proved balanced = solveToCertificate(loaded, settings, {Sought::solution}, symbolic,
                                               [&](ConeSolution& found)
                                               {
                                                   found.displacement.setZero();
                                                   return certifyOptimal(loaded, found).worst();
                                               });
    addWork(solution, balanced.solution);
    return balanced.worst <= settings.tolerance;
}

/// Where there is no load but the live one: no force at all, with the displacements of the solution.
/// Iterations do not come to it, as they seek forces and the multiplier to a share of themselves, which zero
/// has not. \return whether that is proved; then it is the solution
template<int Rows, int Forces>
bool answerWithoutForces(const ConeProgram<Rows, Forces>& program, double tolerance, ConeSolution& solution)
{
    if (!program.load.isZero(0) || solution.displacement.size() != program.load.size())
    {
        return false;
    }
    ConeSolution without = solution;
    without.status = SolveStatus::optimal;
    without.multiplier = 0;
    without.contactForce = Eigen::VectorXd::Zero(Forces * program.points());
    if (!(certifyOptimal(program, without).worst() <= tolerance))
    {
        return false;
    }
    solution = std::move(without);
    return true;
}

/// Where the multiplier has passed what structures bear: without limit if that is proved, else again with
/// room for it. \param solve for an aim \return whether it is proved to have no limit
template<int Rows, int Forces, class Solve>
bool isWithoutLimit(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                    SymbolicAnalysis& symbolic, const Solve& solve, Proved& proved)
{
    ConeSolution& growing = proved.solution;
    if (isLargeMultiplierCarried(program, settings, symbolic, growing)
        && proveUnbounded(program, settings, symbolic, growing))
    {
        return true;
    }
    // First in units of what breaks a point, then as iterates only passed such a multiplier.
    const std::vector<double> expected =
        program.hasStrength() ? std::vector<double>{growing.multiplier, 0} : std::vector<double>{0};
    for (const double multiplier : expected)
    {
        Proved farther = solve({Sought::farther, multiplier});
        addWork(farther.solution, proved.solution);
        proved = std::move(farther);
        if (proved.worst <= settings.tolerance)
        {
            break;
        }
    }
    return false;
}

/// Where the iterations have found no optimum: that nothing balances the loads, or any multiple of the live
/// load, or what extended precision, an active set and upper bounds say. \param solution gets the work, and
/// what is answered with its status
template<int Rows, int Forces>
void answerWithoutOptimum(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                          SymbolicAnalysis& symbolic, ConeSolution& solution)
{
    // Where the least r does not vanish, y = Mbar^-1 r proves that nothing balances f, since the optimality
    // conditions are -A'y in the dual cone, L'y = 0 and f'y = r' Mbar^-1 r > 0.
    const ConeProgram<Rows, Forces> moving = fallProgram(program);
    const Proved moved = solveToCertificate(
        moving, settings, {Sought::fall}, symbolic,
        [&](const ConeSolution& found) { return certifyInfeasible(program, found.displacement).worst(); });
    addWork(solution, moved.solution);
    if (moved.worst <= settings.tolerance)
    {
        solution.status = SolveStatus::infeasible;
        solution.displacement = moved.solution.displacement;
        return;
    }
    answerInExtendedPrecision(program, settings, symbolic, solution);
    if (solution.status != SolveStatus::notConverged)
    {
        return;
    }
    if (isBalanceAlone(program) && !program.hasCrushing())
    {
        answerExactly(program, moving, moved.solution, settings, symbolic, solution);
    }
    if (!program.hasMultiplier())
    {
        return;
    }
    proveUnbounded(program, settings, symbolic, solution);
    if (solution.status == SolveStatus::notConverged)
    {
        boundMultiplier(program, settings, solution);
    }
}

template<int Rows, int Forces>
ConeSolution solveAndProve(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                           SymbolicAnalysis* kept, const ConeSolution* near)
{
    SymbolicAnalysis own;
    SymbolicAnalysis& symbolic = kept ? *kept : own;
    if (program.hasCompliance())
    {
        throw std::invalid_argument("solveInteriorPoint needs rigid points");
    }
    if (near && (!program.hasInertia() || program.hasMultiplier() || program.hasStrength()))
    {
        throw std::invalid_argument(
            "solveInteriorPoint begins near a solution with inertia, cones and no multiplier only");
    }
    if (isBalanceAlone(program))
    {
        ConeSolution resting;
        resting.displacement = Eigen::VectorXd::Zero(program.load.size());
        if (answerWithoutForces(program, settings.tolerance, resting))
        {
            return resting;
        }
    }
    const auto solveFor = [&](const Aim& aim)
    {
        return solveToCertificate(
            program, settings, aim, symbolic,
            [&](ConeSolution& found) { return worstOfOptimum(program, found); }, near);
    };
    Proved proved = solveFor({Sought::solution});
    ConeSolution& solution = proved.solution;
    if (solution.status == SolveStatus::unbounded
        && isWithoutLimit(program, settings, symbolic, solveFor, proved))
    {
        return std::move(solution);
    }
    if (proved.worst > settings.tolerance && answerWithoutForces(program, settings.tolerance, solution))
    {
        return std::move(solution);
    }
    if (solution.status == SolveStatus::optimal)
    {
        if (proved.worst > settings.tolerance)
        {
            solution.status = SolveStatus::notConverged;
            answerInExtendedPrecision(program, settings, symbolic, solution);
        }
        if (solution.status == SolveStatus::notConverged)
        {
            boundMultiplier(program, settings, solution);
        }
    }
    else if (program.hasInertia())
    {
        answerInExtendedPrecision(program, settings, symbolic, solution);
    }
    else
    {
        answerWithoutOptimum(program, settings, symbolic, solution);
    }
    return std::move(solution);
}

} // namespace

template<int Rows, int Forces>
ConeSolution solveInteriorPoint(const ConeProgram<Rows, Forces>& program,
                                const InteriorPointSettings& settings, SymbolicAnalysis* kept,
                                const ConeSolution* near)
{
    if (!settings.writeIterations)
    {
        return solveAndProve(program, settings, kept, near);
    }
    IterationTrace trace;
    InteriorPointSettings traced = settings;
    traced.trace = settings.trace ? settings.trace : &trace;
    ConeSolution solution = solveAndProve(program, traced, kept, near);
    for (const std::string& line : traced.trace->text())
    {
        printLine(line);
    }
    return solution;
}

template ConeSolution solveInteriorPoint(const PlaneConeProgram&, const InteriorPointSettings&,
                                         SymbolicAnalysis*, const ConeSolution*);
template ConeSolution solveInteriorPoint(const SpaceConeProgram&, const InteriorPointSettings&,
                                         SymbolicAnalysis*, const ConeSolution*);

} // namespace drystone
