// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/MotionResults.h"

#include "assembly/ContactState.h"
#include "core/WholeFile.h"
#include "dynamics/InitialMotion.h"
#include "io/Frames.h"

#include <fmt/format.h>

namespace drystone
{
namespace
{

/// The scalars of the ledger by the names they have in a state.
template<class Ledger, class Visit>
void visitLedger(Ledger& energy, const Visit& visit)
{
    visit("energyOpening", energy.opening);
    visit("energyKinetic", energy.kinetic);
    visit("energyPotential", energy.potential);
    visit("energyExternalWork", energy.externalWork);
    visit("energyFrictionLoss", energy.frictionLoss);
    visit("energyImpactLoss", energy.impactLoss);
    visit("energyAlgorithmicLoss", energy.algorithmicLoss);
}

/// The whole numbers that say which corner meets which edge, of one point.
constexpr std::size_t featureNumbers = 5;

FunctionList<2> readFunctions(const std::filesystem::path& caseDirectory, const DynamicCase& scene,
                              Time& time, FunctionObjects functionObjects)
{
    const Dictionary* functions = time.controlDict().findDict("functions");
    if (!functions || functionObjects == FunctionObjects::none)
    {
        return {};
    }
    return {*functions, caseDirectory, time.startName(), time.point(), scene.assembly};
}

} // namespace

State stateOf(const Motion& motion, const Time& time)
{
    State state;
    const TimeState now = time.state();
    state.scalars = {{"time", now.value},
                     {"deltaT", now.deltaT},
                     {"timeIndex", static_cast<double>(now.index)},
                     {"timeOrigin", now.origin},
                     {"timeOriginIndex", static_cast<double>(now.originIndex)}};
    visitLedger(motion.energy, [&](const char* name, double value) { state.scalars[name] = value; });
    auto& translation = state.arrays["translation"];
    auto& rotation = state.arrays["rotation"];
    for (const Placement<2>& placement : motion.state.placements)
    {
        translation.insert(translation.end(), {placement.translation.x(), placement.translation.y()});
        rotation.push_back(placement.rotation);
    }
    state.arrays["velocity"].assign(motion.state.velocity.begin(), motion.state.velocity.end());
    auto& features = state.arrays["contactFeature"];
    auto& gaps = state.arrays["contactGap"];
    auto& forces = state.arrays["contactForce"];
    for (std::size_t i = 0; i < motion.points.size(); ++i)
    {
        const ContactPoint<2>& point = motion.points[i];
        for (const int number : {point.block, point.neighbour, point.feature.vertexBlock,
                                 point.feature.vertex, point.feature.edge})
        {
            features.push_back(number);
        }
        gaps.push_back(point.gap);
        forces.insert(forces.end(), {motion.contactForces[i].x(), motion.contactForces[i].y()});
    }
    return state;
}

Motion startOrContinue(const std::filesystem::path& caseDirectory, const DynamicCase& scene, Time& time)
{
    const std::string startName = time.startName();
    const std::filesystem::path file = caseDirectory / startName / "state";
    if (!std::filesystem::exists(file))
    {
        if (time.startValue() != 0 && !std::filesystem::exists(caseDirectory / startName / "motion"))
        {
            throw FatalError(
                fmt::format("There is nothing to start from at time {0}: neither {0}/state, which "
                            "a run writes, nor {0}/motion. Set `startFrom` and `startTime` in "
                            "system/controlDict.",
                            startName));
        }
        DynamicState initial = readInitialMotion(caseDirectory, startName, scene.assembly);
        initial.time = time.startValue();
        return startMotion(scene, std::move(initial));
    }

    const State saved = readState(file);
    TimeState continued;
    continued.value = stateScalar(saved, "time");
    continued.deltaT = stateScalar(saved, "deltaT");
    continued.index = static_cast<long>(stateScalar(saved, "timeIndex"));
    continued.origin = stateScalar(saved, "timeOrigin");
    continued.originIndex = static_cast<long>(stateScalar(saved, "timeOriginIndex"));
    time.resume(continued);

    DynamicState state = stateAtRest(scene.assembly);
    state.time = continued.value;
    const std::size_t blocks = state.placements.size();
    const auto& translation = stateArray(saved, "translation", 2 * blocks);
    const auto& rotation = stateArray(saved, "rotation", blocks);
    for (std::size_t block = 0; block < blocks; ++block)
    {
        state.placements[block] = {{translation[2 * block], translation[2 * block + 1]}, rotation[block]};
    }
    const auto& velocity = stateArray(saved, "velocity", static_cast<std::size_t>(state.velocity.size()));
    state.velocity = Eigen::Map<const Eigen::VectorXd>(velocity.data(), state.velocity.size());

    Motion motion = startMotion(scene, std::move(state));
    visitLedger(motion.energy, [&](const char* name, double& value) { value = stateScalar(saved, name); });
    const auto gapsThere = saved.arrays.find("contactGap");
    const std::size_t points = gapsThere == saved.arrays.end() ? 0 : gapsThere->second.size();
    const auto& gaps = stateArray(saved, "contactGap", points);
    const auto& features = stateArray(saved, "contactFeature", featureNumbers * points);
    const auto& forces = stateArray(saved, "contactForce", 2 * points);
    if (!motion.contacts && motion.points.size() != points)
    {
        throw FatalError(fmt::format("{} has {} contact points, the structure as built {}: with "
                                     "`smallDisplacements yes;` they must be the same. Start from time 0.",
                                     file.string(), points, motion.points.size()));
    }
    motion.points.resize(points);
    motion.contactForces.resize(points);
    for (std::size_t i = 0; i < points; ++i)
    {
        ContactPoint<2>& point = motion.points[i];
        const double* numbers = &features[featureNumbers * i];
        point.block = static_cast<int>(numbers[0]);
        point.neighbour = static_cast<int>(numbers[1]);
        point.feature = {static_cast<int>(numbers[2]), static_cast<int>(numbers[3]),
                         static_cast<int>(numbers[4])};
        point.gap = gaps[i];
        motion.contactForces[i] = {forces[2 * i], forces[2 * i + 1]};
    }
    return motion;
}

MotionResults::MotionResults(std::filesystem::path caseDirectory, const DynamicCase& scene,
                             const Motion& motion, Time& time, FunctionObjects functionObjects)
    : caseDirectory_(std::move(caseDirectory)),
      scene_(scene),
      motion_(motion),
      time_(time),
      functions_(readFunctions(caseDirectory_, scene, time, functionObjects)),
      states_(caseDirectory_, time.controls().writeFormat, time.controls().purgeWrite),
      blocks_(caseDirectory_ / "VTK", "blocks", time.startValue()),
      contacts_(caseDirectory_ / "VTK", "contacts", time.startValue())
{
    requireWritable(caseDirectory_);
    requireWritable(caseDirectory_ / "VTK");
}

void MotionResults::write()
{
    std::vector<BlockVelocity<2>> velocities;
    const std::vector<double> friction = frictionCoefficients(scene_.contact, motion_.points.size());
    functions_.write(observe(scene_, motion_, time_, velocities, friction), time_.point());
    if (time_.isWriteTime())
    {
        writeNow();
    }
}

void MotionResults::writeNow()
{
    states_.write(time_.name(), stateOf(motion_, time_));
    writeFrames();
}

void MotionResults::writeFrames()
{
    std::vector<double> velocities;
    std::vector<double> angular;
    for (const int free : scene_.free)
    {
        const Eigen::Vector3d velocity = free >= 0
                                             ? Eigen::Vector3d(motion_.state.velocity.segment<3>(3 * free))
                                             : Eigen::Vector3d::Zero();
        velocities.insert(velocities.end(), {velocity.x(), velocity.y()});
        angular.push_back(velocity.z());
    }
    blocks_.write(time_.value(), blockFrame(scene_.assembly, motion_.state.placements,
                                            {{"velocity", 2, std::move(velocities)},
                                             {"angularVelocity", 1, std::move(angular)}}));
    const std::vector<double> friction = frictionCoefficients(scene_.contact, motion_.points.size());
    contacts_.write(time_.value(), contactFrame(motion_.points, motion_.contactForces,
                                                contactStates(motion_.contactForces, friction)));
}

void MotionResults::writeFirstFrames()
{
    if (blocks_.times().empty() || blocks_.times().back() < time_.value())
    {
        writeFrames();
    }
}

double MotionResults::timeToNextWrite(double deltaT) const
{
    return functions_.timeToNextWrite(time_.value(), deltaT);
}

} // namespace drystone
