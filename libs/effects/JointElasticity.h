// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// elasticity { normal kn; tangential kt; }: contact points that give way under force like springs.
#pragma once

#include "effects/EffectType.h"

namespace drystone
{

/// Contact points that give way under force, like springs: Krabbenhoft et al. (2012), the term 1/2 c' C c.
struct Elasticity
{
    double normal = 0;     ///< stiffness of a contact point [N/m]
    double tangential = 0; ///< likewise [N/m]
};

void declare(Options& options, Elasticity& elasticity);

/// Krabbenhoft, Huang, da Silva & Lyamin (2012): the term 1/2 c' C c, C = diag(1/kn, 1/kt). The openings are
/// then z = g + C c - A'y, so that a point that carries n stands at a gap of -n/kn: g has that overlap at the
/// start of the step by itself. Shear leaves nothing that could be seen in the places of the blocks, so its
/// share at the start is put into g: -t0/kt, t0 of the last step.
///
/// Energy: where a point stays closed, c1'(A'y) = c1'C (c1 - c0), which is the change of 1/2 c'Cc and
/// 1/2 (c1 - c0)'C (c1 - c0), a loss of the time integration (theta 1).
///
/// The shear of a point that moves past a corner, and so becomes another one, starts again from none, unless
/// both are ends of one joint of the plane, as of blocks of one width that slide over each other.
template<int Dim>
class JointElasticity final : public Effect<Dim>
{
public:
    explicit JointElasticity(const Elasticity& elasticity)
        : compliance(Vector<Dim>::Constant(1 / elasticity.tangential))
    {
        compliance[0] = 1 / elasticity.normal;
    }
    /// Idle at rest: shear goes on from the forces of the last step, which rest leaves as they are.
    EffectTraits traits() const override
    {
        return {.isCompliant = true, .isIdleAtRest = true, .stiffness = 1 / compliance[0]};
    }
    void contribute(const EffectContext<Dim>& context, EffectState& state,
                    StepProgram<Dim>& program) const override;
    void account(const EffectContext<Dim>& context, const EffectSolution& solution,
                 StepEnergy& energy) const override;

private:
    Vector<Dim> compliance; ///< (1/kn, 1/kt), in space twice 1/kt [m/N]
};

/// Its entry of the list. It refuses what elastic points do not go together with.
template<int Dim>
EffectType<Dim> elasticityType();

} // namespace drystone
