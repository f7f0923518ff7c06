// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What happens at a contact: constant/contactProperties, one sub-dictionary for each effect that is
/// simulated.
#pragma once

#include <optional>

namespace drystone
{

/// Which way a sliding joint moves.
enum class FlowRule
{
    associative,   ///< normal to the cone: a joint that slides by s opens by mu s
    nonAssociative ///< Coulomb's law: a joint slides without opening
};

/// Coulomb friction: |t| <= mu n.
struct CoulombFriction
{
    double mu = 0;
    FlowRule flowRule = FlowRule::associative;
};

/// The effects of a case; one that is absent is not simulated and costs nothing.
struct ContactProperties
{
    std::optional<CoulombFriction> friction; ///< absent: frictionless
};

} // namespace drystone
