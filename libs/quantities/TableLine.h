// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Lines of tables of words and numbers, those that the applications write and those that users give: every
/// reader of a table reads it by these.
#pragma once

#include <algorithm>
#include <iosfwd>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drystone
{

/// A line of a table: `# Time[s]  alpha[-]`, or a row.
struct TableLine
{
    int number = 0;                 ///< in its file, from 1; 0: none has been read
    bool isHeading = false;         ///< begins with `#`, which is not among its words
    std::vector<std::string> words; ///< or cells, where a table has separators
    std::string text;               ///< the whole of it
};

/// Reads the next line of a table. What is between quotes is one word or cell, without them; within it `""`
/// is a quote, as in CSV. \param line whose number goes on from that of the line before \param separator of
/// cells, which may be empty or hold blanks; a blank: words between any number of them \return whether there
/// was one
bool nextLine(std::istream& table, TableLine& line, char separator = ' ');

/// A word of a row; nothing where it is no number.
std::optional<double> numberIn(const std::string& word);

/// The name of a column and its unit, of `kinetic[J]`; the unit is empty where there is none.
std::pair<std::string, std::string> nameAndUnit(const std::string& column);

/// Whether a column `alpha[-]` is the one that a user calls `alpha`, or `alpha[-]`.
bool isColumn(std::string_view column, std::string_view name);

/// The place of the column that a user calls by a name, with or without its unit; nothing where there is
/// none.
template<class Columns>
std::optional<std::size_t> findColumn(const Columns& columns, std::string_view name)
{
    const auto found = std::find_if(std::begin(columns), std::end(columns),
                                    [name](std::string_view column) { return isColumn(column, name); });
    return found == std::end(columns) ? std::nullopt
                                      : std::optional(static_cast<std::size_t>(found - std::begin(columns)));
}

} // namespace drystone
