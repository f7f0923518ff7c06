// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Patches of faces of two blocks in space that face each other: joints where they touch, gaps where they
/// nearly do.
#pragma once

#include "assembly/Assembly.h"
#include "contact/Facing.h"

#include <vector>

namespace drystone
{

/// A polygon over which a face of one block faces a face of another. It lies halfway between the two faces.
struct FacingPatch
{
    int block = -1;                       ///< index in Assembly::blocks
    int neighbour = -1;                   ///< index in Assembly::blocks; block < neighbour
    int face = -1;                        ///< of `block`, index in its shape's faces
    int neighbourFace = -1;               ///< of `neighbour`, likewise
    std::vector<Vector<3>> corners;       ///< counter-clockwise seen from outside `block` [m]
    std::vector<double> gaps;             ///< at each corner, along the normal; negative: they overlap [m]
    Vector<3> normal = Vector<3>::Zero(); ///< unit vector from `neighbour` into `block`
    bool isOblique = false;               ///< one of the faces is not parallel to two axes
};

/// All facing patches of blocks that are not both fixed, sorted by (block, neighbour, face, neighbourFace).
/// Two faces have a patch where they overlap in projection, if their normals are opposite to
/// `tolerance.angle` and they lie within `tolerance.distance` of each other at every corner of the patch, or
/// within `tolerance.oblique` where that is more and one of them is not parallel to two axes; several patches
/// where concave faces overlap in several places. A patch is wider than `tolerance.leastLength` somewhere:
/// faces that touch along an edge or at a corner alone have none. Corners that only split a straight edge
/// within `tolerance.straight` are left out. Time is of order n log n in the number of faces.
std::vector<FacingPatch> findFacingPatches(const Assembly<3>& assembly, const FacingTolerance& tolerance);

} // namespace drystone
