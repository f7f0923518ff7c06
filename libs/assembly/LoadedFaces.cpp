// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Surfaces of the chosen free blocks and, to be taken away, what is covered of them, cut at the box.
#include "assembly/LoadedFaces.h"

#include "assembly/NamedZones.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace drystone
{
namespace
{

template<int Dim>
std::vector<char> chosenBlocks(const Assembly<Dim>& assembly, const LoadedFaces<Dim>& faces)
{
    const bool isAll = faces.blocks.empty() && faces.zones.empty();
    std::vector<char> chosen(assembly.blocks.size(), isAll);
    for (const int block : faces.blocks)
    {
        chosen[block] = true;
    }
    for (const Zone& zone : assembly.zones)
    {
        if (std::any_of(faces.zones.begin(), faces.zones.end(),
                        [&](const NamePattern& pattern) { return pattern.matches(zone.name); }))
        {
            for (const int block : zone.blocks)
            {
                chosen[block] = true;
            }
        }
    }
    for (std::size_t block = 0; block < chosen.size(); ++block)
    {
        chosen[block] = chosen[block] && assembly.blocks[block].support < 0;
    }
    return chosen;
}

} // namespace

template<int Dim>
void requireBlocks(const Assembly<Dim>& assembly, const LoadedFaces<Dim>& faces, const EntryLocations& places)
{
    for (const int block : faces.blocks)
    {
        if (block >= static_cast<int>(assembly.blocks.size()))
        {
            throw FatalIOError(fmt::format("There is no block {}: the assembly has blocks 0 to {}.", block,
                                           assembly.blocks.size() - 1),
                               places.of("blocks"));
        }
    }
    for (const NamePattern& pattern : faces.zones)
    {
        requireZone(pattern, assembly.zones, places.of("zones"));
    }
}

template<int Dim>
void declare(Options& options, LoadedFaces<Dim>& faces)
{
    options.optional("blocks", faces.blocks, "only the faces of these blocks, by index").example("(3 4 5)");
    options.optional("zones", faces.zones, "only the faces of blocks in these zones of the assembly")
        .example("(facade)");
    options
        .optional("box", faces.box,
                  "only what lies between this lower and upper corner; faces are cut at its sides")
        .unit("m")
        .example(Dim == 2 ? "((0 0) (2 1.5))" : "((0 0 0) (2 1 1.5))");
    options.check("box",
                  [&faces]() -> std::string
                  {
                      const bool isBox =
                          faces.box.size() == 2 && (faces.box[1] - faces.box[0]).minCoeff() > 0;
                      return faces.box.empty() || isBox
                                 ? ""
                                 : "A box has two corners, the second above the first in every direction.";
                  });
    options.check("blocks",
                  [&faces]() -> std::string
                  {
                      return std::any_of(faces.blocks.begin(), faces.blocks.end(),
                                         [](int block) { return block < 0; })
                                 ? "Blocks are counted from 0."
                                 : "";
                  });
}

template<int Dim>
std::vector<SurfacePiece<Dim>> exposedSurface(const Assembly<Dim>& assembly,
                                              const std::vector<SurfacePiece<Dim>>& covered,
                                              const LoadedFaces<Dim>& faces)
{
    const std::vector<char> chosen = chosenBlocks(assembly, faces);
    std::vector<SurfacePiece<Dim>> pieces;
    for (std::size_t block = 0; block < chosen.size(); ++block)
    {
        if (chosen[block])
        {
            const std::vector<SurfacePiece<Dim>> own = surfaceOf(assembly, static_cast<int>(block));
            pieces.insert(pieces.end(), own.begin(), own.end());
        }
    }
    std::copy_if(covered.begin(), covered.end(), std::back_inserter(pieces),
                 [&](const SurfacePiece<Dim>& piece) { return chosen[piece.block] != 0; });
    for (int axis = 0; axis < Dim && !faces.box.empty(); ++axis)
    {
        const Vector<Dim> direction = Vector<Dim>::Unit(axis);
        pieces = partBelow(pieces, direction, faces.box[1][axis]);
        pieces = partBelow(pieces, -direction, -faces.box[0][axis]);
    }
    return pieces;
}

template void declare(Options& options, LoadedFaces<2>& faces);
template void declare(Options& options, LoadedFaces<3>& faces);
template void requireBlocks(const Assembly<2>& assembly, const LoadedFaces<2>& faces,
                            const EntryLocations& places);
template void requireBlocks(const Assembly<3>& assembly, const LoadedFaces<3>& faces,
                            const EntryLocations& places);
template std::vector<SurfacePiece<2>> exposedSurface(const Assembly<2>& assembly,
                                                     const std::vector<SurfacePiece<2>>& covered,
                                                     const LoadedFaces<2>& faces);
template std::vector<SurfacePiece<3>> exposedSurface(const Assembly<3>& assembly,
                                                     const std::vector<SurfacePiece<3>>& covered,
                                                     const LoadedFaces<3>& faces);

} // namespace drystone
