// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Whether points that carry a force slide.
#include "dynamics/StickingStep.h"

#include "conic/TreeBalance.h"
#include "dynamics/GroupChoice.h"
#include "dynamics/HeldBlocks.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// Of the gap that blocks which are one may keep: many points slide together, and a slip at one end of a
/// lever moves the other by more.
constexpr double partOfKept = 0.1;

/// Whether forces are inside the cones of friction by the margin, whatever bonds could hold. Near the surface
/// Coulomb's law has other solutions, where points slide, and the program with everything may find one of
/// these.
template<int Dim>
bool isInsideByMargin(const Step<Dim>& step)
{
    constexpr double acting = 1e-6; // of the largest force
    const Eigen::VectorXd& force = step.solved.result.contactForce;
    const double least = acting * force.lpNorm<Eigen::Infinity>();
    const double share = 1 - step.scene.schemes.effects.margin;
    for (int point = 0; point < step.program.points(); ++point)
    {
        const auto own = force.segment<Dim>(Dim * point);
        const double mu = step.program.friction[static_cast<std::size_t>(point)];
        if (own.template lpNorm<Eigen::Infinity>() > least
            && own.template tail<Dim - 1>().norm() > share * mu * own[0])
        {
            return false;
        }
    }
    return true;
}

/// Whether all points of each pair of bodies press in about the same direction: forces at points that press
/// against each other could wedge them.
template<int Dim>
bool pressAlike(const StepProgram<Dim>& program, const std::vector<TreeBranch>& branches)
{
    constexpr double alike = 0.9; // cosine: no friction below 4 wedges between such points
    return std::all_of(branches.begin(), branches.end(),
                       [&program](const TreeBranch& branch)
                       {
                           const auto normal = [&](int point) -> Vector<Dim>
                           {
                               const auto& columns = program.contacts[static_cast<std::size_t>(point)];
                               return columnsOn(columns, branch.body).template topLeftCorner<Dim, 1>();
                           };
                           for (int point = branch.begin + 1; point < branch.end; ++point)
                           {
                               if (normal(point).dot(normal(branch.begin)) < alike)
                               {
                                   return false;
                               }
                           }
                           return true;
                       });
}

} // namespace

template<int Dim>
bool mayStick(const DynamicCase<Dim>& scene)
{
    return scene.schemes.effects.selection == EffectSelection::automatic
           && scene.flowRule() == FlowRule::nonAssociative
           && whyAllBlocks(scene, FlowRule::associative).empty();
}

template<int Dim>
bool mayStick(const Step<Dim>& step)
{
    if (!mayStick(step.scene) || step.isOfAllBlocks || keepsColliding(step.motion))
    {
        return false;
    }
    if constexpr (Dim == 3)
    {
        return true;
    }
    const auto branches = branchesOfTree(step.program);
    return branches && pressAlike<Dim>(step.program, *branches);
}

template<int Dim>
bool sticks(const Step<Dim>& step)
{
    return step.solved.result.slip <= partOfKept * keptGap(step) && isInsideByMargin(step);
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
template bool mayStick(const Step<2>& step);
template bool sticks(const Step<2>& step);
template bool mayStick(const DynamicCase<3>& scene);
template bool mayStick(const Step<3>& step);
template bool sticks(const Step<3>& step);
template bool hardlySlides(const Step<2>& step);
template bool hardlySlides(const Step<3>& step);

} // namespace drystone
