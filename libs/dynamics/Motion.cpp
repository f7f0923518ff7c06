// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A structure in motion: how it begins, and what observers see of it.
#include "dynamics/Motion.h"

#include "conic/form/Form.h"
#include "dynamics/Deletion.h"

#include <cmath>
#include <random>

namespace drystone
{
namespace
{

/// The ends of an unbroken bond are no farther apart than this, in mean block sizes: what steps leave of
/// slips adds up.
constexpr double bondReach = 1e-3;

/// What the joints have of `initialGaps`, and what the places of the blocks make of it, to first order.
void setGapsAsBuilt(const DynamicCase& scene, Motion& motion)
{
    const auto columns = equilibriumColumns(scene.assembly, scene.blocks, motion.points);
    std::mt19937_64 random(scene.schemes.initialGaps ? scene.schemes.initialGaps->seed : 0);
    const auto displacementOf = [&motion](int block)
    {
        const Placement<2>& placement = motion.state.placements[static_cast<std::size_t>(block)];
        return Vector<3>(placement.translation.x(), placement.translation.y(), placement.rotation);
    };
    for (std::size_t i = 0; i < motion.points.size(); ++i)
    {
        ContactPoint<2>& point = motion.points[i];
        if (scene.schemes.initialGaps)
        {
            // Of the generator's numbers themselves: std::uniform_real_distribution differs among libraries.
            const double share = std::ldexp(double(random() >> 11), -53);
            const bool isHeld = !scene.bonds.empty() && !motion.isBondBroken[i];
            point.gap = isHeld ? 0 : scene.schemes.initialGaps->perturbation * share;
        }
        point.gap -= columns[i].onBlock.col(0).dot(displacementOf(point.block))
                     + columns[i].onNeighbour.col(0).dot(displacementOf(point.neighbour));
    }
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

Motion startMotion(const DynamicCase& scene, DynamicState state)
{
    Motion motion;
    motion.state = std::move(state);
    motion.isBondBroken =
        partedBonds(scene.bonds, scene.blocks, motion.state.placements, bondReach * scene.blockSize);
    if (!scene.schemes.smallDisplacements)
    {
        motion.contacts.emplace(scene.assembly);
        deleteBlocks(scene, motion);
        motion.points = motion.contacts->update(motion.state.placements, scene.roundingGap);
    }
    else
    {
        motion.points = findContactPoints(scene.assembly);
        setGapsAsBuilt(scene, motion);
    }
    motion.contactForces.assign(motion.points.size(), Vector<2>::Zero());
    motion.energy.kinetic = kineticEnergy(scene, motion.state.velocity);
    motion.energy.potential = potentialEnergy(scene, motion.state.placements);
    motion.energy.opening = motion.energy.kinetic + motion.energy.potential;
    motion.largestKinetic = motion.energy.kinetic;
    return motion;
}

std::vector<Vector<3>> velocitiesOfAllBlocks(const DynamicCase& scene, const DynamicState& state, double from,
                                             double to)
{
    std::vector<Vector<3>> result =
        supportVelocities(scene.supportMotions, scene.assembly, scene.blocks, state.placements, from, to);
    for (std::size_t block = 0; block < scene.free.size(); ++block)
    {
        if (scene.free[block] >= 0)
        {
            result[block] = state.velocity.segment<3>(3 * scene.free[block]);
        }
    }
    return result;
}

std::vector<int> bondsAt(const DynamicCase& scene, const Motion& motion, const std::vector<char>& isBroken,
                         const std::vector<ContactPoint<2>>& points)
{
    if (motion.contacts)
    {
        return bondsOfPoints(scene.bonds, isBroken, scene.blocks, motion.state.placements, points,
                             bondReach * scene.blockSize);
    }
    std::vector<int> bondOfPoint(points.size()); // they stay as built, in the order of the bonds
    for (std::size_t point = 0; point < points.size(); ++point)
    {
        bondOfPoint[point] = isBroken[point] ? -1 : static_cast<int>(point);
    }
    return bondOfPoint;
}

int brokenBonds(const DynamicCase& scene, const Motion& motion)
{
    int broken = 0;
    for (std::size_t bond = 0; bond < scene.bonds.size(); ++bond)
    {
        const bool isOne = scene.bonds[bond].strength.cohesion > 0 || scene.bonds[bond].strength.tension > 0;
        broken += isOne && motion.isBondBroken[bond] ? 1 : 0;
    }
    return broken;
}

std::vector<Strength> strengthsOf(const DynamicCase& scene, const Motion& motion)
{
    return scene.bonds.empty()
               ? std::vector<Strength>()
               : strengthsOf(scene.bonds, bondsAt(scene, motion, motion.isBondBroken, motion.points));
}

const std::vector<Vector<2>>& meanContactForces(const Motion& motion)
{
    return motion.meanForces.empty() ? motion.contactForces : motion.meanForces;
}

StepObservation<2> observe(const DynamicCase& scene, const Motion& motion, const Time& time,
                           ObservedLists& lists)
{
    lists.friction = frictionAt(scene, motion.points);
    lists.cohesion.clear();
    for (const Strength& strength : strengthsOf(scene, motion))
    {
        lists.cohesion.push_back(strength.cohesion);
    }
    lists.velocities.clear();
    const double now = motion.state.time;
    for (const Vector<3>& velocity : velocitiesOfAllBlocks(scene, motion.state, now, now))
    {
        lists.velocities.push_back({velocity.head<2>(), velocity[2]});
    }
    StepObservation<2> seen;
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

} // namespace drystone
