// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One step in time from rest: towers that stand (at 0.8 of their multiplier) and that move (at 1.1 of it),
/// in the plane and in space, to the certificate that each solver is for: 1e-8, and 1e-4 of gaussSeidel.
#include "Suite.h"

#include "conic/Certificate.h"
#include "conic/HardCases.h"

#include <Eigen/Cholesky>

#include <cctype>

namespace drystone
{
namespace
{

constexpr double exactTolerance = 1e-8;
constexpr double looseTolerance = 1e-4;

template<class Program>
ConeSolution solve(const Program& program, SolverType solver)
{
    if (solver == SolverType::interiorPoint)
    {
        return solveInteriorPoint(program, {.tolerance = exactTolerance});
    }
    if (solver == SolverType::augmentedLagrangian)
    {
        return solveAugmentedLagrangian(program, {},
                                        {.tolerance = exactTolerance, .maximumIterations = 4000});
    }
    // As many sweeps as a step of contactDynamics has, where they take no more than a second.
    return solveGaussSeidel(
        program, {},
        {.tolerance = looseTolerance,
         .maximumIterations = std::min<int>(SolverChoice().maximumSweeps, 1000000 / program.points())});
}

/// What a free fall has of energy over the step, twice: what errors are compared with.
template<class Program>
double fall(const Program& program)
{
    double sum = 0;
    for (int body = 0; body < program.bodies; ++body)
    {
        const auto rows = program.inertia[static_cast<std::size_t>(body)].rows();
        const Eigen::VectorXd load = program.load.segment(rows * body, rows);
        sum += load.dot(program.inertia[static_cast<std::size_t>(body)].ldlt().solve(load));
    }
    return sum;
}

template<class Program>
void judge(const Program& program, SolverType solver, Outcome& outcome)
{
    const double tolerance = solver == SolverType::gaussSeidel ? looseTolerance : exactTolerance;
    const ConeSolution solution = solve(program, solver);
    const Certificate certificate = certifyOptimal(program, solution);
    if ((solution.status == SolveStatus::optimal) != (certificate.worst() <= tolerance))
    {
        outcome.broken = "the status is not what the certificate says";
    }
    if (solver == SolverType::gaussSeidel && !(certificate.primalResidual <= 1e-12))
    {
        outcome.broken = "balance and cones do not hold to rounding";
    }
    // Displacements are unique, and half their distance squared, in the metric of the inertia, is no more
    // than what the objectives lack. Compared with another solver's.
    const ConeSolution other =
        solve(program, solver == SolverType::interiorPoint ? SolverType::augmentedLagrangian
                                                           : SolverType::interiorPoint);
    const Eigen::VectorXd apart = solution.displacement - other.displacement;
    if (solution.status == SolveStatus::optimal && other.status == SolveStatus::optimal
        && !(apart.dot(applyInertia(program, apart)) <= 100 * tolerance * fall(program)))
    {
        outcome.broken = "two solvers certify two displacements";
    }
    outcome.figure = std::max(outcome.figure, certificate.worst());
}

/// Each contact point a second time.
PlaneConeProgram doubled(PlaneConeProgram program)
{
    const auto contacts = program.contacts;
    const auto friction = program.friction;
    program.contacts.clear();
    program.friction.clear();
    for (std::size_t point = 0; point < contacts.size(); ++point)
    {
        program.contacts.insert(program.contacts.end(), 2, contacts[point]);
        program.friction.insert(program.friction.end(), 2, friction[point]);
    }
    program.gap = Eigen::VectorXd::Zero(2 * program.points());
    return program;
}

std::string difficultyOf(const std::string& varied)
{
    if (varied == "massRatio")
    {
        return "heavy on light: forces pass through a block whose own weight is rounding to them";
    }
    if (varied == "friction")
    {
        return "cones degenerate to rays, or so wide that sliding and tipping compete";
    }
    return varied == "blocks" ? "each block's forces depend on all above it"
                              : "forces of many points on a face are not unique";
}

} // namespace

std::vector<StabilityCase> stepCases()
{
    std::vector<StabilityCase> cases;
    for (const HardCase& hard : hardCases())
    {
        std::string name = "step_";
        for (const char c : hard.name)
        {
            name += c == '-'          ? "m"
                    : c == '+'        ? ""
                    : c == '.'        ? "p"
                    : std::isalnum(c) ? std::string(1, c)
                                      : "_";
        }
        cases.push_back({name, difficultyOf(hard.varied), "certificate, plane and space", exactTolerance,
                         looseTolerance, stepSolvers(),
                         [hard](SolverType solver)
                         {
                             Outcome outcome;
                             judge(planeStep(hard.tower, hard.alpha), solver, outcome);
                             judge(spaceStep(hard.tower, hard.alpha), solver, outcome);
                             return outcome;
                         }});
    }
    for (const double share : {0.8, 1.1})
    {
        cases.push_back({share < 1 ? "step_duplicatePoints_standing" : "step_duplicatePoints_moving",
                         "columns of the equilibrium matrix repeat", "certificate", exactTolerance,
                         looseTolerance, stepSolvers(),
                         [share](SolverType solver)
                         {
                             const Tower tower = evenTower(5);
                             Outcome outcome;
                             judge(doubled(planeStep(tower, share * towerMultiplier(tower, 2))), solver,
                                   outcome);
                             return outcome;
                         }});
    }
    return cases;
}

} // namespace drystone
