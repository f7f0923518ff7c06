// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/ThetaStep.h"

#include "conic/CoulombNewton.h"
#include "conic/form/Form.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

constexpr int maximumPrograms = 60;

/// Of the fixed point from where the blocks were heading; then once more from the associative solution, as if
/// they stuck. Where no sliding motion exists (Painleve's rod) only that leads to the solution.
constexpr int programsToRestart = 30;

/// Newton's method reaches Coulomb's law exactly, most often from the first program or the second, and is
/// tried after both, in an impact after the first. From the fourth program on the law may have the error
/// below. Measured on the paper's walls in collapse, steps of 0.002 s: with `contactTolerance` for it, and
/// more tries after 4, 8 ... programs, wall 6 took 30 s of CPU a second instead of 7, and walls 4 and 6 and
/// one of 410 blocks came to steps without an end, for one point of hundreds that would neither slide nor
/// stick.
constexpr int programsToExactFlow = 4;
constexpr int newtonSteps = 60; // on the paper's walls nearly all that end take less than 50

/// From the forces of the last step it ends soon or not at all. Wall 1 collapsing at steps of 0.002 s, solved
/// to 1e-9: in the first 0.2 s 91 of 100 steps end, with 20 factorisations a step instead of 45; when blocks
/// have left their places, a fourth, and the tries cost what they spare.
constexpr int newtonStepsFromLastStep = 20;

/// Impacts of a wall hit 150 points at once, where Newton's method seldom ends: with 20 steps of it once 3.8
/// ms a step of wall 1 falling with restitution, with 60 as in motion, and its tolerance, 23 ms.
constexpr int newtonStepsOfImpact = 20;

/// The error of mu |u_t| may be this share of what the step changes the motion by, and after so many programs
/// the larger one: just above a threshold the fixed point is not reached closer.
constexpr double shareOfStep = 1e-2;
constexpr double largerShareOfStep = 5e-2;
constexpr int programsToLargerShare = 15;
constexpr double nearlySolved = 1000; // times the tolerance

constexpr double closest = 1e-12; // tolerance that every solver but gaussSeidel reaches
constexpr int mostRelinearisations = 10;

/// mu |u_t| of each point: what the program's flow opens. \param closing A'y
Eigen::VectorXd dilatancy(const PlaneConeProgram& program, const Eigen::VectorXd& closing,
                          const Eigen::VectorXd& contactForce)
{
    const Eigen::VectorXd gap = program.hasCompliance() ? gapUnder(program, contactForce) : program.gap;
    Eigen::VectorXd opening(program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        opening[point] = program.friction[static_cast<std::size_t>(point)]
                         * std::abs(closing[2 * point + 1] - gap[2 * point + 1]);
    }
    return opening;
}

/// How far what a program imposed is from the dilatancy of its solution, where that matters: where a point
/// presses, or would enter its partner without what is imposed. Everywhere else the point is apart and
/// without force, which Coulomb's law allows whatever it slides. \param gap of the points [m], without what
/// is imposed \param least force that counts [N]
double errorOfFlow(const Eigen::VectorXd& imposed, const Eigen::VectorXd& opening, const Eigen::VectorXd& gap,
                   const ThetaStep& step, double least)
{
    double error = 0;
    for (Eigen::Index point = 0; point < opening.size(); ++point)
    {
        const bool presses = step.contactForce[2 * point] > least;
        const bool enters = gap[2 * point] < step.closing[2 * point];
        if (presses || enters)
        {
            error = std::max(error, std::abs(opening[point] - imposed[point]));
        }
    }
    return error;
}

/// Mbar^-1 rows.
Eigen::VectorXd displacementUnder(const PlaneConeProgram& program, Eigen::VectorXd rows)
{
    for (int body = 0; body < program.bodies; ++body)
    {
        rows.segment<3>(3 * body).array() /=
            program.inertia[static_cast<std::size_t>(body)].diagonal().array();
    }
    return rows;
}

