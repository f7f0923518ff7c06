// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of a case's files.
#include "assembly/CaseFile.h"

#include <fmt/format.h>

namespace drystone
{

Dictionary readCaseFile(const std::filesystem::path& caseDirectory, std::string_view file,
                        std::string_view example)
{
    const std::filesystem::path path = caseDirectory / file;
    if (!std::filesystem::exists(path))
    {
        throw FatalError(
            fmt::format("There is no {}. Write it, for instance with\n\n    {}", path.string(), example));
    }
    return Dictionary::readFile(path);
}

} // namespace drystone
