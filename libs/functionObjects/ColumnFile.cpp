// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Writes the tables under postProcessing/ so that no row is ever incomplete on disk.
#include "functionObjects/ColumnFile.h"

#include "core/Error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace drystone
{

namespace
{

[[noreturn]] void refuse(const std::filesystem::path& file, int reason)
{
    throw FatalError(
        fmt::format("Cannot write {}: {}.\n\nMake room on the disk, or permit writing there, and run again.",
                    file.string(), std::strerror(reason)));
}

} // namespace

ColumnFile::ColumnFile(const std::filesystem::path& path, const std::vector<std::string>& columns, int digits,
                       const std::vector<std::string>& notes)
    : file(path), columnCount(columns.size()), precision(digits)
{
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    if (error)
    {
        refuse(file.parent_path(), error.value());
    }
    stream.reset(std::fopen(file.c_str(), "w"));
    if (!stream)
    {
        refuse(file, errno);
    }
    std::setvbuf(stream.get(), nullptr, _IONBF, 0); // a row that is longer than a buffer would go in two
    for (const std::string& note : notes)
    {
        put("# " + note + "\n");
    }
    put(columnTitles(columns));
}

void ColumnFile::write(std::span<const double> values)
{
    if (values.size() != columnCount)
    {
        throw std::logic_error(
            fmt::format("{} values for the {} columns of {}", values.size(), columnCount, file.string()));
    }
    put(columnRow(values, precision));
}

void ColumnFile::put(const std::string& line)
{
    if (std::fwrite(line.data(), 1, line.size(), stream.get()) != line.size())
    {
        refuse(file, errno);
    }
}

std::string columnTitles(const std::vector<std::string>& columns)
{
    return fmt::format("# {}\n", fmt::join(columns, "  "));
}

std::string columnRow(std::span<const double> values, int digits)
{
    std::string line;
    for (const double value : values)
    {
        line += fmt::format("{}{:.{}g}", line.empty() ? "" : "  ", value, digits);
    }
    return line + "\n";
}

std::filesystem::path postProcessingFolder(const std::filesystem::path& caseDirectory,
                                           const std::string& function, const std::string& startTime)
{
    return caseDirectory / "postProcessing" / function / startTime;
}

} // namespace drystone