/// Fixed-point iteration x = F(x), accelerated (Anderson 1965; Walker & Ni 2011, type II): the next x is the
/// combination of the last ones at which F(x) - x would vanish were it linear. Plain iteration on a wall that
/// collapses ends in swinging between two states. Near a threshold, though, F grows faster than x up to where
/// Coulomb's motion is, thousands of times the associative one: its secant leads back to a fixed point below
/// zero, and plain iteration away from there.
class AcceleratedIteration
{
public:
    /// \param x where F was evaluated \param image F(x), not negative \return the next x, not negative
    Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& image)
    {
        const Eigen::VectorXd residual = image - x;
        if (residual_.size() > 0)
        {
            if (residualChanges_.size() == depth)
            {
                residualChanges_.erase(residualChanges_.begin());
                imageChanges_.erase(imageChanges_.begin());
            }
            residualChanges_.push_back(residual - residual_);
            imageChanges_.push_back(image - image_);
        }
        residual_ = residual;
        image_ = image;
        const auto columns = static_cast<Eigen::Index>(residualChanges_.size());
        if (columns == 0)
        {
            return image;
        }
        Eigen::MatrixXd changes(residual.size(), columns);
        for (Eigen::Index column = 0; column < columns; ++column)
        {
            changes.col(column) = residualChanges_[static_cast<std::size_t>(column)];
        }
        const Eigen::VectorXd weights = changes.colPivHouseholderQr().solve(residual);
        Eigen::VectorXd result = image;
        for (Eigen::Index column = 0; column < columns; ++column)
        {
            result -= weights[column] * imageChanges_[static_cast<std::size_t>(column)];
        }
        result = result.cwiseMax(0.0);
        const double reached = image.lpNorm<Eigen::Infinity>();
        if (reached > 2 * x.lpNorm<Eigen::Infinity>() && result.lpNorm<Eigen::Infinity>() < reached / 2)
        {
            residualChanges_.clear();
            imageChanges_.clear();
            return image;
        }
        return result;
    }

private:
    static constexpr std::size_t depth = 6;
    Eigen::VectorXd residual_, image_;
    std::vector<Eigen::VectorXd> residualChanges_, imageChanges_;
};

/// No motion, with forces, and how nearly it solves the program.
struct Rest
{
    ConeSolution solution;
    Certificate certificate;
};

Rest restWith(const PlaneConeProgram& program, const Eigen::VectorXd& contactForce)
{
    Rest rest;
    rest.solution.displacement = Eigen::VectorXd::Zero(program.load.size());
    rest.solution.contactForce = contactForce;
    rest.certificate = certifyOptimal(program, rest.solution);
    return rest;
}

/// Whether rest solves the program to the tolerance; then it is the step.
bool comesToRest(ThetaStep& step, const PlaneConeProgram& program, Rest rest, double tolerance)
{
    if (rest.certificate.worst() > tolerance)
    {
        return false;
    }
    step.status = SolveStatus::optimal;
    step.certificate = rest.certificate;
    step.displacement = std::move(rest.solution.displacement);
    step.contactForce = std::move(rest.solution.contactForce);
    step.closing = Eigen::VectorXd::Zero(2 * program.points());
    return true;
}

ConeSolution solveCounted(ThetaStep& step, const PlaneConeProgram& program, const SolverChoice& solver,
                          const ConeSolution& start, SymbolicAnalysis* symbolic)
{
    ConeSolution solution = solveConeProgram(program, solver, start, symbolic);
    if (!solution.interior.isEmpty())
    {
        step.interior = solution.interior;
    }
    step.iterations += solution.iterations;
    step.factorisations += solution.factorisations;
    return solution;
}

/// Largest force among the rows of bodies, moments aside.
double largestForce(const Eigen::VectorXd& rows)
{
    double largest = 0;
    for (Eigen::Index row = 0; row < rows.size(); row += 3)
    {
        largest = std::max(largest, rows.segment<2>(row).lpNorm<Eigen::Infinity>());
    }
    return largest;
}

/// Whether what is out of balance is so small a part of the loads that rest is worth a look.
bool mayRest(const PlaneConeProgram& program, const Eigen::VectorXd& outOfBalance)
{
    constexpr double farFromRest = 0.1;
    return largestForce(outOfBalance) <= farFromRest * largestForce(program.load);
}

