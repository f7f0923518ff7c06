// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Pieces of edges of two blocks that face each other: joints where they touch, gaps where they nearly do.
#pragma once

#include "assembly/Assembly.h"

#include <vector>

namespace drystone
{

/// A straight edge of a block, as a whole: vertices that only split it lie between its ends.
struct OutlineEdge
{
    int block = -1; ///< index in Assembly::blocks
    int first = -1; ///< index in the block's outline of the vertex where it begins
    int last = -1;  ///< of that where it ends; the outline runs from first to last, past its end if need be
    Vector<2> from = Vector<2>::Zero(); ///< [m]
    Vector<2> to = Vector<2>::Zero();   ///< [m]
};

/// A straight piece along which an edge of one block faces an edge of another. It lies halfway between the
/// two edges.
struct FacingPiece
{
    int block = -1;                       ///< index in Assembly::blocks
    int neighbour = -1;                   ///< index in Assembly::blocks; block < neighbour
    Vector<2> from = Vector<2>::Zero();   ///< the piece's ends, in the direction of block's outline [m]
    Vector<2> to = Vector<2>::Zero();     ///< [m]
    Vector<2> normal = Vector<2>::Zero(); ///< unit vector from `neighbour` into `block`
    double gapAtFrom = 0;   ///< distance of the edges along the normal; negative: they overlap [m]
    double gapAtTo = 0;     ///< [m]
    int edge = -1;          ///< of `block`, index in outlineEdges
    int neighbourEdge = -1; ///< of `neighbour`, likewise
    bool isOblique = false; ///< one of the edges is not parallel to an axis
};

/// How near two edges must be to face each other.
struct FacingTolerance
{
    double distance = 0;    ///< largest gap or overlap at either end of a piece [m]
    double angle = 1e-3;    ///< largest turn from exactly opposite directions [rad]
    double straight = 0;    ///< vertices this near to a straight edge do not split it [m]
    double leastLength = 0; ///< of a piece [m]
    double oblique = 0; ///< instead of `distance`, where it is more, and one of the edges is not parallel to
                        ///< an axis, one of the faces not to two; directions may then differ by what such
                        ///< distances turn them by
};

/// Pieces are at least as long as their largest gap; what is straight is so to half of a joint's tolerance.
/// \param distance largest gap or overlap [m] \param joint up to which gaps and overlaps are those of a joint
/// [m]
FacingTolerance facingTolerance(double distance, double joint);

/// The edges of all blocks that are long enough to have a piece, block by block and round each outline.
std::vector<OutlineEdge> outlineEdges(const Assembly<2>& assembly, const FacingTolerance& tolerance);

/// All facing pieces of blocks that are not both fixed, sorted by (block, neighbour) and then by place.
std::vector<FacingPiece> findFacingPieces(const Assembly<2>& assembly, const FacingTolerance& tolerance);

} // namespace drystone
