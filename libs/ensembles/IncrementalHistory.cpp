// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads and writes the history of an incremental analysis.
#include "ensembles/IncrementalHistory.h"

#include "core/WholeFile.h"
#include "dictionary/Fingerprint.h"
#include "ensembles/StudyHistory.h"
#include "ensembles/StudyInput.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace drystone
{
namespace
{

constexpr std::size_t columns = 10;
constexpr const char* studyName = "incrementalDynamics";

constexpr const char* dictionaryName = "system/incrementalDynamicsDict";

/// `records` of the dictionary; empty where the motion is that of constant/groundMotion.
Dictionary recordsOf(const std::filesystem::path& caseDirectory)
{
    const Dictionary dictionary = Dictionary::readFileIfPresent(caseDirectory / dictionaryName);
    return dictionary.found("records") ? dictionary.subDict("records") : Dictionary();
}

template<int Dim>
std::string headingOf(const std::filesystem::path& caseDirectory, const IncrementalDynamics<Dim>& study)
{
    const Dictionary records = recordsOf(caseDirectory);
    StudyRuns runs;
    runs.dictionary = dictionaryName;
    runs.data = filesNamedIn(records);
    std::string text = historyInput(inputOfStudy(caseDirectory, runs))
                       + fmt::format("# criterion {} stopWhenMet {} motions", study.criterion.summary,
                                     study.stopWhenMet ? "yes" : "no");
    for (const StudyMotion& motion : study.motions)
    {
        text += fmt::format(" {} {}", motion.name, motion.peak);
        if (records.found(motion.name)) // its direction, start and padding leave the peak as it is
        {
            text += fmt::format(" {:016x}", fingerprint(records.subDict(motion.name)));
        }
    }
    return text
           + fmt::format("\n# motion[-] intensity[{}] factor[-] verdict[-] {}[{}] endTime[s] steps[-] "
                         "residual[-] cpuTime[s] isGrowing[-]\n",
                         nameOf(study.intensity.unit), study.criterion.figure.name,
                         study.criterion.figure.unit);
}

std::string rowOf(std::size_t motion, const IncrementalRun& run)
{
    return historyRow(fmt::format("{} {} {} {} {} {} {} {} {:.3g} {:d}", motion, run.intensity, run.factor,
                                  static_cast<int>(run.verdict), run.largest, run.endTime, run.steps,
                                  run.worstResidual, run.cpuTime, run.isGrowing));
}

/// Refuses a row whose numbers contradict each other, or the study, or that is there twice: whoever changed
/// it left nothing else to see it by.
template<int Dim>
void refuseContradictions(const IncrementalDynamics<Dim>& study, const HistoryRow& row, std::size_t motion,
                          const IncrementalRun& run, const IncrementalCurve& before)
{
    constexpr double rounding = 1e-12;
    const double factor = study.factor(study.motions[motion], run.intensity);
    if (factor > 0 && std::abs(run.factor - factor) > rounding * factor) // none without gravity
    {
        row.refuse(2, fmt::format("{}, which makes the peak of {} the intensity {}", factor,
                                  study.motions[motion].name, run.intensity));
    }
    const bool isAbove = run.largest > study.criterion.limit;
    if (run.verdict != Verdict::notConverged && isAbove != (run.verdict == Verdict::meets))
    {
        row.refuse(3, fmt::format("{} where {} is {}, and the limit of it {}",
                                  static_cast<int>(isAbove ? Verdict::meets : Verdict::stands),
                                  study.criterion.figure.name, run.largest, study.criterion.limit));
    }
    if (std::any_of(before.begin(), before.end(),
                    [&run](const IncrementalRun& other) { return other.intensity == run.intensity; }))
    {
        row.refuse(1, fmt::format("what no row of motion {} before has", motion));
    }
}

} // namespace

template<int Dim>
IncrementalHistory<Dim>::IncrementalHistory(const std::filesystem::path& caseDirectory,
                                            const std::filesystem::path& folder,
                                            const IncrementalDynamics<Dim>& study)
    : file(folder / "history.dat"), text(headingOf(caseDirectory, study)), curves(study.motions.size())
{
    change = changedHistory(file, text, studyName);
    if (!change.empty())
    {
        return;
    }
    for (const HistoryRow& row : readHistory(file, text, columns, studyName))
    {
        const auto motion = static_cast<std::size_t>(row.whole(0, 0, static_cast<long>(curves.size()) - 1));
        IncrementalRun run;
        run.intensity = row.finite(1, 0);
        run.factor = row.finite(2);
        run.verdict = Verdict{row.wholeInt(3, 0, static_cast<int>(Verdict::notConverged))};
        run.largest = row.number(4);
        run.endTime = row.finite(5);
        run.steps = row.whole(6, 0);
        run.worstResidual = row.number(7);
        run.cpuTime = row.finite(8, 0);
        run.isGrowing = row.whole(9, 0, 1) != 0;
        refuseContradictions(study, row, motion, run, curves[motion]);
        curves[motion].push_back(run);
        text += rowOf(motion, run);
    }
}

template<int Dim>
std::size_t IncrementalHistory<Dim>::count() const
{
    return std::accumulate(curves.begin(), curves.end(), std::size_t{0},
                           [](std::size_t sum, const IncrementalCurve& curve) { return sum + curve.size(); });
}

template<int Dim>
void IncrementalHistory<Dim>::add(std::size_t motion, const IncrementalRun& run)
{
    curves[motion].push_back(run);
    text += rowOf(motion, run);
    writeWholeFile(file, text);
}

template class IncrementalHistory<2>;
template class IncrementalHistory<3>;

} // namespace drystone
