// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Copies of a case, applications run in them, and numbers taken from the tables that they leave.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// Copies what a case is made of: all but results (VTK, postProcessing, logs, times other than 0) and what a
/// search leaves (parameterSearch). What was at `target` is removed. \throws FatalError
void copyCase(const std::filesystem::path& caseDirectory, const std::filesystem::path& target);

/// A number that differs, but for bad luck, when a text does.
std::uint64_t fingerprint(std::string_view text);

/// The same of the files that copyCase copies. \param leftOut a file that does not count, in the case
/// directory
std::uint64_t fingerprint(const std::filesystem::path& caseDirectory, const std::string& leftOut);

/// The rows that a study which was interrupted has left.
/// \param heading comment lines that say what the rows depend on \param numbers in a row
/// \param study name of its folder in postProcessing, for messages
/// \return nothing when there is no such file
/// \throws FatalError when the heading is another one, or a row is none
std::vector<std::vector<double>> readHistory(const std::filesystem::path& file, const std::string& heading,
                                             std::size_t numbers, const std::string& study);

/// What came of an application.
struct ApplicationRun
{
    int status = 0;             ///< exit status; 128 + signal when one has ended it
    bool isInterrupted = false; ///< this program was asked to stop while it ran
    std::string lastWords;      ///< on standard error
};

/// Runs an application of Drystone, the one beside the program that runs, in a case; what it says goes to
/// log.<application> there. A signal that asks this program to stop is passed on.
/// \throws FatalError when there is no such application
ApplicationRun runInCase(const std::string& application, const std::filesystem::path& caseDirectory,
                         const std::vector<std::string>& options);

/// A column of a table of numbers whose last comment line names the columns, `# Time[s]  alpha[-]`.
/// \param name with or without the unit
/// \return nothing when the file is not there
/// \throws FatalError when it is not such a table, or has no such column: the message names those it has
std::optional<std::vector<double>> readColumn(const std::filesystem::path& table, const std::string& name);

} // namespace drystone
