// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// From which dictionary an assembly was built, so that one which is no longer current is noticed.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Fingerprint.h"

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// Of all that results depend on, however it is written: blocks (in the plane their thickness too) and
/// whether they are fixed, the jointTolerance where one is stated, names of supports, zones and stated
/// joints.
template<int Dim>
std::uint64_t fingerprint(const Assembly<Dim>& assembly);

/// The dictionary that an assembly is built from, and the files that it names.
std::vector<InputFile> originOf(const std::filesystem::path& dictionaryFile,
                                const std::filesystem::path& caseDirectory);

/// The entry `builtFrom` of constant/assembly/blocks; empty for no files.
std::string originText(const std::vector<InputFile>& builtFrom);

/// Warns if the dictionary that constant/assembly/blocks was built from has changed since. A dictionary that
/// was removed is ignored. If the entry `builtFrom` is missing, which older versions did not write, this is
/// reported where there is a system/blockTextureDict. \param blocks constant/assembly/blocks, whose entry
/// `builtFrom` is marked as used
void compareWithOrigin(const Dictionary& blocks, const std::filesystem::path& caseDirectory);

} // namespace drystone
