// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Asks whether blocks may rest at all; forces that hold them, certified, are the proof that they do.
#include "dynamics/RestingStep.h"

#include "conic/BalancedForces.h"
#include "conic/ProgramPart.h"
#include "dynamics/FollowedFlow.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

constexpr double closest = 1e-12; // tolerance that every solver but gaussSeidel reaches

/// Largest force among the rows of bodies, moments aside.
template<int Dim>
double largestForce(const Eigen::VectorXd& rows)
{
    double largest = 0;
    for (Eigen::Index row = 0; row < rows.size(); row += freedomCount<Dim>)
    {
        largest = std::max(largest, rows.segment<Dim>(row).template lpNorm<Eigen::Infinity>());
    }
    return largest;
}

/// How far apart, or in each other, points may be that touch at rest [m]: in what follows forces by as much
/// as they give way, else by what gaps are known to, which rounding leaves of them where blocks have moved.
double touchingOf(const StepSettings& settings)
{
    return followsFlow(settings)
               ? yieldingOf(settings)
               : std::min(settings.contactTolerance, settings.solver.tolerance * settings.blockSize);
}

} // namespace

template<int Dim>
Rest restWith(const StepProgram<Dim>& program, const Eigen::VectorXd& contactForce)
{
    Rest rest;
    rest.solution.displacement = Eigen::VectorXd::Zero(program.load.size());
    rest.solution.contactForce = contactForce;
    rest.certificate = certifyOptimal(program, rest.solution);
    return rest;
}

template<int Dim>
StepProgram<Dim> closedWithin(const StepProgram<Dim>& program, const StepSettings& settings)
{
    StepProgram<Dim> closed = program;
    for (int point = 0; point < program.points(); ++point)
    {
        double& gap = closed.gap[Dim * point];
        gap = std::abs(gap) <= touchingOf(settings) ? 0 : gap;
    }
    return closed;
}

/// Rest with the forces nearest to those of another, at the points that touch and where these press, that
/// balance the loads: one factorisation, which is counted on the step. \return the other rest where none
/// balance them
template<int Dim>
Rest balanced(const StepProgram<Dim>& program, Rest rest, double tolerance, ThetaStep& step,
              SymbolicAnalysis* symbolic)
{
    constexpr double shareOfTolerance = 0.1;
    const Eigen::VectorXd& contactForce = rest.solution.contactForce;
    std::vector<int> pressing;
    StepProgram<Dim> carried;
    carried.bodies = program.bodies;
    carried.load = program.load;
    for (int point = 0; point < program.points(); ++point)
    {
        // Of the interior point those that are apart have a rounding of a force.
        if (contactForce[Dim * point] > 0 && program.gap[Dim * point] <= 0)
        {
            pressing.push_back(point);
            carried.contacts.push_back(program.contacts[static_cast<std::size_t>(point)]);
            carried.friction.push_back(program.friction[static_cast<std::size_t>(point)]);
        }
    }
    SymbolicAnalysis ownAnalysis;
    const Eigen::VectorXd holding =
        nearestForces(carried, takenFrom<Dim>(pressing, contactForce), shareOfTolerance * tolerance,
                      symbolic ? *symbolic : ownAnalysis);
    ++step.factorisations;
    if (holding.size() == 0)
    {
        return rest;
    }
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(contactForce.size());
    putInto<Dim>(pressing, holding, forces);
    return restWith(program, forces);
}

template<int Dim>
Rest restWithin(const StepProgram<Dim>& program, const Eigen::VectorXd& contactForce,
                const StepSettings& settings, ThetaStep& step, SymbolicAnalysis* symbolic)
{
    const StepProgram<Dim> closed = closedWithin(program, settings);
    Rest rest = restWith(closed, contactForce);
    return rest.certificate.worst() <= settings.solver.tolerance
               ? rest
               : balanced(closed, std::move(rest), settings.solver.tolerance, step, symbolic);
}

template<int Dim>
bool mayStayAtRest(const StepProgram<Dim>& program, const ConeSolution& start, const StepSettings& settings)
{
    if (settings.kind == StepKind::impact || program.hasCompliance() || start.contactForce.isZero(0))
    {
        return false;
    }
    if (!followsFlow(settings))
    {
        return start.displacement.isZero(0);
    }
    const Eigen::VectorXd closing = applyTransposed(program, start.displacement);
    bool isSlow = true;
    for (int point = 0; isSlow && point < program.points(); ++point)
    {
        isSlow = !(start.contactForce[Dim * point] > 0)
                 || closing.segment<Dim>(Dim * point).norm() <= yieldingOf(settings);
    }
    return isSlow;
}

