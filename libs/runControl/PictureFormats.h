// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// `pictureFormats` of system/controlDict: in which formats an application writes its pictures.
#pragma once

#include "dictionary/Options.h"

#include <array>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

namespace drystone
{

enum class PictureFormat
{
    svg,
    png,
    pdf
};

inline std::array<std::pair<std::string_view, PictureFormat>, 3> namesOf(PictureFormat)
{
    return {{{"svg", PictureFormat::svg}, {"png", PictureFormat::png}, {"pdf", PictureFormat::pdf}}};
}

using PictureFormats = std::vector<PictureFormat>;

/// Declares `pictureFormats`, at least one of svg, png and pdf.
void declarePictureFormats(Options& options, PictureFormats& formats);

/// For applications that read nothing else of system/controlDict: its `pictureFormats`, or svg.
/// \throws FatalIOError for a format that there is not
PictureFormats readPictureFormats(const std::filesystem::path& caseDirectory);

/// `mechanism.svg`, or `mechanism.png, mechanism.pdf`: the files of a picture, for the log.
std::string pictureNames(std::string_view name, const PictureFormats& formats);

} // namespace drystone
