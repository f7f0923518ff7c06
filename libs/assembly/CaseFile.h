// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The files of a case that the assembly library reads.
#pragma once

#include "dictionary/Dictionary.h"

#include <filesystem>
#include <string_view>

namespace drystone
{

/// The dictionary in a file of a case. \throws FatalIOError when there is no such file, with the content that
/// it could have as `example`
Dictionary readCaseFile(const std::filesystem::path& caseDirectory, std::string_view file,
                        std::string_view example);

} // namespace drystone
