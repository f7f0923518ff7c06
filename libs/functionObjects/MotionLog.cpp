// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Words the log of contactDynamics.
#include "functionObjects/MotionLog.h"

#include "conic/MachineText.h"
#include "contact/JointClosure.h"
#include "core/Log.h"
#include "dynamics/EffectCalls.h"
#include "dynamics/HeldBlocks.h"
#include "dynamics/Step.h"
#include "dynamics/StickingStep.h"
#include "geometry/space/PolyhedronOverlap.h"

#include <algorithm>
#include <cstdio>

namespace drystone
{
namespace
{

/// How blocks of space that are not convex are searched for contacts, and which are not.
void printContactSearch(const Assembly<3>& assembly, const Motion<3>& motion)
{
    int parted = 0;
    std::size_t parts = 0;
    int followed = 0;
    for (int block = 0; motion.contacts && block < static_cast<int>(assembly.blocks.size()); ++block)
    {
        const std::size_t own = motion.contacts->parts(block);
        parted += own > 1;
        parts += own > 1 ? own : 0;
        followed += own == 0;
    }
    if (parted > 0)
    {
        info("Contacts: {} blocks that are not convex are searched as {} convex parts", parted, parts);
    }
    if (followed > 0)
    {
        info("Contacts: {} blocks of too many convex parts have those of the start, and find no new ones",
             followed);
    }
}

} // namespace

template<int Dim>
void printAddedEffects(const DynamicCase<Dim>& scene)
{
    if (scene.schemes.effects.selection == EffectSelection::everything)
    {
        info("Effects: everything on{}",
             scene.addedEffects.empty()
                 ? ""
                 : fmt::format(", also what the case leaves out: {}", fmt::join(scene.addedEffects, ", ")));
    }
}

template<int Dim>
void printScene(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time,
                const std::vector<std::string>& functions)
{
    auto [simulated, absent] = scene.effectNames;
    (scene.schemes.smallDisplacements ? absent : simulated).emplace_back("largeDisplacements");
    printEffects(simulated, absent);
    printAddedEffects(scene);
    info("Blocks: {} free, contact points: {}", scene.mass.size() / freedomCount<Dim>, motion.points.size());
    if constexpr (Dim == 3)
    {
        printContactSearch(scene.assembly, motion);
    }
    printClosure(scene.assembly);
    if (const std::string text = frictionText(scene.contact); !text.empty())
    {
        info("{}", text);
    }
    for (std::size_t i = 0; i < scene.effects.size(); ++i)
    {
        if (const std::string text = scene.effects[i]->startText(scene, motion.effectStates[i]);
            !text.empty())
        {
            info("{}", text);
        }
    }
    info("Time integration: theta {:g}, deltaT {:g} s, from {} s to {:g} s",
         scene.schemes.timeIntegration.theta, time.deltaT(), time.startName(), time.controls().endTime);
    info("Solver: {}, tolerance {:g}", nameOf(scene.solution.solver), scene.solution.tolerance);
    printLine(machineText());
    if (!functions.empty())
    {
        std::string names;
        for (const std::string& name : functions)
        {
            names += " " + name;
        }
        info("Functions:{}", names);
    }
    printLine();
}

void printUnappliedLoad(const std::filesystem::path& caseDirectory)
{
    if (Dictionary::readFileIfPresent(caseDirectory / "constant/loads").found("live"))
    {
        printLine("Loads: live of constant/loads is not applied in motion; limitAnalysis multiplies it.");
    }
}

namespace
{

/// What happened in the step apart from its solution, a line each; mostly nothing.
template<int Dim>
std::vector<std::string> eventsOf(const DynamicCase<Dim>& scene, const Motion<Dim>& motion)
{
    const StepResiduals& residuals = motion.residuals;
    std::vector<std::string> events;
    if (missesFlow(scene, residuals.flowError))
    {
        events.push_back(fmt::format("Coulomb's law is satisfied to {:.2g} m of dilatancy after {} programs",
                                     residuals.flowError, residuals.programs));
    }
    if (overlooksContacts(scene, residuals.overlookedDepth))
    {
        events.push_back(fmt::format("Blocks are in each other by {:.2g} m where no contact was foreseen",
                                     residuals.overlookedDepth));
    }
    for (std::size_t i = 0; i < scene.effects.size(); ++i)
    {
        std::string text = scene.effects[i]->stepText(motion.effectStatesBefore[i], motion.effectStates[i]);
        if (!text.empty())
        {
            events.push_back(std::move(text));
        }
    }
    constexpr double shown = 0.9995; // with less of a difference three digits show none
    if (motion.restitutionShare < shown)
    {
        events.push_back(fmt::format(
            "Restitution: {:.3g} instead of {:g} in an impact, where friction and more would create energy",
            motion.restitutionShare * scene.restitution(), scene.restitution()));
    }
    if (residuals.isWithoutRebounds)
    {
        events.push_back("Blocks that hit each other stay together: impacts one after the other had no end");
    }
    if (residuals.retries > 0)
    {
        events.push_back(
            fmt::format("The step was shortened {} to be solved",
                        residuals.retries == 1 ? "once" : fmt::format("{} times", residuals.retries)));
    }
    return events;
}

} // namespace

template<int Dim>
void printStep(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time)
{
    const std::vector<std::string> events = eventsOf(scene, motion);
    if (!time.isLogTime() && events.empty())
    {
        return;
    }
    if (!time.isLogTime())
    {
        printLine("Time = " + time.name()); // of a step in turn it is printed when the step begins
    }
    const StepResiduals& residuals = motion.residuals;
    info("{}:  Solving for contact, Initial residual = {:.6g}, Final residual = {:.6g}, No Iterations {}",
         nameOf(scene.solution.solver), residuals.initialResidual, residuals.worst(), residuals.iterations);
    if (scene.schemes.effects.selection == EffectSelection::automatic)
    {
        const long awake = awakeBlocks(motion);
        const long bodies = simulatedBodies(motion);
        info("Effects: on for {} of {} blocks{}", awake, scene.mass.size() / freedomCount<Dim>,
             bodies < awake ? fmt::format(", which move as {} bod{}", bodies, bodies == 1 ? "y" : "ies")
                            : "");
    }
    for (const std::string& event : events)
    {
        printLine(event);
    }
    printExecutionTime();
}

void printWhereRunBegan(const Time& time)
{
    if (time.startName() != time.beginningName() && time.value() > time.startValue())
    {
        info(
            "This run went on from {} s: what follows is of its own steps. Tables of those before are in the "
            "folders of earlier times in postProcessing.\n",
            time.startName());
    }
}

template<int Dim>
void printSummary(const MotionSummary<Dim>& summary, const Motion<Dim>& motion)
{
    for (const std::string& line : summary.lines(motion.state))
    {
        printLine(line);
    }
    printLine();
    if (const std::string doubt = summary.doubtAboutDisplacements(); !doubt.empty())
    {
        printWarning(doubt);
    }
}

template<int Dim>
void printIntegrationError(const DynamicCase<Dim>& scene, const Motion<Dim>& motion, const Time& time)
{
    if (time.value() == time.startValue()) // no step was due
    {
        return;
    }
    const double theta = scene.schemes.timeIntegration.theta;
    // What rounding moves a structure that stands still by says nothing: the energy of a fall by as little.
    constexpr double rounding = 1e-12;
    const double fall = rounding * scene.blockSize * scene.deadLoad.rows.template lpNorm<1>();
    if (theta > 0.5 && motion.largestKinetic > fall)
    {
        info("Estimated error of the time integration: theta {:g} has dissipated {:.3g} J outside impacts, "
             "{:.2g}% of the largest kinetic energy. It is proportional to the steps{}{}\n",
             theta, motion.smoothLoss, 100 * motion.smoothLoss / motion.largestKinetic,
             time.controls().adjustTimeStep ? ", which adjustTimeStep chooses up to maxDeltaT" : "",
             traitsOf(scene.effects).isCompliant ? "." : "; theta 0.5 is of second order.");
    }
    constexpr double noticeable = 0.01;
    if (traitsOf(scene.effects).isCompliant && motion.created > noticeable * motion.largestKinetic + fall)
    {
        printWarning(fmt::format("Elastic contact points have created {:.3g} J, {:.2g}% of the largest "
                                 "kinetic energy: where a corner passes an edge, points appear with the "
                                 "overlap that others had. Stiffer joints are entered less.",
                                 motion.created, 100 * motion.created / motion.largestKinetic));
    }
}

namespace
{

/// In which steps and at how many places each effect was called for.
void printCalls(const EffectUse& use, const std::vector<std::string>& names)
{
    info("    effect               in steps [%]  at places [%]  places: of the");
    const auto steps = static_cast<double>(use.steps);
    for (std::size_t i = 0; i < names.size() && i < use.calls.size(); ++i)
    {
        info("    {:20} {:12.1f} {:14.2f}  {}", names[i],
             100 * static_cast<double>(use.calls[i].steps) / steps, 100 * use.calls[i].places / steps,
             placesOf(names[i]));
    }
    if (use.blocks > 0)
    {
        info("Simulated: {:.2f}% of the blocks, in bodies whose number is {:.2f}% of theirs; the others rest",
             100 * use.awakeBlocks / use.blocks, 100 * use.bodies / use.blocks);
    }
}

/// Why steps were taken with all blocks, and how often a law was left out.
template<int Dim>
void printWholeSteps(const DynamicCase<Dim>& scene, const EffectUse& use)
{
    const std::string_view why = whyAllBlocks(scene, scene.flowRule());
    if (!why.empty())
    {
        const std::string_view ofSticking = Dim == 3 ? "slides" : "slides, or moves in rings of blocks,";
        info("Steps in which anything {} were taken with all blocks: {}",
             mayStick(scene) ? ofSticking : "moves", why);
    }
    if (scene.restitution() > 0 && (why.empty() || mayStick(scene)))
    {
        info("Steps in which points collide were taken with all blocks: which of them take part follows from "
             "forces that are not unique");
    }
    if (mayStick(scene))
    {
        info("Coulomb's law left out of {} steps, in which nothing slides", use.sticking);
    }
}

void printSavedTime(const EffectUse& use)
{
    const long others = use.steps - use.atRest;
    info("Proved at rest: {} of {} steps, in {:.3g} s, proofs included; the others took {:.3g} s", use.atRest,
         use.steps, use.secondsAtRest, use.secondsOfOthers);
    if (use.verified > 0)
    {
        const double full = use.secondsOfVerified / static_cast<double>(use.verified);
        const double saved = full * static_cast<double>(use.steps) - use.secondsAtRest - use.secondsOfOthers;
        info("Verified with all effects of the case: {} steps, largest difference {:.3g} m at {:g} s; {:.3g} "
             "s a step, so that {}",
             use.verified, use.largestDifference, use.timeOfLargestDifference, full,
             saved > 0 ? fmt::format("{:.3g} s are saved", saved) : "no time is saved");
    }
    else if (others > 0)
    {
        const double full = use.secondsOfOthers / static_cast<double>(others);
        const double saved = full * static_cast<double>(use.atRest) - use.secondsAtRest;
        info("Saved: {}, at {:.3g} s for a step without proof; verifyInterval measures it",
             saved > 0 ? fmt::format("about {:.3g} s", saved) : "nothing", full);
    }
}

} // namespace

template<int Dim>
void printEffectUse(const DynamicCase<Dim>& scene, const Motion<Dim>& motion)
{
    const ChosenEffects& effects = scene.schemes.effects;
    const EffectUse& use = motion.effectUse;
    if (effects.selection != EffectSelection::automatic || use.steps == 0)
    {
        return;
    }
    info("Effects as the steps called for them (margin {:g})", effects.margin);
    printCalls(use, namesOfEffects(scene));
    printWholeSteps(scene, use);
    printSavedTime(use);
    printLine();
}

void printStageTimes(const StageTimes& times)
{
    const double total = times.total();
    if (total == 0) // no step was due
    {
        return;
    }
    info("Time of the stages    [s]      %");
    for (const auto& [name, stage] : namesOf(Stage{}))
    {
        if (stage == Stage::rest && times.of(stage) == 0) // without `selection automatic`
        {
            continue;
        }
        info("    {:12} {:9.3g} {:6.1f}", name, times.of(stage), 100 * times.of(stage) / total);
    }
    printLine();
}

void printStopOrEnd(const Time& time)
{
    const StopAt stopAt = time.controls().stopAt;
    if (time.exitStatus() != 0)
    {
        info("Stopped at {} s by a signal, state kept: `startFrom latestTime;` continues from there.\n",
             time.name());
    }
    else if (stopAt == StopAt::noWriteNow)
    {
        info(
            "Stopped at {} s, as stopAt noWriteNow of system/controlDict requests: this state is not kept.\n",
            time.name());
    }
    else if (stopAt != StopAt::endTime)
    {
        info("Stopped at {} s, as stopAt {} of system/controlDict requests, state kept: "
             "`startFrom latestTime;` continues from there.\n",
             time.name(), stopAt == StopAt::writeNow ? "writeNow" : "nextWrite");
    }
    else
    {
        printEnd();
    }
    std::fflush(stdout);
}

template void printAddedEffects(const DynamicCase<2>& scene);
template void printScene(const DynamicCase<2>& scene, const Motion<2>& motion, const Time& time,
                         const std::vector<std::string>& functions);
template void printStep(const DynamicCase<2>& scene, const Motion<2>& motion, const Time& time);
template void printSummary(const MotionSummary<2>& summary, const Motion<2>& motion);
template void printIntegrationError(const DynamicCase<2>& scene, const Motion<2>& motion, const Time& time);
template void printEffectUse(const DynamicCase<2>& scene, const Motion<2>& motion);
template void printAddedEffects(const DynamicCase<3>& scene);
template void printScene(const DynamicCase<3>& scene, const Motion<3>& motion, const Time& time,
                         const std::vector<std::string>& functions);
template void printStep(const DynamicCase<3>& scene, const Motion<3>& motion, const Time& time);
template void printSummary(const MotionSummary<3>& summary, const Motion<3>& motion);
template void printIntegrationError(const DynamicCase<3>& scene, const Motion<3>& motion, const Time& time);
template void printEffectUse(const DynamicCase<3>& scene, const Motion<3>& motion);

} // namespace drystone
