// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What files of solids say, in whatever format: the readers fill it in, and it becomes blocks
/// (SolidBlocks.h).
#pragma once

#include "geometry/Vector.h"
#include "import/ImportedFile.h"

#include <array>
#include <string>
#include <vector>

namespace drystone
{

/// A solid as its author wrote it: vertices may be there twice, faces may be triangles of larger ones, turned
/// inside, or not quite plane.
struct Solid
{
    std::string name;                    ///< as the file has it, for messages: `Mesh_3`; empty: it has none
    std::vector<std::string> zones;      ///< of Assembly::zones, as the file has them; an empty name is none
    std::vector<Vector<3>> vertices;     ///< in units of the file
    std::vector<std::vector<int>> faces; ///< indices into vertices
    int line = 0;                        ///< where it begins, from 1; 0: not known
};

/// An interface of two solids.
struct SolidInterface
{
    int solid = -1;                ///< index in Solids::solids
    int neighbour = -1;            ///< likewise
    std::vector<Vector<3>> points; ///< in order round it, in units of the file
};

/// Whether each solid is a block.
enum class Division
{
    asWritten,     ///< it is
    byConnectivity ///< solids are parted into pieces that share no edge
};

struct Solids
{
    std::vector<Solid> solids;
    std::vector<SolidInterface> interfaces; ///< of formats that have them
    Division division = Division::asWritten;
    double rounding = 0; ///< unit of the last digit of coordinates; 0: they have all digits
};

/// The zone that a name stands for: without the number at its end, `ground.003` and `Mesh_12` are `ground`
/// and `Mesh`.
std::string withoutNumber(std::string_view name);

/// \defgroup readers Readers of solids. Memory and time are of the order of the file's size.
/// \throws FatalIOError with the line (the byte in binary files, the path of the value in JSON) of the first
/// fault: a word that is no number, a face with a vertex that does not exist, a file that is cut off, ...
/// @{

/// Wavefront OBJ: `v` and `f`; `l` and `p` are skipped, but their vertices are in use; each `o`, or where
/// there is none each `g`, is a solid, `usemtl` its zone; where there is no material at all it is the
/// object's name without its number. A file with neither objects nor groups is parted by connectivity; one
/// that ends with vertices for no face is refused as cut off.
Solids readObj(const ImportedFile& file);

/// Stanford PLY, ascii and binary of either byte order: elements `vertex` (x y z) and `face` (a list
/// vertex_indices or vertex_index); other elements and properties are skipped.
Solids readPly(const ImportedFile& file);

/// STL, ascii and binary; parted by connectivity.
Solids readStl(const ImportedFile& file);

/// COMPAS JSON: an assembly of compas_assembly, in the schemas of compas 2, 1 and 0.19 (`data` or `value`,
/// graph or network, blocks in the nodes or apart from them), a list of meshes, or a mesh. Blocks with
/// `is_support` have that name for a zone, and those in the list `zones` of their node, as exportBlocks
/// writes it. Interfaces are read.
Solids readCompasJson(const ImportedFile& file);

/// @}

} // namespace drystone
