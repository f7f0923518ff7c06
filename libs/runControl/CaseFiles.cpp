// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Lists the known names of each folder; others are tried in small letters, without .txt and by spelling.
#include "runControl/CaseFiles.h"

#include "core/Error.h"
#include "core/LowerCase.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

namespace fs = std::filesystem;

namespace
{

bool contains(const std::vector<std::string>& names, const std::string& name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool isThere(const fs::path& file)
{
    std::error_code ignored;
    return fs::exists(file, ignored);
}

/// The name without the ending that some editors add unasked.
std::string withoutTxt(const std::string& name)
{
    constexpr std::string_view ending = ".txt";
    return lowerCase(name).ends_with(ending) ? name.substr(0, name.size() - ending.size()) : name;
}

/// What a file in this folder was most likely meant as, relative to the case; empty when it is someone's own.
std::string meantAs(const fs::path& caseDirectory, const CaseFolder& folder, const std::string& name)
{
    const auto pathOf = [](const CaseFolder& in, const std::string& file) { return in.name + "/" + file; };
    for (const auto& [elsewhere, ours] : folder.namesElsewhere)
    {
        if (name == elsewhere)
        {
            return pathOf(folder, ours);
        }
    }
    const std::string stem = withoutTxt(name);
    if (name.front() == '.' || stem.find('.') != stem.npos || stem.ends_with("~"))
    {
        return {};
    }
    for (const std::string& known : folder.files)
    {
        const bool isAbsent = !isThere(caseDirectory / folder.name / known);
        if (lowerCase(stem) == lowerCase(known) && (stem == name || isAbsent))
        {
            return pathOf(folder, known);
        }
    }
    if (stem != name)
    {
        return {};
    }
    for (const CaseFolder& other : caseFolders())
    {
        if (contains(other.files, name) && name.size() > 1 && !isThere(caseDirectory / other.name / name))
        {
            return pathOf(other, name);
        }
    }
    const std::string nearest = nearestWord(name, folder.files);
    return nearest.empty() || isThere(caseDirectory / folder.name / nearest) ? "" : pathOf(folder, nearest);
}

[[noreturn]] void refuse(const fs::path& file, const std::string& name, const std::string& meant)
{
    throw FatalIOError(fmt::format("Nothing reads {0}. Did you mean {1}?\n\nRename it to {1}, or remove it. "
                                   "To keep it for yourself give its name an ending, as {0}.orig.",
                                   name, meant),
                       {file.lexically_normal().string(), "", 0});
}

} // namespace

std::vector<std::string> namesIn(const fs::path& folder)
{
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator file(folder, error), end; !error && file != end; file.increment(error))
    {
        names.push_back(file->path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::filesystem::path fullName(const std::filesystem::path& caseDirectory)
{
    std::error_code ignored;
    const std::filesystem::path path = std::filesystem::absolute(caseDirectory, ignored).lexically_normal();
    return path.has_filename() ? path : path.parent_path();
}

std::string caseName(const std::filesystem::path& caseDirectory)
{
    return fullName(caseDirectory).filename().string();
}

const std::vector<CaseFolder>& caseFolders()
{
    static const std::vector<CaseFolder> folders{
        {"0", {"motion", "state"}, {{"pointMotion", "motion"}}},
        {"constant",
         {"assembly", "contactProperties", "g", "groundMotion", "loads", "materialProperties",
          "supportMotion"},
         {{"physicalProperties", "materialProperties"},
          {"transportProperties", "materialProperties"},
          {"mechanicalProperties", "materialProperties"},
          {"dynamicMeshDict", "groundMotion"}}},
        {"system",
         {"accuracyCostDict", "blockTextureDict", "controlDict", "ensembleDict", "incrementalDynamicsDict",
          "parameterSearchDict", "schemes", "solution"},
         {{"fvSchemes", "schemes"}, {"fvSolution", "solution"}, {"blockMeshDict", "blockTextureDict"}}}};
    return folders;
}

void refuseMisnamedFiles(const fs::path& caseDirectory)
{
    for (const CaseFolder& folder : caseFolders())
    {
        for (const std::string& name : namesIn(caseDirectory / folder.name))
        {
            const std::string meant =
                contains(folder.files, name) ? "" : meantAs(caseDirectory, folder, name);
            if (!meant.empty())
            {
                refuse(caseDirectory / folder.name / name, folder.name + "/" + name, meant);
            }
        }
        // Beside the folders only the exact names are refused: users keep files of their own there.
        for (const std::string& name : folder.files)
        {
            std::error_code ignored;
            if (name.size() > 1 && name != "state" && fs::is_regular_file(caseDirectory / name, ignored)
                && !isThere(caseDirectory / folder.name / name))
            {
                refuse(caseDirectory / name, name, folder.name + "/" + name);
            }
        }
    }
}

} // namespace drystone
