// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks as other programs take them: solids, those of the plane given their thickness, each on a layer.
#pragma once

#include "assembly/Assembly.h"

#include <array>
#include <string>
#include <vector>

namespace drystone
{

struct ExportedSolid
{
    Polyhedron shape; ///< in space z is up; a block of the plane lies in x-z, from y = 0 to its thickness [m]
    std::string layer; ///< the first of `zones`, or `blocks`
    bool isFixed = false;
    double density = 0;                  ///< [kg/m3]
    std::vector<std::string> zones = {}; ///< names of its support and its zones
};

/// The blocks where they are, in their order. \param placements one a block, or none: as built \param
/// densities one a block, or none: 0
template<int Dim>
std::vector<ExportedSolid> exportedSolids(const Assembly<Dim>& assembly,
                                          const std::vector<Placement<Dim>>& placements = {},
                                          const std::vector<double>& densities = {});

/// The first block that has less than half of its volume where coordinates have so many decimals; -1: none.
int flattenedBlock(const std::vector<ExportedSolid>& solids, int decimals);

/// The name of its support, if it has one, and those of its zones, for each block.
template<int Dim>
std::vector<std::vector<std::string>> groupsOfBlocks(const Assembly<Dim>& assembly);

/// The layer of each block: the first of these names, or `blocks`.
template<int Dim>
std::vector<std::string> layersOf(const Assembly<Dim>& assembly);

/// Triangles of a face by indices of its vertices, turned as the face is; a concave one is cut at its
/// corners.
std::vector<std::array<int, 3>> trianglesOf(const Polyhedron& shape, const std::vector<int>& face);

} // namespace drystone
