// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The programs in turn that lead to the solution of a theta step.
#include "dynamics/ThetaStep.h"

#include "dynamics/AcceleratedIteration.h"
#include "dynamics/AllowedFlowError.h"
#include "dynamics/CoulombFlow.h"
#include "dynamics/FollowedFlow.h"
#include "dynamics/OneProgram.h"
#include "dynamics/RestingStep.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace drystone
{
namespace
{

constexpr int maximumPrograms = 60;

/// Of the fixed point from the motion that was expected; then once more from the associative solution, as if
/// they stuck. Where no sliding motion exists (Painleve's rod) only that leads to the solution. Before it,
/// Newton's method from no forces at all: just above a threshold Coulomb's motion is thousands of times the
/// associative one, near which it is not (a prism that begins to slide in a groove).
constexpr int programsToRestart = 30;

/// Newton's method reaches Coulomb's law exactly, most often from the first program or the second, and is
/// tried after both, in an impact after the first.
constexpr int newtonSteps = 60; // nearly all tries that end take less than 50

/// Impacts of a wall hit 150 points at once, where Newton's method seldom ends.
constexpr int newtonStepsOfImpact = 20;

/// Only the last program of Coulomb's law has to be solved to the tolerance, those before it to so many times
/// it.
constexpr double nearlySolved = 1000;

/// Gaps of bonds are met to this part of the error allowed in gaps, or as well as so many programs do it.
constexpr double unstrained = 1e-6;
constexpr int programsToStrainedBonds = 8;

/// The largest |u_t| of the solution of the last program, -z_t of z = g - A'y, at points that carry a force.
template<int Dim>
double largestSlip(const ThetaStep& step, double tolerance)
{
    const double least = tolerance * step.contactForce.lpNorm<Eigen::Infinity>();
    double largest = 0;
    for (Eigen::Index row = 0; row < step.contactForce.size(); row += Dim)
    {
        if (step.contactForce[row] > least)
        {
            largest = std::max(
                largest,
                (step.gap.segment<Dim - 1>(row + 1) - step.closing.segment<Dim - 1>(row + 1)).norm());
        }
    }
    return largest;
}

/// A step between the programs that lead to its solution. Each program is linearised about the motion that
/// the last one found, with the gaps that Coulomb's law opens by it.
template<int Dim>
class StepSearch
{
public:
    StepSearch(StepProgram<Dim> stepProgram, const StepSettings& stepSettings, const StepGuess& stepGuess,
               const Relinearisation<Dim>& relinearisation, SymbolicAnalysis* keptAnalysis)
        : program(std::move(stepProgram)),
          settings(stepSettings),
          guess(stepGuess),
          relinearise(relinearisation),
          symbolic(keptAnalysis),
          isGuessed(stepGuess.displacement.size() > 0),
          isCoulomb(stepSettings.flowRule == FlowRule::nonAssociative),
          isImpact(stepSettings.kind == StepKind::impact)
    {
        step.interior = guess.interior;
    }

    ThetaStep solve();

private:
    void flyFreely();
    bool rests();
    void chooseFollowing();
    void chooseStart();
    void expectSliding();
    bool beginsAtRest() const;
    bool staysAtRest();
    bool isNewtonsTurn() const;
    bool reachesFlow();
    bool endsBeforePrograms();
    void predictSliding();
    void solvePrograms();
    void solveProgram();
    bool stands();
    void completeStep();
    bool isOfNoUse() const;
    bool beginsFromPlace();
    double wayOfLoads() const;
    bool meetsFlow();
    bool meetsGaps();
    FlowProblem<Dim> flowProblem()
    {
        return {program, settings, relinearise, expected, symbolic ? *symbolic : ownAnalysis};
    }

    ThetaStep step;
    StepProgram<Dim> program;
    const StepSettings& settings;
    const StepGuess& guess;
    const Relinearisation<Dim>& relinearise;
    SymbolicAnalysis* symbolic;
    SymbolicAnalysis ownAnalysis; ///< where none is kept
    bool isGuessed;
    bool isCoulomb;
    bool isImpact;

    Following fromLastStep = Following::fromAnyForces;
    Following afterProgram = Following::fromAnyForces; ///< from that of the first program
    ConeSolution start;
    Eigen::VectorXd expected; ///< motion of the blocks, by the guess; of Coulomb's law
    Eigen::VectorXd imposed;  ///< share of the gaps that it opens, one a point
    Eigen::VectorXd gap;      ///< of the program without that share
    AcceleratedIteration fixedPoint;
    std::vector<MissedFlow> missed; ///< by the programs in turn
    bool isPredicted = false;       ///< the programs began with openings by alternating directions
    bool isBalanced = false; ///< displacements of the last program are those that its forces give the blocks
};

/// Without contact points.
template<int Dim>
void StepSearch<Dim>::flyFreely()
{
    step.displacement = displacementUnder(program, program.load);
    step.status = SolveStatus::optimal;
    if constexpr (Dim == 3)
    {
        if (relinearise) // blocks that turn
        {
            step.contactForce.resize(0);
            relinearise(step.displacement, step.contactForce, program);
            if (!keepMomenta(step, program, relinearise))
            {
                step.status = SolveStatus::notConverged;
            }
        }
    }
}

/// Whether the blocks stay at rest, by forces near those of the guess.
template<int Dim>
bool StepSearch<Dim>::rests()
{
    start.displacement = guess.displacement;
    start.contactForce = guess.contactForce.size() == Dim * program.points()
                             ? guess.contactForce
                             : Eigen::VectorXd::Zero(Dim * program.points());
    Rest rest = restWith(program, start.contactForce);
    step.initialResidual = rest.certificate.worst();
    if (rest.certificate.worst() > settings.solver.tolerance && isGuessed
        && mayStayAtRest(program, start, settings))
    {
        rest = restWithin(program, start.contactForce, settings, step, symbolic);
    }
    return comesToRest(step, program, std::move(rest), settings.solver.tolerance);
}

/// In the plane paths from afar lead by the same forces of soft points: one is tried. In space such a path is
/// long, and in large structures often leads nowhere: it is tried where a motion begins, and where one that
/// was followed is lost.
template<int Dim>
void StepSearch<Dim>::chooseFollowing()
{
    if constexpr (Dim == 3)
    {
        // Where overlaps are closed they show nothing.
        const bool isFollowed = settings.overlaps == Overlaps::closed && !isImpact
                                    ? !settings.isFixedPointOnly
                                    : areFollowed(program, start.contactForce);
        const bool begins =
            !isImpact && (!isGuessed || guess.displacement.isZero(0) || start.contactForce.isZero(0));
        fromLastStep = isFollowed ? Following::fromLastStep : Following::notAtAll;
        afterProgram = isFollowed || begins ? Following::fromAnyForces : Following::notAtAll;
    }
    else if (isCoulomb && mayGoOn(program, settings, start))
    {
        afterProgram = Following::fromLastStep;
    }
}

template<int Dim>
void StepSearch<Dim>::chooseStart()
{
    start.interior = step.interior;
    if (start.contactForce.template lpNorm<Eigen::Infinity>() > 0)
    {
        // Where the forces of the last step would take the blocks: in steady motion that is nearly the
        // solution.
        start.displacement =
            displacementUnder(program, program.load - applyEquilibrium(program, start.contactForce));
    }
    if (isCoulomb)
    {
        expectSliding();
    }
    if (relinearise && isGuessed)
    {
        // About the expected motion, so that what is left is of second order in the acceleration of blocks.
        relinearise(guess.displacement, start.contactForce, program);
    }
}

/// What Coulomb's law needs of a guess: where the blocks will be, and how far points open by sliding there.
template<int Dim>
void StepSearch<Dim>::expectSliding()
{
    imposed = isGuessed ? dilatancy(program, applyTransposed(program, guess.displacement), start.contactForce)
                        : Eigen::VectorXd(Eigen::VectorXd::Zero(program.points()));
    // An impact starts from nothing, as it changes much at times, but its error counts as a share of the
    // change.
    expected = isGuessed  ? guess.displacement
               : isImpact ? displacementUnder(program, program.load)
                          : Eigen::VectorXd(Eigen::VectorXd::Zero(program.load.size()));
}

/// Whether blocks stand, or move by no more than points may give way.
template<int Dim>
bool StepSearch<Dim>::beginsAtRest() const
{
    return !isImpact && !program.hasCompliance() && isGuessed && !start.contactForce.isZero(0)
           && farthestMotion<Dim>(guess.displacement, settings.blockSize) <= yieldingOf(settings);
}

/// Whether there are forces that hold the blocks where they are, by a program of the associative law, which
/// has no other solution then. By Coulomb's law it may: what is at rest stays at rest if it can. Points that
/// give way count as touching: rigid ones would be pushed apart by their overlaps, and a structure that has
/// come to rest on them would be moved by that in each step, until no step is found.
template<int Dim>
bool StepSearch<Dim>::staysAtRest()
{
    ThetaStep trial = step;
    solveOnce(trial, closedWithin(program, settings), settings, start, symbolic);
    step.iterations = trial.iterations;
    step.factorisations = trial.factorisations;
    const bool isAtRest = trial.status == SolveStatus::optimal && trial.displacement.isZero(0);
    if (isAtRest)
    {
        step = std::move(trial);
    }
    return isAtRest;
}

template<int Dim>
bool StepSearch<Dim>::isNewtonsTurn() const
{
    return isCoulomb && !program.hasCompliance()
           && (step.programs == 1 || (step.programs == 2 && !isImpact) || step.programs == programsToRestart);
}

/// Whether Coulomb's law is reached by following forces or by Newton's method; otherwise the step is as it
/// was.
template<int Dim>
bool StepSearch<Dim>::reachesFlow()
{
    program.gap = gap;
    const FlowProblem<Dim> problem = flowProblem();
    if (step.programs == 1 && followFlow(step, problem, start, afterProgram))
    {
        return true;
    }
    if (step.programs == 1 && afterProgram != Following::notAtAll)
    {
        predictSliding();
    }
    ConeSolution from = start;
    if (step.programs == programsToRestart) // from nothing
    {
        from.displacement = expected;
        from.contactForce.setZero();
    }
    return (!settings.isFixedPointOnly || step.programs == programsToRestart)
           && solveFlow(step, problem, std::move(from),
                        {isImpact ? newtonStepsOfImpact : newtonSteps, settings.contactTolerance});
}

/// The next program.
template<int Dim>
void StepSearch<Dim>::solveProgram()
{
    for (int point = 0; isCoulomb && point < program.points(); ++point)
    {
        program.gap[Dim * point] = gap[Dim * point] + imposed[point];
    }
    step.load = program.load;
    step.gap = program.gap;
    isBalanced = solveOnce(step, program, settings, start, symbolic);
}

/// Whether no further program can begin with the last one's solution. Only the last program of Coulomb's law
/// has to be solved to the tolerance.
template<int Dim>
bool StepSearch<Dim>::isOfNoUse() const
{
    return step.status != SolveStatus::optimal
           && (!isCoulomb || step.certificate.worst() > nearlySolved * settings.solver.tolerance
               || step.programs == maximumPrograms
               || (!program.hasStrength()
                   && step.contactForce.lpNorm<Eigen::Infinity>()
                          > largestForce(program, settings.blockSize)));
}

/// Where blocks are wedged, to linearise about a motion that they do not take makes overlaps of second order,
/// which no motion can open. Then the first program of the associative law is linearised where the blocks are
/// instead (by Coulomb's law what follows forces finds such steps). \return whether it was not
template<int Dim>
bool StepSearch<Dim>::beginsFromPlace()
{
    if (isCoulomb || !relinearise || !isGuessed || step.programs != 1 || isImpact)
    {
        return false;
    }
    program.gap = gap;
    relinearise(Eigen::VectorXd(Eigen::VectorXd::Zero(program.load.size())), start.contactForce, program);
    gap = program.gap;
    return true;
}

/// How far the loads would take the blocks without contacts [m].
template<int Dim>
double StepSearch<Dim>::wayOfLoads() const
{
    return farthestMotion<Dim>(displacementUnder(program, program.load), settings.blockSize);
}

/// Whether the gaps that the motion opens by Coulomb's law are those that the program had; the next has new
/// ones.
template<int Dim>
bool StepSearch<Dim>::meetsFlow()
{
    const Eigen::VectorXd opening = dilatancy(program, step.closing, step.contactForce);
    const double least = settings.solver.tolerance * step.contactForce.template lpNorm<Eigen::Infinity>();
    step.flowError = errorOfFlow<Dim>(imposed, opening, gap, step, least);
    missed.push_back({step.flowError, farthestMotion<Dim>(step.displacement - expected, settings.blockSize)});
    const bool isMet = step.flowError <= allowedFlowError<Dim>(
                           {step, opening, gap, missed, wayOfLoads(), isPredicted, isBalanced}, settings);
    imposed = fixedPoint.next(imposed, opening);
    if (step.programs == programsToRestart)
    {
        fixedPoint = {};
        imposed.setZero();
    }
    return isMet;
}

/// Whether the gaps at the end of the motion are those of the linearised program; the next is linearised
/// about it.
template<int Dim>
bool StepSearch<Dim>::meetsGaps()
{
    program.gap = gap;
    const double error = relinearise(step.displacement, step.contactForce, program);
    gap = program.gap;
    // By the associative law bonds are rigid, and more of them than hold a block: whatever linearisation has
    // left of gaps that no motion closes stresses them up to their strength, without any load.
    const bool isStrained = program.hasStrength() && !isCoulomb && step.programs < programsToStrainedBonds
                            && !isWorkUsedUp(settings, step, program);
    return error <= (isStrained ? unstrained : 1) * settings.contactTolerance;
}

/// Whether the program had what its own solution gives: then that is the step. The next has it otherwise.
template<int Dim>
bool StepSearch<Dim>::stands()
{
    bool isSolution = step.status == SolveStatus::optimal;
    if (isCoulomb)
    {
        isSolution = meetsFlow() && isSolution;
    }
    if (relinearise)
    {
        isSolution = meetsGaps() && isSolution;
    }
    return isSolution;
}

template<int Dim>
void StepSearch<Dim>::completeStep()
{
    step.slip = largestSlip<Dim>(step, settings.solver.tolerance);
    if (relinearise && isBalanced && settings.keepsMomenta && !keepMomenta(step, program, relinearise))
    {
        step.status = SolveStatus::notConverged;
    }
}

/// Whether the step is found without the programs of a search: in flight, at rest, or by going on from the
/// forces of the last step.
template<int Dim>
bool StepSearch<Dim>::endsBeforePrograms()
{
    if (program.points() == 0)
    {
        flyFreely();
        return true;
    }
    if (rests())
    {
        return true;
    }
    chooseFollowing();
    chooseStart();
    return isCoulomb
           && ((beginsAtRest() && staysAtRest())
               || goesOnFromLastStep(step, flowProblem(), start, fromLastStep));
}

/// In large structures of space whose forces are not followed programs begin with the openings of forces near
/// the least ones. Those of the last step, or of the interior point, keep a pressure between blocks that
/// nothing asks for, and hold them back.
template<int Dim>
void StepSearch<Dim>::predictSliding()
{
    if (!isCoulomb || !isGuessed)
    {
        return;
    }
    program.gap = gap;
    if (Eigen::VectorXd predicted = openingsOfLeastForces(step, flowProblem()); predicted.size() > 0)
    {
        imposed = std::move(predicted);
        fixedPoint = {};
        isPredicted = true;
    }
}

template<int Dim>
void StepSearch<Dim>::solvePrograms()
{
    gap = program.gap;
    if (afterProgram == Following::notAtAll)
    {
        predictSliding();
    }
    while (!(isNewtonsTurn() && reachesFlow()))
    {
        solveProgram();
        if (isOfNoUse())
        {
            if (beginsFromPlace())
            {
                continue;
            }
            return;
        }
        if (stands())
        {
            completeStep();
            return;
        }
        if (step.programs == maximumPrograms || isWorkUsedUp(settings, step, program))
        {
            step.status = SolveStatus::notConverged;
            return;
        }
        start.displacement = step.displacement;
        start.contactForce = step.contactForce;
        start.interior = step.interior;
    }
}

template<int Dim>
ThetaStep StepSearch<Dim>::solve()
{
    if (!endsBeforePrograms())
    {
        solvePrograms();
    }
    return std::move(step);
}

} // namespace

template<int Dim>
ThetaStep solveThetaStep(StepProgram<Dim> program, const StepSettings& settings, const StepGuess& guess,
                         const Relinearisation<Dim>& relinearise, SymbolicAnalysis* symbolic)
{
    return StepSearch<Dim>(std::move(program), settings, guess, relinearise, symbolic).solve();
}

template ThetaStep solveThetaStep(StepProgram<2> program, const StepSettings& settings,
                                  const StepGuess& guess, const Relinearisation<2>& relinearise,
                                  SymbolicAnalysis* symbolic);
template ThetaStep solveThetaStep(StepProgram<3> program, const StepSettings& settings,
                                  const StepGuess& guess, const Relinearisation<3>& relinearise,
                                  SymbolicAnalysis* symbolic);

} // namespace drystone
