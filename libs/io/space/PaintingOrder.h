// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The order in which pictures of space paint blocks, so that what is in front hides what is behind.
#pragma once

#include "geometry/space/Polyhedron.h"
#include "io/space/View.h"

#include <vector>

namespace drystone
{

/// A block of a picture, where it is drawn.
struct ShownBlock
{
    Polyhedron shape;
    Vector<3> centre = Vector<3>::Zero(); ///< mean of the corners [m]
    Box<2> box;                           ///< as it is seen [m]
    double moved = 0;                     ///< mean displacement of its corners [m]
    bool isFixed = false;
    int block = -1; ///< in the assembly
};

/// Indices of the blocks from back to front.
///
/// Of two blocks that hide parts of each other one is in front if a plane of a face of either has the blocks
/// on its two sides: the one on the viewer's side. The order obeys all of these relations (topological
/// sorting), the farthest first where they leave a choice. Where there is no such order, because blocks
/// overlap each other in a ring, the one whose centre is farthest goes first.
std::vector<int> paintingOrder(const std::vector<ShownBlock>& shown, const View& view);

} // namespace drystone
