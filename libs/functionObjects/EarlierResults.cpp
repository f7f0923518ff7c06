// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Finds answers by their pictures, and frames of their series by name, number and ending.
#include "functionObjects/EarlierResults.h"

#include "core/WholeFile.h"
#include "io/PictureFile.h"
#include "runControl/Case.h"
#include "runControl/CaseFiles.h"

#include <algorithm>
#include <string_view>

namespace drystone
{
namespace
{

constexpr std::string_view picture = "mechanism";

/// Whether a file has the ending of a format of pictures.
bool isPicture(const std::string& name)
{
    const std::string_view ending = std::string_view(name).substr(name.rfind('.') + 1);
    const auto formats = namesOf(PictureFormat{});
    return std::any_of(formats.begin(), formats.end(),
                       [&](const auto& format) { return ending == format.first; });
}

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
        const std::filesystem::path stem = std::filesystem::path(name).stem();
        if (!name.starts_with(picture) || !isPicture(name))
        {
            continue;
        }
        const std::string suffix = stem.string().substr(picture.size());
        const bool isOurs = suffix.empty() || suffix == "Negative" || suffix.starts_with("_");
        if (!isOurs || std::find(suffixes.begin(), suffixes.end(), suffix) != suffixes.end())
        {
            continue;
        }
        std::error_code ignored;
        removePicture(folder / ("mechanism" + suffix));
        removePicture(folder / ("thrust" + suffix));
        for (const std::string& file : {"thrust" + suffix + ".dat", "coulomb" + suffix + ".dat"})
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

void writeOrRemove(const std::filesystem::path& file, const std::string& text)
{
    if (!text.empty())
    {
        writeWholeFile(file, text);
        return;
    }
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
}

void removeCapacityCurve(const std::filesystem::path& caseDirectory)
{
    const std::filesystem::path folder = caseDirectory / "postProcessing/limitAnalysis/0";
    writeOrRemove(folder / "capacity.dat", "");
    removePicture(folder / "capacity");
    removeSeries(caseDirectory / "VTK", "pushover");
}

} // namespace drystone
