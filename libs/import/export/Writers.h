// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Texts of files for other programs. Numbers read back as the same bits, unless a number of decimals is
/// requested; glTF has single precision.
#pragma once

#include "import/export/ExportedSolids.h"

#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// How coordinates are written: all their digits, or so many decimals (`%.3f`).
struct WrittenNumbers
{
    std::optional<int> decimals = {};
};

/// Wavefront OBJ, an object `block_<index>` a block, its layer as material. Imported again, blocks whose
/// faces are plane are the same to the last bit.
std::string objText(const std::vector<ExportedSolid>& solids, const WrittenNumbers& numbers);

/// COMPAS JSON, an assembly of compas_assembly: fixed blocks have `is_support`, joints are interfaces with
/// the z axis of their frame from the first block of the edge to the second, as equilibrium in COMPAS takes
/// it, and `zones` of a node names the support and the zones of its block. \param joints with points in order
/// round each
std::string compasJsonText(const std::vector<ExportedSolid>& solids,
                           const std::vector<StatedJoint<3>>& joints, const WrittenNumbers& numbers);

/// DXF (R12): closed polylines of the plane by layer, or faces of solids as 3DFACE.
std::string dxfText(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                    const WrittenNumbers& numbers);
std::string dxfText(const std::vector<ExportedSolid>& solids, const WrittenNumbers& numbers);

/// Where the solids are at a moment of an animation, a column each. NaN: not shown, as a block that was
/// deleted.
struct SolidFrame
{
    double time = 0;               ///< [s]; later than that of the frame before
    Eigen::Matrix3Xd displacement; ///< of the centres of volume from where `solids` are, axes as theirs [m]
    Eigen::Matrix3Xd rotation;     ///< rotation vectors about them [rad]
};

/// glTF 2.0 in one file: a node `block_<index>` a block, y upwards, blocks of clay and grey supports. With
/// frames, an animation `motion` moves the nodes of all blocks that are not fixed. Of a structure far from
/// the origin, as in coordinates of a map, a node `structure` above them has the place.
std::string gltfText(const std::vector<ExportedSolid>& solids, const std::vector<SolidFrame>& frames = {});

/// A script for the pre-processor of LMGC90 (pylmgc90.pre), which writes its DATBOX: rigid polyhedra, Coulomb
/// friction. LMGC90 takes convex blocks. \param friction coefficient
std::string lmgc90Text(const std::vector<ExportedSolid>& solids, double friction);

/// Commands of 3DEC, `block create polyhedron`. 3DEC takes convex blocks: others are left out, with a
/// comment.
std::string threeDecText(const std::vector<ExportedSolid>& solids);

/// Indices of the blocks that are not convex.
std::vector<int> concaveBlocks(const std::vector<ExportedSolid>& solids);

} // namespace drystone
