// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading, closing and refusing.
#include "contact/ClosedAssembly.h"

#include "assembly/AssemblyFile.h"
#include "assembly/Outlines.h"
#include "contact/JointClosure.h"

#include <fmt/format.h>

namespace drystone
{

Assembly<2> readAssembly(const std::filesystem::path& caseDirectory)
{
    Assembly<2> assembly = readBlocks(caseDirectory);
    closeJoints(assembly);
    return assembly;
}

std::string overlapText(const Overlap& overlap)
{
    return fmt::format(
        "Blocks {} and {} overlap by {:.6g} m2, {:.3g} of the smaller one. Blocks may touch, but not "
        "overlap: "
        "correct system/blockTextureDict and run blockTexture again (checkBlocks lists all overlaps).",
        overlap.block, overlap.neighbour, overlap.area, overlap.fraction);
}

void refuseOverlaps(const Assembly<2>& assembly, const std::filesystem::path& caseDirectory)
{
    const std::vector<Overlap> overlaps = findOverlaps(assembly);
    if (!overlaps.empty())
    {
        const Dictionary dictionary = Dictionary::readFile(assemblyFile(caseDirectory));
        throw FatalIOError(overlapText(overlaps.front()),
                           dictionary.get<Outlines>("outlines").places[overlaps.front().neighbour]);
    }
}

} // namespace drystone
