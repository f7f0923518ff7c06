// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Writes the whole table anew with each point, under a heading of all that its rows depend on.
#include "ensembles/SearchHistory.h"

#include "core/WholeFile.h"
#include "ensembles/StudyHistory.h"
#include "functionObjects/ColumnFile.h"

#include <fmt/format.h>

namespace drystone
{
namespace
{

/// Everything that the points of a history depend on.
std::string historyHeading(const ParameterSearch& search)
{
    const ParameterSearchSettings& settings = search.settings;
    std::string text = search.caseInput
                       + fmt::format("# applications {} in {}", fmt::join(settings.applications, " "),
                                     fmt::join(settings.cases, " "));
    for (const auto& [name, variable] : settings.variables)
    {
        text += fmt::format("; {} = {}/{}", name, variable.place.file, variable.place.entry);
    }
    for (const auto& [name, result] : settings.results)
    {
        text += fmt::format("; {} = {} {} {}", name, result.figure.table, result.figure.column,
                            int(result.figure.take));
    }
    text += "\n#";
    for (const auto& [name, variable] : settings.variables)
    {
        text += " " + name;
    }
    for (const auto& [name, result] : settings.results)
    {
        text += " " + name;
    }
    return text + " exitStatus[-] cpuTime[s]\n";
}

} // namespace

std::filesystem::path searchFolder(const std::filesystem::path& caseDirectory)
{
    return postProcessingFolder(caseDirectory, parameterSearchName, "0");
}

SearchHistory::SearchHistory(const ParameterSearch& parameterSearch)
    : search(parameterSearch), file(searchFolder(search.caseDirectory) / "history.dat")
{
    const std::size_t variables = search.settings.variables.size();
    const std::size_t numbers = variables + search.settings.results.size() + 2;
    const auto take = [&](const HistoryRow& row)
    {
        SearchRecord record;
        std::size_t column = 0;
        for (; column < variables; ++column)
        {
            record.variables.push_back(row.finite(column));
        }
        for (; column < numbers - 2; ++column)
        {
            record.results.push_back(row.number(column));
        }
        constexpr int mostStatus = 255;
        record.exitStatus = row.wholeInt(numbers - 2, 0, mostStatus);
        record.cpuTime = row.finite(numbers - 1, 0);
        if (find(record.variables))
        {
            row.refuse(0, "what no row before has"
                              + std::string(variables > 1 ? " with the same other variables" : ""));
        }
        places[record.variables] = knownRecords.size();
        knownRecords.push_back(std::move(record));
    };
    readHistory(file, historyHeading(search), numbers, parameterSearchName, take);
}

const SearchRecord* SearchHistory::find(const std::vector<double>& variables) const
{
    const auto found = places.find(variables);
    return found == places.end() ? nullptr : &knownRecords[found->second];
}

void SearchHistory::add(SearchRecord record)
{
    places[record.variables] = knownRecords.size();
    knownRecords.push_back(std::move(record));
    std::string text = historyHeading(search);
    for (const SearchRecord& known : knownRecords)
    {
        // The fewest digits that read back as the same number.
        text += historyRow(fmt::format("{}  {}  {}  {:.3g}", fmt::join(known.variables, "  "),
                                       fmt::join(known.results, "  "), known.exitStatus, known.cpuTime));
    }
    writeWholeFile(file, text);
}

} // namespace drystone
