// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The theta step: its program, the motion of its forces, and what it does to velocities and energy.
#include "dynamics/ThetaStep.h"

#include <algorithm>
#include <limits>

namespace drystone
{

template<int Dim>
Eigen::VectorXd displacementUnder(const StepProgram<Dim>& program, Eigen::VectorXd rows)
{
    for (int body = 0; body < program.bodies; ++body)
    {
        auto own = rows.segment<freedomCount<Dim>>(freedomCount<Dim> * body);
        own = solveBlock(program.inertia[static_cast<std::size_t>(body)], BlockVector<Dim>(own));
    }
    return rows;
}

template<int Dim>
double largestForce(const StepProgram<Dim>& program, double blockSize)
{
    constexpr double leverage = 1e3;
    const double closed = program.points() > 0 ? std::max(0.0, -program.gap.minCoeff()) : 0;
    double all = 0;
    for (int body = 0; body < program.bodies; ++body)
    {
        const BlockVector<Dim> load =
            program.load.template segment<freedomCount<Dim>>(freedomCount<Dim> * body);
        all += load.template head<Dim>().norm() + load.template tail<rotationCount<Dim>>().norm() / blockSize
               + program.inertia[static_cast<std::size_t>(body)](0, 0) * closed;
    }
    return leverage * all;
}

template<int Dim>
bool keepMomenta(ThetaStep& step, StepProgram<Dim>& program, const Relinearisation<Dim>& relinearise)
{
    // Each leaves the square of the last, in effect; in space the part by which a block turns in a step,
    // times the ratio of its moments of inertia: where that is more than one, a part of each change.
    constexpr int mostRounds = Dim == 2 ? 4 : 40;
    constexpr double lastDigits = 1e-15;
    constexpr double kept = 1e-9; // [m, rad], and of the displacement
    constexpr double slow = 0.9;
    double part = 1;
    double before = std::numeric_limits<double>::infinity();
    double size = 0;
    for (int round = 0; round < mostRounds; ++round)
    {
        Eigen::VectorXd displacement =
            displacementUnder(program, program.load - applyEquilibrium(program, step.contactForce));
        const double change = (displacement - step.displacement).template lpNorm<Eigen::Infinity>();
        size = displacement.template lpNorm<Eigen::Infinity>();
        if (change <= lastDigits * size)
        {
            return true;
        }
        part = Dim == 3 && change > slow * before && change > kept * std::max(1.0, size) ? 0.5 * part : part;
        before = change;
        step.displacement = part == 1 ? std::move(displacement)
                                      : Eigen::VectorXd((1 - part) * step.displacement + part * displacement);
        step.closing = applyTransposed(program, step.displacement);
        relinearise(step.displacement, step.contactForce, program);
    }
    return Dim == 2 || before <= kept * std::max(1.0, size);
}

template<int Dim>
void setColumns(StepProgram<Dim>& program, const std::vector<ContactColumns<Dim>>& columns)
{
    program.contacts.clear();
    program.contacts.reserve(columns.size());
    for (const ContactColumns<Dim>& column : columns)
    {
        program.contacts.push_back({column.block, column.neighbour, column.onBlock, column.onNeighbour});
    }
}

template<int Dim>
MassMatrix<Dim> setInertia(StepProgram<Dim>& program, const std::type_identity_t<MassMatrix<Dim>>& mass,
                           const ThetaScheme& scheme)
{
    MassMatrix<Dim> inertia = over(mass, scheme.theta * scheme.timeStep * scheme.timeStep);
    program.inertia.clear();
    program.inertia.reserve(static_cast<std::size_t>(program.bodies));
    for (int body = 0; body < program.bodies; ++body)
    {
        program.inertia.push_back(blockOf(inertia, body));
    }
    return inertia;
}

template<int Dim>
StepProgram<Dim> thetaStepProgram(const std::type_identity_t<MassMatrix<Dim>>& mass,
                                  const Eigen::VectorXd& velocity, const Eigen::VectorXd& load,
                                  const std::vector<ContactPoint<Dim>>& points,
                                  const std::vector<ContactColumns<Dim>>& columns,
                                  const std::vector<double>& friction, const ThetaScheme& scheme)
{
    StepProgram<Dim> program;
    program.bodies = static_cast<int>(velocity.size() / freedomCount<Dim>);
    program.friction = friction;
    setColumns(program, columns);
    program.gap = Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(points.size()));
    for (std::size_t point = 0; point < points.size(); ++point)
    {
        program.gap[Dim * static_cast<Eigen::Index>(point)] = points[point].gap;
    }
    const MassMatrix<Dim> inertia = setInertia(program, mass, scheme);
    program.load = load + scheme.timeStep * times(inertia, velocity);
    return program;
}

