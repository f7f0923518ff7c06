// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Whether points that carry a force slide.
#include "dynamics/StickingStep.h"

#include "dynamics/GroupChoice.h"
#include "dynamics/HeldBlocks.h"

namespace drystone
{
namespace
{

/// Of the gap that blocks which are one may keep: many points slide together, and a slip at one end of a
/// lever moves the other by more.
constexpr double partOfKept = 0.1;

} // namespace

template<int Dim>
bool mayStick(const DynamicCase<Dim>& scene)
{
    return Dim == 3 && scene.schemes.effects.selection == EffectSelection::automatic
           && scene.flowRule() == FlowRule::nonAssociative && !hasImpacts(scene)
           && !traitsOf(scene.effects).holdsJoints && whyAllBlocks(scene, FlowRule::associative).empty();
}

template<int Dim>
bool sticks(const Step<Dim>& step)
{
    return step.solved.result.slip <= partOfKept * keptGap(step);
}

template<int Dim>
bool hardlySlides(const Step<Dim>& step)
{
    const ThetaStep& result = step.solved.result;
    const Eigen::VectorXd opening = openingAtEnd(step, result.displacement, result.contactForce);
    const double least =
        step.settings.solver.tolerance * result.contactForce.template lpNorm<Eigen::Infinity>();
    const double kept = keptGap(step);
    for (Eigen::Index row = 0; row < result.contactForce.size(); row += Dim)
    {
        if (result.contactForce[row] > least
            && opening.segment<Dim - 1>(row + 1).template lpNorm<Eigen::Infinity>() > kept)
        {
            return false;
        }
    }
    return true;
}

template bool mayStick(const DynamicCase<2>& scene);
template bool sticks(const Step<2>& step);
template bool mayStick(const DynamicCase<3>& scene);
template bool sticks(const Step<3>& step);
template bool hardlySlides(const Step<2>& step);
template bool hardlySlides(const Step<3>& step);

} // namespace drystone
