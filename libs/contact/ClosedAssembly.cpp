// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading, closing and refusing.
#include "contact/ClosedAssembly.h"

#include "assembly/AssemblyFile.h"
#include "contact/JointClosure.h"

#include <fmt/format.h>

namespace drystone
{

template<int Dim>
Assembly<Dim> readAssembly(const std::filesystem::path& caseDirectory)
{
    Assembly<Dim> assembly = readBlocks<Dim>(caseDirectory);
    closeJoints(assembly);
    return assembly;
}

template<int Dim>
std::string overlapText(const Overlap<Dim>& overlap)
{
    constexpr double rounded = 0.05; // of a block: not by more
    return fmt::format(
        "Blocks {} and {} overlap by {:.6g} {}, {:.3g} of the smaller one. Blocks may touch, but not "
        "overlap: correct system/blockTextureDict and run blockTexture again (checkBlocks lists all "
        "overlaps).{}",
        overlap.block, overlap.neighbour, overlap.common, Dim == 2 ? "m2" : "m3", overlap.fraction,
        overlap.fraction < rounded
            ? " Where faces are only in each other by what they were rounded or flattened by, state that as "
              "`jointTolerance` [m] there."
            : "");
}

template<int Dim>
void refuseOverlaps(const Assembly<Dim>& assembly, const std::filesystem::path& caseDirectory)
{
    const std::vector<Overlap<Dim>> overlaps = findOverlaps(assembly);
    if (!overlaps.empty())
    {
        throw FatalIOError(overlapText(overlaps.front()),
                           blockPlaces<Dim>(caseDirectory)[overlaps.front().neighbour]);
    }
}

template Assembly<2> readAssembly<2>(const std::filesystem::path& caseDirectory);
template Assembly<3> readAssembly<3>(const std::filesystem::path& caseDirectory);
template std::string overlapText(const Overlap<2>& overlap);
template std::string overlapText(const Overlap<3>& overlap);
template void refuseOverlaps(const Assembly<2>& assembly, const std::filesystem::path& caseDirectory);
template void refuseOverlaps(const Assembly<3>& assembly, const std::filesystem::path& caseDirectory);

} // namespace drystone
