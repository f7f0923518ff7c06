// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What happens at a contact, as data. The keys of constant/contactProperties, one sub-dictionary for each
/// effect that is simulated, are declared by the effects (libs/effects).
#pragma once

#include "dictionary/Options.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drystone
{

/// Which way a sliding joint moves.
enum class FlowRule
{
    associative,   ///< normal to the cone: a joint that slides by s opens by mu s
    nonAssociative ///< Coulomb's law: a joint slides without opening
};

inline std::array<std::pair<std::string_view, FlowRule>, 2> namesOf(FlowRule)
{
    return {{{"associative", FlowRule::associative}, {"nonAssociative", FlowRule::nonAssociative}}};
}

/// Coulomb friction: |t| <= mu n.
struct CoulombFriction
{
    double mu = 0; ///< friction coefficient, 0 to 1e6
    FlowRule flowRule = FlowRule::associative;
};

/// Rebound after an impact (Newton): the points of a contact part with `normal` times the velocity at which
/// they met.
struct Restitution
{
    double normal = 0; ///< coefficient, 0 to 1
};

/// Strength of the joints over their area. Of cohesion: shear that a joint carries beside friction; of
/// tension: normal stress that holds it together; of crushing: pressure that it bears.
struct JointStrength
{
    double strength = 0; ///< [Pa]
};

/// Friction of some joints only. The flow rule is that of all.
struct JointFriction
{
    double mu = 0; ///< friction coefficient, 0 to 1e6
};

/// What limit analysis knows of a joint.
enum class ContactFormulation
{
    points, ///< forces (n, t) at points along it
    surface ///< stress resultants (N, T, M) of the whole
};

inline std::array<std::pair<std::string_view, ContactFormulation>, 2> namesOf(ContactFormulation)
{
    return {{{"points", ContactFormulation::points}, {"surface", ContactFormulation::surface}}};
}

struct ContactModel
{
    ContactFormulation formulation = ContactFormulation::points;
};

/// Contact points of the joints in space: a grid over each, beside its corners.
struct PointGrid
{
    int perSide = 5; ///< points along each side of a joint
};

/// What some joints have instead of what all have; the effects that it does not name stay as they are.
struct JointProperties
{
    std::optional<JointFriction> friction;
    std::optional<JointStrength> cohesion;
    std::optional<JointStrength> tension;
    std::optional<JointStrength> crushing;
};

/// What the joints of a case carry and how they rebound; what is absent is not simulated and costs nothing.
struct ContactProperties
{
    std::optional<CoulombFriction> friction; ///< absent: frictionless
    std::optional<Restitution> restitution;  ///< absent: impacts are plastic
    std::optional<JointStrength> cohesion;   ///< absent: shear by friction alone
    std::optional<JointStrength> tension;    ///< absent: joints open freely
    std::optional<JointStrength> crushing;   ///< absent: any pressure is borne
    std::optional<ContactModel> contact;     ///< absent: points; in limit analysis only
    /// By name (see jointName), exact names before the last pattern that matches.
    std::vector<std::pair<NamePattern, JointProperties>> joints;
    std::optional<int> pointsPerJoint;    ///< of the plane; absent: the ends, and hinges that crush
    std::optional<PointGrid> jointPoints; ///< of space; absent: the corners
};

/// Friction coefficient of each of `points` contact points: 0 without friction. Not for cases with `joints`.
std::vector<double> frictionCoefficients(const ContactProperties& properties, std::size_t points);

} // namespace drystone