template<int Dim>
Eigen::VectorXd advance(DynamicState<Dim>& state, const std::vector<int>& free,
                        const Eigen::VectorXd& displacement, const ThetaScheme& scheme)
{
    state.placements = moved(std::move(state.placements), free, displacement);
    const Eigen::VectorXd mean = displacement / scheme.timeStep;
    Eigen::VectorXd velocity = (mean - (1 - scheme.theta) * state.velocity) / scheme.theta;
    state.velocity = turnedWithBlocks<Dim>(velocity, displacement);
    state.time += scheme.timeStep;
    return velocity;
}

template<int Dim>
StepEnergy stepEnergy(const ThetaStep& step, const MassMatrix<Dim>& mass, const Eigen::VectorXd& load,
                      const Eigen::VectorXd& velocityBefore, const Eigen::VectorXd& velocityAfter,
                      const ThetaScheme& scheme)
{
    StepEnergy energy;
    energy.loadWork = load.dot(step.displacement);
    const Eigen::VectorXd change = velocityAfter - velocityBefore;
    energy.algorithmicLoss = (scheme.theta - 0.5) * times(mass, change).dot(change);
    for (Eigen::Index row = 0; row < step.closing.size(); row += Dim)
    {
        energy.normalLoss += step.contactForce[row] * step.closing[row];
        energy.frictionLoss +=
            step.contactForce.segment<Dim - 1>(row + 1).dot(step.closing.segment<Dim - 1>(row + 1));
    }
    return energy;
}

template double largestForce(const StepProgram<2>& program, double blockSize);
template double largestForce(const StepProgram<3>& program, double blockSize);
template Eigen::VectorXd displacementUnder(const StepProgram<2>& program, Eigen::VectorXd rows);
template bool keepMomenta(ThetaStep& step, StepProgram<2>& program, const Relinearisation<2>& relinearise);
template void setColumns(StepProgram<2>& program, const std::vector<ContactColumns<2>>& columns);
template MassMatrix<2> setInertia(StepProgram<2>& program, const MassMatrix<2>& mass,
                                  const ThetaScheme& scheme);
template StepProgram<2> thetaStepProgram<2>(const MassMatrix<2>& mass, const Eigen::VectorXd& velocity,
                                            const Eigen::VectorXd& load,
                                            const std::vector<ContactPoint<2>>& points,
                                            const std::vector<ContactColumns<2>>& columns,
                                            const std::vector<double>& friction, const ThetaScheme& scheme);
template Eigen::VectorXd advance(DynamicState<2>& state, const std::vector<int>& free,
                                 const Eigen::VectorXd& displacement, const ThetaScheme& scheme);
template StepEnergy stepEnergy(const ThetaStep& step, const MassMatrix<2>& mass, const Eigen::VectorXd& load,
                               const Eigen::VectorXd& velocityBefore, const Eigen::VectorXd& velocityAfter,
                               const ThetaScheme& scheme);
template Eigen::VectorXd displacementUnder(const StepProgram<3>& program, Eigen::VectorXd rows);
template bool keepMomenta(ThetaStep& step, StepProgram<3>& program, const Relinearisation<3>& relinearise);
template void setColumns(StepProgram<3>& program, const std::vector<ContactColumns<3>>& columns);
template MassMatrix<3> setInertia(StepProgram<3>& program, const MassMatrix<3>& mass,
                                  const ThetaScheme& scheme);
template StepProgram<3> thetaStepProgram<3>(const MassMatrix<3>& mass, const Eigen::VectorXd& velocity,
                                            const Eigen::VectorXd& load,
                                            const std::vector<ContactPoint<3>>& points,
                                            const std::vector<ContactColumns<3>>& columns,
                                            const std::vector<double>& friction, const ThetaScheme& scheme);
template Eigen::VectorXd advance(DynamicState<3>& state, const std::vector<int>& free,
                                 const Eigen::VectorXd& displacement, const ThetaScheme& scheme);
template StepEnergy stepEnergy(const ThetaStep& step, const MassMatrix<3>& mass, const Eigen::VectorXd& load,
                               const Eigen::VectorXd& velocityBefore, const Eigen::VectorXd& velocityAfter,
                               const ThetaScheme& scheme);

} // namespace drystone
