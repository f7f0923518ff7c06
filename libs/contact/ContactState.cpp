// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Open, sticking or sliding.
#include "contact/ContactState.h"

#include "core/Error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

template<int Dim>
std::vector<Vector<Dim>> pointForces(const Eigen::VectorXd& contactForce)
{
    if (contactForce.size() % Dim != 0)
    {
        throw FatalError(fmt::format("{} components of contact forces are no {}.", contactForce.size(),
                                     Dim == 2 ? "pairs" : "triples"));
    }
    std::vector<Vector<Dim>> forces;
    forces.reserve(static_cast<std::size_t>(contactForce.size() / Dim));
    for (Eigen::Index i = 0; i < contactForce.size(); i += Dim)
    {
        forces.push_back(contactForce.segment<Dim>(i));
    }
    return forces;
}

template std::vector<Vector<2>> pointForces<2>(const Eigen::VectorXd& contactForce);
template std::vector<Vector<3>> pointForces<3>(const Eigen::VectorXd& contactForce);

namespace
{

template<int Dim>
std::vector<ContactState> statesOf(std::span<const Vector<Dim>> forces, std::span<const double> friction,
                                   std::span<const double> cohesion, double tolerance)
{
    if (friction.size() != forces.size())
    {
        throw FatalError(fmt::format("{} friction coefficients were given for {} contact forces.",
                                     friction.size(), forces.size()));
    }
    double largest = 0;
    for (const Vector<Dim>& force : forces)
    {
        largest = std::max(largest, force.x());
    }
    std::vector<ContactState> states;
    states.reserve(forces.size());
    for (std::size_t i = 0; i < forces.size(); ++i)
    {
        const double normal = forces[i].x();
        const double shear = forces[i].template tail<Dim - 1>().norm();
        const double strength = friction[i] * normal + (cohesion.empty() ? 0 : cohesion[i]);
        const bool isCohesive = !cohesion.empty() && cohesion[i] > 0;
        if (isCohesive ? std::max(std::abs(normal), shear) <= tolerance * largest
                       : normal <= tolerance * largest)
        {
            states.push_back(ContactState::open);
        }
        else if (shear >= strength - tolerance * (normal + (isCohesive ? cohesion[i] : 0)))
        {
            states.push_back(ContactState::sliding);
        }
        else
        {
            states.push_back(ContactState::sticking);
        }
    }
    return states;
}

} // namespace

std::vector<ContactState> contactStates(std::span<const Vector<2>> forces, std::span<const double> friction,
                                        std::span<const double> cohesion, double tolerance)
{
    return statesOf<2>(forces, friction, cohesion, tolerance);
}

std::vector<ContactState> contactStates(std::span<const Vector<3>> forces, std::span<const double> friction,
                                        std::span<const double> cohesion, double tolerance)
{
    return statesOf<3>(forces, friction, cohesion, tolerance);
}

} // namespace drystone
