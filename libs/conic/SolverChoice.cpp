// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The turns of `automatic`: active rays, multipliers from nearby, the interior point, the last digits.
#include "conic/SolverChoice.h"

#include "conic/ActiveRays.h"
#include "conic/Certificate.h"
#include "conic/ElasticNewton.h"
#include "conic/form/Form.h"

#include <algorithm>
#include <array>
#include <limits>

namespace drystone
{
namespace
{

/// A start with such a certificate is worth some steps of the augmented Lagrangian, with a large penalty,
/// which keeps what is right in it and ends with the right active set, so that the next step takes one. From
/// further away the interior point is quicker.
constexpr double nearby = 1e-4;
constexpr int mostStepsFromNearby = 24;
constexpr double penaltyFromNearby = 1e4;

/// What the interior point reaches on every step; the digits beyond come from the augmented Lagrangian, whose
/// active set is then right and whose penalty can be large.
constexpr double attainable = 1e-10;
constexpr std::array penaltiesOfLastDigits{1e7, 1e5, 1e3, 1e9};

/// A certificate beyond this, or none that is a number, is of no start.
constexpr double astray = 1;

/// Down to here the interior point is tried once more where the active set does not settle, with all digits
/// requested.
constexpr double lastDigits = 1e-13;

} // namespace

void declare(Options& options, SolverChoice& choice)
{
    options.optional("solver", choice.solver,
                     "of the cone program; augmentedLagrangian and gaussSeidel solve steps in time only");
    options.optional("tolerance", choice.tolerance, "on every figure of the certificate")
        .above(0)
        .atMost(1e-3);
    options
        .optional("maximumIterations", choice.maximumIterations,
                  "of one attempt of a solver; after one that fails others follow, from other starts")
        .atLeast(1);
    options.optional("maximumSweeps", choice.maximumSweeps, "over all contact points, of gaussSeidel")
        .atLeast(1);
    options
        .optional(
            "maximumFactorisations", choice.maximumFactorisations,
            "of one step in time with all its programs and shorter attempts; half as many more go to a step "
            "whose impacts had no end with them, for blocks that then stay together; programs of more "
            "than 8 contact points a block, and sweeps (1/100), count by what they cost")
        .atLeast(1);
    options.optional("writeProgram", choice.writeProgram,
                     "which cone programs are written into postProcessing/, as solveProgram reads them");
    options.optional("writeIterations", choice.writeIterations,
                     "whether each iteration of interiorPoint gets a line in the log, with the reason for "
                     "stopping and the time of each phase");
    options.optional("correctors", choice.correctors, "of interiorPoint, tried with one factorisation")
        .atLeast(0)
        .atMost(20);
}

InteriorPointSettings interiorPointSettings(const SolverChoice& choice)
{
    InteriorPointSettings settings{choice.tolerance, choice.maximumIterations, choice.correctors};
    settings.writeIterations = choice.writeIterations;
    return settings;
}

bool solvesMotionOnly(SolverType solver)
{
    return solver == SolverType::augmentedLagrangian || solver == SolverType::gaussSeidel;
}

std::string nameOf(SolverType solver)
{
    for (const auto& [name, type] : namesOf(solver))
    {
        if (type == solver)
        {
            return std::string(name);
        }
    }
    return {};
}

namespace
{

/// Whether solvers are tried one after the other until one has reached the tolerance, or one alone.
enum class SolversTried
{
    one,
    untilSolved
};

/// The best of what the solvers that are tried one after the other have found, with the work of them all.
template<int Rows, int Forces>
class BestSolution
{
public:
    BestSolution(const ConeProgram<Rows, Forces>& ofProgram, SolversTried solversTried)
        : program(ofProgram), tried(solversTried)
    {
    }

    /// \return whether that ends the search
    bool take(const ConeSolution& solved)
    {
        if (!solved.interior.isEmpty())
        {
            interior = solved.interior;
        }
        const bool isSolved = solved.status == SolveStatus::optimal;
        const double itsError = isSolved ? 0 : certifyOptimal(program, solved).worst();
        if (isSolved || itsError < error || best.contactForce.size() == 0)
        {
            best = solved;
            error = itsError;
        }
        best.interior = interior;
        addWork(work, solved);
        static_cast<SolverWork&>(best) = work;
        best.isStartLost = isStartLost;
        return best.status == SolveStatus::optimal || tried == SolversTried::one;
    }

    void loseStart() { isStartLost = true; }

    /// What is solved to a larger tolerance than that of the choice.
    void goOn()
    {
        best.status = SolveStatus::notConverged;
        error = certifyOptimal(program, best).worst();
    }

