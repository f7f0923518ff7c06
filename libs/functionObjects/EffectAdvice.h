// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which effects a scene requires, by closed-form criteria: what `contactDynamics -dry-run` reports. It needs
/// statics and dynamics, which do not see each other, and so belongs above both.
#pragma once

#include "dynamics/DynamicCase.h"

#include <string>

namespace drystone
{

/// The demand of a scene on rigid blocks at rest as built, and their capacity.
///
/// The loads that dry joints can carry form a convex set, and each of them is in equilibrium with forces
/// within the cones. At every instant the ground loads the blocks with a combination of its components
/// between minus and plus their peaks; so when the blocks carry all of the 2^k corners of that box, they
/// carry every instant, and with the associative flow rule they remain at rest: limit analysis is sufficient.
struct EffectAdvice
{
    bool isAssessed = true; ///< false: the criteria do not apply to this scene, and all below is empty
    std::string reason;     ///< why not

    /// The multiple of the peaks of the ground that the blocks carry, the smallest of the corners: 0 when
    /// they are unstable at rest, infinite when no such motion moves them.
    double capacity = 0;
    double peak = 0;           ///< of the ground, the length of the corner with the least capacity [m/s2]
    double frictionDemand = 0; ///< smallest mu that carries the corners, or the part of them that can be
                               ///< carried with any mu: where it is below mu, joints do not slide first;
                               ///< not a number where it is unknown
    double mu = 0;             ///< of the joints
};

/// A demand compared with the capacity.
enum class Margin
{
    below,     ///< by 5% or more
    nearLimit, ///< within 5%: rounding, the flow rule or small gaps may decide
    above
};
Margin margin(double demand, double available);

/// Assesses a scene. Costs some ten to thirty limit analyses.
EffectAdvice adviseEffects(const DynamicCase<2>& scene, const DynamicState<2>& start);

/// The advice as text, one line per criterion, and a warning for each criterion within 5% of its limit. It
/// changes nothing in the scene.
std::string adviceText(const DynamicCase<2>& scene, const EffectAdvice& advice);

} // namespace drystone
