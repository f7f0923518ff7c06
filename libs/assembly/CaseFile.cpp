// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A file that the case must have, with an example of it where it is missing.
#include "assembly/CaseFile.h"

#include "runControl/Case.h"

#include <fmt/format.h>

namespace drystone
{

Dictionary readCaseFile(const std::filesystem::path& caseDirectory, std::string_view file,
                        std::string_view example)
{
    return Dictionary::readFile(
        requireCaseFile(caseDirectory, file, fmt::format("Write it, for instance with\n\n    {}", example)));
}

} // namespace drystone
