// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The tables under postProcessing/ as curves over time.
#pragma once

#include "io/Plot.h"

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// A table of numbers: `# Time[s] kinetic[J] ...`, then a row of numbers for each time.
struct NumberTable
{
    std::vector<std::string> names; ///< of the columns, without units
    std::vector<std::string> units;
    std::vector<std::vector<double>> columns;
    int damagedLine = 0; ///< of the file, the first of a row that is none, among others that are, or of one
                         ///< whose time is none; 0: none
};

/// Reads a table; rows that are no numbers, such as the last of a run that was killed, are left out, and
/// those whose Time is not finite. Empty for a file that is no such table.
NumberTable readNumberTable(const std::filesystem::path& file);

/// A plot over the first column for the columns of each unit, with at most some thousand points each: columns
/// that are zero throughout are left out. None for a table whose first column is no time, or has one that is
/// not finite. \return each with the unit of its columns
std::vector<std::pair<std::string, Plot>> historyPlots(const NumberTable& table, const std::string& title);

/// The picture of the columns of a unit in the folder of their table, without its ending: energy_J,
/// block3_m_s, and <table>_numbers for columns without a unit.
std::filesystem::path historyPicture(const std::filesystem::path& table, const std::string& unit);

/// Draws each table (.dat) of a folder over time, a picture for each unit in it: energy_J.svg,
/// block3_m_s.svg; columns without unit are in <table>_numbers. \param title of the case
/// \return number of pictures \throws FatalError naming what cannot be written
std::size_t writeHistoryPictures(const std::filesystem::path& folder, const std::string& title,
                                 const PictureFormats& formats);

} // namespace drystone
