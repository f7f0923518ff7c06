// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Files that a dictionary names: drawings, solids, records, photographs; one message where there is none.
#pragma once

#include "core/Error.h"

#include <filesystem>

namespace drystone
{

/// \param location of the entry that names the file. \throws FatalIOError naming the file when there is none,
/// with the file of its folder that may be meant
void requireFile(const std::filesystem::path& file, const SourceLocation& location);

} // namespace drystone