template<int Dim>
bool comesToRest(ThetaStep& step, const StepProgram<Dim>& program, Rest rest, double tolerance)
{
    if (rest.certificate.worst() > tolerance)
    {
        return false;
    }
    step.status = SolveStatus::optimal;
    step.certificate = rest.certificate;
    step.displacement = std::move(rest.solution.displacement);
    step.contactForce = std::move(rest.solution.contactForce);
    step.closing = Eigen::VectorXd::Zero(Dim * program.points());
    return true;
}

template<int Dim>
ConeSolution solveCounted(ThetaStep& step, const StepProgram<Dim>& program, const SolverChoice& solver,
                          const ConeSolution& start, SymbolicAnalysis* symbolic)
{
    ConeSolution solution = solveConeProgram(program, solver, start, symbolic);
    if (!solution.interior.isEmpty())
    {
        step.interior = solution.interior;
    }
    addWork(step, solution);
    return solution;
}

template<int Dim>
bool mayRest(const StepProgram<Dim>& program, const Eigen::VectorXd& outOfBalance)
{
    constexpr double farFromRest = 0.1;
    return largestForce<Dim>(outOfBalance) <= farFromRest * largestForce<Dim>(program.load);
}

template<int Dim>
bool standsStill(ThetaStep& step, const StepProgram<Dim>& program, const StepSettings& settings,
                 const SolverChoice& solver, const ConeSolution& solution, SymbolicAnalysis* symbolic)
{
    const double nearly = std::sqrt(solver.tolerance);
    Rest rest = restWith(program, solution.contactForce);
    const auto isNearlyRest = [&]
    { return rest.certificate.worst() > solver.tolerance && rest.certificate.worst() <= nearly; };
    SolverChoice closer = solver;
    closer.tolerance = std::max(closest, 0.1 * solver.tolerance * solver.tolerance);
    if (Dim == 3 && solver.solver == SolverType::automatic)
    {
        // 15 to 20 factorisations, where multipliers from a start take hundreds as cones are round.
        closer.solver = SolverType::interiorPoint;
    }
    if (isNearlyRest() && closer.tolerance < solver.tolerance && solver.solver != SolverType::gaussSeidel)
    {
        const bool isOfPlaces =
            settings.flowRule == FlowRule::associative && settings.kind == StepKind::motion;
        const StepProgram<Dim> closed = isOfPlaces ? closedWithin(program, settings) : program;
        rest = restWith(closed, solveCounted(step, closed, closer, solution, symbolic).contactForce);
        if (Dim == 3 && isNearlyRest())
        {
            rest = balanced(closed, std::move(rest), settings.solver.tolerance, step, symbolic);
        }
    }
    return comesToRest(step, program, std::move(rest), solver.tolerance);
}

template StepProgram<2> closedWithin(const StepProgram<2>& program, const StepSettings& settings);
template Rest restWith(const StepProgram<2>& program, const Eigen::VectorXd& contactForce);
template Rest restWithin(const StepProgram<2>& program, const Eigen::VectorXd& contactForce,
                         const StepSettings& settings, ThetaStep& step, SymbolicAnalysis* symbolic);
template bool mayStayAtRest(const StepProgram<2>& program, const ConeSolution& start,
                            const StepSettings& settings);
template bool comesToRest(ThetaStep& step, const StepProgram<2>& program, Rest rest, double tolerance);
template bool mayRest(const StepProgram<2>& program, const Eigen::VectorXd& outOfBalance);
template bool standsStill(ThetaStep& step, const StepProgram<2>& program, const StepSettings& settings,
                          const SolverChoice& solver, const ConeSolution& solution,
                          SymbolicAnalysis* symbolic);
template ConeSolution solveCounted(ThetaStep& step, const StepProgram<2>& program, const SolverChoice& solver,
                                   const ConeSolution& start, SymbolicAnalysis* symbolic);
template StepProgram<3> closedWithin(const StepProgram<3>& program, const StepSettings& settings);
template Rest restWith(const StepProgram<3>& program, const Eigen::VectorXd& contactForce);
template Rest restWithin(const StepProgram<3>& program, const Eigen::VectorXd& contactForce,
                         const StepSettings& settings, ThetaStep& step, SymbolicAnalysis* symbolic);
template bool mayStayAtRest(const StepProgram<3>& program, const ConeSolution& start,
                            const StepSettings& settings);
template bool comesToRest(ThetaStep& step, const StepProgram<3>& program, Rest rest, double tolerance);
template bool mayRest(const StepProgram<3>& program, const Eigen::VectorXd& outOfBalance);
template bool standsStill(ThetaStep& step, const StepProgram<3>& program, const StepSettings& settings,
                          const SolverChoice& solver, const ConeSolution& solution,
                          SymbolicAnalysis* symbolic);
template ConeSolution solveCounted(ThetaStep& step, const StepProgram<3>& program, const SolverChoice& solver,
                                   const ConeSolution& start, SymbolicAnalysis* symbolic);

} // namespace drystone
