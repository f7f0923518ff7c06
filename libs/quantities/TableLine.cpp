// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Splits lines of tables into words, and names of columns from their units.
#include "quantities/TableLine.h"

#include <cstdlib>
#include <istream>
#include <iterator>
#include <sstream>

namespace drystone
{
namespace
{

/// What is between separators, without blanks at its ends.
std::vector<std::string> cellsOf(const std::string& text, char separator)
{
    std::vector<std::string> cells;
    std::istringstream stream(text + separator);
    for (std::string cell; std::getline(stream, cell, separator);)
    {
        constexpr std::string_view blanks = " \t\r";
        cell.erase(0, cell.find_first_not_of(blanks));
        cell.erase(cell.find_last_not_of(blanks) + 1);
        cells.push_back(std::move(cell));
    }
    return cells;
}

} // namespace

bool nextLine(std::istream& table, TableLine& line, char separator)
{
    if (!std::getline(table, line.text))
    {
        return false;
    }
    ++line.number;
    line.isHeading = line.text.starts_with("#");
    const std::string text = line.isHeading ? line.text.substr(1) : line.text;
    if (separator != ' ')
    {
        line.words = cellsOf(text, separator);
        return true;
    }
    std::istringstream words(text);
    line.words.assign(std::istream_iterator<std::string>(words), {});
    return true;
}

std::optional<double> numberIn(const std::string& word)
{
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    return end == word.c_str() || *end != 0 ? std::nullopt : std::optional(value);
}

std::pair<std::string, std::string> nameAndUnit(const std::string& column)
{
    const std::size_t bracket = column.find('[');
    if (bracket == std::string::npos || column.back() != ']')
    {
        return {column, ""};
    }
    return {column.substr(0, bracket), column.substr(bracket + 1, column.size() - bracket - 2)};
}

bool isColumn(std::string_view column, std::string_view name)
{
    return column == name
           || (column.size() > name.size() && column.starts_with(name) && column[name.size()] == '[');
}

} // namespace drystone
