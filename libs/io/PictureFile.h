// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Drawings as files in the formats that a case requests.
#pragma once

#include "io/Canvas.h"
#include "runControl/PictureFormats.h"

#include <filesystem>

namespace drystone
{

/// Writes `<name>.svg`, `.png`, `.pdf`, as many of them as `formats` has, each whole or not at all; removes
/// those that it has not, which an earlier run may have left and which would show other results.
/// \param name the file without its ending \throws FatalError naming the file that cannot be written
void writePicture(const std::filesystem::path& name, const Canvas& canvas, const PictureFormats& formats);

/// Removes the files of a picture, in all formats; what is not there is none.
void removePicture(const std::filesystem::path& name);

} // namespace drystone
