// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The tables of numbers under postProcessing/.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace drystone
{

/// A table of text, one column a scalar: a heading `# Time[s]  kinetic[J]  potential[J]` and rows of numbers
/// that a plotting program reads as they are. Each row is handed to the system whole, as soon as it is
/// written, so that a run can be watched and one that is killed leaves no half row.
class ColumnFile
{
public:
    /// Begin the file, in place of one that was there; folders missing on the way are made.
    /// \param columns with their units, without blanks: `Time[s]`
    /// \param digits significant ones
    /// \throws FatalError naming the file and the system's reason
    ColumnFile(const std::filesystem::path& path, const std::vector<std::string>& columns, int digits = 12);

    /// Add a row.
    /// \param values one a column
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

/// postProcessing/<function>/<startTime>/ of a case. The start time is a run's own, so that a run that
/// continues an earlier one leaves the earlier tables alone.
std::filesystem::path postProcessingFolder(const std::filesystem::path& caseDirectory,
                                           const std::string& function, const std::string& startTime);

} // namespace drystone
