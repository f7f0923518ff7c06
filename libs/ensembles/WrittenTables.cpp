// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Compares paths of tables with the folders that limitAnalysis and functions of controlDict write.
#include "ensembles/WrittenTables.h"

#include "core/Error.h"
#include "quantities/Figure.h"
#include "quantities/LimitAnalysisFigures.h"
#include "quantities/TableLine.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

bool runsApplication(const StudyRuns& runs, const std::string& application)
{
    return std::find(runs.applications.begin(), runs.applications.end(), application)
           != runs.applications.end();
}

/// In which of the cases a table is, and its path there; nothing where it is in none.
std::optional<std::pair<fs::path, fs::path>> placeOf(const fs::path& table, const StudyRuns& runs)
{
    for (const std::string& directory : runs.cases)
    {
        const fs::path path =
            table.lexically_normal().lexically_relative(fs::path(directory).lexically_normal());
        if (!path.empty() && *path.begin() == "postProcessing")
        {
            return std::pair(fs::path(directory), path);
        }
    }
    return std::nullopt;
}

/// Refuses a table that is in no folder of results and that the case does not have.
void requireResults(const TableFigure& figure, const fs::path& caseDirectory, const StudyRuns& runs,
                    const Dictionary& result)
{
    std::error_code ignored;
    if (fs::exists(caseDirectory / figure.table, ignored))
    {
        return;
    }
    std::vector<std::string> folders;
    for (const std::string& directory : runs.cases)
    {
        folders.push_back((fs::path(directory) / "postProcessing").lexically_normal().string());
    }
    throw FatalIOError(fmt::format("No application writes the table {}: their tables are in {}.",
                                   figure.table, fmt::join(folders, ", ")),
                       result.locationOf("table"));
}

/// Refuses a table that limitAnalysis does not write, and a column that its main one does not have.
void requireTableOfCollapse(const TableFigure& figure, const fs::path& table, const Dictionary& result)
{
    const std::vector<std::string> written{"limitAnalysis", "thrust",    "combinations", "coulomb",
                                           "movingLoad",    "loadCases", "capacity"};
    const std::string name = table.stem().string();
    const bool isOurs = std::any_of(written.begin(), written.end(),
                                    [&](const std::string& one) { return name.starts_with(one); });
    const fs::path folder = fs::path(limitAnalysisTableName).parent_path();
    if (table.parent_path() != folder && *std::next(table.begin()) == *std::next(folder.begin()))
    {
        throw FatalIOError(fmt::format("limitAnalysis writes its tables into {}, and not into {}.",
                                       folder.string(), table.parent_path().string()),
                           result.locationOf("table"));
    }
    if (table.parent_path() == folder && !(isOurs && table.extension() == ".dat"))
    {
        throw FatalIOError(unknownWordMessage("limitAnalysis table", name, written),
                           result.locationOf("table"));
    }
    const std::vector<std::string_view> headings = limitAnalysisHeadings();
    if (table == fs::path(limitAnalysisTableName) && !findColumn(headings, figure.column))
    {
        throw FatalIOError(fmt::format("{} has no column {}.\n\nIts columns: {}", limitAnalysisTableName,
                                       figure.column, fmt::join(headings, " ")),
                           result.locationOf("column"));
    }
}

/// Refuses the table of a function that a case does not have. \param name of the function
void requireFunction(const fs::path& caseDirectory, const std::string& name, const Dictionary& result)
{
    const Dictionary controlDict = Dictionary::readFileIfPresent(caseDirectory / "system/controlDict");
    std::vector<std::string> names;
    if (const Dictionary* functions = controlDict.findDict("functions"))
    {
        for (const Entry& entry : functions->entries())
        {
            if (entry.isDictionary())
            {
                names.push_back(entry.keyword());
            }
        }
    }
    if (std::find(names.begin(), names.end(), name) == names.end())
    {
        throw FatalIOError(names.empty()
                               ? fmt::format("No application writes a table into postProcessing/{}, and "
                                             "system/controlDict has no functions.",
                                             name)
                               : unknownWordMessage("controlDict function", name, names),
                           result.locationOf("table"));
    }
}

} // namespace

void requireTable(const TableFigure& figure, const fs::path& caseDirectory, const StudyRuns& runs,
                  const Dictionary& result)
{
    if (hasScript(runs))
    {
        return;
    }
    const auto place = placeOf(figure.table, runs);
    if (!place)
    {
        requireResults(figure, caseDirectory, runs, result);
        return;
    }
    const auto& [directory, table] = *place;
    if (runsApplication(runs, "limitAnalysis"))
    {
        requireTableOfCollapse(figure, table, result);
    }
    const std::string writer = std::next(table.begin())->string();
    // contactDynamics says in `effects`, without a function, which effects were simulated.
    if (runsApplication(runs, "contactDynamics") && !runsApplication(runs, writer) && writer != "effects")
    {
        requireFunction(caseDirectory / directory, writer, result);
    }
}

} // namespace drystone
