// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads tables as words under their headings; one function a study picks the columns that answer it.
#include "ensembles/StudyAnswers.h"

#include "core/WholeFile.h"
#include "ensembles/Ensemble.h"
#include "ensembles/Intensity.h"
#include "ensembles/ParameterSearch.h"
#include "ensembles/SampleStore.h"
#include "quantities/TableLine.h"
#include "runControl/CaseFiles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

/// A table of words: its heading without `#` and units, and its rows.
struct WordTable
{
    std::vector<std::string> head;
    std::vector<std::string> units; ///< of the columns, empty where there is none
    std::vector<std::string> remarks;
    std::vector<std::vector<std::string>> rows;
};

/// Of blanks between cells, or of commas: of blanks the last line with `#` is the heading, of commas the
/// first line.
WordTable readWords(const fs::path& file, char separator)
{
    WordTable table;
    std::vector<std::string> columns;
    std::istringstream stream(contentOfFile(file));
    for (TableLine line; nextLine(stream, line, separator);)
    {
        if (line.isHeading)
        {
            table.remarks.push_back(line.text.substr(std::min<std::size_t>(2, line.text.size())));
        }
        if (line.isHeading || (separator != ' ' && columns.empty()))
        {
            columns = line.words;
        }
        else if (line.words.size() == columns.size())
        {
            table.rows.push_back(line.words);
        }
    }
    for (const std::string& column : columns)
    {
        const auto [name, unit] = nameAndUnit(column);
        table.head.push_back(name);
        table.units.push_back(unit);
    }
    return table;
}

/// A number with six digits; nothing for what is not known.
std::string numberText(const std::string& cell)
{
    const std::optional<double> value = numberIn(cell);
    return !value ? cell : std::isnan(*value) ? "" : fmt::format("{:.6g}", *value);
}

/// Cells of a row in the columns of these names.
std::vector<std::string> cellsOf(const WordTable& table, const std::vector<std::string>& row,
                                 const std::vector<std::string>& names)
{
    std::vector<std::string> cells;
    for (const std::string& name : names)
    {
        const auto column = std::find(table.head.begin(), table.head.end(), name) - table.head.begin();
        const auto at = static_cast<std::size_t>(column);
        cells.push_back(at < row.size() ? numberText(row[at]) : "");
    }
    return cells;
}

/// The statistics that system/ensembleDict requests and that have no row in their table.
std::vector<std::string> missingStatistics(const fs::path& caseDirectory, const WordTable& statistics)
{
    const Dictionary dictionary = Dictionary::readFileIfPresent(caseDirectory / "system/ensembleDict");
    std::vector<std::string> missing;
    if (!dictionary.found("statistics"))
    {
        return missing;
    }
    for (const Entry& statistic : dictionary.subDict("statistics").entries())
    {
        const bool isThere = std::any_of(statistics.rows.begin(), statistics.rows.end(),
                                         [&](const std::vector<std::string>& row)
                                         { return row.front() == statistic.keyword(); });
        if (!isThere)
        {
            missing.push_back(statistic.keyword());
        }
    }
    return missing;
}

StudyAnswer answerOfEnsemble(const fs::path& caseDirectory, const fs::path& folder)
{
    StudyAnswer answer;
    const WordTable samples = readWords(folder / "samples.dat", ' ');
    std::map<int, long> counts;
    for (const std::vector<std::string>& row : samples.rows)
    {
        ++counts[std::atoi(cellsOf(samples, row, {"status"}).front().c_str())];
    }
    std::vector<std::string> parts;
    for (const auto& [status, count] : counts)
    {
        if (status >= 0 && status < sampleStatuses)
        {
            parts.push_back(fmt::format("{}: {}", textOf(static_cast<SampleStatus>(status)), count));
        }
    }
    if (!parts.empty())
    {
        answer.sentences.push_back(
            fmt::format("{} samples; {}.", samples.rows.size(), fmt::join(parts, ", ")));
        if (const long ordered = samplesOrdered(folder / "work"); std::ssize(samples.rows) < ordered)
        {
            answer.faults.push_back(
                fmt::format("samples.dat has {} of the {} samples of the design: run ensemble, "
                            "which computes those that are missing",
                            samples.rows.size(), ordered));
        }
    }
    const WordTable statistics = readWords(folder / "statistics.dat", ' ');
    const std::vector<std::string> missing = missingStatistics(caseDirectory, statistics);
    if (!parts.empty() && !missing.empty())
    {
        answer.faults.push_back(fmt::format("statistics.dat has nothing of {}: run ensemble -postProcess",
                                            fmt::join(missing, ", ")));
    }
    answer.head = {"statistic", "quantity", "value", "standard error", "95% from", "to"};
    for (const std::vector<std::string>& row : statistics.rows)
    {
        answer.rows.push_back(
            cellsOf(statistics, row, {"statistic", "quantity", "value", "standardError", "lower", "upper"}));
    }
    return answer;
}

