// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Looks for a name in a folder, and for the one that is nearest to it.
#include "core/NamedFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

/// A folder may hold any number of files; the nearest of more than these nobody waits for.
constexpr std::size_t mostNames = 1000;

std::string nearestInFolder(const fs::path& file)
{
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator entry(file.parent_path().empty() ? "." : file.parent_path(), error);
         !error && entry != fs::directory_iterator() && names.size() < mostNames; entry.increment(error))
    {
        std::error_code unknown;
        if (entry->is_regular_file(unknown))
        {
            names.push_back(entry->path().filename().string());
        }
    }
    std::sort(names.begin(), names.end()); // the order of a folder is the system's
    return nearestWord(file.filename().string(), names);
}

} // namespace

void requireFile(const fs::path& file, const SourceLocation& location)
{
    std::error_code ignored;
    if (fs::exists(file, ignored))
    {
        return;
    }
    const std::string nearest = nearestInFolder(file);
    throw FatalIOError(
        fmt::format("There is no file {}.{}\n\nCheck the name: it is relative to the case directory.",
                    file.lexically_normal().string(),
                    nearest.empty() ? "" : fmt::format(" Did you mean {}?", nearest)),
        location);
}

} // namespace drystone
