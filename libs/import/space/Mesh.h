// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// From the faces that a file has to those of a polyhedron: one closed surface a block, turned outwards, its
/// triangles merged where they are coplanar.
#pragma once

#include "geometry/space/Polyhedron.h"

#include <vector>

namespace drystone
{

/// The polyhedron without repeated vertices: those within `tolerance` [m] of each other become one, at their
/// mean where they differ, and faces that shrink to a line or point vanish.
Polyhedron welded(const Polyhedron& mesh, double tolerance);

/// Removes faces that have the corners of one before in the same order, as files have that were put together
/// from several: no edge would be one of two faces. \return how many
int dropRepeatedFaces(Polyhedron& mesh);

/// The pieces of a mesh whose vertices are welded: faces that share an edge belong together. Where several
/// solids meet along an edge, a face goes on with the one across the solid, so that solids that touch are
/// parted. \post vertices and faces of each piece are in their old order
std::vector<Polyhedron> parted(const Polyhedron& mesh);

/// Turns faces so that neighbours agree and the volume is positive. \return how many were turned
int turnOutwards(Polyhedron& mesh);

/// Merges neighbouring faces that lie in one plane, to `tolerance` [m], as far as the merged face has no
/// hole, and removes vertices that only split a straight edge. \return by how many there are fewer faces
int mergeCoplanar(Polyhedron& mesh, double tolerance);

} // namespace drystone
