// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading, closing and refusing.
#include "contact/ClosedAssembly.h"

#include "assembly/AssemblyFile.h"
#include "contact/JointClosure.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

template<int Dim>
Assembly<Dim> readAssembly(const std::filesystem::path& caseDirectory)
{
    Assembly<Dim> assembly = readBlocks<Dim>(caseDirectory);
    closeJoints(assembly);
    return assembly;
}

namespace
{

constexpr double ofRounding = 0.05; // of a block: coordinates are not rounded by more

} // namespace

template<int Dim>
std::string overlapText(const Overlap<Dim>& overlap)
{
    return fmt::format(
        "Blocks {} and {} overlap by {:.6g} {}, {:.3g} of the smaller one. Blocks may touch, but not "
        "overlap: correct system/blockTextureDict and run blockTexture again (checkBlocks lists all "
        "overlaps).{}",
        overlap.block, overlap.neighbour, overlap.common, Dim == 2 ? "m2" : "m3", overlap.fraction,
        overlap.fraction < ofRounding
            ? " Where faces are only in each other by what they were rounded or flattened by, state that as "
              "`jointTolerance` [m] there."
            : "");
}

namespace
{

template<int Dim>
[[noreturn]] void refuse(const Overlap<Dim>& overlap, const std::filesystem::path& caseDirectory)
{
    throw FatalIOError(overlapText(overlap), blockPlaces<Dim>(caseDirectory)[overlap.neighbour]);
}

} // namespace

template<int Dim>
void refuseUnstatedOverlaps(const Assembly<Dim>& assembly, const std::filesystem::path& caseDirectory)
{
    const std::vector<Overlap<Dim>> overlaps = findOverlaps(assembly);
    const bool areRounded =
        std::all_of(overlaps.begin(), overlaps.end(),
                    [](const Overlap<Dim>& overlap) { return overlap.fraction < ofRounding; });
    if (overlaps.empty())
    {
        return;
    }
    if (assembly.statedJoints.empty() || !areRounded)
    {
        refuse(overlaps.front(), caseDirectory);
    }
    printWarningOnce(
        fmt::format("Blocks {} and {} overlap by {:.3g} of the smaller one{}. Their joints are those "
                    "that the file states, so that forces do not depend on it; checkBlocks lists all "
                    "overlaps.",
                    overlaps.front().block, overlaps.front().neighbour, overlaps.front().fraction,
                    overlaps.size() > 1 ? fmt::format(", and {} pairs more", overlaps.size() - 1) : ""),
        blockPlaces<Dim>(caseDirectory)[overlaps.front().neighbour]);
}

template<int Dim>
void refuseOverlaps(const Assembly<Dim>& assembly, const std::filesystem::path& caseDirectory)
{
    const std::vector<Overlap<Dim>> overlaps = findOverlaps(assembly);
    if (!overlaps.empty())
    {
        refuse(overlaps.front(), caseDirectory);
    }
}

template Assembly<2> readAssembly<2>(const std::filesystem::path& caseDirectory);
template Assembly<3> readAssembly<3>(const std::filesystem::path& caseDirectory);
template std::string overlapText(const Overlap<2>& overlap);
template std::string overlapText(const Overlap<3>& overlap);
template void refuseUnstatedOverlaps(const Assembly<2>& assembly, const std::filesystem::path& caseDirectory);
template void refuseUnstatedOverlaps(const Assembly<3>& assembly, const std::filesystem::path& caseDirectory);
template void refuseOverlaps(const Assembly<2>& assembly, const std::filesystem::path& caseDirectory);
template void refuseOverlaps(const Assembly<3>& assembly, const std::filesystem::path& caseDirectory);

} // namespace drystone