StudyAnswer answerOfIncrementalDynamics(const fs::path&, const fs::path& folder)
{
    static constexpr std::array meanings{"the least that meets the criterion; the one below does not",
                                         "the lowest tried meets it already", "none that was tried meets it",
                                         "not known: a run below did not converge"};
    StudyAnswer answer;
    const WordTable table = readWords(folder / "leastIntensity.dat", ' ');
    for (const std::string& remark : table.remarks)
    {
        if (remark.starts_with("motion "))
        {
            answer.sentences.push_back(remark + ".");
        }
    }
    const std::string unit = table.units.size() > 1 ? table.units[1] : "";
    answer.head = {"motion", fmt::format("peak acceleration [{}]", unit), fmt::format("below [{}]", unit),
                   "runs", "meaning"};
    for (const std::vector<std::string>& row : table.rows)
    {
        answer.rows.push_back(cellsOf(table, row, {"motion", "leastIntensity", "below", "runs"}));
        const auto kind = static_cast<std::size_t>(std::atoi(cellsOf(table, row, {"kind"}).front().c_str()));
        answer.rows.back().emplace_back(kind < meanings.size() ? meanings[kind] : "");
    }
    return answer;
}

StudyAnswer answerOfParameterSearch(const fs::path&, const fs::path& folder)
{
    StudyAnswer answer;
    const WordTable table = readWords(folder / "best.dat", ' ');
    answer.head = {"quantity", "value at the best point"};
    for (const std::vector<std::string>& row : table.rows)
    {
        for (std::size_t column = 0; column < row.size(); ++column)
        {
            if (table.head[column] == "end")
            {
                const bool isConverged =
                    std::atoi(row[column].c_str()) == static_cast<int>(SearchEnd::converged);
                answer.sentences.emplace_back(isConverged ? "The search has converged."
                                                          : "The search has not converged.");
                continue;
            }
            answer.rows.push_back({table.head[column], numberText(row[column])});
        }
    }
    return answer;
}

/// Whether all rows say the same in a column.
bool isTheSameInAll(const WordTable& table, const std::string& name)
{
    return std::all_of(table.rows.begin(), table.rows.end(),
                       [&](const std::vector<std::string>& row)
                       { return cellsOf(table, row, {name}) == cellsOf(table, table.rows.front(), {name}); });
}

/// Settings that are the same in all rows are named once, those that differ have a column each.
StudyAnswer answerOfAccuracyCost(const fs::path&, const fs::path& folder)
{
    static const std::vector<std::string> settings{
        "deltaT",        "theta",         "flowRule",    "solver",         "tolerance", "pointsPerJoint",
        "pointsPerSide", "displacements", "formulation", "contactOverlap", "effects"};
    StudyAnswer answer;
    const WordTable table = readWords(folder / "accuracyCost.csv", ',');
    if (table.rows.empty())
    {
        return answer;
    }
    std::vector<std::string> names{"sweep", "quantity"};
    std::vector<std::string> common;
    for (const std::string& name : settings)
    {
        const std::string value = cellsOf(table, table.rows.front(), {name}).front();
        if (!isTheSameInAll(table, name))
        {
            names.push_back(name);
        }
        else if (value != "0" && !value.empty()) // 0: it has no meaning for these quantities
        {
            common.push_back(name + " " + value);
        }
    }
    if (!common.empty())
    {
        answer.sentences.push_back(fmt::format("In all rows: {}.", fmt::join(common, ", ")));
    }
    names.insert(names.end(), {"value", "medianError", "worstError", "cpuTime"});
    for (const std::string& name : names)
    {
        const auto column = std::find(table.head.begin(), table.head.end(), name) - table.head.begin();
        const std::string unit =
            column < std::ssize(table.head) ? table.units[static_cast<std::size_t>(column)] : "";
        answer.head.push_back(unit.empty() ? name : fmt::format("{} [{}]", name, unit));
    }
    for (const std::vector<std::string>& row : table.rows)
    {
        answer.rows.push_back(cellsOf(table, row, names));
    }
    return answer;
}

} // namespace

std::vector<StudyAnswer> answersOfStudies(const fs::path& caseDirectory)
{
    struct Study
    {
        std::string name;
        std::string table; ///< that its answer is in
        StudyAnswer (*answer)(const fs::path& caseDirectory, const fs::path& folder);
    };
    static const std::vector<Study> studies{
        {"accuracyCost", "accuracyCost.csv", answerOfAccuracyCost},
        {"ensemble", "samples.dat", answerOfEnsemble},
        {"incrementalDynamics", "leastIntensity.dat", answerOfIncrementalDynamics},
        {"parameterSearch", "best.dat", answerOfParameterSearch}};
    std::vector<StudyAnswer> answers;
    for (const Study& study : studies)
    {
        for (const std::string& time : namesIn(caseDirectory / "postProcessing" / study.name))
        {
            StudyAnswer answer =
                study.answer(caseDirectory, caseDirectory / "postProcessing" / study.name / time);
            if (answer.rows.empty() && answer.sentences.empty())
            {
                answer.faults.push_back(
                    fmt::format("{} is missing or holds nothing: the study has not come to "
                                "its end. Run {}, which repeats nothing that it has",
                                study.table, study.name));
            }
            answer.study = study.name;
            answers.push_back(std::move(answer));
        }
    }
    return answers;
}

} // namespace drystone
