// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Looking at case directories.
#include "runControl/Case.h"

#include "core/Error.h"
#include "dictionary/FilesInMemory.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <unistd.h>

namespace drystone
{

namespace fs = std::filesystem;

void refuseUnreadable(const fs::path& caseDirectory, std::error_code failure)
{
    const bool isAbsent =
        !failure || failure == std::errc::no_such_file_or_directory || failure == std::errc::not_a_directory;
    if (!isAbsent)
    {
        std::error_code ignored;
        throw FatalError(
            fmt::format("The case directory {} cannot be read: {}.\n\nPermit reading it and the "
                        "folders that it is in (chmod u+rx), or name another one with -case DIR.",
                        fs::absolute(caseDirectory, ignored).lexically_normal().string(), failure.message()));
    }
}

void requireCase(const fs::path& caseDirectory)
{
    std::error_code ofSystem;
    std::error_code ofConstant;
    if (fs::is_directory(caseDirectory / "system", ofSystem)
        || fs::is_directory(caseDirectory / "constant", ofConstant))
    {
        return;
    }
    refuseUnreadable(caseDirectory, ofSystem);
    std::error_code ignored;
    throw FatalError(fmt::format("{} is not a case directory: it has neither system/ nor constant/.\n\nName "
                                 "one with -case DIR. A case begins with system/blockTextureDict, from which "
                                 "blockTexture builds the blocks, and system/controlDict; the cases in "
                                 "tutorials/ are there to be copied.",
                                 fs::absolute(caseDirectory, ignored).lexically_normal().string()));
}

fs::path requireCaseFile(const fs::path& caseDirectory, const fs::path& file, const std::string& repair)
{
    fs::path path = (caseDirectory / file).lexically_normal();
    if (isInMemory(path))
    {
        return path;
    }
    requireCase(caseDirectory);
    std::error_code ignored;
    if (!fs::exists(path, ignored))
    {
        throw FatalIOError(fmt::format("There is no {}.\n\n{}", file.string(), repair),
                           {path.string(), "", 0});
    }
    if (fs::is_directory(path, ignored))
    {
        throw FatalIOError(
            fmt::format("{} is a directory, and a file is needed.\n\n{}", file.string(), repair),
            {path.string(), "", 0});
    }
    if (::access(path.c_str(), R_OK) != 0)
    {
        throw FatalIOError(
            fmt::format("{} may not be read.\n\nPermit reading it (chmod u+r).", file.string()),
            {path.string(), "", 0});
    }
    return path;
}

std::vector<TimeDirectory> timeDirectories(const fs::path& caseDirectory)
{
    std::vector<TimeDirectory> result;
    std::error_code failure;
    for (const fs::directory_entry& entry : fs::directory_iterator(caseDirectory, failure))
    {
        const std::string name = entry.path().filename().string();
        double time = 0;
        const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), time);
        if (error == std::errc() && end == name.data() + name.size() && std::isfinite(time)
            && entry.is_directory(failure))
        {
            result.push_back({time, name});
        }
    }
    std::sort(result.begin(), result.end(),
              [](const TimeDirectory& a, const TimeDirectory& b)
              { return a.time < b.time || (a.time == b.time && a.name < b.name); });
    return result;
}

} // namespace drystone
