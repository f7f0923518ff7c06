// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Open, sticking or sliding.
#include "contact/ContactState.h"

#include "core/Error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

std::vector<Vector<2>> pointForces(const Eigen::VectorXd& contactForce)
{
    if (contactForce.size() % 2 != 0)
        throw FatalError(fmt::format("{} components of contact forces are no pairs.", contactForce.size()));
    std::vector<Vector<2>> forces;
    forces.reserve(static_cast<std::size_t>(contactForce.size() / 2));
    for (Eigen::Index i = 0; i < contactForce.size(); i += 2)
        forces.push_back(contactForce.segment<2>(i));
    return forces;
}

std::vector<ContactState> contactStates(std::span<const Vector<2>> forces, std::span<const double> friction,
                                        std::span<const double> cohesion, double tolerance)
{
    if (friction.size() != forces.size())
        throw FatalError(fmt::format("{} friction coefficients were given for {} contact forces.",
                                     friction.size(), forces.size()));
    double largest = 0;
    for (const Vector<2>& force : forces)
        largest = std::max(largest, force.x());
    std::vector<ContactState> states;
    states.reserve(forces.size());
    for (std::size_t i = 0; i < forces.size(); ++i)
    {
        const double normal = forces[i].x();
        const double shear = std::abs(forces[i].y());
        const double strength = friction[i] * normal + (cohesion.empty() ? 0 : cohesion[i]);
        const bool isCohesive = !cohesion.empty() && cohesion[i] > 0;
        if (isCohesive ? std::max(std::abs(normal), shear) <= tolerance * largest
                       : normal <= tolerance * largest)
            states.push_back(ContactState::open);
        else if (shear >= strength - tolerance * (normal + (isCohesive ? cohesion[i] : 0)))
            states.push_back(ContactState::sliding);
        else
            states.push_back(ContactState::sticking);
    }
    return states;
}

} // namespace drystone
