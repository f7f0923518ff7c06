// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Runs the motions of an incremental analysis on several threads.
#include "ensembles/IncrementalDynamics.h"

#include "core/Signals.h"
#include "ensembles/Executor.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

namespace drystone
{
namespace
{

/// CPU time of this thread [s].
double threadCpuTime()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A run to be carried out.
struct Job
{
    std::size_t motion = 0;
    double intensity = 0;
};

/// The run of a job, among known ones; null: it is to be carried out.
const IncrementalRun* findRun(const IncrementalCurve& known, const Job& job)
{
    const auto found =
        std::find_if(known.begin(), known.end(),
                     [&](const IncrementalRun& run) { return run.intensity == job.intensity; });
    return found == known.end() ? nullptr : &*found;
}

/// Carries out the runs, several at a time, and reports each as soon as all before it are complete.
template<int Dim>
std::vector<IncrementalRun> runAll(const IncrementalDynamics<Dim>& study, const std::vector<Job>& jobs,
                                   const RunReport& report, const std::vector<IncrementalCurve>& known)
{
    std::vector<IncrementalRun> runs(jobs.size());
    std::vector<std::size_t> unknown;
    for (std::size_t job = 0; job < jobs.size(); ++job)
    {
        const IncrementalRun* run = known.empty() ? nullptr : findRun(known[jobs[job].motion], jobs[job]);
        if (run)
        {
            runs[job] = *run;
        }
        else
        {
            unknown.push_back(job);
        }
    }
    carryOutAll(
        unknown.size(), study.jobs,
        [&](std::size_t i)
        {
            const Job& job = jobs[unknown[i]];
            runs[unknown[i]] = runAt(study, study.motions[job.motion], job.intensity);
        },
        [&](std::size_t i)
        {
            const IncrementalRun& run = runs[unknown[i]];
            if (report && run.verdict != Verdict::interrupted)
            {
                report(jobs[unknown[i]].motion, run);
            }
        });
    return runs;
}

std::vector<Trial> trialsOf(const IncrementalCurve& curve)
{
    std::vector<Trial> trials;
    for (const IncrementalRun& run : curve)
    {
        trials.push_back({run.intensity, run.verdict});
    }
    return trials;
}

} // namespace

void declare(Options& options, StudyRecord& record)
{
    options.optional("direction", record.direction, "of the acceleration; its length does not matter");
    declare(options, record.record);
    options.check("direction",
                  [&record]
                  {
                      const Eigen::Map<const Eigen::Vector3d> direction(record.direction.data());
                      return direction.norm() > 0 ? "" : "The direction has no length.";
                  });
    options.check(
        "scale", [&record]
        { return record.record.scale == 1 ? "" : "The intensity is the peak of the record: remove scale."; });
    options.check("peakAcceleration",
                  [&record]
                  {
                      return !record.record.peakAcceleration
                                 ? ""
                                 : "The intensity is the peak of the record: remove peakAcceleration.";
                  });
}

void declare(Options& options, IncrementalDynamicsSettings& settings)
{
    options.required("intensity", settings.intensity, intensityTypes(),
                     "peak accelerations of the ground that are tried");
    options.required("criterion", settings.criterion, criterionTypes(), "when a run has gone too far");
    options.optional("records", settings.records,
                     "instead of constant/groundMotion: one analysis for each; any names");
    options.check("records",
                  [&settings]() -> std::string
                  {
                      for (const auto& [name, record] : settings.records)
                      {
                          if (name.find('/') != std::string::npos || name == "leastIntensity")
                          {
                              return "The name " + name + " cannot be that of a table: choose another one.";
                          }
                      }
                      return "";
                  });
    options.optional("jobs", settings.jobs, "concurrent runs; absent: the number of cores")
        .atLeast(1)
        .atMost(1024)
        .example("2");
    options.optional("stopWhenMet", settings.stopWhenMet,
                     "a run ends as soon as it meets the criterion; no: it continues to endTime, for the "
                     "largest figure over the whole motion");
}

/// A step, whose faults are those of one run of many.
template<int Dim>
bool advanceIn(const DynamicCase<Dim>& scene, Motion<Dim>& motion, Time& time, const StudyMotion& ground,
               double intensity)
{
    try
    {
        return advance(scene, motion, time);
    }
    catch (const FatalError& error)
    {
        throw FatalError(
            fmt::format("In the run of motion {} at intensity {:g}, at {:g} s: {}\n\nWith `stopWhenMet "
                        "yes;` a run ends as soon as it meets the criterion.",
                        ground.name, intensity, motion.state.time, error.what()));
    }
}

template<int Dim>
IncrementalRun runAt(const IncrementalDynamics<Dim>& study, const StudyMotion& ground, double intensity)
{
    const double cpuTimeBefore = threadCpuTime();
    DynamicCase<Dim> scene = study.scene;
    GroundMotion scaled = ground.ground;
    scaled.factor = study.factor(ground, intensity);
    setGroundMotion(scene.effects, scaled);
    Motion<Dim> motion = study.start;
    Time time(study.controls, study.startTime);

    IncrementalRun run;
    run.intensity = intensity;
    run.factor = scaled.factor;
    run.endTime = time.value();
    double before = 0;
    double now = 0;
    while (time.loop())
    {
        if (stopSignal() != 0)
        {
            run.verdict = Verdict::interrupted;
            break;
        }
        const bool isSolved = advanceIn(scene, motion, time, ground, intensity);
        run.worstResidual = std::max(run.worstResidual, motion.residuals.worst());
        if (!isSolved)
        {
            run.verdict = Verdict::notConverged;
            run.endTime = time.value();
            break;
        }
        ++run.steps;
        before = now;
        now = study.criterion.figure.at(study.start.state, motion);
        run.largest = std::max(run.largest, now);
        if (run.verdict == Verdict::stands)
        {
            run.endTime = time.value();
        }
        if (run.largest > study.criterion.limit)
        {
            run.verdict = Verdict::meets;
            if (study.stopWhenMet)
            {
                break;
            }
        }
    }
    constexpr double share = 0.1;
    run.isGrowing = run.verdict == Verdict::stands && now == run.largest
                    && (now - before) * static_cast<double>(run.steps) > share * study.criterion.limit;
    run.cpuTime = threadCpuTime() - cpuTimeBefore;
    return run;
}

template<int Dim>
std::vector<IncrementalCurve> carryOut(const IncrementalDynamics<Dim>& study, const RunReport& report,
                                       const std::vector<IncrementalCurve>& known)
{
    std::vector<IncrementalCurve> curves(study.motions.size());
    for (;;)
    {
        std::vector<Job> jobs;
        for (std::size_t motion = 0; motion < curves.size(); ++motion)
        {
            for (const double intensity : study.intensity.next(trialsOf(curves[motion])))
            {
                jobs.push_back({motion, intensity});
            }
        }
        if (jobs.empty() || stopSignal() != 0)
        {
            break;
        }
        const std::vector<IncrementalRun> runs = runAll(study, jobs, report, known);
        for (std::size_t job = 0; job < jobs.size(); ++job)
        {
            curves[jobs[job].motion].push_back(runs[job]);
        }
    }
    for (IncrementalCurve& curve : curves)
    {
        std::sort(curve.begin(), curve.end(),
                  [](const IncrementalRun& a, const IncrementalRun& b) { return a.intensity < b.intensity; });
    }
    return curves;
}

IncrementalCurve finishedRuns(const IncrementalCurve& curve)
{
    IncrementalCurve finished;
    std::copy_if(curve.begin(), curve.end(), std::back_inserter(finished),
                 [](const IncrementalRun& run) { return run.verdict != Verdict::interrupted; });
    return finished;
}

LeastIntensity leastIntensity(const IncrementalCurve& curve)
{
    return leastIntensity(trialsOf(curve));
}

int exitStatus(const std::vector<IncrementalCurve>& curves)
{
    if (stopSignal() != 0)
    {
        return exitStatusOfSignal(stopSignal());
    }
    for (const IncrementalCurve& curve : curves)
    {
        for (const IncrementalRun& run : curve)
        {
            if (run.verdict == Verdict::notConverged)
            {
                return 2;
            }
        }
    }
    return 0;
}

template IncrementalRun runAt(const IncrementalDynamics<2>& study, const StudyMotion& ground,
                              double intensity);
template std::vector<IncrementalCurve> carryOut(const IncrementalDynamics<2>& study, const RunReport& report,
                                                const std::vector<IncrementalCurve>& known);
template IncrementalRun runAt(const IncrementalDynamics<3>& study, const StudyMotion& ground,
                              double intensity);
template std::vector<IncrementalCurve> carryOut(const IncrementalDynamics<3>& study, const RunReport& report,
                                                const std::vector<IncrementalCurve>& known);

} // namespace drystone
