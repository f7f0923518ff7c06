// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// contact, pointsPerJoint, jointPoints and joints: what computations know of a joint, and what some joints
/// have instead of what all have. No effect by itself, but keys of the same dictionary.
#pragma once

#include "dictionary/Registry.h"
#include "effects/EffectType.h"

#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

namespace drystone
{

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

/// The formulation that a case chooses.
struct ContactModel
{
    ContactFormulation formulation = ContactFormulation::points;
};

/// Contact points of the joints in space: a grid over each, in addition to its corners.
struct PointGrid
{
    int perSide = 5; ///< points along each side of a joint
};

/// Contact points added to the joints in space where they count.
struct AdaptivePoints
{
    double tolerance = 1e-3; ///< of the multiplier, by which it may exceed the bound of its mechanism
};

/// Points of joints in space in addition to their corners.
using MorePoints = std::variant<PointGrid, AdaptivePoints>;

void declare(Options& options, ContactModel& model);
void declare(Options& options, PointGrid& grid);
void declare(Options& options, AdaptivePoints& points);

/// The points that `jointPoints { type ...; }` chooses from; nothing: the corners alone.
const Registry<std::optional<MorePoints>>& jointPointTypes();

/// Its entry of the list. It refuses in motion what only limit analysis has.
template<int Dim>
EffectType<Dim> jointModelType();

} // namespace drystone
