// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the contact points do, derived from the forces that they carry.
#pragma once

#include "contact/ContactPoint.h"

#include <span>

namespace drystone
{

/// What a contact point does.
enum class ContactState
{
    open = 0,     ///< carries nothing
    sticking = 1, ///< presses, and its shear stays below the strength
    sliding = 2,  ///< its shear has reached the strength
};

/// Forces of the points one by one, from n t n t ... (n t1 t2 n t1 t2 ...) as solvers have them.
template<int Dim>
std::vector<Vector<Dim>> pointForces(const Eigen::VectorXd& contactForce);

/// State of each point from its force (normal, tangent), in space (normal, tangent1, tangent2) [N]. A point
/// is open when its normal force is below `tolerance` times the largest, and slides when its shear comes
/// within `tolerance` n of mu n.
///
/// \param friction coefficient mu of each point \param cohesion shear that each carries in addition to it
/// [N]; empty: none. A point in tension is open only when it carries no shear either.
std::vector<ContactState> contactStates(std::span<const Vector<2>> forces, std::span<const double> friction,
                                        std::span<const double> cohesion = {}, double tolerance = 1e-6);
std::vector<ContactState> contactStates(std::span<const Vector<3>> forces, std::span<const double> friction,
                                        std::span<const double> cohesion = {}, double tolerance = 1e-6);

} // namespace drystone
