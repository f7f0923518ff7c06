// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The tables of numbers under postProcessing/, common to all function objects.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace drystone
{

/// A text table with one column per scalar: a heading `# Time[s]  kinetic[J]  potential[J]` and rows of
/// numbers that plotting programs read directly. Each row is written by a single system call as soon as it is
/// complete, so that a run can be observed and one that is killed leaves no partial row.
class ColumnFile
{
public:
    /// Starts the file and replaces an existing one; missing folders are created.
    /// \param columns with their units, without blanks: `Time[s]`
    /// \param digits significant ones
    /// \param notes lines of comment above the columns
    /// \throws FatalError naming the file and the system's reason
    ColumnFile(const std::filesystem::path& path, const std::vector<std::string>& columns, int digits = 12,
               const std::vector<std::string>& notes = {});

    /// Adds a row.
    /// \param values one per column
    /// \throws FatalError naming the file and the system's reason, such as a full disk
    void write(std::span<const double> values);

private:
    struct Close
    {
        void operator()(std::FILE* opened) const { std::fclose(opened); }
    };

    std::filesystem::path file;
    std::size_t columnCount;
    int precision;
    std::unique_ptr<std::FILE, Close> stream;

    void put(const std::string& line);
};

/// The titles of the columns of a table, and a row of it, as ColumnFile writes them: each a line with its
/// end.
std::string columnTitles(const std::vector<std::string>& columns);
std::string columnRow(std::span<const double> values, int digits);

/// postProcessing/<function>/<startTime>/ of a case. The start time is that of the run, so that a run that
/// continues an earlier one leaves its tables unchanged.
std::filesystem::path postProcessingFolder(const std::filesystem::path& caseDirectory,
                                           const std::string& function, const std::string& startTime);

} // namespace drystone