/// A structure whose forces balance its loads to the tolerance stands still: not by what the solver leaves of
/// a displacement, which would be an impulse in the next step, but exactly. The gap of a certificate is work,
/// so of second order in what is out of balance: a solution that is nearly rest may be rest, and is known
/// when it is solved to the square of the tolerance. Otherwise a wall would move off below its multiplier,
/// little by little.
bool standsStill(ThetaStep& step, const PlaneConeProgram& program, const SolverChoice& solver,
                 const ConeSolution& solution, SymbolicAnalysis* symbolic)
{
    const double nearly = std::sqrt(solver.tolerance);
    Rest rest = restWith(program, solution.contactForce);
    SolverChoice closer = solver;
    closer.tolerance = std::max(closest, 0.1 * solver.tolerance * solver.tolerance);
    if (rest.certificate.worst() > solver.tolerance && rest.certificate.worst() <= nearly
        && closer.tolerance < solver.tolerance && solver.solver != SolverType::gaussSeidel)
    {
        rest = restWith(program, solveCounted(step, program, closer, solution, symbolic).contactForce);
    }
    return comesToRest(step, program, std::move(rest), solver.tolerance);
}

/// \return whether the displacements are those that the contact forces give the blocks
bool solveOnce(ThetaStep& step, const PlaneConeProgram& program, const SolverChoice& solver,
               const ConeSolution& start, SymbolicAnalysis* symbolic)
{
    ConeSolution solution = solveCounted(step, program, solver, start, symbolic);
    ++step.programs;
    step.status = solution.status;
    bool isBalanced = false;
    if (solution.status == SolveStatus::optimal)
    {
        const Eigen::VectorXd outOfBalance = program.load - applyEquilibrium(program, solution.contactForce);
        if (mayRest(program, outOfBalance) && standsStill(step, program, solver, solution, symbolic))
        {
            return false;
        }
        ConeSolution balanced = solution;
        balanced.displacement = displacementUnder(program, outOfBalance);
        const Certificate certificate = certifyOptimal(program, balanced);
        isBalanced = certificate.worst() <= solver.tolerance;
        if (isBalanced)
        {
            step.certificate = certificate;
            solution = std::move(balanced);
        }
    }
    if (!isBalanced)
    {
        step.certificate = certifyOptimal(program, solution);
    }
    step.displacement = std::move(solution.displacement);
    step.contactForce = std::move(solution.contactForce);
    step.closing = applyTransposed(program, step.displacement);
    return isBalanced;
}

/// With theta below 1 lever arms are those on the way to where the step takes the blocks. They are then right
/// to the tolerance of the gaps, and angular momentum with them: here both become exact, by displacements
/// that are less than that tolerance.
void keepMomenta(ThetaStep& step, PlaneConeProgram& program, const Relinearisation& relinearise)
{
    constexpr int mostRounds = 4; // each leaves the square of the last, in effect
    constexpr double lastDigits = 1e-15;
    for (int round = 0; round < mostRounds; ++round)
    {
        Eigen::VectorXd displacement =
            displacementUnder(program, program.load - applyEquilibrium(program, step.contactForce));
        const double change = (displacement - step.displacement).lpNorm<Eigen::Infinity>();
        if (change <= lastDigits * displacement.lpNorm<Eigen::Infinity>())
        {
            return;
        }
        step.displacement = std::move(displacement);
        step.closing = applyTransposed(program, step.displacement);
        relinearise(step.displacement, step.contactForce, program);
    }
}

