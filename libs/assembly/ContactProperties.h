// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What happens at a contact: constant/contactProperties, one sub-dictionary for each effect that is
/// simulated.
#pragma once

#include "core/Options.h"
#include "core/Registry.h"

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

void declare(Options& options, CoulombFriction& friction);

/// Rebound after an impact (Newton): the points of a contact part with `normal` times the velocity at which
/// they met.
struct Restitution
{
    double normal = 0; ///< coefficient, 0 to 1
};

void declare(Options& options, Restitution& restitution);

/// The effects of a case; one that is absent is not simulated and costs nothing.
struct ContactProperties
{
    std::optional<CoulombFriction> friction; ///< absent: frictionless
    std::optional<Restitution> restitution;  ///< absent: impacts are plastic
};

void declare(Options& options, ContactProperties& properties);

/// The friction laws that `friction { type ...; }` chooses from.
const Registry<CoulombFriction>& frictionTypes();

/// An effect that constant/contactProperties knows and this version does not simulate.
struct AbsentEffect
{
    std::string_view name;
    std::string_view summary;
};

/// All of them: asking for one is an error, so that nobody takes a result for what it is not.
const std::vector<AbsentEffect>& absentEffects();

/// The effects of a case, for the log: which are simulated and which are not.
struct EffectNames
{
    std::vector<std::string> simulated;
    std::vector<std::string> absent;
};
EffectNames effectNames(const ContactProperties& properties);

/// The effects of a case. \throws FatalError or FatalIOError when constant/contactProperties is missing or
/// faulty, or asks for an effect that is unknown or absent from this version
ContactProperties readContactProperties(const std::filesystem::path& caseDirectory);

/// Friction coefficient of each of `points` contact points: 0 without friction.
std::vector<double> frictionCoefficients(const ContactProperties& properties, std::size_t points);

} // namespace drystone
