// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The files of a case in an order for readers, so that a report is the same each time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// Those below a folder with an ending, sorted by name, numbers in names by their value.
std::vector<std::filesystem::path> filesWithEnding(const std::filesystem::path& folder,
                                                   const std::string& ending);

} // namespace drystone
