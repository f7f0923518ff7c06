// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Chooses the writer of each format.
#include "io/PictureFile.h"

#include "core/WholeFile.h"
#include "io/CairoPicture.h"
#include "io/SvgText.h"

#include <algorithm>

namespace drystone
{

namespace
{

std::string contentOf(const Canvas& canvas, PictureFormat format)
{
    switch (format)
    {
    case PictureFormat::svg:
        return svgText(canvas);
    case PictureFormat::png:
        return pngContent(canvas);
    case PictureFormat::pdf:
        break;
    }
    return pdfContent(canvas);
}

/// The name may have dots of its own: scatter_friction.mu.
std::filesystem::path fileOf(std::filesystem::path name, std::string_view ending)
{
    name += ".";
    name += ending;
    return name;
}

} // namespace

void writePicture(const std::filesystem::path& name, const Canvas& canvas, const PictureFormats& formats)
{
    for (const auto& [ending, format] : namesOf(PictureFormat{}))
    {
        const std::filesystem::path file = fileOf(name, ending);
        if (std::find(formats.begin(), formats.end(), format) != formats.end())
        {
            writeWholeFile(file, contentOf(canvas, format));
        }
        else
        {
            std::error_code ignored;
            std::filesystem::remove(file, ignored);
        }
    }
}

void removePicture(const std::filesystem::path& name)
{
    for (const auto& [ending, format] : namesOf(PictureFormat{}))
    {
        std::error_code ignored;
        std::filesystem::remove(fileOf(name, ending), ignored);
    }
}

} // namespace drystone
