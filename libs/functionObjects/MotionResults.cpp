// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where a run begins, and the states, frames and tables that it writes.
#include "functionObjects/MotionResults.h"

#include "conic/ProgramFile.h"
#include "contact/ContactState.h"
#include "core/Log.h"
#include "core/WholeFile.h"
#include "dynamics/Advance.h"
#include "dynamics/InitialMotion.h"
#include "dynamics/StartCheck.h"
#include "functionObjects/KeptResults.h"
#include "functionObjects/MotionState.h"
#include "io/Frames.h"
#include "io/ParaViewState.h"
#include "runControl/Case.h"
#include "runControl/CaseFiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace drystone
{
namespace
{

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

/// The last step ends within half a step of endTime; so there may be none, or the run may end elsewhere.
void questionSteps(const Time& time)
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
        return;
    }
    const double length = controls.endTime - time.value();
    const double last = std::ceil(length / step - 0.5) * step;
    constexpr double noticeable = 0.01;
    if (controls.stopAt == StopAt::endTime && !controls.adjustTimeStep
        && std::abs(last - length) > noticeable * length)
    {
        printWarning(
            fmt::format("The run ends at {:g} s, and not at endTime {:g} s: steps of deltaT {:g} s do not "
                        "divide the time from {:g} s. Give a deltaT that does, such as {:g}, or write "
                        "`adjustTimeStep yes;`.",
                        time.value() + last, controls.endTime, step, time.value(),
                        length / std::ceil(length / step)),
            time.controlDict().locationOf("deltaT"));
    }
}

/// Whether a run has taken steps, up to its end time.
bool hasEnded(const Time& time)
{
    return time.value() > time.startValue() && time.exitStatus() == 0
           && time.controls().stopAt == StopAt::endTime;
}

/// A directory that was renamed, or copied to begin another motion from the end of this one.
void refuseOtherTime(const TimeState& saved, const Time& time, const std::filesystem::path& file)
{
    if (std::abs(saved.value - time.startValue()) > 0.5 * std::max(saved.deltaT, saved.stepLength))
    {
        throw FatalIOError(
            fmt::format(
                "The directory {} has the state of time {:g}: it was renamed. Give it the name {} again, to "
                "continue that motion. To begin another with these places, write them to {}/motion and "
                "remove the state.",
                time.startName(), saved.value, time.nameOf(saved.value), time.startName()),
            {file.string(), "", 1});
    }
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
Motion<Dim> startOrContinue(const std::filesystem::path& caseDirectory, const DynamicCase<Dim>& scene,
                            Time& time)
{
    questionDigits(scene);
    questionMasses(scene);
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
        questionSpeeds(scene.assembly, start, time.controls());
        auto& [initial, places] = start;
        initial.time = time.startValue();
        if (!scene.schemes.smallDisplacements) // whose geometry is the one as built
        {
            refuseStartOverlaps(scene.assembly, initial.placements, places,
                                traitsOf(scene.effects).isCompliant ? JointStiffness::elastic
                                                                    : JointStiffness::rigid);
        }
        questionSteps(time);
        return startMotion(scene, std::move(initial));
    }

    const State saved = readState(file);
    const TimeState then = timeOf(saved);
    refuseOtherTime(then, time, file);
    time.resume(then);
    compareWithInput(saved, inputOfMotion(caseDirectory, scene.assembly, time, time.beginningName()), time);
    Motion<Dim> motion = motionOf(scene, saved);
    if (saved.isEdited)
    {
        refuseEditedPlaces(scene, motion.state.placements, {file.string(), "translation", 1});
    }
    return motion;
}

