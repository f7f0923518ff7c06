// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/ThetaStep.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

constexpr int maximumPrograms = 100;

/// mu |u_t| of each point: what the program's flow opens.
Eigen::VectorXd dilatancy(const PlaneConeProgram& program, const Eigen::VectorXd& displacement)
{
    const Eigen::VectorXd closing = applyTransposed(program, displacement);
    Eigen::VectorXd opening(program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        opening[point] = program.friction[static_cast<std::size_t>(point)] * std::abs(closing[2 * point + 1]);
    }
    return opening;
}

void solveOnce(ThetaStep& step, const PlaneConeProgram& program, const InteriorPointSettings& settings)
{
    const ConeSolution solution = solveInteriorPoint(program, settings);
    step.status = solution.status;
    step.displacement = solution.displacement;
    step.contactForce = solution.contactForce;
    step.certificate = certifyOptimal(program, solution);
    step.iterations += solution.iterations;
    step.factorisations += solution.factorisations;
    ++step.programs;
}

} // namespace

PlaneConeProgram thetaStepProgram(const Eigen::VectorXd& mass, const Eigen::VectorXd& velocity,
                                  const Eigen::VectorXd& load, const std::vector<ContactPoint<2>>& points,
                                  const std::vector<ContactColumns<2>>& columns,
                                  const std::vector<double>& friction, const ThetaScheme& scheme)
{
    PlaneConeProgram program;
    program.bodies = static_cast<int>(mass.size() / 3);
    program.friction = friction;
    program.gap = Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(points.size()));
    for (std::size_t point = 0; point < points.size(); ++point)
    {
        const ContactColumns<2>& column = columns[point];
        program.contacts.push_back({column.block, column.neighbour, column.onBlock, column.onNeighbour});
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

ThetaStep solveThetaStep(PlaneConeProgram program, FlowRule flowRule, double blockSize,
                         const InteriorPointSettings& settings)
{
    ThetaStep step;
    if (program.points() == 0)
    {
        // Free flight: nothing to optimise, y = Mbar^-1 fbar exactly.
        step.displacement = program.load;
        for (int body = 0; body < program.bodies; ++body)
        {
            const Eigen::Vector3d inertia = program.inertia[static_cast<std::size_t>(body)].diagonal();
            step.displacement.segment<3>(3 * body).array() /= inertia.array();
        }
        step.status = SolveStatus::optimal;
        return step;
    }
    const Eigen::VectorXd gap = program.gap;
    solveOnce(step, program, settings);
    Eigen::VectorXd imposed = Eigen::VectorXd::Zero(program.points());
    while (flowRule == FlowRule::nonAssociative && step.status == SolveStatus::optimal)
    {
        const Eigen::VectorXd opening = dilatancy(program, step.displacement);
        const double change = (opening - imposed).lpNorm<Eigen::Infinity>();
        if (change <= std::max(1e-12 * blockSize, 1e-8 * opening.lpNorm<Eigen::Infinity>()))
        {
            break;
        }
        if (step.programs == maximumPrograms)
        {
            step.status = SolveStatus::notConverged;
            break;
        }
        imposed = opening;
        for (int point = 0; point < program.points(); ++point)
        {
            program.gap[2 * point] = gap[2 * point] + imposed[point];
        }
        solveOnce(step, program, settings);
    }
    return step;
}

void advance(DynamicState& state, const std::vector<int>& free, const Eigen::VectorXd& displacement,
             const ThetaScheme& scheme)
{
    for (std::size_t block = 0; block < free.size(); ++block)
    {
        if (free[block] >= 0)
        {
            state.placements[block].translation += displacement.segment<2>(3 * free[block]);
            state.placements[block].rotation += displacement[3 * free[block] + 2];
        }
    }
    const Eigen::VectorXd mean = displacement / scheme.timeStep;
    state.velocity = (mean - (1 - scheme.theta) * state.velocity) / scheme.theta;
    state.time += scheme.timeStep;
}

StepEnergy stepEnergy(const PlaneConeProgram& program, const ThetaStep& step, const Eigen::VectorXd& mass,
                      const Eigen::VectorXd& load, const Eigen::VectorXd& velocityBefore,
                      const Eigen::VectorXd& velocityAfter, const ThetaScheme& scheme)
{
    StepEnergy energy;
    energy.loadWork = load.dot(step.displacement);
    const Eigen::VectorXd change = velocityAfter - velocityBefore;
    energy.algorithmicLoss = (scheme.theta - 0.5) * change.cwiseProduct(mass).dot(change);
    if (program.points() > 0)
    {
        const Eigen::VectorXd closing = applyTransposed(program, step.displacement);
        for (Eigen::Index point = 0; point < program.points(); ++point)
        {
            energy.normalLoss += step.contactForce[2 * point] * closing[2 * point];
            energy.frictionLoss += step.contactForce[2 * point + 1] * closing[2 * point + 1];
        }
    }
    return energy;
}

} // namespace drystone
