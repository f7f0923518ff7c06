// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// damping { massProportional a; }: a force -a M u on each block.
#pragma once

#include "dynamics/StepEffect.h"

namespace drystone
{

/// With the mean velocity of the step, u = y/dt, the motion M (v1 - v0) = dt (f - A c - a M y/dt) reads
///
///     (Mbar + a/dt M) y + A c = f + Mbar v0 dt:
///
/// the damping makes blocks heavier in the program, and not in the momentum that they bring along. It takes
/// a/dt y'My from the energy, never less than 0.
class MassDamping final : public StepEffect
{
public:
    explicit MassDamping(const Damping& damping) : coefficient(damping.massProportional) {}
    void contribute(const EffectContext& context, PlaneConeProgram& program) const override;
    void account(const EffectContext& context, const ThetaStep& step, StepEnergy& energy) const override;

private:
    double coefficient; ///< a [1/s]
};

} // namespace drystone
