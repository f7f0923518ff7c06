// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What each contact point carries: the properties of its joint, over its part of the joint's area.
#pragma once

#include "contact/ContactPoint.h"
#include "contact/PointAreas.h"
#include "effects/ContactProperties.h"

#include <functional>
#include <limits>
#include <string>

namespace drystone
{

/// Limits to the force (n, t) of a point: -tension <= n <= crushing, |t| <= cohesion + mu n; in space t has
/// two components.
struct PointLaw
{
    double mu = 0;                                             ///< friction coefficient
    double cohesion = 0;                                       ///< [N]
    double tension = 0;                                        ///< [N]
    double crushing = std::numeric_limits<double>::infinity(); ///< [N]
};

/// A joint and what the case says of it, for the effects that make its law (JointLaw in EffectType.h).
struct JointOfCase
{
    const ContactProperties& contact;  ///< of all joints
    const JointProperties& own;        ///< of this one
    const std::string& entry;          ///< of `joints` that it takes; empty: none
    std::function<std::string()> name; ///< see jointName; for messages
};

/// Of a joint, else of all [Pa]; nothing where neither is given.
std::optional<double> stressOf(const std::optional<JointStrength>& ofJoint,
                               const std::optional<JointStrength>& ofAll);

/// Finds what `joints` says of two blocks by their names and zones, whether they touch as built or come to
/// later; null: nothing. Both arguments must outlive it.
template<int Dim>
std::function<const JointProperties*(int block, int neighbour)> jointsByName(const ContactProperties& contact,
                                                                             const Assembly<Dim>& assembly);

/// Name of the joint of two blocks, for patterns and messages: `3-7`, lower index first; a fixed block goes
/// by the name of its support and comes last, `12-ground`.
template<int Dim>
std::string jointName(const Assembly<Dim>& assembly, int block, int neighbour);

/// Whether blocks may come to touch that do not as built: in motion, where `joints` may give them a friction.
enum class NewJoints
{
    none,
    possible
};

/// The law of each point: what the effects of the list make of it.
/// \param areas that each stands for [m2]; without them those of pointAreas
/// \throws FatalIOError for a name of `joints` that no joint has, or what a joint cannot have
template<int Dim>
std::vector<PointLaw> pointLaws(const ContactProperties& contact, const Assembly<Dim>& assembly,
                                const std::vector<ContactPoint<Dim>>& points,
                                const std::vector<double>& areas, NewJoints newJoints = NewJoints::none);
template<int Dim>
std::vector<PointLaw> pointLaws(const ContactProperties& contact, const Assembly<Dim>& assembly,
                                const std::vector<ContactPoint<Dim>>& points,
                                NewJoints newJoints = NewJoints::none)
{
    return pointLaws(contact, assembly, points, pointAreas(assembly, points), newJoints);
}

} // namespace drystone
