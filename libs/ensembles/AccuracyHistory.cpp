// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Rows with the fewest digits that read back the same, under a heading with fingerprints of the input.
#include "ensembles/AccuracyHistory.h"

#include "core/Log.h"
#include "core/WholeFile.h"
#include "dictionary/Fingerprint.h"
#include "ensembles/StudyHistory.h"
#include "functionObjects/ColumnFile.h"
#include "runControl/Case.h"

#include <fmt/format.h>

#include <cmath>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

constexpr std::size_t historyNumbers = 20;

} // namespace

std::string historyHeading(const fs::path& caseDirectory, const Dictionary& dictionary)
{
    StudyRuns runs;
    runs.dictionary = "system/accuracyCostDict";
    std::string quantities;
    for (const Entry& quantity : dictionary.subDict("quantities").entries())
    {
        if (quantity.isDictionary())
        {
            quantities += quantity.keyword();
            for (const Entry& entry : quantity.dictionary().entries())
            {
                quantities += entry.keyword() == "reference" ? "" : toText(entry);
            }
        }
    }
    return fmt::format(
        "{}# quantities {:016x} on {}\n"
        "# quantity[-] deltaT[s] theta[-] flowRule[-] solver[-] tolerance[-] pointsPerJoint[-] "
        "pointsPerSide[-] displacements[-] formulation[-] contactOverlap[-] effects[-] phase[-] phases[-] "
        "value hover[m] steps[-] "
        "cpuTime[s] residual[-] "
        "end[-]\n",
        historyInput(inputOfStudy(caseDirectory, runs)), fingerprint(quantities), processorName());
}

AccuracyRuns::AccuracyRuns(const AccuracyStudy& accuracyStudy)
    : study(accuracyStudy), file(accuracyFolder(study.caseDirectory) / "history.dat")
{
    const long quantities = static_cast<long>(study.quantities.size());
    const auto take = [&](const HistoryRow& row)
    {
        const int phases = row.wholeInt(13, 1);
        const RunKey key{static_cast<std::size_t>(row.whole(0, 0, quantities - 1)),
                         {row.finite(1, 0), row.finite(2, 0), row.choice<FlowRule>(3),
                          row.choice<SolverType>(4), row.finite(5, 0), row.wholeInt(6, 0), row.wholeInt(7, 0),
                          row.choice<Displacements>(8), row.choice<ContactFormulation>(9), row.finite(10, 0),
                          row.choice<EffectSelection>(11)},
                         {row.wholeInt(12, 0, phases - 1), phases}};
        const RunEnd end{row.wholeInt(19, 0, static_cast<int>(RunEnd::missing))};
        const auto figure = [&](std::size_t column) // of which a run that has failed may have none
        { return end == RunEnd::done ? row.finite(column) : row.number(column); };
        const Measurement run{figure(14),        figure(15),     row.finite(16, 0),
                              row.finite(17, 0), row.number(18), end};
        if (end != RunEnd::done && !std::isnan(run.value))
        {
            row.refuse(14, fmt::format("nan where end is {}", static_cast<int>(end)));
        }
        if (find(key))
        {
            row.refuse(12, "what no row before has with this setting");
        }
        add(key, run);
    };
    readHistory(file, study.heading, historyNumbers, accuracyCostName, take);
    if (size() > 0)
    {
        info("Continuing: {} runs are known from postProcessing/accuracyCost/0/history.dat", size());
    }
}

const Measurement* AccuracyRuns::find(const RunKey& key) const
{
    const auto found = runs.find(key);
    return found == runs.end() ? nullptr : &found->second;
}

void AccuracyRuns::add(const RunKey& key, const Measurement& run)
{
    if (runs.emplace(key, run).second)
    {
        order.push_back(key);
    }
}

void AccuracyRuns::write() const
{
    std::string text = study.heading;
    for (const RunKey& key : order)
    {
        const RunSetting& setting = key.setting;
        const Measurement& run = runs.at(key);
        // The fewest digits that read back as the same number.
        text += historyRow(fmt::format(
            "{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", key.quantity, setting.deltaT,
            setting.theta, int(setting.flowRule), int(setting.solver), setting.tolerance,
            setting.pointsPerJoint, setting.pointsPerSide, int(setting.displacements),
            int(setting.formulation), setting.contactOverlap, int(setting.effects), key.phase.index,
            key.phase.count, run.value, run.hover, run.steps, run.cpuTime, run.worstResidual, int(run.end)));
    }
    writeWholeFile(file, text);
}

} // namespace drystone
