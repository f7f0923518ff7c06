// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A structure in motion: how it begins, and what observers see of it.
#include "dynamics/Motion.h"

#include "conic/form/Form.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace drystone
{
namespace
{

/// What the joints have of `initialGaps`, and what the places of the blocks make of it, to first order.
template<int Dim>
void setGapsAsBuilt(const DynamicCase<Dim>& scene, Motion<Dim>& motion)
{
    const auto columns = equilibriumColumns(scene.assembly, scene.blocks, motion.points);
    const std::vector<Strength> strengths = strengthsOf(scene, motion);
    std::mt19937_64 random(scene.schemes.initialGaps ? scene.schemes.initialGaps->seed : 0);
    const auto displacementOf = [&motion](int block)
    {
        const Placement<Dim>& placement = motion.state.placements[static_cast<std::size_t>(block)];
        BlockVector<Dim> displacement;
        displacement << placement.translation, rowsOf(placement.rotation);
        return displacement;
    };
    for (std::size_t i = 0; i < motion.points.size(); ++i)
    {
        ContactPoint<Dim>& point = motion.points[i];
        if (scene.schemes.initialGaps)
        {
            // Of the generator's numbers themselves: std::uniform_real_distribution differs among libraries.
            const double share = std::ldexp(double(random() >> 11), -53);
            const bool isHeld = !strengths.empty() && strengths[i].isBond();
            point.gap = isHeld ? 0 : scene.schemes.initialGaps->perturbation * share;
        }
        point.gap -= columns[i].onBlock.col(0).dot(displacementOf(point.block))
                     + columns[i].onNeighbour.col(0).dot(displacementOf(point.neighbour));
    }
}

/// Gives points that start pressed together the force of their spring. \return what they store [J]
template<int Dim>
double pressElasticPoints(const DynamicCase<Dim>& scene, Motion<Dim>& motion)
{
    const double stiffness = traitsOf(scene.effects).stiffness;
    double stored = 0;
    for (std::size_t point = 0; stiffness > 0 && point < motion.points.size(); ++point)
    {
        const double pressed = std::max(0.0, -motion.points[point].gap);
        motion.contactForces[point][0] = stiffness * pressed;
        stored += 0.5 * stiffness * pressed * pressed;
    }
    return stored;
}

} // namespace

KeptAnalysis::KeptAnalysis() = default;
KeptAnalysis::KeptAnalysis(const KeptAnalysis&) {}
KeptAnalysis& KeptAnalysis::operator=(const KeptAnalysis&)
{
    return *this;
}
KeptAnalysis::~KeptAnalysis() = default;

SymbolicAnalysis* KeptAnalysis::get()
{
    if (!analysis)
    {
        analysis = std::make_unique<SymbolicAnalysis>();
    }
    return analysis.get();
}

template<int Dim>
Motion<Dim> startMotion(const DynamicCase<Dim>& scene, DynamicState<Dim> state)
{
    Motion<Dim> motion;
    motion.state = std::move(state);
    motion.jointFriction = scene.jointFriction;
    motion.effectStates.resize(scene.effects.size());
    for (std::size_t i = 0; i < scene.effects.size(); ++i)
    {
        scene.effects[i]->start(scene, motion.state.placements, motion.effectStates[i]);
    }
    if (!scene.schemes.smallDisplacements)
    {
        MovingContactOptions options;
        if (traitsOf(scene.effects).isCompliant)
        {
            options.mayEnter = mayEnterElastic;
            options.edgesAlongFaces = EdgesAlongFaces::faces;
        }
        motion.contacts.emplace(scene.assembly, options);
        leaveOutBlocks(scene, motion);
        motion.points = motion.contacts->update(motion.state.placements, scene.roundingGap);
    }
    else
    {
        motion.points = findContactPoints(scene.assembly);
        setGapsAsBuilt(scene, motion);
    }
    motion.contactForces.assign(motion.points.size(), Vector<Dim>::Zero());
    motion.energy.kinetic = kineticEnergy(scene, motion.state);
    motion.energy.potential = potentialEnergy(scene, motion.state.placements);
    motion.energy.elastic = pressElasticPoints(scene, motion);
    motion.energy.opening = motion.energy.kinetic + motion.energy.potential + motion.energy.elastic;
    motion.largestKinetic = motion.energy.kinetic;
    motion.effectStatesBefore = motion.effectStates;
    return motion;
}

template<int Dim>
std::vector<BlockVector<Dim>> velocitiesOfAllBlocks(const DynamicCase<Dim>& scene,
                                                    const DynamicState<Dim>& state, double from, double to)
{
    std::vector<BlockVector<Dim>> result =
        supportVelocities(scene.effects, scene, state.placements, from, to);
    for (std::size_t block = 0; block < scene.free.size(); ++block)
    {
        if (scene.free[block] >= 0)
        {
            result[block] =
                state.velocity.template segment<freedomCount<Dim>>(freedomCount<Dim> * scene.free[block]);
        }
    }
    return result;
}

template<int Dim>
std::vector<double> frictionAt(const DynamicCase<Dim>& scene, const Motion<Dim>& motion)
{
    return frictionAt(scene.contact, scene.assembly, motion.jointFriction, motion.points);
}

template<int Dim>
std::vector<Strength> strengthsOf(const DynamicCase<Dim>& scene, const Motion<Dim>& motion)
{
    const Eigen::VectorXd none;
    const MassMatrix<Dim> mass = massAt(scene, motion.state.placements);
    const EffectContext<Dim> context{.structure = scene,
                                     .placements = motion.state.placements,
                                     .points = motion.points,
                                     .forcesBefore = none,
                                     .allForcesBefore = motion.contactForces,
                                     .mass = mass,
                                     .displacements = scene.displacements()};
    std::vector<Strength> all;
    for (std::size_t i = 0; i < scene.effects.size(); ++i)
    {
        const std::vector<Strength> own = scene.effects[i]->strengths(context, motion.effectStates[i]);
        all.resize(std::max(all.size(), own.size()));
        for (std::size_t point = 0; point < own.size(); ++point)
        {
            all[point].cohesion += own[point].cohesion;
            all[point].tension += own[point].tension;
        }
    }
    return all;
}

template<int Dim>
double leaveOutBlocks(const DynamicCase<Dim>& scene, Motion<Dim>& motion)
{
    double taken = 0;
    for (std::size_t i = 0; motion.contacts && i < scene.effects.size(); ++i)
    {
        const std::vector<int> leaving =
            scene.effects[i]->leaveOut(scene, motion.state.placements, motion.effectStates[i]);
        if (leaving.empty())
        {
            continue;
        }
        const double before = kineticEnergy(scene, motion.state);
        for (const int block : leaving)
        {
            motion.contacts->leaveOut(block);
            motion.state.velocity
                .template segment<freedomCount<Dim>>(
                    freedomCount<Dim> * scene.free[static_cast<std::size_t>(block)])
                .setZero();
        }
        taken += before - kineticEnergy(scene, motion.state);
    }
    return taken;
}

template<int Dim>
long awakeBlocks(const Motion<Dim>& motion)
{
    return motion.isAwake.empty() ? motion.state.velocity.size() / freedomCount<Dim>
                                  : std::count(motion.isAwake.begin(), motion.isAwake.end(), true);
}

template<int Dim>
long simulatedBodies(const Motion<Dim>& motion)
{
    // They are numbered from 0 on.
    return motion.bodies.empty() ? awakeBlocks(motion)
                                 : 1 + *std::max_element(motion.bodies.begin(), motion.bodies.end());
}

template<int Dim>
const std::vector<Vector<Dim>>& meanContactForces(const Motion<Dim>& motion)
{
    return motion.meanForces.empty() ? motion.contactForces : motion.meanForces;
}

template<int Dim>
StepObservation<Dim> observe(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time,
                             ObservedLists<Dim>& lists)
{
    lists.friction = frictionAt(scene, motion);
    lists.cohesion.clear();
    for (const Strength& strength : strengthsOf(scene, motion))
    {
        lists.cohesion.push_back(strength.cohesion);
    }
    lists.velocities.clear();
    const double now = motion.state.time;
    for (const BlockVector<Dim>& velocity : velocitiesOfAllBlocks(scene, motion.state, now, now))
    {
        lists.velocities.push_back(
            {velocity.template head<Dim>(), turnOf<Dim>(velocity.template tail<rotationCount<Dim>>())});
    }
    StepObservation<Dim> seen;
    seen.time = time.value();
    seen.timeStep = time.value() - time.previousValue();
    seen.step = time.index();
    seen.assembly = &scene.assembly;
    seen.placements = motion.state.placements;
    seen.velocities = lists.velocities;
    seen.contactPoints = motion.points;
    seen.contactForces = meanContactForces(motion);
    seen.frictionCoefficients = lists.friction;
    seen.cohesions = lists.cohesion;
    seen.energy = motion.energy;
    seen.residuals = motion.residuals;
    seen.stageTimes = motion.stageTimes;
    return seen;
}

template std::vector<double> frictionAt(const DynamicCase<2>& scene, const Motion<2>& motion);
template std::vector<Strength> strengthsOf(const DynamicCase<2>& scene, const Motion<2>& motion);
template double leaveOutBlocks(const DynamicCase<2>& scene, Motion<2>& motion);
template Motion<2> startMotion(const DynamicCase<2>& scene, DynamicState<2> state);
template std::vector<BlockVector<2>>
velocitiesOfAllBlocks(const DynamicCase<2>& scene, const DynamicState<2>& state, double from, double to);
template long awakeBlocks(const Motion<2>& motion);
template long simulatedBodies(const Motion<2>& motion);
template const std::vector<Vector<2>>& meanContactForces(const Motion<2>& motion);
template StepObservation<2> observe(const DynamicCase<2>& scene, const Motion<2>& motion, const Time& time,
                                    ObservedLists<2>& lists);
template std::vector<double> frictionAt(const DynamicCase<3>& scene, const Motion<3>& motion);
template std::vector<Strength> strengthsOf(const DynamicCase<3>& scene, const Motion<3>& motion);
template double leaveOutBlocks(const DynamicCase<3>& scene, Motion<3>& motion);
template Motion<3> startMotion(const DynamicCase<3>& scene, DynamicState<3> state);
template std::vector<BlockVector<3>>
velocitiesOfAllBlocks(const DynamicCase<3>& scene, const DynamicState<3>& state, double from, double to);
template long awakeBlocks(const Motion<3>& motion);
template long simulatedBodies(const Motion<3>& motion);
template const std::vector<Vector<3>>& meanContactForces(const Motion<3>& motion);
template StepObservation<3> observe(const DynamicCase<3>& scene, const Motion<3>& motion, const Time& time,
                                    ObservedLists<3>& lists);

} // namespace drystone
