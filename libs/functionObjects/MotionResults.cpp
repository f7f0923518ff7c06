// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Writes and reads the states, frames and tables of a run through time.
#include "functionObjects/MotionResults.h"

#include "conic/ProgramFile.h"
#include "contact/ContactState.h"
#include "core/Log.h"
#include "core/WholeFile.h"
#include "dynamics/InitialMotion.h"
#include "dynamics/StartCheck.h"
#include "functionObjects/KeptResults.h"
#include "io/Frames.h"
#include "runControl/Case.h"

#include <fmt/format.h>

namespace drystone
{
namespace
{

/// The scalars of the ledger with their names in a state.
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
    visit("energyElastic", energy.elastic);
    visit("energyDampingLoss", energy.dampingLoss);
}

/// The solver's residuals of the step that led to a state, likewise.
template<class Residuals, class Visit>
void visitResiduals(Residuals& residuals, const Visit& visit)
{
    visit("solverInitialResidual", residuals.initialResidual);
    visit("solverPrimalResidual", residuals.primalResidual);
    visit("solverDualResidual", residuals.dualResidual);
    visit("solverGap", residuals.gap);
    visit("solverFlowError", residuals.flowError);
    visit("solverIterations", residuals.iterations);
    visit("solverFactorisations", residuals.factorisations);
    visit("solverPrograms", residuals.programs);
    visit("solverRetries", residuals.retries);
}

/// The integers that identify corner and edge of one contact point.
constexpr std::size_t featureNumbers = 5;

FunctionList<2> readFunctions(const std::filesystem::path& caseDirectory, const DynamicCase<2>& scene,
                              Time& time, FunctionObjects functionObjects)
{
    const Dictionary* functions = time.controlDict().findDict("functions");
    if (!functions || functionObjects == FunctionObjects::none)
    {
        return {};
    }
    return {*functions,    caseDirectory, time.startName(), time.point(), time.controls().startTime,
            scene.assembly};
}

/// The time at which a state was written.
TimeState timeOf(const State& saved)
{
    TimeState time;
    time.value = stateScalar(saved, "time");
    time.deltaT = stateScalar(saved, "deltaT");
    time.index = static_cast<long>(stateScalar(saved, "timeIndex"));
    time.origin = stateScalar(saved, "timeOrigin");
    time.originIndex = static_cast<long>(stateScalar(saved, "timeOriginIndex"));
    time.detourEnd = stateScalar(saved, "timeDetourEnd");
    // Older versions did not keep it, and most motions begin at 0.
    time.beginning = saved.scalars.contains("timeBeginning") ? stateScalar(saved, "timeBeginning") : 0;
    return time;
}

/// The motion stored in a state.
Motion<2> motionOf(const DynamicCase<2>& scene, const State& saved)
{
    DynamicState<2> state = stateAtRest(scene.assembly);
    state.time = stateScalar(saved, "time");
    const std::size_t blocks = state.placements.size();
    const auto& translation = stateArray(saved, "translation", 2 * blocks);
    const auto& rotation = stateArray(saved, "rotation", blocks);
    for (std::size_t block = 0; block < blocks; ++block)
    {
        state.placements[block] = {{translation[2 * block], translation[2 * block + 1]}, rotation[block]};
    }
    const auto& velocity = stateArray(saved, "velocity", static_cast<std::size_t>(state.velocity.size()));
    state.velocity = Eigen::Map<const Eigen::VectorXd>(velocity.data(), state.velocity.size());

    Motion<2> motion = startMotion(scene, std::move(state));
    visitLedger(motion.energy, [&](const char* name, double& value) { value = stateScalar(saved, name); });
    visitResiduals(motion.residuals, [&](const char* name, auto& value)
                   { value = static_cast<std::decay_t<decltype(value)>>(stateScalar(saved, name)); });
    const auto gapsThere = saved.arrays.find("contactGap");
    const std::size_t points = gapsThere == saved.arrays.end() ? 0 : gapsThere->second.size();
    const auto& gaps = stateArray(saved, "contactGap", points);
    const auto& features = stateArray(saved, "contactFeature", featureNumbers * points);
    const auto& forces = stateArray(saved, "contactForce", 2 * points);
    if (!motion.contacts && motion.points.size() != points)
    {
        throw FatalError(fmt::format("{} has {} contact points, the structure as built {}: with "
                                     "`smallDisplacements yes;` they must be the same. Start from time 0.",
                                     saved.file.string(), points, motion.points.size()));
    }
    const auto& positions = stateArray(saved, "contactPosition", 2 * points);
    const auto& normals = stateArray(saved, "contactNormal", 2 * points);
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
        point.position = {positions[2 * i], positions[2 * i + 1]};
        point.normal = {normals[2 * i], normals[2 * i + 1]};
        motion.contactForces[i] = {forces[2 * i], forces[2 * i + 1]};
    }
    if (saved.arrays.contains("contactForceMean")) // else the same
    {
        const auto& means = stateArray(saved, "contactForceMean", 2 * points);
        for (std::size_t i = 0; i < points; ++i)
        {
            motion.meanForces.emplace_back(means[2 * i], means[2 * i + 1]);
        }
    }
    if (saved.arrays.contains("interiorForce"))
    {
        const auto vectorOf = [&saved](const char* name, Eigen::Index size)
        {
            const auto& values = stateArray(saved, name, static_cast<std::size_t>(size));
            return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data(), size));
        };
        const auto ofPoints = 2 * static_cast<Eigen::Index>(points);
        motion.interior = {vectorOf("interiorForce", ofPoints), vectorOf("interiorOpening", ofPoints),
                           vectorOf("interiorDisplacement", motion.state.velocity.size())};
    }
    for (std::size_t i = 0; i < scene.effects.size(); ++i)
    {
        scene.effects[i]->restore(saved.arrays, motion.effectStates[i]);
    }
    motion.effectStatesBefore = motion.effectStates;
    return motion;
}

} // namespace