/// Coulomb's law by Newton's method. \param program its gaps without what the flow opens; with it on return
/// \return whether it was reached; otherwise the step is as it was but for the work counted
bool solveFlow(ThetaStep& step, PlaneConeProgram& program, const ConeSolution& start,
               const StepSettings& settings, double gapTolerance, int mostNewtonSteps)
{
    constexpr double beyond = 1e-3; // nearly for nothing: the last Newton step is exact
    ConeSolution solution = solveCoulombNewton(
        program, start, {beyond * settings.solver.tolerance, gapTolerance, mostNewtonSteps});
    step.iterations += solution.iterations;
    step.factorisations += solution.factorisations;
    if (solution.status != SolveStatus::optimal)
    {
        return false;
    }
    solution.displacement =
        displacementUnder(program, program.load - applyEquilibrium(program, solution.contactForce));
    Eigen::VectorXd closing = applyTransposed(program, solution.displacement);
    // Gaps that are right to a tolerance only may as well be those that the points which touch want.
    for (int point = 0; point < program.points(); ++point)
    {
        const double mu = program.friction[static_cast<std::size_t>(point)];
        const Strength strength =
            program.hasStrength() ? program.strength[static_cast<std::size_t>(point)] : Strength{};
        const auto force = solution.contactForce.segment<2>(2 * point);
        auto gap = program.gap.segment<2>(2 * point);
        const Eigen::Vector2d open = gap - closing.segment<2>(2 * point);
        if ((force[0] > -strength.tension || open[0] < 0) && std::abs(open[0]) <= gapTolerance)
        {
            gap[0] -= open[0];
        }
        if (std::abs(force[1]) < strength.cohesion + mu * force[0] && std::abs(open[1]) <= gapTolerance)
        {
            gap[1] -= open[1];
        }
        gap[0] += mu * std::abs(closing[2 * point + 1] - gap[1]);
    }
    step.certificate = certifyOptimal(program, solution);
    step.flowError = 0;
    if (settings.solver.observer)
    {
        settings.solver.observer(program, solution);
    }
    step.status = SolveStatus::optimal;
    step.displacement = std::move(solution.displacement);
    step.contactForce = std::move(solution.contactForce);
    step.closing = std::move(closing);
    return true;
}

/// Of Newton's method for Coulomb's law.
struct NewtonEffort
{
    int steps;           ///< at most, in each program
    double gapTolerance; ///< error allowed in gaps that no motion closes [m]
};

/// Likewise with gaps that are right where the blocks end up. Closed rings of blocks are mobile to first
/// order only: as they move, some points open by the square of their displacements, and which of them carries
/// what is then decided by less than contactTolerance. So gaps are taken as known to that, or to a thousandth
/// of what the step changes the motion by, if that is less. \param heading dt v0
bool solveFlow(ThetaStep& step, PlaneConeProgram program, ConeSolution start, const Eigen::VectorXd& heading,
               const StepSettings& settings, const Relinearisation& relinearise, const NewtonEffort& effort)
{
    constexpr double partOfStep = 1e-3;
    for (int round = 0; round <= mostRelinearisations; ++round)
    {
        PlaneConeProgram flowing = program;
        const double gapTolerance =
            relinearise ? std::min(effort.gapTolerance,
                                   partOfStep * (start.displacement - heading).lpNorm<Eigen::Infinity>())
                        : 0;
        if (!solveFlow(step, flowing, start, settings, gapTolerance, effort.steps))
        {
            return false;
        }
        const bool isRight =
            !relinearise || relinearise(step.displacement, step.contactForce, program) <= effort.gapTolerance;
        if (isRight && step.certificate.worst() <= settings.solver.tolerance)
        {
            if (relinearise)
            {
                keepMomenta(step, program, relinearise);
            }
            return true;
        }
        if (!relinearise)
        {
            return false;
        }
        start.displacement = step.displacement;
        start.contactForce = step.contactForce;
    }
    return false;
}

/// Coulomb's law from the forces of the last step, without a program: with `automatic` alone, since every
/// other solver is asked for by name, and not near rest, which only a program tells from slow motion.
bool goesOnFromLastStep(ThetaStep& step, const PlaneConeProgram& program, const ConeSolution& start,
                        const Eigen::VectorXd& heading, const StepSettings& settings,
                        const Relinearisation& relinearise)
{
    if (settings.solver.solver != SolverType::automatic || program.hasCompliance()
        || start.contactForce.isZero(0))
    {
        return false;
    }
    const NewtonEffort effort{
        newtonStepsFromLastStep,
        std::min(settings.contactTolerance, settings.solver.tolerance * settings.blockSize)};
    return solveFlow(step, program, start, heading, settings, relinearise, effort)
           && !mayRest(program, program.load - applyEquilibrium(program, step.contactForce));
}

