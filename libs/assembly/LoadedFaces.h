// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which faces of an assembly a load acts on.
#pragma once

#include "assembly/BlockSurface.h"
#include "assembly/Loads.h"

namespace drystone
{

/// Where a load acts on faces: on those of free blocks that no other block touches.
template<int Dim>
struct LoadedFaces
{
    std::vector<int> blocks;        ///< by index; empty: all
    std::vector<NamePattern> zones; ///< of the assembly; empty: all blocks
    std::vector<Vector<Dim>> box;   ///< lower and upper corner; empty: anywhere [m]
};

template<int Dim>
void declare(Options& options, LoadedFaces<Dim>& faces);

/// What of the faces is loaded: their surface less the parts on which other blocks lie.
/// \param covered see coveredSurface (contact/CoveredSurface.h)
template<int Dim>
std::vector<SurfacePiece<Dim>> exposedSurface(const Assembly<Dim>& assembly,
                                              const std::vector<SurfacePiece<Dim>>& covered,
                                              const LoadedFaces<Dim>& faces);

/// Refuses blocks and zones that the assembly does not have. \param places of the entries of a load
template<int Dim>
void requireBlocks(const Assembly<Dim>& assembly, const LoadedFaces<Dim>& faces,
                   const EntryLocations& places);

} // namespace drystone