void writePrograms(DynamicCase<2>& scene, const std::filesystem::path& caseDirectory, const Time& time)
{
    scene.solution.observer = programWriter(
        scene.solution.writeProgram, [caseDirectory, &time]
        { return postProcessingFolder(caseDirectory, "contactDynamics", time.name()) / "coneProgram"; });
}

State stateOf(const DynamicCase<2>& scene, const Motion<2>& motion, const Time& time)
{
    State state;
    const TimeState now = time.state();
    state.scalars = {{"time", now.value},
                     {"deltaT", now.deltaT},
                     {"timeIndex", static_cast<double>(now.index)},
                     {"timeOrigin", now.origin},
                     {"timeOriginIndex", static_cast<double>(now.originIndex)},
                     {"timeDetourEnd", now.detourEnd},
                     {"timeBeginning", now.beginning},
                     {"stepLength", time.value() - time.previousValue()}};
    visitResiduals(motion.residuals,
                   [&](const char* name, auto value) { state.scalars[name] = static_cast<double>(value); });
    visitLedger(motion.energy, [&](const char* name, double value) { state.scalars[name] = value; });
    auto& translation = state.arrays["translation"];
    auto& rotation = state.arrays["rotation"];
    for (const Placement<2>& placement : motion.state.placements)
    {
        translation.insert(translation.end(), {placement.translation.x(), placement.translation.y()});
        rotation.push_back(placement.rotation);
    }
    state.arrays["velocity"].assign(motion.state.velocity.begin(), motion.state.velocity.end());
    for (std::size_t i = 0; i < scene.effects.size(); ++i)
    {
        scene.effects[i]->save(motion.effectStates[i], state.arrays);
    }
    auto& features = state.arrays["contactFeature"];
    auto& gaps = state.arrays["contactGap"];
    auto& forces = state.arrays["contactForce"];
    auto& positions = state.arrays["contactPosition"];
    auto& normals = state.arrays["contactNormal"];
    for (std::size_t i = 0; i < motion.points.size(); ++i)
    {
        const ContactPoint<2>& point = motion.points[i];
        for (const int number : {point.block, point.neighbour, point.feature.vertexBlock,
                                 point.feature.vertex, point.feature.edge})
        {
            features.push_back(number);
        }
        gaps.push_back(point.gap);
        positions.insert(positions.end(), {point.position.x(), point.position.y()});
        normals.insert(normals.end(), {point.normal.x(), point.normal.y()});
        forces.insert(forces.end(), {motion.contactForces[i].x(), motion.contactForces[i].y()});
    }
    for (const Vector<2>& mean : motion.meanForces)
    {
        auto& means = state.arrays["contactForceMean"];
        means.insert(means.end(), {mean.x(), mean.y()});
    }
    if (const InteriorStart& interior = motion.interior; !interior.isEmpty())
    {
        state.arrays["interiorForce"].assign(interior.contactForce.begin(), interior.contactForce.end());
        state.arrays["interiorOpening"].assign(interior.opening.begin(), interior.opening.end());
        state.arrays["interiorDisplacement"].assign(interior.displacement.begin(),
                                                    interior.displacement.end());
    }
    return state;
}

Motion<2> startOrContinue(const std::filesystem::path& caseDirectory, const DynamicCase<2>& scene, Time& time)
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
        auto [initial, places] = readInitialMotion(caseDirectory, startName, scene.assembly);
        initial.time = time.startValue();
        if (!scene.schemes.smallDisplacements) // whose geometry is the one as built
        {
            refuseStartOverlaps(scene.assembly, initial.placements, places);
        }
        return startMotion(scene, std::move(initial));
    }

    const State saved = readState(file);
    time.resume(timeOf(saved));
    compareWithInput(saved, inputOfMotion(caseDirectory, scene, time), time);
    return motionOf(scene, saved);
}

