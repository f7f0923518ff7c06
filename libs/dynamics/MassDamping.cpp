// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/MassDamping.h"

#include <cmath>

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

double equivalentDamping(const HousnerLoss& loss, double gravity)
{
    const double alpha = loss.slenderness;
    const double ratio = 1 - 1.5 * std::pow(std::sin(alpha), 2);
    const double beta0 = alpha - loss.amplitude;
    const double s0 = std::sqrt(alpha * alpha - beta0 * beta0);
    const double s1 = ratio * s0;
    const double beta1 = std::sqrt(alpha * alpha - s1 * s1);
    const auto swing = [alpha](double s, double beta) // 2 J
    { return alpha * s - beta * beta * std::acosh(alpha / beta); };
    const double p = std::sqrt(0.75 * gravity / loss.radius);
    return p * (1 - ratio * ratio) * s0 * s0 / (swing(s0, beta0) + swing(s1, beta1));
}

} // namespace drystone