    ConeSolution best;

private:
    const ConeProgram<Rows, Forces>& program;
    const SolversTried tried;
    double error = std::numeric_limits<double>::infinity();
    InteriorStart interior; ///< passed on the way
    SolverWork work;
    bool isStartLost = false;
};

/// Whether a program can be solved from near a solution, and to the last digits: one with inertia alone.
template<int Rows, int Forces>
bool isStepInTime(const ConeProgram<Rows, Forces>& program)
{
    return program.hasInertia() && !program.hasMultiplier() && !program.hasCrushing();
}

/// The digits that the interior point does not reach. \param from where multipliers begin
template<int Rows, int Forces>
void findLastDigits(const ConeProgram<Rows, Forces>& program, const SolverChoice& choice,
                    const ConeSolution& from, SymbolicAnalysis* kept, BestSolution<Rows, Forces>& found)
{
    // Which penalty keeps the most digits depends on how stiff the contacts are compared with the inertia.
    AugmentedLagrangianSettings multipliers{choice.tolerance, choice.maximumIterations};
    multipliers.stop = StopWhen::settled;
    for (const double penalty : penaltiesOfLastDigits)
    {
        multipliers.penalty = penalty;
        if (found.take(solveAugmentedLagrangian(program, from, multipliers, kept)))
        {
            return;
        }
    }
    if (isStepInTime(program) && choice.tolerance < attainable && choice.tolerance >= lastDigits)
    {
        found.take(solveInteriorPoint(program, interiorPointSettings(choice), kept));
    }
}

/// From the last step if it is near; else by the interior point, and the last digits from there.
template<int Rows, int Forces>
ConeSolution solveAutomatically(const ConeProgram<Rows, Forces>& program, const SolverChoice& choice,
                                const ConeSolution& start, SymbolicAnalysis* kept)
{
    const bool canStart = isStepInTime(program);
    const bool isStarted = canStart && start.contactForce.size() == Forces * program.points()
                           && start.displacement.size() == program.load.size();
    if constexpr (Forces == 2)
    {
        if (isStarted && !program.hasStrength())
        {
            if (std::optional<ConeSolution> few = solveByActiveRays(program, start, choice.tolerance))
            {
                return *std::move(few);
            }
        }
    }
    BestSolution<Rows, Forces> found(program, canStart ? SolversTried::untilSolved : SolversTried::one);
    if (isStarted && choice.isNearTried && certifyOptimal(program, start).worst() <= nearby)
    {
        AugmentedLagrangianSettings multipliers{choice.tolerance,
                                                std::min(mostStepsFromNearby, choice.maximumIterations)};
        multipliers.penalty = penaltyFromNearby;
        multipliers.stop = choice.tolerance >= attainable ? StopWhen::certified : StopWhen::settled;
        if (found.take(solveAugmentedLagrangian(program, start, multipliers, kept)))
        {
            return std::move(found.best);
        }
        found.loseStart();
    }
    SolverChoice within = choice; // of what the interior point reaches
    within.tolerance = canStart ? std::max(choice.tolerance, attainable) : choice.tolerance;
    InteriorPointSettings ofRough = interiorPointSettings(within);
    ofRough.arithmetic = canStart ? Arithmetic::standard : Arithmetic::adaptive;
    const ConeSolution rough =
        solveInteriorPoint(program, ofRough, kept, isStarted && !program.hasStrength() ? &start : nullptr);
    if (found.take(rough) && (within.tolerance == choice.tolerance || !canStart))
    {
        return std::move(found.best);
    }
    found.goOn();
    // Where the interior point has come to nothing, from where the step begins.
    const bool isRoughStart = certifyOptimal(program, rough).worst() <= astray;
    findLastDigits(program, choice, isRoughStart ? rough : start, kept, found);
    return std::move(found.best);
}

template<int Rows, int Forces>
ConeSolution solveAsChosen(const ConeProgram<Rows, Forces>& program, const SolverChoice& choice,
                           const ConeSolution& start, SymbolicAnalysis* kept)
{
    if (program.hasCompliance()) // which no other solver takes
    {
        return choice.solver == SolverType::gaussSeidel
                   ? solveGaussSeidel(program, start, {choice.tolerance, choice.maximumSweeps})
                   : solveElasticNewton(program, start, {choice.tolerance, choice.maximumIterations}, kept);
    }
    switch (choice.solver)
    {
    case SolverType::interiorPoint:
        return solveInteriorPoint(program, interiorPointSettings(choice), kept);
    case SolverType::augmentedLagrangian:
        return solveAugmentedLagrangian(program, start, {choice.tolerance, choice.maximumIterations}, kept);
    case SolverType::gaussSeidel:
        return solveGaussSeidel(program, start, {choice.tolerance, choice.maximumSweeps});
    case SolverType::automatic:
        break;
    }
    return solveAutomatically(program, choice, start, kept);
}

} // namespace

template<int Rows, int Forces>
ConeSolution solveConeProgram(const ConeProgram<Rows, Forces>& program, const SolverChoice& choice,
                              const ConeSolution& start, SymbolicAnalysis* kept)
{
    SymbolicAnalysis own; // shared by the solvers that are tried
    ConeSolution solution = solveAsChosen(program, choice, start, kept ? kept : &own);
    choice.observer(program, solution);
    return solution;
}

template ConeSolution solveConeProgram(const PlaneConeProgram&, const SolverChoice&, const ConeSolution&,
                                       SymbolicAnalysis*);
template ConeSolution solveConeProgram(const SpaceConeProgram&, const SolverChoice&, const ConeSolution&,
                                       SymbolicAnalysis*);

} // namespace drystone
