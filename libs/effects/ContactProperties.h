// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a case says of its joints in constant/contactProperties: the settings of the effects that structures
/// at rest have, too, each declared in its own files.
#pragma once

#include "dictionary/EntryLocations.h"
#include "dictionary/Options.h"
#include "effects/Friction.h"
#include "effects/JointModel.h"
#include "effects/JointStrength.h"
#include "effects/Restitution.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace drystone
{

/// What some joints have instead of what all have; the effects that it does not name stay as they are.
struct JointProperties
{
    std::optional<JointFriction> friction;
    std::optional<JointStrength> cohesion;
    std::optional<JointStrength> tension;
    std::optional<JointStrength> crushing;
};

void declare(Options& options, JointProperties& properties);

/// What the joints of a case carry and how they rebound; what is absent is not simulated and costs nothing.
struct ContactProperties
{
    std::optional<CoulombFriction> friction; ///< absent: frictionless
    std::optional<Restitution> restitution;  ///< absent: impacts are plastic
    std::optional<JointStrength> cohesion;   ///< absent: shear by friction alone
    std::optional<JointStrength> tension;    ///< absent: joints open freely
    std::optional<JointStrength> crushing;   ///< absent: any pressure is borne
    std::optional<ContactModel> contact;     ///< absent: points; in limit analysis only
    /// By name (see jointName) or by the zones of both blocks, as base-shaft; names of blocks before those of
    /// zones, and these before patterns, of equally close ones the last.
    std::vector<std::pair<NamePattern, JointProperties>> joints;
    std::optional<int> pointsPerJoint;     ///< of the plane; absent: the ends, and hinges that crush
    std::optional<MorePoints> jointPoints; ///< of space; absent: the corners, and those of joints that crush
    EntryLocations locations;              ///< of the entries of constant/contactProperties, for messages
};

inline FlowRule flowRuleOf(const ContactProperties& contact)
{
    return contact.friction ? contact.friction->flowRule : FlowRule::associative;
}

/// Whether joints of the plane are one surface each, in limit analysis.
inline bool isSurfaceContact(const ContactProperties& contact)
{
    return contact.contact && contact.contact->formulation == ContactFormulation::surface;
}

/// How joints of space get more points, if that is how; else null. Owned by the properties.
template<class Points>
const Points* jointPointsOf(const ContactProperties& contact)
{
    return contact.jointPoints ? std::get_if<Points>(&*contact.jointPoints) : nullptr;
}

/// Whether some joint has a property of its own.
template<class Property>
bool isInJoints(const ContactProperties& contact, std::optional<Property> JointProperties::*property)
{
    return std::any_of(contact.joints.begin(), contact.joints.end(),
                       [property](const auto& joint) { return (joint.second.*property).has_value(); });
}

} // namespace drystone
