// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which effects a scene calls for, by criteria in closed form: asked before a run, by `-dry-run`.
#pragma once

#include "dynamics/DynamicCase.h"

#include <string>

namespace drystone
{

/// What a scene demands of rigid blocks at rest as built, and what they have.
///
/// The loads that dry joints can carry are a convex set, each of them carried in full by forces within the
/// cones. At every instant the ground loads the blocks with a combination of its components between minus and
/// plus their peaks; so when the blocks carry all of the 2^k corners of that box, they carry every instant,
/// and with the associative flow rule they stay where they are: limit analysis is all that is needed.
struct EffectAdvice
{
    bool isAssessed = true; ///< false: the criteria are not for this scene, and all below is empty
    std::string reason;     ///< why not

    /// The multiple of the peaks of the ground that the blocks carry, the least of the corners: 0 when they
    /// do not even stand at rest, infinite when no such motion moves them.
    double capacity = 0;
    double peak = 0;           ///< of the ground, the length of the corner with the least capacity [m/s2]
    double frictionDemand = 0; ///< least mu that carries the corners, or as much of them as no friction
                               ///< coefficient exceeds: where it is below mu, joints do not slide first;
                               ///< not a number where that is not known
    double mu = 0;             ///< what there is
};

/// How a demand compares with what there is.
enum class Margin
{
    below,      ///< by 5% or more
    nearBorder, ///< within 5%: rounding, the flow rule or small gaps may decide
    above
};
Margin margin(double demand, double available);

/// Assesses a scene. Costs some ten to thirty limit analyses.
EffectAdvice adviseEffects(const DynamicCase& scene, const DynamicState& start);

/// The advice in words, a line each, and a warning for each criterion within 5% of its border. It changes
/// nothing in the scene.
std::string adviceText(const DynamicCase& scene, const EffectAdvice& advice);

} // namespace drystone
