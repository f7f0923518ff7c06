// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads, prints and writes an incremental analysis.
#include "ensembles/IncrementalDynamicsCase.h"

#include "core/Log.h"
#include "core/WholeFile.h"
#include "dynamics/GroundMotionPlausibility.h"
#include "effects/RecordPlausibility.h"
#include "functionObjects/ColumnFile.h"
#include "functionObjects/MotionLog.h"
#include "functionObjects/MotionResults.h"
#include "functionObjects/MotionSummary.h"
#include "io/Plot.h"
#include "runControl/Case.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace drystone
{
namespace
{

constexpr const char* applicationName = "incrementalDynamics";

/// The ground motions, each with a peak that can be scaled.
template<int Dim>
std::vector<StudyMotion> studyMotions(const std::filesystem::path& caseDirectory, const GroundMotion& ofCase,
                                      const IncrementalDynamicsSettings& settings,
                                      const Dictionary& dictionary)
{
    std::vector<StudyMotion> motions;
    for (const auto& [name, record] : settings.records)
    {
        requireComponents(dictionary.subDict("records").subDict(name), Dim);
        GroundMotion::Component component{
            recordedAcceleration(record.record, caseDirectory),
            Eigen::Map<const Eigen::Vector3d>(record.direction.data()).stableNormalized()};
        question(doubtsAboutRecord(component, dictionary.subDict("records").subDict(name)));
        motions.push_back({name, {{std::move(component)}}, 0});
    }
    if (motions.empty())
    {
        motions.push_back({applicationName, ofCase, 0});
    }
    for (StudyMotion& motion : motions)
    {
        motion.peak = peakAcceleration(motion.ground);
        if (!(motion.peak > 0) && settings.records.empty())
        {
            throw FatalError("The ground does not move, so that there is nothing to make stronger. Say in "
                             "constant/groundMotion how it moves (etc/annotated/constant/groundMotion is an "
                             "example), or give `records` in system/incrementalDynamicsDict.");
        }
        if (!(motion.peak > 0))
        {
            throw FatalIOError(fmt::format("The record {} is zero throughout: it cannot be made stronger.\n\n"
                                           "Get a complete copy of it, or leave the record out.",
                                           motion.name),
                               dictionary.subDict("records").subDict(motion.name).locationOf("file"));
        }
    }
    return motions;
}

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

/// Runs interrupted by a signal have no verdict.
IncrementalCurve finishedRuns(const IncrementalCurve& curve)
{
    IncrementalCurve finished;
    std::copy_if(curve.begin(), curve.end(), std::back_inserter(finished),
                 [](const IncrementalRun& run) { return run.verdict != Verdict::interrupted; });
    return finished;
}

template<int Dim>
void writeTable(const std::filesystem::path& file, const IncrementalDynamics<Dim>& study,
                const IncrementalCurve& curve)
{
    ColumnFile table(file, {fmt::format("intensity[{}]", nameOf(study.intensity.unit)), "factor[-]",
                            fmt::format("{}[{}]", study.criterion.figure.name, study.criterion.figure.unit),
                            "verdict[-]", "endTime[s]", "steps[-]", "residual[-]", "cpuTime[s]"});
    for (const IncrementalRun& run : curve)
    {
        table.write({{run.intensity, run.factor, run.largest, static_cast<double>(run.verdict), run.endTime,
                      static_cast<double>(run.steps), run.worstResidual, run.cpuTime}});
    }
}

template<int Dim>
void writeCurves(const std::filesystem::path& name, const IncrementalDynamics<Dim>& study,
                 const std::vector<IncrementalCurve>& curves)
{
    const Criterion<Dim>& criterion = study.criterion;
    Plot plot;
    plot.title = fmt::format("Largest {} over the run", criterion.figure.name);
    plot.subtitle =
        fmt::format("criterion: {}; deltaT {:g} s to {:g} s, tolerance {:g}", criterion.summary,
                    study.controls.deltaT, study.controls.endTime, study.scene.solution.tolerance);
    plot.x.label = fmt::format("intensity: peak ground acceleration [{}]", nameOf(study.intensity.unit));
    plot.y.label = fmt::format("{} [{}]", criterion.figure.name, criterion.figure.unit);
    plot.references.push_back({"limit", ReferenceDirection::horizontal, criterion.limit});
    for (std::size_t motion = 0; motion < curves.size(); ++motion)
    {
        PlotCurve curve;
        curve.name = study.motions[motion].name;
        for (const IncrementalRun& run : curves[motion])
        {
            if (run.verdict != Verdict::notConverged)
            {
                curve.x.push_back(run.intensity);
                curve.y.push_back(run.largest);
            }
        }
        plot.curves.push_back(std::move(curve));
        const LeastIntensity least = leastIntensity(curves[motion]);
        if (curves.size() == 1 && least.kind == LeastIntensity::Kind::found)
        {
            plot.references.push_back(
                {fmt::format("a_g = {:.9g} {}", least.value, nameOf(study.intensity.unit)),
                 ReferenceDirection::vertical, least.value});
        }
    }
    writePlot(name, plot, study.controls.pictureFormats);
}

} // namespace

template<int Dim>
IncrementalDynamics<Dim> readIncrementalDynamics(const std::filesystem::path& caseDirectory, Time& time)
{
    const Dictionary dictionary = Dictionary::readFile(
        requireCaseFile(caseDirectory, "system/incrementalDynamicsDict",
                        "It specifies which accelerations to try and when a run counts as failed; "
                        "etc/annotated/system/incrementalDynamicsDict is one to copy."));
    const auto settings = readOptions<IncrementalDynamicsSettings>(dictionary);
    if (time.controls().stopAt != StopAt::endTime)
    {
        throw FatalIOError("Every run of an incremental analysis ends at endTime: set `stopAt endTime;`.",
                           time.controlDict().locationOf("stopAt"));
    }

    IncrementalDynamics<Dim> study;
    study.scene = readDynamicCase<Dim>(caseDirectory);
    study.controls = time.controls();
    study.startTime = time.state();
    study.gravity = study.scene.gravity.norm();
    study.intensity = settings.intensity;
    study.criterion = settings.criterion(study.scene.assembly);
    if (const std::string doubt = doubtAboutCriterion(study); !doubt.empty())
    {
        question({{doubt, dictionary.locationOf("criterion")}});
    }
    study.motions =
        studyMotions<Dim>(caseDirectory, groundMotionOf(study.scene.effects), settings, dictionary);
    setGroundMotion(study.scene.effects, study.motions.front().ground); // before the effects have states
    study.start = startOrContinue(caseDirectory, study.scene, time);
    if (const std::string doubt = doubtAboutSupports(study); !doubt.empty())
    {
        question({{doubt, dictionary.locationOf("criterion")}});
    }
    for (const StudyMotion& motion : study.motions)
    {
        question(doubtsAboutTimes(motion.ground, time.controls(), time.controlDict()));
    }
    study.jobs = settings.jobs.value_or(threadCount());
    study.stopWhenMet = settings.stopWhenMet;
    if (study.intensity.unit == IntensityUnit::g && !(study.gravity > 0))
    {
        throw FatalIOError("Without gravity there is no acceleration g: give intensities with `unit m/s2;`.",
                           dictionary.subDict("intensity").locationOf("unit"));
    }
    return study;
}

template<int Dim>
std::string doubtAboutCriterion(const IncrementalDynamics<Dim>& study)
{
    const Criterion<Dim>& criterion = study.criterion;
    // Half a block moves by half its size where the block turns by 1 rad.
    const double share =
        criterion.figure.unit == "rad" ? 0.5 * criterion.limit : criterion.limit / study.scene.blockSize;
    if (!study.scene.schemes.smallDisplacements || share <= mostSmallDisplacement)
    {
        return "";
    }
    return fmt::format(
        "With `smallDisplacements yes;` of system/schemes contact points and lever arms stay as "
        "built, and blocks meet this criterion, {}, only when they have moved by {:.3g} of the "
        "mean block size. Usual there are up to {:g}, or `smallDisplacements no;`, which follows "
        "the blocks.",
        criterion.summary, share, mostSmallDisplacement);
}

template<int Dim>
std::string doubtAboutSupports(const IncrementalDynamics<Dim>& study)
{
    const Criterion<Dim>& criterion = study.criterion;
    const bool isTurn = criterion.figure.unit == "rad";
    if (!traitsOf(study.scene.effects).movesSupports || (!isTurn && criterion.figure.unit != "m"))
    {
        return "";
    }
    constexpr int parts = 1000;
    const std::vector<Placement<Dim>>& start = study.start.state.placements;
    std::vector<Placement<Dim>> placements = start;
    const double length = (study.controls.endTime - study.startTime.value) / parts;
    double largest = 0;
    for (int i = 0; i < parts; ++i)
    {
        const double from = study.startTime.value + i * length;
        moveWithSupports(placements,
                         supportSteps(study.scene.effects, study.scene, placements, from, from + length));
        for (std::size_t block = 0; block < placements.size(); ++block)
        {
            const Vector<Dim> way = placements[block].translation - start[block].translation;
            largest = std::max(largest, isTurn ? rowsOf(placements[block].rotation).norm() : way.norm());
        }
    }
    return largest > criterion.limit ? fmt::format(
               "Supports move by up to {:.3g} {} (constant/supportMotion), beyond the criterion, "
               "{}: what they carry along meets it however weak the ground's motion is, for "
               "displacements are relative to the ground. Give a larger limit{}.",
               largest, criterion.figure.unit, criterion.summary,
               isTurn ? "" : ", or a criterion of type rotation")
                                     : "";
}

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
        switch (least.kind)
        {
        case LeastIntensity::Kind::found:
            info("{}Least acceleration that meets the criterion a_g = {:.9g} {}", name, least.value, unit);
            break;
        case LeastIntensity::Kind::belowRange:
            info("{}The lowest acceleration tried, {:.9g} {}, meets the criterion already: try lower ones",
                 name, least.value, unit);
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
            info(
                "{}In {} of the runs that stand {} still grows at endTime {:g} s: with a later one the least "
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
}

std::filesystem::path incrementalDynamicsFolder(const std::filesystem::path& caseDirectory, const Time& time)
{
    return postProcessingFolder(caseDirectory, applicationName, time.startName());
}

template<int Dim>
LeastIntensityTable leastIntensityTable(const IncrementalDynamics<Dim>& study,
                                        const std::vector<IncrementalCurve>& curves)
{
    const std::string unit(nameOf(study.intensity.unit));
    LeastIntensityTable table;
    table.headings = {"motion[-]", fmt::format("leastIntensity[{}]", unit), fmt::format("below[{}]", unit),
                      "kind[-]", "runs[-]"};
    for (std::size_t motion = 0; motion < curves.size(); ++motion)
    {
        const IncrementalCurve finished = finishedRuns(curves[motion]);
        if (finished.empty())
        {
            continue;
        }
        const LeastIntensity least = leastIntensity(finished);
        const bool isKnown =
            least.kind == LeastIntensity::Kind::found || least.kind == LeastIntensity::Kind::belowRange;
        table.rows.push_back({static_cast<double>(motion), isKnown ? least.value : std::nan(""), least.below,
                              static_cast<double>(least.kind), static_cast<double>(finished.size())});
    }
    return table;
}

template<int Dim>
void writeIncrementalDynamics(const std::filesystem::path& folder, const IncrementalDynamics<Dim>& study,
                              const std::vector<IncrementalCurve>& curves)
{
    const LeastIntensityTable least = leastIntensityTable(study, curves);
    // Of several motions, which number is which record.
    std::vector<std::string> names;
    for (std::size_t motion = 0; motion < study.motions.size() && study.motions.size() > 1; ++motion)
    {
        names.push_back(fmt::format("motion {}: {}", motion, study.motions[motion].name));
    }
    ColumnFile answers(folder / "leastIntensity.dat", least.headings, 12, names);
    for (const std::vector<double>& row : least.rows)
    {
        answers.write(row);
    }
    std::vector<IncrementalCurve> finished;
    for (std::size_t motion = 0; motion < curves.size(); ++motion)
    {
        finished.push_back(finishedRuns(curves[motion]));
        if (!finished.back().empty())
        {
            writeTable(folder / (study.motions[motion].name + ".dat"), study, finished.back());
        }
    }
    if (std::none_of(finished.begin(), finished.end(), [](const auto& curve) { return curve.empty(); }))
    {
        writeCurves(folder / "incrementalDynamics", study, finished);
    }
}

template IncrementalDynamics<2> readIncrementalDynamics(const std::filesystem::path& caseDirectory,
                                                        Time& time);
template std::string doubtAboutCriterion(const IncrementalDynamics<2>& study);
template std::string doubtAboutSupports(const IncrementalDynamics<2>& study);
template void printStudy(const IncrementalDynamics<2>& study);
template void printRun(const IncrementalDynamics<2>& study, std::size_t motion, const IncrementalRun& run,
                       const std::string& timeLeft);
template void printLeast(const IncrementalDynamics<2>& study, const std::vector<IncrementalCurve>& curves);
template LeastIntensityTable leastIntensityTable(const IncrementalDynamics<2>& study,
                                                 const std::vector<IncrementalCurve>& curves);
template void writeIncrementalDynamics(const std::filesystem::path& folder,
                                       const IncrementalDynamics<2>& study,
                                       const std::vector<IncrementalCurve>& curves);

template IncrementalDynamics<3> readIncrementalDynamics(const std::filesystem::path& caseDirectory,
                                                        Time& time);
template std::string doubtAboutCriterion(const IncrementalDynamics<3>& study);
template std::string doubtAboutSupports(const IncrementalDynamics<3>& study);
template void printStudy(const IncrementalDynamics<3>& study);
template void printRun(const IncrementalDynamics<3>& study, std::size_t motion, const IncrementalRun& run,
                       const std::string& timeLeft);
template void printLeast(const IncrementalDynamics<3>& study, const std::vector<IncrementalCurve>& curves);
template LeastIntensityTable leastIntensityTable(const IncrementalDynamics<3>& study,
                                                 const std::vector<IncrementalCurve>& curves);
template void writeIncrementalDynamics(const std::filesystem::path& folder,
                                       const IncrementalDynamics<3>& study,
                                       const std::vector<IncrementalCurve>& curves);

} // namespace drystone
