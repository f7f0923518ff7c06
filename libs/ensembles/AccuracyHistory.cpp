// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "ensembles/AccuracyHistory.h"

#include "core/Log.h"
#include "core/WholeFile.h"
#include "dictionary/Fingerprint.h"
#include "ensembles/CaseRuns.h"
#include "functionObjects/ColumnFile.h"
#include "runControl/Case.h"

#include <fmt/format.h>

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
    for (const std::vector<double>& row : readHistory(file, study.heading, historyNumbers, accuracyCostName))
    {
        const auto whole = [&row](std::size_t column) { return static_cast<int>(row[column]); };
        RunKey key{static_cast<std::size_t>(row[0]),
                   {row[1], row[2], FlowRule{whole(3)}, SolverType{whole(4)}, row[5], whole(6), whole(7),
                    Displacements{whole(8)}, ContactFormulation{whole(9)}, row[10],
                    EffectSelection{whole(11)}},
                   {whole(12), whole(13)}};
        add(key, {row[14], row[15], row[16], row[17], row[18], RunEnd{whole(19)}});
    }
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
        text += fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}\n", key.quantity,
                            setting.deltaT, setting.theta, int(setting.flowRule), int(setting.solver),
                            setting.tolerance, setting.pointsPerJoint, setting.pointsPerSide,
                            int(setting.displacements), int(setting.formulation), setting.contactOverlap,
                            int(setting.effects), key.phase.index, key.phase.count, run.value, run.hover,
                            run.steps, run.cpuTime, run.worstResidual, int(run.end));
    }
    writeWholeFile(file, text);
}

} // namespace drystone