void postProcess(const std::filesystem::path& caseDirectory, const DynamicCase<2>& scene, const Time& time)
{
    std::vector<std::pair<std::string, State>> states;
    for (const TimeDirectory& directory : timeDirectories(caseDirectory))
    {
        const std::filesystem::path file = caseDirectory / directory.name / "state";
        if (std::filesystem::exists(file))
        {
            states.emplace_back(directory.name, readState(file));
        }
    }
    if (states.empty())
    {
        throw FatalError("There are no results to process: no time directory of this case has a state. Run "
                         "contactDynamics without -postProcess first.");
    }
    compareWithInput(states, inputOfMotion(caseDirectory, scene, time));
    const Dictionary functions =
        time.controlDict().found("functions") ? time.controlDict().subDict("functions") : Dictionary();
    FunctionList<2> list(functions, caseDirectory, states.front().first, {}, 0, scene.assembly);
    ObservedLists<2> lists;
    for (const auto& [name, saved] : states)
    {
        info("Time = {}", name);
        const Motion<2> motion = motionOf(scene, saved);
        StepObservation<2> seen = observe(scene, motion, time, lists);
        const TimeState then = timeOf(saved);
        seen.time = then.value;
        seen.timeStep = stateScalar(saved, "stepLength");
        seen.step = then.index;
        seen.stageTimes.reset();
        list.writeAlways(seen);
    }
}

MotionResults::MotionResults(std::filesystem::path directory, const DynamicCase<2>& dynamicCase,
                             const Motion<2>& currentMotion, Time& runTime, FunctionObjects functionObjects)
    : caseDirectory(std::move(directory)),
      scene(dynamicCase),
      motion(currentMotion),
      time(runTime),
      functionList(readFunctions(caseDirectory, scene, time, functionObjects)),
      input(inputOfMotion(caseDirectory, scene, time)),
      states(caseDirectory, time.controls().writeFormat, time.controls().purgeWrite),
      blocks(caseDirectory / "VTK", "blocks", time.startValue()),
      contacts(caseDirectory / "VTK", "contacts", time.startValue())
{
    requireWritable(caseDirectory);
    requireWritable(caseDirectory / "VTK");
    time.stopAlsoAt([this](double value, double deltaT)
                    { return functionList.timeToNextWrite(value, deltaT); });
}

void MotionResults::write()
{
    ObservedLists<2> lists;
    functionList.write(observe(scene, motion, time, lists), time.point());
    if (time.isWriteTime())
    {
        writeNow();
    }
}

void MotionResults::writeNow()
{
    State state = stateOf(scene, motion, time);
    input.back() = inputOfSteps(time); // controlDict may have been read again
    state.texts[inputInState] = textsOf(input);
    states.write(time.name(), state);
    writeFrames();
}

void MotionResults::writeFrames()
{
    std::vector<double> velocities;
    std::vector<double> angular;
    for (const int free : scene.free)
    {
        const Eigen::Vector3d velocity =
            free >= 0 ? Eigen::Vector3d(motion.state.velocity.segment<3>(3 * free)) : Eigen::Vector3d::Zero();
        velocities.insert(velocities.end(), {velocity.x(), velocity.y()});
        angular.push_back(velocity.z());
    }
    std::vector<Field> fields{{"velocity", 2, std::move(velocities)},
                              {"angularVelocity", 1, std::move(angular)}};
    for (std::size_t i = 0; i < scene.effects.size(); ++i)
    {
        for (EffectField& field : scene.effects[i]->blockFields(motion.effectStates[i]))
        {
            fields.push_back({std::move(field.name), 1, std::move(field.values)});
        }
    }
    blocks.write(time.value(), blockFrame(scene.assembly, motion.state.placements, std::move(fields)));
    const std::vector<double> friction = frictionAt(scene, motion.points);
    const std::vector<Vector<2>>& forces = meanContactForces(motion);
    std::vector<double> cohesion;
    std::vector<Field> pointFields;
    if (traitsOf(scene.effects).holdsJoints)
    {
        Field isHeld{"bonded", 1, {}, FieldType::integer};
        for (const Strength& strength : strengthsOf(scene, motion))
        {
            cohesion.push_back(strength.cohesion);
            isHeld.values.push_back(strength.cohesion > 0 || strength.tension > 0);
        }
        pointFields.push_back(std::move(isHeld));
    }
    contacts.write(time.value(),
                   contactFrame(motion.points, forces, contactStates(forces, friction, cohesion),
                                std::move(pointFields)));
}

void MotionResults::writeFirstFrames()
{
    if (blocks.times().empty() || blocks.times().back() < time.value())
    {
        writeFrames();
    }
}

} // namespace drystone
