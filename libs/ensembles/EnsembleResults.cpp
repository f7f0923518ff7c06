// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Collects, evaluates and writes the samples of an ensemble.
#include "ensembles/EnsembleResults.h"

#include "core/Log.h"
#include "core/WholeFile.h"
#include "dictionary/NamesIn.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

/// A cell of samples.dat: words with blanks or signs between quotes.
std::string cell(const SampleValue& value)
{
    const bool isPlain = value.text.find_first_of(" \t\",;#") == std::string::npos;
    return isPlain && !value.text.empty() ? value.text : fmt::format("\"{}\"", value.text);
}

void writeTable(const Ensemble& ensemble, const std::map<long, SampleRow>& rows)
{
    const EnsembleSettings& settings = ensemble.settings;
    std::string heading = "# sample[-]";
    std::string titles = "sample";
    for (const auto& [name, variable] : settings.variables)
    {
        heading += " " + name;
        titles.append(",").append(name);
    }
    for (const auto& [name, figure] : settings.results)
    {
        heading += figure.unit.empty() ? fmt::format(" {}", name) : fmt::format(" {}[{}]", name, figure.unit);
        titles.append(",").append(name);
    }
    std::string table = heading + " status[-] attempts[-] cpuTime[s]\n";
    std::string commas = titles + ",status,attempts,cpuTime\n";
    for (const auto& [sample, row] : rows)
    {
        std::string line = fmt::format("{}", sample);
        for (const SampleValue& value : ensemble.sampler->at(sample))
        {
            line.append(" ").append(cell(value));
        }
        for (const double result : row.results)
        {
            line += fmt::format(" {}", result);
        }
        line += fmt::format(" {} {} {:.3g}\n", static_cast<int>(row.status), row.attempts, row.cpuTime);
        table += line;
        bool isQuoted = false;
        for (const char c : line)
        {
            isQuoted = isQuoted != (c == '"');
            commas += c == ' ' && !isQuoted ? ',' : c;
        }
    }
    const fs::path folder = ensembleFolder(ensemble.caseDirectory);
    writeWholeFile(folder / "samples.dat", table);
    writeWholeFile(folder / "samples.csv", commas);
}

/// The first result over a variable.
void writeScatter(const Ensemble& ensemble, const SampleTable& table, std::size_t variable)
{
    constexpr std::size_t mostPoints = 2000; // more only make the file large
    const std::size_t result = table.variables;
    Plot plot;
    plot.x.label = table.names[variable];
    plot.y.label = table.names[result];
    plot.title = fmt::format("{} over {}", table.names[result], table.names[variable]);
    PlotCurve points{"", {}, {}, CurveLine::none, CurveMarker::circle, {}};
    for (std::size_t row = 0; row < table.rows() && points.x.size() < mostPoints; ++row)
    {
        const double x = table.columns[variable][row];
        const double y = table.columns[result][row];
        if (!table.isFailed[row] && std::isfinite(x) && std::isfinite(y))
        {
            points.x.push_back(x);
            points.y.push_back(y);
        }
    }
    if (points.x.size() < 2)
    {
        return;
    }
    plot.subtitle = points.x.size() < table.rows()
                        ? fmt::format("{} of {} samples", points.x.size(), table.rows())
                        : fmt::format("{} samples", table.rows());
    plot.curves.push_back(std::move(points));
    writePlot(ensembleFolder(ensemble.caseDirectory) / fmt::format("scatter_{}", table.names[variable]), plot,
              ensemble.pictureFormats);
}

/// How many failed, in which way, and the first message of each way.
long printFailures(const Ensemble& ensemble, const std::map<long, SampleRow>& rows)
{
    std::array<long, sampleStatuses> counts{};
    std::array<long, sampleStatuses> first{};
    for (const auto& [sample, row] : rows)
    {
        const auto status = static_cast<std::size_t>(row.status);
        first[status] = counts[status]++ == 0 ? sample : first[status];
    }
    long failed = 0;
    const std::vector<FailedAttempt> attempts = readFailures(ensembleWork(ensemble.caseDirectory));
    for (std::size_t status = 1; status < counts.size(); ++status)
    {
        if (counts[status] == 0)
        {
            continue;
        }
        const bool isFailed = isFailure(static_cast<SampleStatus>(status));
        failed += isFailed ? counts[status] : 0;
        const auto message =
            std::find_if(attempts.begin(), attempts.end(),
                         [&](const FailedAttempt& attempt) { return attempt.sample == first[status]; });
        info("{} samples: {}, the first is {}{}", counts[status], textOf(static_cast<SampleStatus>(status)),
             first[status], isFailed && message != attempts.end() ? ": " + message->message : "");
    }
    return failed;
}

/// What workers had to warn of: each line once.
void printMessages(const Ensemble& ensemble)
{
    std::error_code error;
    for (fs::directory_iterator file(ensembleWork(ensemble.caseDirectory), error), end; !error && file != end;
         file.increment(error))
    {
        if (file->path().filename().string().starts_with("messages.")
            && fs::file_size(file->path(), error) > 0)
        {
            info("Samples had warnings: see {}", file->path().string());
            return;
        }
    }
}

std::string numberText(double value)
{
    return std::isnan(value) ? "-" : fmt::format("{:.6g}", value);
}