/// Whether another program would go beyond the work allowed.
bool isWorkUsedUp(const StepSettings& settings, const ThetaStep& step, const PlaneConeProgram& program)
{
    return settings.work
           && settings.work->done
                      + workOf(step.iterations, step.factorisations, program.points(), program.bodies)
                  > settings.work->mostOfAttempt;
}

} // namespace

void setColumns(PlaneConeProgram& program, const std::vector<ContactColumns<2>>& columns)
{
    program.contacts.clear();
    for (const ContactColumns<2>& column : columns)
    {
        program.contacts.push_back({column.block, column.neighbour, column.onBlock, column.onNeighbour});
    }
}

PlaneConeProgram thetaStepProgram(const Eigen::VectorXd& mass, const Eigen::VectorXd& velocity,
                                  const Eigen::VectorXd& load, const std::vector<ContactPoint<2>>& points,
                                  const std::vector<ContactColumns<2>>& columns,
                                  const std::vector<double>& friction, const ThetaScheme& scheme)
{
    PlaneConeProgram program;
    program.bodies = static_cast<int>(mass.size() / 3);
    program.friction = friction;
    setColumns(program, columns);
    program.gap = Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(points.size()));
    for (std::size_t point = 0; point < points.size(); ++point)
    {
        program.gap[2 * static_cast<Eigen::Index>(point)] = points[point].gap;
    }
    const Eigen::VectorXd inertia = mass / (scheme.theta * scheme.timeStep * scheme.timeStep);
    for (int body = 0; body < program.bodies; ++body)
    {
        program.inertia.push_back(inertia.segment<3>(3 * body).asDiagonal());
    }
    program.load = load + scheme.timeStep * inertia.cwiseProduct(velocity);
    return program;
}

