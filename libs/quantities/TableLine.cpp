// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Splits lines of tables into words, and names of columns from their units.
#include "quantities/TableLine.h"

#include <algorithm>
#include <cstdlib>
#include <istream>

namespace drystone
{
namespace
{

constexpr std::string_view blanks = " \t\r";

/// Cuts what is between quotes off the front of a text that begins with one; all of it where no other quote
/// ends it.
std::string takeQuoted(std::string_view& text)
{
    std::string word;
    for (text.remove_prefix(1); !text.empty(); text.remove_prefix(1))
    {
        const bool isQuote = text.front() == '"';
        if (isQuote && !text.substr(1).starts_with('"'))
        {
            text.remove_prefix(1);
            return word;
        }
        text.remove_prefix(isQuote ? 1 : 0); // the first of two
        word += text.front();
    }
    return word;
}

std::string_view withoutBlanks(std::string_view text)
{
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::vector<std::string> wordsOf(std::string_view text)
{
    std::vector<std::string> words;
    for (text = withoutBlanks(text); !text.empty(); text = withoutBlanks(text))
    {
        if (text.front() == '"')
        {
            words.push_back(takeQuoted(text));
            continue;
        }
        const std::size_t end = std::min(text.find_first_of(blanks), text.size());
        words.emplace_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return words;
}

/// What is between separators, without blanks at its ends.
std::vector<std::string> cellsOf(std::string_view text, char separator)
{
    std::vector<std::string> cells;
    for (bool isLast = false; !isLast;)
    {
        text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
        std::string quoted = text.starts_with('"') ? takeQuoted(text) : "";
        const std::size_t end = text.find(separator);
        isLast = end == std::string_view::npos;
        cells.push_back(quoted.append(withoutBlanks(text.substr(0, end))));
        text.remove_prefix(isLast ? text.size() : end + 1);
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
    const std::string_view text = std::string_view(line.text).substr(line.isHeading ? 1 : 0);
    line.words = separator == ' ' ? wordsOf(text) : cellsOf(text, separator);
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
