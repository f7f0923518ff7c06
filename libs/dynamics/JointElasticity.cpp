// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/JointElasticity.h"

namespace drystone
{

void JointElasticity::contribute(const EffectContext& context, PlaneConeProgram& program) const
{
    program.compliance.resize(2 * program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        program.compliance.segment<2>(2 * point) = compliance;
        program.gap[2 * point + 1] -= compliance[1] * context.forcesBefore[2 * point + 1];
    }
}

void JointElasticity::account(const EffectContext& context, const ThetaStep& step, StepEnergy& energy) const
{
    Eigen::Vector2d stored = Eigen::Vector2d::Zero();
    Eigen::Vector2d before = Eigen::Vector2d::Zero();
    Eigen::Vector2d lost = Eigen::Vector2d::Zero();
    for (Eigen::Index row = 0; row < step.contactForce.size(); row += 2)
    {
        const Eigen::Vector2d now = step.contactForce.segment<2>(row);
        const Eigen::Vector2d then = context.forcesBefore.segment<2>(row);
        stored += now.cwiseAbs2();
        before += then.cwiseAbs2();
        lost += (now - then).cwiseAbs2();
    }
    const Eigen::Vector2d change = 0.5 * compliance.cwiseProduct(stored - before);
    const Eigen::Vector2d algorithmic = 0.5 * compliance.cwiseProduct(lost);
    energy.normalLoss -= change[0] + algorithmic[0];
    energy.frictionLoss -= change[1] + algorithmic[1];
    // Points that are no longer there take what they had stored with them.
    Eigen::Vector2d all = Eigen::Vector2d::Zero();
    for (const Vector<2>& force : context.allForcesBefore)
    {
        all += force.cwiseAbs2();
    }
    const double gone = 0.5 * compliance.dot(all - before);
    energy.elasticChange += change.sum() - gone;
    energy.algorithmicLoss += algorithmic.sum() + gone;
}

} // namespace drystone
