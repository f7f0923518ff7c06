// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The assembly on disk: constant/assembly/blocks, plain text in the dictionary grammar.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Fingerprint.h"

#include <filesystem>
#include <string>

namespace drystone
{

/// Where a case keeps its blocks: `<case>/constant/assembly/blocks`.
std::filesystem::path assemblyFile(const std::filesystem::path& caseDirectory);

/// The text of the file: a FoamFile header, `dimensions`, `thickness` [m] (one number, or a list with one for
/// each block), `jointTolerance` [m] where the user states one, `supports` with the indices of the blocks
/// that each of them fixes, and `outlines`, one polygon [m] a line in the order of Assembly::blocks. Numbers
/// are the shortest that read back as the same bits. \param builtFrom the dictionary that it was built from
/// (AssemblyOrigin.h); none: the file does not say it
std::string assemblyText(const Assembly<2>& assembly, const std::vector<InputFile>& builtFrom = {});

/// Reads the blocks of a case as the file has them, and warns when the dictionary that they were built from
/// has changed, or sizes are improbable. Outlines may be in either orientation and are turned
/// counter-clockwise. Computations take readAssembly of contact/ClosedAssembly.h instead, which also closes
/// joints.
/// \throws Error with file and line when the file is missing or no dictionary, a key is missing or unknown,
/// dimensions are not 2, there is no block, a number is not finite, an outline has fewer than three corners,
/// no area, or crosses or touches itself, a thickness is not positive, a support fixes a block that does not
/// exist or is fixed already, a jointTolerance is more than a tenth of the mean block size
Assembly<2> readBlocks(const std::filesystem::path& caseDirectory);

/// For computations. \throws FatalIOError when every block of the assembly is fixed: nothing can move
void requireFreeBlock(const Assembly<2>& assembly, const std::filesystem::path& caseDirectory);

} // namespace drystone
