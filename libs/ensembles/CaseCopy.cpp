// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Copies file by file, with includes that lead out of the case.
#include "ensembles/CaseCopy.h"

#include "core/Error.h"
#include "core/WholeFile.h"
#include "dictionary/CopiedIncludes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

/// Whether an entry of a case directory is a result, or belongs to a search.
bool isLeftOut(const fs::path& path)
{
    const std::string name = path.filename().string();
    if (name == "VTK" || name == "postProcessing" || name == "parameterSearch" || name.starts_with("log.")
        || name.starts_with("."))
    {
        return true;
    }
    char* end = nullptr;
    const double time = std::strtod(name.c_str(), &end);
    return end != name.c_str() && *end == 0 && time != 0 && fs::is_directory(path);
}

/// A copy of a file, whose included files are where those of the file are. What is written into it is the
/// study's: a file that is write-protected has a copy that is not.
void copyFile(const fs::path& file, const fs::path& to, const fs::path& caseDirectory)
{
    const fs::perms permissions = fs::status(file).permissions() | fs::perms::owner_write;
    constexpr std::uintmax_t largestDictionary = 1 << 20; // with includes; records and the like are larger
    if (fs::file_size(file) <= largestDictionary)
    {
        std::ifstream stream(file, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        const std::string there = withFilesFromOutside(text, file, caseDirectory);
        if (there != text)
        {
            writeWholeFile(to, there);
            fs::permissions(to, permissions);
            return;
        }
    }
    fs::copy_file(file, to, fs::copy_options::overwrite_existing);
    fs::permissions(to, permissions);
}

void copyInto(const fs::path& from, const fs::path& to, const fs::path& caseDirectory)
{
    fs::create_directories(to);
    for (const fs::directory_entry& entry : fs::directory_iterator(from))
    {
        if (isLeftOut(entry.path()))
        {
            continue;
        }
        if (entry.is_directory())
        {
            copyInto(entry.path(), to / entry.path().filename(), caseDirectory);
        }
        else if (entry.is_regular_file())
        {
            copyFile(entry.path(), to / entry.path().filename(), caseDirectory);
        }
    }
}

void listFiles(const fs::path& folder, std::vector<fs::path>& files)
{
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    {
        if (isLeftOut(entry.path()))
        {
            continue;
        }
        if (entry.is_directory())
        {
            listFiles(entry.path(), files);
        }
        else if (entry.is_regular_file())
        {
            files.push_back(entry.path());
        }
    }
}

} // namespace

void copyCase(const fs::path& caseDirectory, const fs::path& target)
{
    try
    {
        fs::remove_all(target);
        copyInto(caseDirectory, target, caseDirectory);
    }
    catch (const fs::filesystem_error& error)
    {
        throw FatalError(
            fmt::format("Cannot copy the case to {}: {}.\n\nCheck that its folder may be written and "
                        "that the disk has room.",
                        target.string(), error.code().message()));
    }
}

std::vector<fs::path> filesOfCase(const fs::path& caseDirectory)
{
    std::vector<fs::path> files;
    listFiles(caseDirectory, files);
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace drystone
