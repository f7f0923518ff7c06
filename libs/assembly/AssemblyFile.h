// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The assembly on disk: constant/assembly/blocks, plain text in the dictionary grammar.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Dictionary.h"
#include "dictionary/Fingerprint.h"

#include <filesystem>
#include <string>

namespace drystone
{

/// Where a case keeps its blocks: `<case>/constant/assembly/blocks`.
std::filesystem::path assemblyFile(const std::filesystem::path& caseDirectory);

/// The dimensions of the blocks of a case, 2 (plane) or 3 (space): what an application chooses its types
/// from. \throws FatalIOError when the file is missing or has other dimensions
int assemblyDimensions(const std::filesystem::path& caseDirectory);

/// The file as it is. \throws FatalIOError when it is missing or no dictionary
Dictionary readFileOfBlocks(const std::filesystem::path& caseDirectory);

/// Likewise of a file that has been read. \param file of blocks \throws FatalIOError when it has others
int dimensionsOfBlocks(const Dictionary& file);

/// The text of the file: a FoamFile header, `dimensions`, `jointTolerance` [m] where the user states one,
/// `supports` with the indices of the blocks that each of them fixes, where there are any `zones` with the
/// indices of theirs, and the blocks in the order of Assembly::blocks. In the plane these are `thickness` [m]
/// (one number, or a list with one for each block) and `outlines`, one polygon [m] a line; in space `blocks`,
/// each `{ vertices ((x y z) ...); faces ((0 3 2 1) ...); }` with vertices in metres and the faces by index,
/// counter-clockwise seen from outside, and where joints are stated `joints`, each `{ blocks (0 1); normal (x
/// y z); points ((x y z) ...); }`. Numbers are the shortest that read back as the same bits. \param builtFrom
/// the dictionary that it was built from (AssemblyOrigin.h); none: the file does not say it
template<int Dim>
std::string assemblyText(const Assembly<Dim>& assembly, const std::vector<InputFile>& builtFrom = {});

/// Reads the blocks of a case as the file has them, and warns when the dictionary that they were built from
/// has changed, or sizes are improbable. Outlines may be in either orientation and are turned
/// counter-clockwise. Computations take readAssembly of contact/ClosedAssembly.h instead, which also closes
/// joints.
/// \throws FatalIOError with file and line when the file is missing or no dictionary, a key is missing or
/// unknown, dimensions are not Dim, there is no block, a number is not finite, an outline has fewer than
/// three corners, no area, or crosses or touches itself, a thickness is not positive, a polyhedron is none
/// (see findFault of geometry/space/PolyhedronFault.h), a support fixes a block that does not exist or is
/// fixed already, a jointTolerance is more than a tenth of the mean block size
template<int Dim>
Assembly<Dim> readBlocks(const std::filesystem::path& caseDirectory);

/// Where each block stands in the file, for messages.
template<int Dim>
std::vector<SourceLocation> blockPlaces(const std::filesystem::path& caseDirectory);
template<>
std::vector<SourceLocation> blockPlaces<2>(const std::filesystem::path& caseDirectory);
template<>
std::vector<SourceLocation> blockPlaces<3>(const std::filesystem::path& caseDirectory);

/// For computations. \throws FatalIOError when every block of the assembly is fixed: nothing can move
template<int Dim>
void requireFreeBlock(const Assembly<Dim>& assembly, const std::filesystem::path& caseDirectory);

} // namespace drystone