void printSamples(const Ensemble& ensemble, const std::map<long, SampleRow>& rows)
{
    double cpuTime = 0;
    for (const auto& [sample, row] : rows)
    {
        cpuTime += row.cpuTime;
    }
    printLine();
    info("Samples: {} of {}{}, {:.3g} s CPU time, {:.3g} ms a sample", rows.size(), ensemble.samples(),
         static_cast<long>(rows.size()) < ensemble.samples() ? " so far" : "", cpuTime,
         rows.empty() ? 0 : 1000 * cpuTime / static_cast<double>(rows.size()));
}

void printStatistic(const std::string& name, const StatisticResult& result)
{
    printLine();
    info("{}", name);
    for (const StatisticRow& row : result.rows)
    {
        const bool hasError = !std::isnan(row.standardError);
        const bool hasInterval = !std::isnan(row.lower);
        info("    {} = {}{}{}", row.quantity, numberText(row.value),
             hasError ? ", standard error " + numberText(row.standardError) : "",
             hasInterval ? fmt::format(", 95% from {} to {}", numberText(row.lower), numberText(row.upper))
                         : "");
    }
    for (const std::string& remark : result.remarks)
    {
        info("    {}.", remark);
    }
}

/// An expression may have blanks, a column may not.
std::string columnText(std::string expression)
{
    std::erase(expression, ' ');
    return expression;
}

/// Of statistics.dat.
std::string linesOf(const std::string& name, const StatisticResult& result)
{
    std::string text;
    for (const StatisticRow& row : result.rows)
    {
        text += fmt::format("{} {} {:.12g} {:.12g} {:.12g} {:.12g}\n", name, columnText(row.quantity),
                            row.value, row.standardError, row.lower, row.upper);
    }
    return text;
}

std::string curveText(const StatisticTable& table)
{
    std::vector<std::string> columns;
    for (const std::string& column : table.columns)
    {
        columns.push_back(columnText(column));
    }
    std::string text = fmt::format("# {}\n", fmt::join(columns, " "));
    for (const std::vector<double>& row : table.rows)
    {
        std::string line;
        for (const double value : row)
        {
            line += fmt::format("{}{:.12g}", line.empty() ? "" : " ", value);
        }
        text += line + "\n";
    }
    return text;
}

/// The table and the pictures of a statistic that has them.
void writeStatistic(const Ensemble& ensemble, const std::string& name, const StatisticResult& result)
{
    const fs::path folder = ensembleFolder(ensemble.caseDirectory);
    if (!result.table.rows.empty())
    {
        writeWholeFile(folder / (name + ".dat"), curveText(result.table));
    }
    for (const auto& [suffix, plot] : result.pictures)
    {
        writePlot(folder / (name + suffix), plot, ensemble.pictureFormats);
    }
}

} // namespace

SampleTable collectSamples(const Ensemble& ensemble, std::map<long, SampleRow>& rows)
{
    const EnsembleSettings& settings = ensemble.settings;
    std::vector<Doubt> doubts;
    rows = readJournals(ensembleWork(ensemble.caseDirectory), settings.results.size(), &doubts);
    question(doubts);
    rows.erase(rows.lower_bound(ensemble.samples()), rows.end()); // of an earlier, longer table
    SampleTable table;
    table.variables = settings.variables.size();
    table.names = namesIn(settings.variables, settings.results);
    table.columns.resize(table.names.size());
    table.texts.resize(table.variables);
    table.requested = ensemble.samples();
    table.sensitivityRuns = settings.design.sensitivity ? static_cast<long>(table.variables) + 2 : 0;
    table.isGrid = settings.design.type == DesignType::grid && ensemble.samples() > settings.design.repeats;
    for (const auto& [sample, row] : rows)
    {
        const std::vector<SampleValue> values = ensemble.sampler->at(sample);
        for (std::size_t k = 0; k < values.size(); ++k)
        {
            table.columns[k].push_back(values[k].number);
            table.texts[k].push_back(values[k].text);
        }
        for (std::size_t k = 0; k < row.results.size(); ++k)
        {
            table.columns[table.variables + k].push_back(row.results[k]);
        }
        table.isFailed.push_back(isFailure(row.status));
    }
    return table;
}

int writeEnsemble(const Ensemble& ensemble, const std::map<long, SampleRow>& rows, const SampleTable& table)
{
    writeTable(ensemble, rows);
    printSamples(ensemble, rows);
    const long failed = printFailures(ensemble, rows);
    printMessages(ensemble);
    if (rows.empty())
    {
        return 0;
    }
    std::string text = "# statistic quantity value standardError lower upper\n";
    for (const auto& [name, statistic] : ensemble.settings.statistics)
    {
        const StatisticResult result = statistic.evaluate(name, table);
        printStatistic(name, result);
        text += linesOf(name, result);
        writeStatistic(ensemble, name, result);
    }
    writeWholeFile(ensembleFolder(ensemble.caseDirectory) / "statistics.dat", text);
    for (std::size_t variable = 0; variable < table.variables; ++variable)
    {
        writeScatter(ensemble, table, variable);
    }
    printLine();
    const auto part = static_cast<double>(failed) / static_cast<double>(rows.size());
    if (part > ensemble.settings.failures.maximumPart)
    {
        info("{} of {} samples have failed, more than maximumPart {:g} of them", failed, rows.size(),
             ensemble.settings.failures.maximumPart);
        return 2;
    }
    return 0;
}

} // namespace drystone
