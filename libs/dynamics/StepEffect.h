// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Effects that a case asks for beside friction and impact: each adds its terms to the program of a step, and
/// says where its energy goes.
#pragma once

#include "contact/ContactProperties.h"
#include "dynamics/ThetaStep.h"

#include <memory>
#include <vector>

namespace drystone
{

/// What an effect may look at. Nothing is owned.
struct EffectContext
{
    const Eigen::VectorXd& mass;         ///< diagonal of M, 3 a free block [kg, kg, kg m2]
    const Eigen::VectorXd& forcesBefore; ///< of the last step at the points of this one [N], two a point
    const std::vector<Vector<2>>& allForcesBefore; ///< at the points of the last step (normal, tangent) [N]
    double timeStep = 0;                           ///< [s]
};

/// One effect. Immutable, so that threads may share it.
class StepEffect
{
public:
    virtual ~StepEffect() = default;

    /// Add to the program, which has the terms of the rigid step.
    virtual void contribute(const EffectContext& context, PlaneConeProgram& program) const = 0;

    /// Take what is the effect's own out of the energies of the rigid step, and name it.
    virtual void account(const EffectContext& context, const ThetaStep& step, StepEnergy& energy) const = 0;
};

/// The effects of a case; those that it does not ask for are not in the list.
std::vector<std::shared_ptr<const StepEffect>> stepEffects(const ContactProperties& properties);

} // namespace drystone