template<int Dim>
void chooseFirstTimeStep(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, Time& time)
{
    if (time.controls().adjustTimeStep)
    {
        chooseTimeStep(scene, motion, time.wantedDeltaT(), time);
    }
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
      input(inputOfMotion(caseDirectory, scene.assembly, time, time.beginningName())),
      states(caseDirectory, time.controls().writeFormat, time.controls().purgeWrite),
      blocks(caseDirectory / "VTK", "blocks", time.startValue(), "contactDynamics"),
      contacts(caseDirectory / "VTK", "contacts", time.startValue(), "contactDynamics")
{
    if (scene.schemes.effects.selection == EffectSelection::automatic
        && functionObjects == FunctionObjects::asInControlDict)
    {
        effects.emplace(scene);
    }
    if (time.controls().stopAt == StopAt::endTime)
    {
        functionList.questionTimes(time.controls().endTime, time.controls().deltaT);
    }
    if (time.startName() == time.beginningName())
    {
        functionList.questionTimesBeforeMotion();
    }
    time.stopAlsoAt([this](double value, double deltaT)
                    { return functionList.timeToNextWrite(value, deltaT); });
    chooseFirstTimeStep(scene, motion, time);
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
        [this, name = time.name(), state = std::move(state), frames = framesNow(), history = effects]
        {
            if (history && !history->isEmpty()) // first: a run that goes on from the state does not repeat it
            {
                history->writeTable(effectsFolder());
            }
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
    const double now = motion.state.time;
    for (const BlockVector<Dim>& velocity : velocitiesOfAllBlocks(scene, motion.state, now, now))
    {
        velocities.insert(velocities.end(), velocity.begin(), velocity.begin() + Dim);
        angular.insert(angular.end(), velocity.begin() + Dim, velocity.end());
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
    const std::vector<double> friction = frictionAt(scene, motion);
    const std::vector<Vector<Dim>>& forces = meanContactForces(motion);
    std::vector<double> cohesion;
    std::vector<Field> pointFields;
    if (traitsOf(scene.effects).holdsJoints)
    {
        Field isHeld{"bonded", 1, {}, FieldType::integer};
        for (const Strength& strength : strengthsOf(scene, motion))
        {
            cohesion.push_back(strength.cohesion);
            isHeld.values.push_back(strength.isBond());
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
    removeLeftovers(caseDirectory);
    removeLeftovers(caseDirectory / "VTK");
    hasState = writeParaViewState(caseDirectory); // so that a motion can be watched while it is computed
    blocks.begin();
    contacts.begin();
    const bool hasBlocks = blocks.hasFrameAt(time.value());
    const bool hasContacts = contacts.hasFrameAt(time.value());
    if (hasBlocks && hasContacts)
    {
        return;
    }
    writing.start( // a run that was killed may have written one of the two
        [this, hasBlocks, hasContacts, frames = framesNow()]
        {
            if (!hasBlocks)
            {
                blocks.write(frames.time, frames.blocks);
            }
            if (!hasContacts)
            {
                contacts.write(frames.time, frames.contacts);
            }
        });
}

template<int Dim>
std::filesystem::path MotionResults<Dim>::effectsFolder() const
{
    return postProcessingFolder(caseDirectory, "effects", time.startName());
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
    else if (statesWritten.empty() && hasEnded(time))
    {
        info("Wrote no state, from which a run could continue: the end {} s is before the first write of "
             "writeControl and writeInterval",
             time.name());
    }
    functionList.writePictures();
    if (effects && !effects->isEmpty())
    {
        const std::filesystem::path folder = effectsFolder();
        effects->writeTable(folder);
        effects->writePicture(folder, caseName(caseDirectory), time.controls().pictureFormats);
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
    if (hasEnded(time))
    {
        functionList.questionUnwritten(time.value());
    }
}

template Motion<2> startOrContinue(const std::filesystem::path& caseDirectory, const DynamicCase<2>& scene,
                                   Time& time);
template void chooseFirstTimeStep(const DynamicCase<2>& scene, const Motion<2>& motion, Time& time);
template void writePrograms(DynamicCase<2>& scene, const std::filesystem::path& caseDirectory,
                            const Time& time);
template class MotionResults<2>;
template Motion<3> startOrContinue(const std::filesystem::path& caseDirectory, const DynamicCase<3>& scene,
                                   Time& time);
template void chooseFirstTimeStep(const DynamicCase<3>& scene, const Motion<3>& motion, Time& time);
template void writePrograms(DynamicCase<3>& scene, const std::filesystem::path& caseDirectory,
                            const Time& time);
template class MotionResults<3>;

} // namespace drystone
