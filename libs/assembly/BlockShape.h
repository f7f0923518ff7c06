// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Questions about the shape of one block that have an answer in the plane and in space, so that what needs
/// them is one text. The answers are in plane/ and space/.
#pragma once

#include "assembly/Assembly.h"
#include "geometry/Box.h"

#include <vector>

namespace drystone
{

/// The corners of a block as built [m].
inline const std::vector<Vector<2>>& cornersOf(const Block<2>& block)
{
    return block.outline;
}
inline const std::vector<Vector<3>>& cornersOf(const Block<3>& block)
{
    return block.shape.vertices;
}

/// The corners of a block where it is [m].
inline std::vector<Vector<2>> placedCorners(const Block<2>& block, const Placement<2>& placement)
{
    return placedOutline(block, placement);
}
inline std::vector<Vector<3>> placedCorners(const Block<3>& block, const Placement<3>& placement)
{
    return placedShape(block, placement).vertices;
}

/// The smallest box that contains a block as built.
template<int Dim>
Box<Dim> boundingBox(const Block<Dim>& block);
template<>
Box<2> boundingBox(const Block<2>& block);
template<>
Box<3> boundingBox(const Block<3>& block);

/// The smallest box that contains all blocks as built; empty where there are none.
template<int Dim>
Box<Dim> boundingBox(const Assembly<Dim>& assembly)
{
    Box<Dim> box;
    for (const Block<Dim>& block : assembly.blocks)
    {
        extend<Dim>(box, boundingBox(block));
    }
    return box;
}

/// Distance of a point from a block [m]: 0 inside and on it.
double distanceFrom(const Block<2>& block, const Vector<2>& point);
double distanceFrom(const Block<3>& block, const Vector<3>& point);

/// Where a line from + s along may enter or leave a block, or pass from being nearest to it to being nearest
/// to another: the places s, in any order, on the line outside the block too.
std::vector<double> placesToCut(const Block<2>& block, const Vector<2>& from, const Vector<2>& along);
std::vector<double> placesToCut(const Block<3>& block, const Vector<3>& from, const Vector<3>& along);

} // namespace drystone
