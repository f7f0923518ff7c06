// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/StepEffect.h"

#include "dynamics/JointElasticity.h"
#include "dynamics/MassDamping.h"

namespace drystone
{

std::vector<std::shared_ptr<const StepEffect>> stepEffects(const ContactProperties& properties)
{
    std::vector<std::shared_ptr<const StepEffect>> effects;
    if (properties.elasticity)
    {
        effects.push_back(std::make_shared<JointElasticity>(*properties.elasticity));
    }
    if (properties.damping && properties.damping->massProportional > 0)
    {
        effects.push_back(std::make_shared<MassDamping>(*properties.damping));
    }
    return effects;
}

} // namespace drystone
