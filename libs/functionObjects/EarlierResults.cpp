// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/EarlierResults.h"

#include "runControl/Case.h"
#include "runControl/CaseFiles.h"

#include <algorithm>
#include <string_view>

namespace drystone
{
namespace
{

constexpr std::string_view picture = "mechanism";
constexpr std::string_view extension = ".svg";

/// A series of frames with its list.
void removeSeries(const std::filesystem::path& folder, const std::string& name)
{
    std::error_code ignored;
    for (const std::string& file : namesIn(folder))
    {
        const std::string_view rest = std::string_view(file).substr(std::min(file.size(), name.size()));
        const bool isFrame =
            rest.starts_with("_") && rest.ends_with(".vtp") && rest.size() > 5
            && rest.substr(1, rest.size() - 5).find_first_not_of("0123456789") == std::string_view::npos;
        if (file.starts_with(name) && (isFrame || rest == ".vtp.series"))
        {
            std::filesystem::remove(folder / file, ignored);
        }
    }
}

} // namespace

std::vector<std::string> removeEarlierResults(const std::filesystem::path& caseDirectory,
                                              const std::vector<std::string>& suffixes)
{
    const std::filesystem::path folder = caseDirectory / "postProcessing/limitAnalysis/0";
    const std::filesystem::path series = caseDirectory / "VTK";
    std::vector<std::string> removed;
    for (const std::string& name : namesIn(folder))
    {
        if (!name.starts_with(picture) || !name.ends_with(extension))
        {
            continue;
        }
        const std::string suffix =
            name.substr(picture.size(), name.size() - picture.size() - extension.size());
        const bool isOurs = suffix.empty() || suffix == "Negative" || suffix.starts_with("_");
        if (!isOurs || std::find(suffixes.begin(), suffixes.end(), suffix) != suffixes.end())
        {
            continue;
        }
        std::error_code ignored;
        for (const std::string& file :
             {name, "thrust" + suffix + ".svg", "thrust" + suffix + ".dat", "coulomb" + suffix + ".dat"})
        {
            std::filesystem::remove(folder / file, ignored);
        }
        removeSeries(series, "thrust" + suffix);
        if (!suffix.empty() || timeDirectories(caseDirectory).empty())
        {
            removeSeries(series, "blocks" + suffix);
            removeSeries(series, "contacts" + suffix);
        }
        removed.push_back(name);
    }
    return removed;
}

} // namespace drystone
