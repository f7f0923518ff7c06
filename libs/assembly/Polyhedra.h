// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A list of polyhedra as a user writes them, for the file of the blocks and for textures: what Outlines.h is
/// in the plane.
#pragma once

#include "dictionary/Dictionary.h"
#include "geometry/space/Polyhedron.h"

#include <vector>

namespace drystone
{

/// `( { vertices ((x y z) ...); faces ((0 3 2 1) ...); } ... )`: vertices in metres, faces by the indices of
/// their vertices, counter-clockwise seen from outside.
struct Polyhedra
{
    std::vector<Polyhedron> shapes;
    std::vector<SourceLocation> places; ///< of each polyhedron
};

/// \throws FatalIOError at the line of the face where it is not a polyhedron (see findFault): a face
/// with a vertex that does not exist, not plane, without a neighbour, turned inside
void read(TokenCursor& cursor, Polyhedra& polyhedra);

} // namespace drystone
