// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A number in a table that an application has written: the figure of a run that is known by its files only.
#pragma once

#include "dictionary/Options.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// Which of several numbers, those of a column or of the instants of a motion, is used.
enum class Take
{
    last,
    first,
    minimum,
    maximum,
    largest, ///< the one farthest from zero, without its sign
    mean,
};
inline std::array<std::pair<std::string_view, Take>, 6> namesOf(Take)
{
    return {{{"last", Take::last},
             {"first", Take::first},
             {"minimum", Take::minimum},
             {"maximum", Take::maximum},
             {"largest", Take::largest},
             {"mean", Take::mean}}};
}

/// The one number of several. \return nan where there are none, or one that counts is not a number
double taken(const std::vector<double>& values, Take take);

/// A number in a table of the applications.
struct TableFigure
{
    std::string table;  ///< in the case directory
    std::string column; ///< its name, with or without the unit in brackets
    Take take = Take::last;
};
void declare(Options& options, TableFigure& figure);

/// A path that stays within the case directory.
bool isInsideCase(const std::string& path);

/// A column of a table of numbers whose last comment line names the columns, `# Time[s]  alpha[-]`.
/// \param name with or without the unit
/// \return nothing when the file does not exist
/// \throws FatalError when it is not such a table, or has no such column: the message lists its columns
std::optional<std::vector<double>> readColumn(const std::filesystem::path& table, const std::string& name);

} // namespace drystone
