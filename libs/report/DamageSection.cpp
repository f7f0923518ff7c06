// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Results that are missing, damaged or of another case, and a case without any.
#include "core/Error.h"
#include "functionObjects/Histories.h"
#include "functionObjects/KeptResults.h"
#include "functionObjects/LimitAnalysisResults.h"
#include "report/ReportSections.h"
#include "report/SortedFiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

/// Whether a row that says it has a multiplier has none, or says nothing that there is.
bool hasNoNumber(const NumberTable& multipliers)
{
    for (std::size_t row = 0; row < multipliers.columns.front().size(); ++row)
    {
        const std::optional<CollapseStatus> status = storedStatus(multipliers.columns[1][row]);
        if (!status || (status == CollapseStatus::optimal && !std::isfinite(multipliers.columns[0][row])))
        {
            return true;
        }
    }
    return false;
}

/// What is wrong with a table of multipliers as one of this case; empty: nothing.
std::string faultOfMultipliers(const NumberTable& found, std::size_t freeBlocks)
{
    if (found.columns.size() < 10 || found.columns.front().empty() || hasNoNumber(found))
    {
        return "holds no multiplier: it is damaged";
    }
    const auto blocks = std::find(found.names.begin(), found.names.end(), "blocks");
    const double counted = blocks == found.names.end()
                               ? static_cast<double>(freeBlocks)
                               : found.columns[static_cast<std::size_t>(blocks - found.names.begin())].back();
    return counted == static_cast<double>(freeBlocks)
               ? ""
               : fmt::format("is of {:g} free blocks, and this case has {}", counted, freeBlocks);
}

/// What cannot be read of the results, a text each.
std::vector<std::string> damagedResults(const fs::path& caseDirectory, std::size_t freeBlocks)
{
    std::vector<std::string> faults;
    std::error_code none;
    const fs::path multipliers = limitAnalysisTable(caseDirectory);
    const std::string fault = faultOfMultipliers(readNumberTable(multipliers), freeBlocks);
    const bool isOfMechanism =
        fs::exists(caseDirectory / "VTK/blocks.vtp.series", none) && !isOfMotion(caseDirectory);
    const bool isExpected = fs::exists(limitAnalysisInput(caseDirectory), none) || isOfMechanism;
    if (isExpected && !fs::exists(multipliers, none))
    {
        faults.push_back(fmt::format("{} is missing, which has the multiplier. Run limitAnalysis again.",
                                     fs::relative(multipliers, caseDirectory).string()));
    }
    else if (fs::exists(multipliers, none) && !fault.empty())
    {
        faults.push_back(fmt::format("{} {}. Run limitAnalysis again.",
                                     fs::relative(multipliers, caseDirectory).string(), fault));
    }
    for (const fs::path& file : filesWithEnding(caseDirectory / "postProcessing", ".dat"))
    {
        if (const int line = readNumberTable(file).damagedLine; line > 0)
        {
            faults.push_back(fmt::format("{} is damaged in line {}: rows that are no numbers are left out.",
                                         fs::relative(file, caseDirectory).string(), line));
        }
    }
    return faults;
}

/// Whether an application, other than one of a study, has written an answer of the case.
bool hasAnswer(const fs::path& caseDirectory)
{
    std::error_code none;
    return !timesOfStates(caseDirectory).empty() || fs::exists(limitAnalysisTable(caseDirectory), none);
}

} // namespace

void addDamage(HtmlPage& page, const fs::path& caseDirectory, std::size_t freeBlocks,
               const std::vector<ReportSection>& sections)
{
    std::vector<std::string> faults = damagedResults(caseDirectory, freeBlocks);
    if (faults.empty() && sections.empty() && !hasAnswer(caseDirectory))
    {
        faults.emplace_back(
            "There is no answer to report: neither a multiplier of limitAnalysis, nor a state of "
            "contactDynamics, nor the table of a study. What was run has given none, as its log "
            "says, or its results were removed.");
    }
    if (!faults.empty())
    {
        page.heading("Results that are missing or damaged");
    }
    for (const std::string& fault : faults)
    {
        printWarning(fault);
        page.paragraph(fault);
    }
}

} // namespace drystone
