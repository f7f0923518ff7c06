// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The program of the bodies that a step is taken with, and the forces that hold each of them together.
#include "dynamics/HeldBlocks.h"

#include "dynamics/BodiesStep.h"
#include "dynamics/HoldingForces.h"
#include "dynamics/TurnedGroups.h"

#include <algorithm>
#include <bit>

namespace drystone
{
namespace
{

/// Fewer bodies than this share of the blocks, or it does not pay.
constexpr double mostBodies = 0.7;

/// With more bodies than this share of the blocks a try has gained little.
constexpr double muchFewer = 0.5;

/// Where a guess is not proved it is changed so many times less one.
constexpr int attempts = 3;

/// More bodies than this, where some of them are expected at rest, cost nearly what all blocks do.
constexpr double mostBodiesWithBuffer = 0.5;

/// Whether fewer bodies are worth a try after so many steps in a row without: less and less often, as a
/// structure that breaks goes on breaking.
bool isWorthATry(int stepsInVain)
{
    constexpr int seldom = 16;
    return stepsInVain % seldom == 0 || std::has_single_bit(static_cast<unsigned>(stepsInVain));
}

/// See Step::isShared.
template<int Dim>
std::vector<char> sharedBlocks(const BlockGroups<Dim>& groups)
{
    std::vector<char> isShared;
    if (!groups.areSingle())
    {
        isShared.resize(groups.group.size());
        for (std::size_t body = 0; body < isShared.size(); ++body)
        {
            isShared[body] = groups.group[body] >= 0 && groups.isBound(body);
        }
    }
    return isShared;
}

template<int Dim>
MeasuredPoints measuredPoints(const Step<Dim>& step, const std::vector<std::size_t>& points)
{
    MeasuredPoints measured{points, std::vector<int>(step.scene.free.size(), -1)};
    for (const std::size_t index : points)
    {
        const ContactPoint<Dim>& point = step.points[index];
        for (const int block : {point.block, point.neighbour})
        {
            measured.free[static_cast<std::size_t>(block)] = step.scene.free[static_cast<std::size_t>(block)];
        }
    }
    return measured;
}

Certificate larger(const Certificate& one, const Certificate& other)
{
    return {std::max(one.primalResidual, other.primalResidual),
            std::max(one.dualResidual, other.dualResidual), std::max(one.dualityGap, other.dualityGap)};
}

/// How a guess came out.
struct Outcome
{
    bool isProved = false;
    std::vector<std::size_t> failing; ///< points of the whole that are not; none: nothing is known
};

/// Gives the solution of the bodies, of which nothing but the groups is left, to all blocks. \param forces of
/// all points \param displacement of all blocks
template<int Dim>
void takeOver(Step<Dim>& step, BodiesStep<Dim>& bodies, Eigen::VectorXd forces, Eigen::VectorXd displacement)
{
    ThetaStep& result = step.solved.result;
    result = std::move(bodies.step);
    result.displacement = std::move(displacement);
    result.contactForce = std::move(forces);
    result.closing = applyTransposed(step.program, result.displacement);
    result.interior = std::move(bodies.interior);
    result.load.resize(0);
    result.gap.resize(0);
}

/// \param groups become those that the step was proved with; nothing is left of them where it was not
template<int Dim>
Outcome solveGroups(Step<Dim>& step, BlockGroups<Dim>& groups, const GroupChoice<Dim>& choice)
{
    BodiesStep<Dim> bodies = solveBodies(step, std::move(groups), choice);
    if (bodies.step.status != SolveStatus::optimal)
    {
        return {};
    }
    if (choice.hasBuffer())
    {
        holdBodiesAtRest(step, bodies);
    }
    Eigen::VectorXd displacement = bodies.step.displacement;
    if (!bodies.groups.areSingle())
    {
        displacement = balancedDisplacement(bodies.groups, bodies.ofBlocks, bodies.program,
                                            bodies.step.contactForce, displacement);
        if (farthestMotion<Dim>(displacement - bodies.step.displacement, step.scene.blockSize)
            > partOfGapWithLess * step.settings.contactTolerance)
        {
            return {};
        }
    }
    Eigen::VectorXd forces = forcesBetween(step, bodies);
    Eigen::VectorXd y = displacementOfBlocks(bodies.groups, displacement);
    HoldingForces holding =
        findHoldingForces(step, bodies.groups,
                          Eigen::VectorXd(bodies.ofBlocks.load - applyInertia(bodies.ofBlocks, y)
                                          - applyEquilibrium(bodies.ofBlocks, bodies.step.contactForce)),
                          forces);
    if (!holding.isFound)
    {
        return {false, std::move(holding.failing)};
    }
    bodies.step.certificate = larger(bodies.step.certificate, holding.certificate);
    takeOver(step, bodies, std::move(forces), std::move(y));
    groups = std::move(bodies.groups);
    return {true, {}};
}

/// Says which blocks were simulated, and in which bodies.
template<int Dim>
void keepGroups(Step<Dim>& step, const BlockGroups<Dim>& groups)
{
    const std::vector<int>& free = step.scene.free;
    step.isAwake.assign(free.size(), false);
    step.bodies.assign(free.size(), -1);
    for (std::size_t block = 0; block < free.size(); ++block)
    {
        step.bodies[block] = groups.of(free[block]);
        step.isAwake[block] = step.bodies[block] >= 0;
    }
}

} // namespace

template<int Dim>
void forgetBodies(Step<Dim>& step)
{
    step.isAwake.clear();
    step.bodies.clear();
}

template<int Dim>
std::string_view whyAllBlocks(const DynamicCase<Dim>& scene, FlowRule flowRule)
{
    if (traitsOf(scene.effects).isCompliant)
    {
        return "elastic joints give way at rest too";
    }
    if (scene.schemes.timeIntegration.theta < 1)
    {
        return "with theta below 1 blocks that meet have impacts of their own, which depend on forces that "
               "are not unique";
    }
    if (flowRule == FlowRule::nonAssociative)
    {
        return "by Coulomb's law forces that are not unique decide what moves";
    }
    return "";
}

template<int Dim>
bool solveAwake(Step<Dim>& step)
{
    const StepProgram<Dim>& program = step.program;
    if (step.scene.schemes.effects.selection != EffectSelection::automatic || program.bodies == 0
        || step.isOfAllBlocks || keepsColliding(step.motion)
        || !whyAllBlocks(step.scene, step.settings.flowRule).empty())
    {
        return false;
    }
    step.isInVain = !isWorthATry(step.motion.stepsInVain);
    if (step.isInVain)
    {
        return false;
    }
    // Work in vain takes nothing from the step with all blocks, which is solved as if it had come first.
    const double done = step.motion.work.done;
    GroupChoice<Dim> choice(step);
    int bodiesBefore = 0;
    for (int attempt = 0; attempt < attempts; ++attempt)
    {
        const int bodies = choice.bodies();
        const double most = (choice.hasBuffer() ? mostBodiesWithBuffer : mostBodies) * program.bodies;
        if (bodies == bodiesBefore || bodies > most)
        {
            break;
        }
        bodiesBefore = bodies;
        BlockGroups<Dim> groups = blockGroups(step, choice.groups());
        step.isShared = sharedBlocks(groups);
        const MeasuredPoints measured = measuredPoints(step, groups.outer);
        step.measuredPoints = &measured;
        const Outcome outcome = solveGroups(step, groups, choice);
        step.measuredPoints = nullptr;
        step.isShared.clear();
        if (outcome.isProved)
        {
            keepGroups(step, groups);
            step.isInVain = groups.count() > muchFewer * program.bodies;
            return true;
        }
        step.isInVain = true;
        choice.change(outcome.failing);
    }
    step.motion.work.done = done;
    return false;
}

template void forgetBodies(Step<2>& step);
template std::string_view whyAllBlocks(const DynamicCase<2>& scene, FlowRule flowRule);
template bool solveAwake(Step<2>& step);
template void forgetBodies(Step<3>& step);
template std::string_view whyAllBlocks(const DynamicCase<3>& scene, FlowRule flowRule);
template bool solveAwake(Step<3>& step);

} // namespace drystone
