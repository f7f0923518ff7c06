// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The last stage of a step: its energy, and what the next step starts from.
#include "dynamics/EffectCalls.h"
#include "dynamics/Step.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// The part of the algorithmic loss that a motion without impacts has.
template<int Dim>
double smoothLoss(const Step<Dim>& step)
{
    constexpr double byLoads = 4; // twice the change of velocity, squared
    const double smooth = byLoads * (step.scheme.theta - 0.5) * step.scheme.timeStep * step.scheme.timeStep
                          * inverseSquareOf(step.mass, step.load);
    return std::min(step.energy.algorithmicLoss, smooth);
}

/// Work that contacts have done on the blocks [J].
template<int Dim>
double createdByContact(const Step<Dim>& step)
{
    return -(step.energy.normalLoss + step.energy.frictionLoss);
}

/// Forces and gaps, where the next step starts.
template<int Dim>
void keepContacts(Step<Dim>& step)
{
    Motion<Dim>& motion = step.motion;
    const ThetaStep& result = step.solved.result;
    motion.points = std::move(step.pointsAtEnd);
    motion.contactForces.resize(motion.points.size());
    for (std::size_t i = 0; i < motion.points.size(); ++i)
    {
        const Eigen::Index row = Dim * static_cast<Eigen::Index>(i);
        motion.contactForces[i] = result.contactForce.segment<Dim>(row);
        if (!motion.contacts)
        {
            motion.points[i].gap -=
                result.closing[row] + (step.bySupports.size() > 0 ? step.bySupports[row] : 0);
        }
    }
    motion.meanForces.clear();
    if (step.solved.impulse.size() > 0)
    {
        motion.meanForces = motion.contactForces;
        for (std::size_t i = 0; i < motion.points.size(); ++i)
        {
            motion.meanForces[i] +=
                step.solved.impulse.template segment<Dim>(Dim * static_cast<Eigen::Index>(i))
                / step.scheme.timeStep;
        }
    }
    motion.interior = std::move(step.solved.result.interior);
}

} // namespace

template<int Dim>
void measureEnergy(Step<Dim>& step)
{
    const StageTimer timer(step.motion.stageTimes, Stage::account);
    const ThetaStep& result = step.solved.result;
    StepEnergy& energy = step.energy;
    energy = stepEnergy(result, step.mass, step.load, step.solved.velocity, step.velocityAtEnd, step.scheme);
    energy.algorithmicLoss += step.lostInStopping - step.keptInFlight;
    // Points close and slide by A'y and by what the supports do, which work against the same forces.
    double workOfSupports = step.solved.workOfSupports;
    for (Eigen::Index row = 0; row < step.bySupports.size(); row += Dim)
    {
        const double normalWork = result.contactForce[row] * step.bySupports[row];
        const double shearWork = result.contactForce.template segment<Dim - 1>(row + 1).dot(
            step.bySupports.template segment<Dim - 1>(row + 1));
        energy.normalLoss += normalWork;
        energy.frictionLoss += shearWork;
        workOfSupports += normalWork + shearWork;
    }
    energy.externalWork = (step.load - step.deadLoad).dot(result.displacement) + workOfSupports;
    if (step.scene.deadLoad.firstMoments.size() > 0)
    {
        // By what the mean moments of the step differ from those along the way is the time integration's.
        energy.algorithmicLoss += step.motion.energy.potential
                                  - potentialEnergy(step.scene, step.motion.state.placements)
                                  - step.deadLoad.dot(result.displacement);
    }
    else if constexpr (Dim == 3) // constant moments have no potential
    {
        for (Eigen::Index row = Dim; row < result.displacement.size(); row += freedomCount<Dim>)
        {
            energy.externalWork +=
                step.deadLoad.template segment<3>(row).dot(result.displacement.template segment<3>(row));
        }
    }
    const std::function<Eigen::VectorXd()> opening = [&step, &result]
    { return openingAtEnd(step, result.displacement, result.contactForce); };
    const EffectContext<Dim> context = contextOf(step);
    const EffectSolution solution{result.displacement, result.contactForce, opening};
    for (const auto& effect : step.scene.effects)
    {
        effect->account(context, solution, energy);
    }
}

template<int Dim>
bool createsEnergy(const Step<Dim>& step)
{
    constexpr double mostCreated = 0.1; // of the energy that the blocks had, or got from outside
    constexpr double closed = 1e-4;     // of a block, against the forces
    const StepEnergy& energy = step.energy;
    const double created = createdByContact(step);
    if (!(created > 0) || step.program.hasCompliance()) // whose points may appear with an overlap
    {
        return false;
    }
    const double had = 0.5 * squareOf(step.mass, step.solved.velocity);
    double forces = 0;
    for (Eigen::Index row = 0; row < step.solved.result.contactForce.size(); row += Dim)
    {
        forces += std::abs(step.solved.result.contactForce[row]);
    }
    return created > mostCreated * (had + std::abs(energy.loadWork) + std::abs(energy.externalWork))
           && created > closed * step.scene.blockSize * forces;
}

template<int Dim>
void account(Step<Dim>& step)
{
    const StageTimer timer(step.motion.stageTimes, Stage::account);
    const DynamicCase<Dim>& scene = step.scene;
    Motion<Dim>& motion = step.motion;
    if (scene.schemes.effects.selection == EffectSelection::automatic)
    {
        motion.effectCalls = effectCalls(step);
    }
    motion.smoothLoss += smoothLoss(step);
    motion.created += std::max(0.0, createdByContact(step) - step.energy.algorithmicLoss);
    motion.effectStates = std::move(step.effectStates);
    step.energy.externalWork -= leaveOutBlocks(scene, motion);
    motion.energy.impactLoss += step.solved.lostInImpacts - step.solved.rubbedInImpacts;
    motion.energy.frictionLoss += step.solved.rubbedInImpacts;
    keepLedger(motion.energy, scene, step.energy, motion.state);
    motion.largestKinetic = std::max(motion.largestKinetic, motion.energy.kinetic);
    motion.restitutionShare = step.solved.restitutionShare;
    motion.slides = step.solved.slides;
    motion.overlapsLeft = step.overlapsLeft;
    motion.collisions = step.solved.collides ? motion.collisions + 1 : 0;
    motion.stepsInVain = step.isInVain          ? motion.stepsInVain + 1
                         : step.isAwake.empty() ? motion.stepsInVain
                                                : 0;
    motion.isAwake = std::move(step.isAwake);
    motion.bodies = std::move(step.bodies);
    motion.effectUse.sticking += step.solved.sticks ? 1 : 0;
    motion.residuals = motion.attempt;
    keepContacts(step);
}

template void measureEnergy(Step<2>& step);
template bool createsEnergy(const Step<2>& step);
template void account(Step<2>& step);
template void measureEnergy(Step<3>& step);
template bool createsEnergy(const Step<3>& step);
template void account(Step<3>& step);

} // namespace drystone
