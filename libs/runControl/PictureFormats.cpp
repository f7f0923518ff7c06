// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads the formats of pictures, which limit analysis, motion and studies have in common.
#include "runControl/PictureFormats.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace drystone
{

namespace
{

constexpr std::string_view nothingNamed = "pictureFormats is empty.\n\nName at least one of svg, png and "
                                          "pdf: `pictureFormats (svg png);`.";

} // namespace

void declarePictureFormats(Options& options, PictureFormats& formats)
{
    options
        .optional("pictureFormats", formats,
                  "of every picture that is written: svg for web pages, png (192 pixels an inch), pdf")
        .example("(svg png pdf)");
    options.check("pictureFormats", [&formats] { return std::string(formats.empty() ? nothingNamed : ""); });
}

PictureFormats readPictureFormats(const std::filesystem::path& caseDirectory)
{
    const Dictionary controls = Dictionary::readFileIfPresent(caseDirectory / "system/controlDict");
    const Entry* entry = controls.find("pictureFormats");
    if (!entry)
    {
        return {PictureFormat::svg};
    }
    PictureFormats formats = entry->as<PictureFormats>();
    if (formats.empty())
    {
        throw FatalIOError(std::string(nothingNamed), entry->location());
    }
    return formats;
}

std::string pictureNames(std::string_view name, const PictureFormats& formats)
{
    std::vector<std::string> files;
    for (const auto& [ending, format] : namesOf(PictureFormat{}))
    {
        if (std::find(formats.begin(), formats.end(), format) != formats.end())
        {
            files.push_back(fmt::format("{}.{}", name, ending));
        }
    }
    return fmt::format("{}", fmt::join(files, ", "));
}

} // namespace drystone
