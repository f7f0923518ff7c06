// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The assembly of a case as computations need it: read from its file, its joints closed. In this library
/// because it takes the facing of blocks to close joints and the overlap of blocks to refuse them.
#pragma once

#include "contact/Overlaps.h"

#include <filesystem>
#include <string>

namespace drystone
{

/// The blocks of a case (readBlocks of assembly/AssemblyFile.h). Joints whose faces do not quite meet are
/// closed (JointClosure.h); say so with printClosure. \throws FatalIOError as readBlocks
template<int Dim>
Assembly<Dim> readAssembly(const std::filesystem::path& caseDirectory);

/// What to say of an overlap, with the repair.
template<int Dim>
std::string overlapText(const Overlap<Dim>& overlap);

/// For computations that need sound geometry.
/// \throws FatalIOError at the line of the block when two blocks of the assembly, as read from this case,
/// share more than rounding explains: what `checkBlocks` calls an overlap
template<int Dim>
void refuseOverlaps(const Assembly<Dim>& assembly, const std::filesystem::path& caseDirectory);

/// The same for computations of the structure as built, which overlaps of rounded blocks are warned of where
/// the joints between them are stated instead of found from their shapes.
template<int Dim>
void refuseUnstatedOverlaps(const Assembly<Dim>& assembly, const std::filesystem::path& caseDirectory);

} // namespace drystone
