// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The words of an incremental analysis on standard output.
#include "ensembles/IncrementalDynamicsLog.h"

#include "core/Log.h"
#include "functionObjects/MotionLog.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace drystone
{
namespace
{

const char* textOf(Verdict verdict)
{
    switch (verdict)
    {
    case Verdict::stands:
        return "stands";
    case Verdict::meets:
        return "meets the criterion";
    case Verdict::notConverged:
        return "DID NOT CONVERGE";
    case Verdict::interrupted:
        break;
    }
    return "was interrupted";
}

} // namespace

template<int Dim>
void printStudy(const IncrementalDynamics<Dim>& study)
{
    auto [simulated, absent] = withSimulated(study.scene.effectNames, "groundMotion");
    (study.scene.schemes.smallDisplacements ? absent : simulated).emplace_back("largeDisplacements");
    printEffects(simulated, absent);
    printAddedEffects(study.scene);
    for (const StudyMotion& motion : study.motions)
    {
        if (study.motions.size() > 1)
        {
            printLine(motion.name + ":");
        }
        info("{}", summary(motion.ground, study.gravity));
    }
    info("Blocks: {} free, contact points: {}", study.scene.mass.size() / freedomCount<Dim>,
         study.start.points.size());
    info("Each run: theta {:g}, deltaT {:g} s, to {:g} s; solver {}, tolerance {:g}",
         study.scene.schemes.timeIntegration.theta, study.controls.deltaT, study.controls.endTime,
         nameOf(study.scene.solution.solver), study.scene.solution.tolerance);
    info("Intensity: peak of the ground's acceleration in {}",
         study.intensity.unit == IntensityUnit::g ? fmt::format("g = {:g} m/s2", study.gravity) : "m/s2");
    info("Criterion: {}", study.criterion.summary);
    info("Runs at a time: {}", study.jobs);
    printLine();
}

template<int Dim>
void printRun(const IncrementalDynamics<Dim>& study, std::size_t motion, const IncrementalRun& run,
              const std::string& timeLeft)
{
    info("{}intensity = {:.9g} {}  {} = {:.4g} {}  {}{}{}  ({} steps, residual {:.2g}, {:.2f} s; {})",
         study.motions.size() > 1 ? study.motions[motion].name + ": " : "", run.intensity,
         nameOf(study.intensity.unit), study.criterion.figure.name, run.largest, study.criterion.figure.unit,
         textOf(run.verdict), run.verdict == Verdict::stands ? "" : fmt::format(" at {:g} s", run.endTime),
         run.isGrowing ? ", still growing" : "", run.steps, run.worstResidual, run.cpuTime, timeLeft);
    std::fflush(stdout); // for those who follow the log
}

StudyClock::StudyClock(long runs, long known) : toDo(runs - known), start(clockTime()) {}

std::string StudyClock::timeLeft() const
{
    const double each = done > 0 ? (clockTime() - start) / static_cast<double>(done) : 0;
    return "at most " + durationText(each * static_cast<double>(std::max(toDo - done, 0L))) + " left";
}

namespace
{

/// \param name of the motion and a colon, or nothing \param unit of accelerations
void printKind(const LeastIntensity& least, const std::string& name, std::string_view unit)
{
    switch (least.kind)
    {
    case LeastIntensity::Kind::found:
        info("{}Least acceleration that meets the criterion a_g = {:.9g} {}", name, least.value, unit);
        break;
    case LeastIntensity::Kind::belowRange:
        info("{}The lowest acceleration tried, {:.9g} {}, meets the criterion already: try lower ones", name,
             least.value, unit);
        break;
    case LeastIntensity::Kind::aboveRange:
        info("{}No acceleration up to {:.9g} {} meets the criterion", name, least.value, unit);
        break;
    case LeastIntensity::Kind::notConverged:
        info("{}The least acceleration that meets the criterion is not known: a run below it did not "
             "converge",
             name);
        break;
    }
}

/// What the runs leave open about the least acceleration.
template<int Dim>
void printReservations(const IncrementalDynamics<Dim>& study, const LeastIntensity& least,
                       const IncrementalCurve& finished, const std::string& name)
{
    if (!least.isMonotone)
    {
        info("{}At some higher accelerations the structure stands again: see the table", name);
    }
    else if (least.kind == LeastIntensity::Kind::found && study.intensity.isBisection)
    {
        info("{}A bisection finds one change of the verdict: whether lower accelerations meet the "
             "criterion too, as those of one-sine pulses may, `type step` shows",
             name);
    }
    const auto growing = std::count_if(finished.begin(), finished.end(),
                                       [](const IncrementalRun& run) { return run.isGrowing; });
    if (growing > 0)
    {
        info("{}In {} of the runs that stand {} still grows at endTime {:g} s: with a later one the least "
             "acceleration may be lower",
             name, growing, study.criterion.figure.name, study.controls.endTime);
    }
    const auto failed =
        std::count_if(finished.begin(), finished.end(),
                      [](const IncrementalRun& run) { return run.verdict == Verdict::notConverged; });
    if (failed > 0)
    {
        info("{}{} of {} runs did not converge", name, failed, finished.size());
    }
}

} // namespace

template<int Dim>
void printLeast(const IncrementalDynamics<Dim>& study, const std::vector<IncrementalCurve>& curves)
{
    const std::string_view unit = nameOf(study.intensity.unit);
    printLine();
    for (std::size_t motion = 0; motion < curves.size(); ++motion)
    {
        const std::string name = study.motions.size() > 1 ? study.motions[motion].name + ": " : "";
        const IncrementalCurve finished = finishedRuns(curves[motion]);
        if (finished.size() < curves[motion].size() || finished.empty())
        {
            info("{}Stopped before the least acceleration that meets the criterion was known", name);
            continue;
        }
        const LeastIntensity least = leastIntensity(finished);
        printKind(least, name, unit);
        printReservations(study, least, finished, name);
    }
}

template void printStudy(const IncrementalDynamics<2>& study);
template void printRun(const IncrementalDynamics<2>& study, std::size_t motion, const IncrementalRun& run,
                       const std::string& timeLeft);
template void printLeast(const IncrementalDynamics<2>& study, const std::vector<IncrementalCurve>& curves);

template void printStudy(const IncrementalDynamics<3>& study);
template void printRun(const IncrementalDynamics<3>& study, std::size_t motion, const IncrementalRun& run,
                       const std::string& timeLeft);
template void printLeast(const IncrementalDynamics<3>& study, const std::vector<IncrementalCurve>& curves);

} // namespace drystone
