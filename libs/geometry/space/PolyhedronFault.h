// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Whether vertices and faces make a solid: what the readers of polyhedra check, so that all else may rely on
/// it.
#pragma once

#include "geometry/space/Polyhedron.h"

#include <optional>
#include <string>

namespace drystone
{

/// What keeps vertices and faces from being a solid.
struct PolyhedronFault
{
    static constexpr int vertices = -1; ///< instead of a face: the vertices are at fault
    static constexpr int allFaces = -2; ///< instead of a face: all faces are

    int face = vertices; ///< index of the face at fault, or one of the above
    std::string text;    ///< names faces and vertices by their indices, `face 3 is not plane: ...`
};

/// The first fault of a polyhedron, or nothing when it is a solid: too few vertices or faces, a coordinate
/// that is not finite, vertices that coincide or belong to no face, a face with a vertex that does not exist
/// or that is there twice, that is not plane (to 1e-5 of the extent of the block) or crosses itself, an edge
/// without a second face (not closed), faces that are turned differently, all faces turned inwards, an edge
/// that crosses another face, solids apart from each other. Time is of order edges times faces.
std::optional<PolyhedronFault> findFault(const Polyhedron& polyhedron);

} // namespace drystone
