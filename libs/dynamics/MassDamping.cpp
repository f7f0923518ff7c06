// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/MassDamping.h"

namespace drystone
{

void MassDamping::contribute(const EffectContext& context, PlaneConeProgram& program) const
{
    for (int body = 0; body < program.bodies; ++body)
    {
        program.inertia[static_cast<std::size_t>(body)].diagonal() +=
            coefficient / context.timeStep * context.mass.segment<3>(3 * body);
    }
}

void MassDamping::account(const EffectContext& context, const ThetaStep& step, StepEnergy& energy) const
{
    energy.dampingLoss += coefficient / context.timeStep * context.mass.dot(step.displacement.cwiseAbs2());
}

} // namespace drystone