ThetaStep solveThetaStep(PlaneConeProgram program, const StepSettings& settings, const StepGuess& guess,
                         const Relinearisation& relinearise, SymbolicAnalysis* symbolic)
{
    ThetaStep step;
    step.interior = guess.interior;
    if (program.points() == 0)
    {
        step.displacement = displacementUnder(program, program.load); // free flight
        step.status = SolveStatus::optimal;
        return step;
    }

    ConeSolution start;
    start.displacement = guess.displacement;
    start.contactForce = guess.contactForce.size() == 2 * program.points()
                             ? guess.contactForce
                             : Eigen::VectorXd::Zero(2 * program.points());
    Rest rest = restWith(program, start.contactForce);
    step.initialResidual = rest.certificate.worst();
    if (comesToRest(step, program, std::move(rest), settings.solver.tolerance))
    {
        return step;
    }

    start.interior = step.interior;
    if (start.contactForce.lpNorm<Eigen::Infinity>() > 0)
    {
        // Where the forces of the last step would take the blocks: in steady motion that is nearly the
        // solution.
        start.displacement =
            displacementUnder(program, program.load - applyEquilibrium(program, start.contactForce));
    }
    const bool isCoulomb = settings.flowRule == FlowRule::nonAssociative;
    const bool isImpact = settings.kind == StepKind::impact;
    Eigen::VectorXd imposed = Eigen::VectorXd::Zero(program.points());
    if (isCoulomb && guess.displacement.size() > 0)
    {
        imposed = dilatancy(program, applyTransposed(program, guess.displacement), start.contactForce);
    }
    if (relinearise && guess.displacement.size() > 0)
    {
        // About where the blocks are heading, so that what is left is of second order in their acceleration.
        relinearise(guess.displacement, start.contactForce, program);
    }
    const Eigen::VectorXd heading =
        guess.displacement.size() > 0 ? guess.displacement : Eigen::VectorXd::Zero(program.load.size());
    if (isCoulomb && goesOnFromLastStep(step, program, start, heading, settings, relinearise))
    {
        return step;
    }
    AcceleratedIteration fixedPoint;
    Eigen::VectorXd gap = program.gap; // without the share that is imposed
    for (;;)
    {
        const bool isNewtonsTurn = isCoulomb && !program.hasCompliance()
                                   && (step.programs == 1 || (step.programs == 2 && !isImpact));
        if (isNewtonsTurn)
        {
            program.gap = gap;
            if (solveFlow(step, program, start, heading, settings, relinearise,
                          {isImpact ? newtonStepsOfImpact : newtonSteps, settings.contactTolerance}))
            {
                return step;
            }
        }
        for (int point = 0; isCoulomb && point < program.points(); ++point)
        {
            program.gap[2 * point] = gap[2 * point] + imposed[point];
        }
        const bool isBalanced = solveOnce(step, program, settings.solver, start, symbolic);
        // Only the last program of Coulomb's law has to be solved to the tolerance.
        const bool isSolved = step.status == SolveStatus::optimal;
        if (!isSolved
            && (!isCoulomb || step.certificate.worst() > nearlySolved * settings.solver.tolerance
                || step.programs == maximumPrograms))
        {
            return step;
        }
        start.displacement = step.displacement;
        start.contactForce = step.contactForce;
        start.interior = step.interior;
        bool stands = isSolved;
        if (isCoulomb)
        {
            const Eigen::VectorXd opening = dilatancy(program, step.closing, step.contactForce);
            const double least = settings.solver.tolerance * step.contactForce.lpNorm<Eigen::Infinity>();
            const double change = errorOfFlow(imposed, opening, gap, step, least);
            const double exact = std::max(1e-12 * settings.blockSize,
                                          10 * settings.solver.tolerance * opening.lpNorm<Eigen::Infinity>());
            // Otherwise a small part of what the step itself does: with steps so short that gravity moves a
            // block by less than some length, any force at all would do. Nor less than a program certified to
            // its tolerance tells.
            const double moved =
                (step.displacement
                 - (guess.displacement.size() > 0 ? guess.displacement
                                                  : Eigen::VectorXd::Zero(step.displacement.size())))
                    .lpNorm<Eigen::Infinity>();
            const double share = step.programs < programsToLargerShare ? shareOfStep : largerShareOfStep;
            const double told =
                settings.solver.tolerance
                * std::max(step.displacement.lpNorm<Eigen::Infinity>(), gap.lpNorm<Eigen::Infinity>());
            const bool isExact = !isImpact
                                 && (step.programs < programsToExactFlow
                                     || (!isBalanced && step.programs < programsToLargerShare));
            stands = stands && change <= (isExact ? exact : std::max({exact, told, share * moved}));
            step.flowError = change;
            imposed = fixedPoint.next(imposed, opening);
            if (step.programs == programsToRestart)
            {
                fixedPoint = {};
                imposed.setZero();
            }
        }
        if (relinearise)
        {
            program.gap = gap;
            stands = relinearise(step.displacement, step.contactForce, program) <= settings.contactTolerance
                     && stands;
            gap = program.gap;
        }
        if (stands)
        {
            if (relinearise && isBalanced)
            {
                keepMomenta(step, program, relinearise);
            }
            return step;
        }
        if (step.programs == maximumPrograms || isWorkUsedUp(settings, step, program))
        {
            step.status = SolveStatus::notConverged;
            return step;
        }
    }
}

void advance(DynamicState& state, const std::vector<int>& free, const Eigen::VectorXd& displacement,
             const ThetaScheme& scheme)
{
    state.placements = moved(std::move(state.placements), free, displacement);
    const Eigen::VectorXd mean = displacement / scheme.timeStep;
    state.velocity = (mean - (1 - scheme.theta) * state.velocity) / scheme.theta;
    state.time += scheme.timeStep;
}

StepEnergy stepEnergy(const ThetaStep& step, const Eigen::VectorXd& mass, const Eigen::VectorXd& load,
                      const Eigen::VectorXd& velocityBefore, const Eigen::VectorXd& velocityAfter,
                      const ThetaScheme& scheme)
{
    StepEnergy energy;
    energy.loadWork = load.dot(step.displacement);
    const Eigen::VectorXd change = velocityAfter - velocityBefore;
    energy.algorithmicLoss = (scheme.theta - 0.5) * change.cwiseProduct(mass).dot(change);
    for (Eigen::Index row = 0; row < step.closing.size(); row += 2)
    {
        energy.normalLoss += step.contactForce[row] * step.closing[row];
        energy.frictionLoss += step.contactForce[row + 1] * step.closing[row + 1];
    }
    return energy;
}

} // namespace drystone
