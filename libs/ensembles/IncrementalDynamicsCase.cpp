// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads and writes an incremental analysis.
#include "ensembles/IncrementalDynamicsCase.h"

#include "core/Log.h"
#include "core/WholeFile.h"
#include "dynamics/GroundMotionPlausibility.h"
#include "effects/RecordPlausibility.h"
#include "functionObjects/ColumnFile.h"
#include "functionObjects/MotionResults.h"
#include "functionObjects/MotionSummary.h"
#include "io/Plot.h"
#include "runControl/Case.h"

#include <algorithm>
#include <cmath>

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
template LeastIntensityTable leastIntensityTable(const IncrementalDynamics<2>& study,
                                                 const std::vector<IncrementalCurve>& curves);
template void writeIncrementalDynamics(const std::filesystem::path& folder,
                                       const IncrementalDynamics<2>& study,
                                       const std::vector<IncrementalCurve>& curves);

template IncrementalDynamics<3> readIncrementalDynamics(const std::filesystem::path& caseDirectory,
                                                        Time& time);
template std::string doubtAboutCriterion(const IncrementalDynamics<3>& study);
template std::string doubtAboutSupports(const IncrementalDynamics<3>& study);
template LeastIntensityTable leastIntensityTable(const IncrementalDynamics<3>& study,
                                                 const std::vector<IncrementalCurve>& curves);
template void writeIncrementalDynamics(const std::filesystem::path& folder,
                                       const IncrementalDynamics<3>& study,
                                       const std::vector<IncrementalCurve>& curves);

} // namespace drystone
