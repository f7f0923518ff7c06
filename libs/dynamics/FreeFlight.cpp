// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Displacements of blocks in free flight within a step.
#include "dynamics/FreeFlight.h"

#include "geometry/Rotation.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <optional>

namespace drystone
{
namespace
{

/// A block is in free flight when its contacts carry no more than this part of its loads.
constexpr double flightForce = 1e-3;

/// The turn of a block of space by theta 1/2, r = dt (w0 + w1)/2 (see turnMomenta): J0 w1 = exp(-r)(J0 w0 +
/// dt m) in turn with r, each time nearer by the part of a radian that the block turns in a step. \param
/// tensor J0 \param velocity w0 \param moment m \return none where it turns too far for that
std::optional<Vector<3>> turnByTheMean(const Eigen::Matrix3d& tensor, const Vector<3>& velocity,
                                       const Vector<3>& moment, double timeStep)
{
    constexpr int mostRounds = 100;
    constexpr double lastDigits = 1e-15;
    constexpr double found = 1e-9; // [rad]
    const Vector<3> momentum = tensor * velocity + timeStep * moment;
    Vector<3> turn = timeStep * velocity;
    double change = 0;
    for (int round = 0; round < mostRounds; ++round)
    {
        const Vector<3> next =
            0.5 * timeStep * (velocity + tensor.llt().solve(turned(Vector<3>(-turn), momentum)));
        change = (next - turn).norm();
        turn = next;
        if (change <= lastDigits * turn.norm())
        {
            break;
        }
    }
    return change <= found ? std::optional(turn) : std::nullopt;
}

/// Which bodies no contact carries. \param free points that carry none, whatever their forces
template<int Dim>
std::vector<char> bodiesInFlight(const Step<Dim>& step, const Eigen::VectorXd& contactForce,
                                 const std::vector<std::size_t>& free)
{
    const StepProgram<Dim>& program = step.program;
    std::vector<char> flies(static_cast<std::size_t>(program.bodies), true);
    for (std::size_t point = 0; point < program.contacts.size(); ++point)
    {
        const double force = std::find(free.begin(), free.end(), point) == free.end()
                                 ? contactForce.segment<Dim>(Dim * static_cast<Eigen::Index>(point))
                                       .template lpNorm<Eigen::Infinity>()
                                 : 0;
        for (const int body : {program.contacts[point].first, program.contacts[point].second})
        {
            if (body >= 0
                && force > flightForce
                               * step.load.template segment<freedomCount<Dim>>(freedomCount<Dim> * body)
                                     .template lpNorm<Eigen::Infinity>())
            {
                flies[static_cast<std::size_t>(body)] = false;
            }
        }
    }
    return flies;
}

/// Turns of bodies of space are not the mean of theirs: to those that fly gives the turns by theta 1/2. One
/// that turns too far for that moves as the step has it.
void turnByTheMean(const Step<3>& step, const ThetaStep& result, const Eigen::VectorXd& velocity,
                   const std::vector<char>& flies, Eigen::VectorXd& flight)
{
    constexpr int rows = freedomCount<3>;
    const Eigen::VectorXd byContacts = applyEquilibrium(step.program, result.contactForce);
    for (std::size_t body = 0; body < flies.size(); ++body)
    {
        if (!flies[body])
        {
            continue;
        }
        const Eigen::Index row = rows * static_cast<Eigen::Index>(body) + 3;
        const Vector<3> moment = step.load.segment<3>(row) - byContacts.segment<3>(row);
        const std::optional<Vector<3>> turn =
            turnByTheMean(step.mass.tensors[body], velocity.segment<3>(row), moment, step.scheme.timeStep);
        if (turn)
        {
            flight.segment<3>(row) = *turn - result.displacement.segment<3>(row);
        }
        else
        {
            flight.segment<rows>(rows * static_cast<Eigen::Index>(body)).setZero();
        }
    }
}

} // namespace

template<int Dim>
Eigen::VectorXd flightOf(const Step<Dim>& step, const ThetaStep& result, const Eigen::VectorXd& velocity,
                         const std::vector<std::size_t>& free)
{
    const double theta = step.scheme.theta;
    if (step.scene.restitution() == 0 || theta == 0.5 || traitsOf(step.scene.effects).actsOnBlocks)
    {
        return {};
    }
    const std::vector<char> flies = bodiesInFlight(step, result.contactForce, free);
    if (std::count(flies.begin(), flies.end(), true) == 0)
    {
        return {};
    }
    // y = dt (theta v1 + (1 - theta) v0), and dt (v0 + v1)/2 is to be.
    Eigen::VectorXd flight = (0.5 - theta) / theta * (result.displacement - step.scheme.timeStep * velocity);
    for (int body = 0; body < step.program.bodies; ++body)
    {
        if (!flies[static_cast<std::size_t>(body)])
        {
            flight.segment<freedomCount<Dim>>(freedomCount<Dim> * body).setZero();
        }
    }
    if constexpr (Dim == 3)
    {
        turnByTheMean(step, result, velocity, flies, flight);
    }
    return flight;
}

template<int Dim>
Eigen::VectorXd flightApart(const Step<Dim>& step, const ThetaStep& result, const Eigen::VectorXd& velocity)
{
    const StepProgram<Dim>& program = step.program;
    Eigen::VectorXd flight = flightOf(step, result, velocity);
    if (flight.size() == 0 || program.points() == 0)
    {
        return flight;
    }
    for (bool isApart = false; !isApart;)
    {
        isApart = true;
        const Eigen::VectorXd opening = openingAfterFlight(step, result, flight);
        for (int point = 0; point < program.points(); ++point)
        {
            for (const int body : {program.contacts[static_cast<std::size_t>(point)].first,
                                   program.contacts[static_cast<std::size_t>(point)].second})
            {
                if (opening[Dim * point] < -step.scene.roundingGap && body >= 0
                    && !flight.segment<freedomCount<Dim>>(freedomCount<Dim> * body).isZero(0))
                {
                    flight.segment<freedomCount<Dim>>(freedomCount<Dim> * body).setZero();
                    isApart = false; // but for what else this block then meets
                }
            }
        }
    }
    return flight;
}

template<int Dim>
Eigen::VectorXd openingAfterFlight(const Step<Dim>& step, const ThetaStep& result,
                                   const Eigen::VectorXd& flight)
{
    return flight.size() == 0 ? openingAtEnd(step, result.displacement, result.contactForce)
                              : openingAtEnd(step, result.displacement + flight, result.contactForce);
}

template Eigen::VectorXd flightOf(const Step<2>& step, const ThetaStep& result,
                                  const Eigen::VectorXd& velocity, const std::vector<std::size_t>& free);
template Eigen::VectorXd flightApart(const Step<2>& step, const ThetaStep& result,
                                     const Eigen::VectorXd& velocity);
template Eigen::VectorXd openingAfterFlight(const Step<2>& step, const ThetaStep& result,
                                            const Eigen::VectorXd& flight);
template Eigen::VectorXd flightOf(const Step<3>& step, const ThetaStep& result,
                                  const Eigen::VectorXd& velocity, const std::vector<std::size_t>& free);
template Eigen::VectorXd flightApart(const Step<3>& step, const ThetaStep& result,
                                     const Eigen::VectorXd& velocity);
template Eigen::VectorXd openingAfterFlight(const Step<3>& step, const ThetaStep& result,
                                            const Eigen::VectorXd& flight);

} // namespace drystone
