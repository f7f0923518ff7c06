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
#include "io/ParaViewState.h"
#include "runControl/Case.h"
#include "runControl/CaseFiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

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

/// The vector with this index in a list of them.
template<int Size>
Eigen::Matrix<double, Size, 1> vectorAt(const std::vector<double>& values, std::size_t index)
{
    return Eigen::Map<const Eigen::Matrix<double, Size, 1>>(&values[Size * index]);
}

template<class Derived>
void append(std::vector<double>& values, const Eigen::MatrixBase<Derived>& vector)
{
    values.insert(values.end(), vector.derived().begin(), vector.derived().end());
}

/// The integers that identify corner and edge of one contact point.
constexpr std::size_t featureNumbers = 5;

template<int Dim>
FunctionList<Dim> readFunctions(const std::filesystem::path& caseDirectory, const DynamicCase<Dim>& scene,
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
template<int Dim>
Motion<Dim> motionOf(const DynamicCase<Dim>& scene, const State& saved)
{
    DynamicState<Dim> state = stateAtRest(scene.assembly);
    state.time = stateScalar(saved, "time");
    const std::size_t blocks = state.placements.size();
    const auto& translation = stateArray(saved, "translation", Dim * blocks);
    const auto& rotation = stateArray(saved, "rotation", rotationCount<Dim> * blocks);
    for (std::size_t block = 0; block < blocks; ++block)
    {
        state.placements[block] = {vectorAt<Dim>(translation, block),
                                   turnOf<Dim>(vectorAt<rotationCount<Dim>>(rotation, block))};
    }
    const auto& velocity = stateArray(saved, "velocity", static_cast<std::size_t>(state.velocity.size()));
    state.velocity = Eigen::Map<const Eigen::VectorXd>(velocity.data(), state.velocity.size());

    Motion<Dim> motion = startMotion(scene, std::move(state));
    visitLedger(motion.energy, [&](const char* name, double& value) { value = stateScalar(saved, name); });
    visitResiduals(motion.residuals, [&](const char* name, auto& value)
                   { value = static_cast<std::decay_t<decltype(value)>>(stateScalar(saved, name)); });
    const auto gapsThere = saved.arrays.find("contactGap");
    const std::size_t points = gapsThere == saved.arrays.end() ? 0 : gapsThere->second.size();
    const auto& gaps = stateArray(saved, "contactGap", points);
    const auto& features = stateArray(saved, "contactFeature", featureNumbers * points);
    const auto& forces = stateArray(saved, "contactForce", Dim * points);
    if (!motion.contacts && motion.points.size() != points)
    {
        throw FatalError(fmt::format("{} has {} contact points, the structure as built {}: with "
                                     "`smallDisplacements yes;` they must be the same. Start from time 0.",
                                     saved.file.string(), points, motion.points.size()));
    }
    const auto& positions = stateArray(saved, "contactPosition", Dim * points);
    const auto& normals = stateArray(saved, "contactNormal", Dim * points);
    motion.points.resize(points);
    motion.contactForces.resize(points);
    for (std::size_t i = 0; i < points; ++i)
    {
        ContactPoint<Dim>& point = motion.points[i];
        const double* numbers = &features[featureNumbers * i];
        point.block = static_cast<int>(numbers[0]);
        point.neighbour = static_cast<int>(numbers[1]);
        point.feature = {static_cast<int>(numbers[2]), static_cast<int>(numbers[3]),
                         static_cast<int>(numbers[4])};
        point.gap = gaps[i];
        point.position = vectorAt<Dim>(positions, i);
        point.normal = vectorAt<Dim>(normals, i);
        motion.contactForces[i] = vectorAt<Dim>(forces, i);
    }
    if (saved.arrays.contains("contactForceMean")) // else the same
    {
        const auto& means = stateArray(saved, "contactForceMean", Dim * points);
        for (std::size_t i = 0; i < points; ++i)
        {
            motion.meanForces.push_back(vectorAt<Dim>(means, i));
        }
    }
    if (saved.arrays.contains("interiorForce"))
    {
        const auto vectorOf = [&saved](const char* name, Eigen::Index size)
        {
            const auto& values = stateArray(saved, name, static_cast<std::size_t>(size));
            return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data(), size));
        };
        const auto ofPoints = Dim * static_cast<Eigen::Index>(points);
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

template<int Dim>
void writePrograms(DynamicCase<Dim>& scene, const std::filesystem::path& caseDirectory, const Time& time)
{
    scene.solution.observer = programWriter(
        scene.solution.writeProgram, [caseDirectory, &time]
        { return postProcessingFolder(caseDirectory, "contactDynamics", time.name()) / "coneProgram"; });
}

template<int Dim>
State stateOf(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time)
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
    for (const Placement<Dim>& placement : motion.state.placements)
    {
        append(translation, placement.translation);
        append(rotation, rowsOf(placement.rotation));
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
        const ContactPoint<Dim>& point = motion.points[i];
        for (const int number : {point.block, point.neighbour, point.feature.vertexBlock,
                                 point.feature.vertex, point.feature.edge})
        {
            features.push_back(number);
        }
        gaps.push_back(point.gap);
        append(positions, point.position);
        append(normals, point.normal);
        append(forces, motion.contactForces[i]);
    }
    for (const Vector<Dim>& mean : motion.meanForces)
    {
        append(state.arrays["contactForceMean"], mean);
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

namespace
{

/// The last step ends within half a step of endTime; so there may be none.
void warnWithoutSteps(const Time& time)
{
    const TimeControls& controls = time.controls();
    const double step = std::min(time.deltaT(), controls.deltaT);
    if (controls.stopAt == StopAt::endTime && time.value() >= controls.endTime - 0.5 * step)
    {
        printWarning(
            fmt::format("No step is computed: from {:g} s to endTime {:g} s is at most half of deltaT {:g} "
                        "s. Give a shorter deltaT or a later endTime.",
                        time.value(), controls.endTime, step),
            time.controlDict().locationOf("deltaT"));
    }
}

} // namespace

template<int Dim>
Motion<Dim> startOrContinue(const std::filesystem::path& caseDirectory, const DynamicCase<Dim>& scene,
                            Time& time)
{
    const std::string startName = time.startName();
    const std::filesystem::path file = caseDirectory / startName / "state";
    if (!std::filesystem::exists(file))
    {
        if (time.startValue() != 0 && !std::filesystem::exists(caseDirectory / startName / "motion"))
        {
            const bool isGiven = !std::filesystem::exists(caseDirectory / startName)
                                 || time.controls().startFrom == StartFrom::startTime;
            throw FatalIOError(
                fmt::format("There is nothing to start from at time {0}: neither {0}/state, which "
                            "a run writes, nor {0}/motion.\n\n{1}",
                            startName,
                            isGiven ? "Give the startTime of a time directory, or write `startFrom "
                                      "latestTime;`."
                                    : fmt::format("Remove the directory {}, or write `startFrom startTime;` "
                                                  "with the startTime of another.",
                                                  startName)),
                time.controlDict().locationOf(isGiven ? "startTime" : "startFrom"));
        }
        InitialState<Dim> start = readInitialMotion(caseDirectory, startName, scene.assembly);
        questionSpeeds(scene.assembly, start, time.controls().deltaT);
        auto& [initial, places] = start;
        initial.time = time.startValue();
        if (!scene.schemes.smallDisplacements) // whose geometry is the one as built
        {
            refuseStartOverlaps(scene.assembly, initial.placements, places);
        }
        warnWithoutSteps(time);
        return startMotion(scene, std::move(initial));
    }

    const State saved = readState(file);
    time.resume(timeOf(saved));
    compareWithInput(saved, inputOfMotion(caseDirectory, scene.assembly, time), time);
    return motionOf(scene, saved);
}

template<int Dim>
void postProcess(const std::filesystem::path& caseDirectory, const DynamicCase<Dim>& scene, const Time& time)
{
    std::vector<std::pair<std::string, State>> states;
    for (const std::string& name : timesOfStates(caseDirectory))
    {
        states.emplace_back(name, readState(caseDirectory / name / "state"));
    }
    if (states.empty())
    {
        throw FatalError("There are no results to process: no time directory of this case has a state. Run "
                         "contactDynamics without -postProcess first.");
    }
    compareWithInput(states, inputOfMotion(caseDirectory, scene.assembly, time));
    const Dictionary functions =
        time.controlDict().found("functions") ? time.controlDict().subDict("functions") : Dictionary();
    FunctionList<Dim> list(functions, caseDirectory, states.front().first, {}, 0, scene.assembly);
    ObservedLists<Dim> lists;
    for (const auto& [name, saved] : states)
    {
        info("Time = {}", name);
        const Motion<Dim> motion = motionOf(scene, saved);
        StepObservation<Dim> seen = observe(scene, motion, time, lists);
        const TimeState then = timeOf(saved);
        seen.time = then.value;
        seen.timeStep = stateScalar(saved, "stepLength");
        seen.step = then.index;
        seen.stageTimes.reset();
        list.writeAlways(seen);
    }
    list.writePictures();
}

template<int Dim>
MotionResults<Dim>::MotionResults(std::filesystem::path directory, const DynamicCase<Dim>& dynamicCase,
                                  const Motion<Dim>& currentMotion, Time& runTime,
                                  FunctionObjects functionObjects)
    : caseDirectory(std::move(directory)),
      scene(dynamicCase),
      motion(currentMotion),
      time(runTime),
      functionList(readFunctions(caseDirectory, scene, time, functionObjects)),
      input(inputOfMotion(caseDirectory, scene.assembly, time)),
      states(caseDirectory, time.controls().writeFormat, time.controls().purgeWrite),
      blocks(caseDirectory / "VTK", "blocks", time.startValue()),
      contacts(caseDirectory / "VTK", "contacts", time.startValue())
{
    if (scene.schemes.effects.selection == EffectSelection::automatic
        && functionObjects == FunctionObjects::asInControlDict)
    {
        effects.emplace(scene);
    }
    time.stopAlsoAt([this](double value, double deltaT)
                    { return functionList.timeToNextWrite(value, deltaT); });
}

template<int Dim>
void MotionResults<Dim>::write()
{
    ObservedLists<Dim> lists;
    functionList.write(observe(scene, motion, time, lists), time.point());
    if (effects)
    {
        effects->observe(motion);
    }
    if (time.isWriteTime())
    {
        writeNow();
    }
}

template<int Dim>
void MotionResults<Dim>::writeNow()
{
    State state = stateOf(scene, motion, time);
    input.back() = inputOfSteps(time); // controlDict may have been read again
    state.texts[inputInState] = textsOf(input);
    statesWritten.push_back(time.name());
    writing.start(
        [this, name = time.name(), state = std::move(state), frames = framesNow()]
        {
            states.write(name, state);
            write(frames);
        });
}

template<int Dim>
void MotionResults<Dim>::write(const Frames& frames)
{
    blocks.write(frames.time, frames.blocks);
    contacts.write(frames.time, frames.contacts);
}

template<int Dim>
typename MotionResults<Dim>::Frames MotionResults<Dim>::framesNow() const
{
    std::vector<double> velocities;
    std::vector<double> angular;
    for (const int free : scene.free)
    {
        BlockVector<Dim> velocity = BlockVector<Dim>::Zero();
        if (free >= 0)
        {
            velocity = motion.state.velocity.template segment<freedomCount<Dim>>(freedomCount<Dim> * free);
        }
        append(velocities, velocity.template head<Dim>());
        append(angular, velocity.template tail<rotationCount<Dim>>());
    }
    std::vector<Field> fields{{"velocity[m/s]", Dim, std::move(velocities)},
                              {"angularVelocity[rad/s]", rotationCount<Dim>, std::move(angular)}};
    for (std::size_t i = 0; i < scene.effects.size(); ++i)
    {
        for (EffectField& field : scene.effects[i]->blockFields(motion.effectStates[i]))
        {
            fields.push_back({std::move(field.name), 1, std::move(field.values)});
        }
    }
    if (scene.schemes.effects.selection == EffectSelection::automatic)
    {
        Field isAwake{"awake", 1, {motion.isAwake.begin(), motion.isAwake.end()}, FieldType::integer};
        for (std::size_t block = isAwake.values.size(); block < scene.free.size(); ++block)
        {
            isAwake.values.push_back(scene.free[block] >= 0); // all that are free
        }
        fields.push_back(std::move(isAwake));
        Field bodies{"body", 1, {motion.bodies.begin(), motion.bodies.end()}, FieldType::integer};
        for (std::size_t block = bodies.values.size(); block < scene.free.size(); ++block)
        {
            bodies.values.push_back(scene.free[block]); // each its own
        }
        fields.push_back(std::move(bodies));
    }
    PolyData<Dim> ofBlocks = blockFrame(scene.assembly, motion.state.placements, std::move(fields));
    const std::vector<double> friction = frictionAt(scene, motion.points);
    const std::vector<Vector<Dim>>& forces = meanContactForces(motion);
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
    PolyData<Dim> ofContacts = contactFrame(motion.points, forces, contactStates(forces, friction, cohesion),
                                            std::move(pointFields));
    return {time.value(), std::move(ofBlocks), std::move(ofContacts)};
}

template<int Dim>
void MotionResults<Dim>::finish()
{
    writing.finish();
}

template<int Dim>
void MotionResults<Dim>::writeFirstFrames()
{
    requireWritable(caseDirectory);
    requireWritable(caseDirectory / "VTK");
    hasState = writeParaViewState(caseDirectory); // so that a motion can be watched while it is computed
    if (blocks.times().empty() || blocks.times().back() < time.value())
    {
        writing.start([this, frames = framesNow()] { write(frames); });
    }
}

template<int Dim>
void MotionResults<Dim>::printWritten() const
{
    std::vector<std::string> kept; // purgeWrite may have removed the others
    std::copy_if(statesWritten.begin(), statesWritten.end(), std::back_inserter(kept),
                 [this](const std::string& name) { return std::filesystem::exists(caseDirectory / name); });
    if (!kept.empty())
    {
        info("Wrote {}; `startFrom latestTime;` continues from the last",
             kept.size() == 1 ? "the state of time " + kept.front()
                              : fmt::format("{} states, {} to {}", kept.size(), kept.front(), kept.back()));
    }
    functionList.writePictures();
    const std::filesystem::path folder = postProcessingFolder(caseDirectory, "effects", time.startName());
    if (effects && effects->write(folder, caseName(caseDirectory), time.controls().pictureFormats))
    {
        info("Wrote {}: what the steps called for, over time, as table and picture",
             folder.lexically_normal().string());
    }
    info("Wrote {}: blocks and contacts, {} frames; .vtp.series opens in ParaView{}",
         (caseDirectory / "VTK").lexically_normal().string(), blocks.times().size(),
         hasState ? ", paraviewState.py (Load State) shows all of it" : "");
    if (const std::vector<std::string> names = functionList.writtenNames(); !names.empty())
    {
        info("Wrote {}: {}", (caseDirectory / "postProcessing").lexically_normal().string(),
             fmt::join(names, " "));
    }
    printLine();
}

template Motion<2> startOrContinue(const std::filesystem::path& caseDirectory, const DynamicCase<2>& scene,
                                   Time& time);
template State stateOf(const DynamicCase<2>& scene, const Motion<2>& motion, const Time& time);
template void postProcess(const std::filesystem::path& caseDirectory, const DynamicCase<2>& scene,
                          const Time& time);
template void writePrograms(DynamicCase<2>& scene, const std::filesystem::path& caseDirectory,
                            const Time& time);
template class MotionResults<2>;
template Motion<3> startOrContinue(const std::filesystem::path& caseDirectory, const DynamicCase<3>& scene,
                                   Time& time);
template State stateOf(const DynamicCase<3>& scene, const Motion<3>& motion, const Time& time);
template void postProcess(const std::filesystem::path& caseDirectory, const DynamicCase<3>& scene,
                          const Time& time);
template void writePrograms(DynamicCase<3>& scene, const std::filesystem::path& caseDirectory,
                            const Time& time);
template class MotionResults<3>;

} // namespace drystone
