// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads tables and draws them over time.
#include "functionObjects/Histories.h"

#include "quantities/TableLine.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

namespace drystone
{

namespace
{

/// What the columns of a unit are, for the label of an axis.
std::string quantityOf(const std::string& unit)
{
    constexpr std::array names{std::pair{"m", "displacement"},    std::pair{"rad", "rotation"},
                               std::pair{"m/s", "velocity"},      std::pair{"rad/s", "angular velocity"},
                               std::pair{"m/s2", "acceleration"}, std::pair{"N", "force"},
                               std::pair{"Nm", "moment"},         std::pair{"J", "energy"},
                               std::pair{"s", "elapsed time"}};
    for (const auto& [of, name] : names)
    {
        if (unit == of)
        {
            return fmt::format("{} [{}]", name, unit);
        }
    }
    return fmt::format("[{}]", unit);
}

/// All rows; or where they are more than `most` the first and the last, and of each few in a row those with
/// the least and the largest value: what lasts a single step, as the force of an impact, is drawn.
std::vector<std::size_t> rowsToDraw(const std::vector<double>& values, std::size_t most)
{
    const std::size_t few = values.size() > most ? 2 * values.size() / most + 1 : 1;
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < values.size(); row += few)
    {
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row);
        const auto end = values.begin() + static_cast<std::ptrdiff_t>(std::min(row + few, values.size()));
        const auto [least, largest] = std::minmax_element(begin, end);
        std::vector<std::size_t> drawn{static_cast<std::size_t>(least - values.begin()),
                                       static_cast<std::size_t>(largest - values.begin())};
        if (row == 0)
        {
            drawn.push_back(0);
        }
        if (end == values.end())
        {
            drawn.push_back(values.size() - 1);
        }
        std::sort(drawn.begin(), drawn.end());
        rows.insert(rows.end(), drawn.begin(), std::unique(drawn.begin(), drawn.end()));
    }
    return rows;
}

} // namespace

NumberTable readNumberTable(const std::filesystem::path& file)
{
    NumberTable table;
    std::ifstream stream(file);
    TableLine line;
    if (!nextLine(stream, line) || !line.isHeading)
    {
        return table;
    }
    for (const std::string& column : line.words)
    {
        const auto [name, unit] = nameAndUnit(column);
        table.names.push_back(name);
        table.units.push_back(unit);
    }
    table.columns.resize(table.names.size());
    int firstLeftOut = 0;
    bool hasNoTime = false;
    while (nextLine(stream, line))
    {
        std::vector<double> numbers;
        for (const std::string& word : line.words)
        {
            if (const std::optional<double> number = numberIn(word))
            {
                numbers.push_back(*number);
            }
        }
        // A row of no moment is none either: what is drawn over time needs one.
        const bool isOfTime = table.names.empty() || table.names.front() != "Time" || numbers.empty()
                              || std::isfinite(numbers.front());
        const bool isRow =
            line.words.size() == table.names.size() && numbers.size() == table.names.size() && isOfTime;
        hasNoTime = hasNoTime || !isOfTime;
        for (std::size_t column = 0; isRow && column < numbers.size(); ++column)
        {
            table.columns[column].push_back(numbers[column]);
        }
        if (!isRow && !line.isHeading && !line.words.empty() && firstLeftOut == 0)
        {
            firstLeftOut = line.number;
        }
    }
    const bool hasRows = !table.columns.empty() && !table.columns.front().empty();
    table.damagedLine = hasRows || hasNoTime ? firstLeftOut : 0; // others have words in each row
    return table;
}

std::filesystem::path historyPicture(const std::filesystem::path& table, const std::string& unit)
{
    std::string ending = unit == "-" ? "numbers" : unit;
    std::replace(ending.begin(), ending.end(), '/', '_');
    return table.parent_path() / (table.stem().string() + "_" + ending);
}

std::size_t writeHistoryPictures(const std::filesystem::path& folder, const std::string& title,
                                 const PictureFormats& formats)
{
    std::vector<std::filesystem::path> tables;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    {
        if (entry.path().extension() == ".dat")
        {
            tables.push_back(entry.path());
        }
    }
    std::size_t count = 0;
    for (const std::filesystem::path& file : tables)
    {
        const NumberTable table = readNumberTable(file);
        const std::string name = file.stem().string();
        // A function with the name of its table is named once.
        const std::string full = title.ends_with(", " + name) ? title : title + ", " + name;
        for (const auto& [unit, plot] : historyPlots(table, full))
        {
            writePlot(historyPicture(file, unit), plot, formats);
            ++count;
        }
    }
    return count;
}

std::vector<std::pair<std::string, Plot>> historyPlots(const NumberTable& table, const std::string& title)
{
    constexpr std::size_t mostPoints = 2000;
    std::vector<std::pair<std::string, Plot>> plots;
    if (table.names.size() < 2 || table.names.front() != "Time" || table.columns.front().size() < 2)
    {
        return plots;
    }
    const std::vector<double>& times = table.columns.front();
    if (!std::all_of(times.begin(), times.end(), [](double time) { return std::isfinite(time); }))
    {
        return plots;
    }
    std::vector<std::string> drawn;
    for (std::size_t first = 1; first < table.names.size(); ++first)
    {
        const std::string& unit = table.units[first];
        if (std::find(drawn.begin(), drawn.end(), unit) != drawn.end())
        {
            continue;
        }
        drawn.push_back(unit);
        Plot plot;
        plot.title = title;
        plot.x.label = "time [s]";
        plot.y.label = quantityOf(unit);
        for (std::size_t column = first; column < table.names.size(); ++column)
        {
            const std::vector<double>& values = table.columns[column];
            const bool isZero =
                std::all_of(values.begin(), values.end(), [](double value) { return value == 0; });
            const bool isFinite =
                std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
            if (table.units[column] != unit || isZero || !isFinite)
            {
                continue;
            }
            PlotCurve curve;
            curve.name = table.names[column];
            curve.marker = CurveMarker::none;
            for (const std::size_t row : rowsToDraw(values, mostPoints))
            {
                curve.x.push_back(times[row]);
                curve.y.push_back(values[row]);
            }
            plot.curves.push_back(std::move(curve));
        }
        if (!plot.curves.empty())
        {
            plots.emplace_back(unit, std::move(plot));
        }
    }
    return plots;
}

} // namespace drystone
