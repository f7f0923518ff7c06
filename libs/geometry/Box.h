// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Axis-aligned boxes, of the plane and of space: the first question of every search.
#pragma once

#include "geometry/Vector.h"

#include <algorithm>
#include <vector>

namespace drystone
{

/// Axis-aligned box around a block. The default is empty: it meets nothing, and extending it by a point gives
/// that point.
template<int Dim>
struct Box
{
    Vector<Dim> lower = Vector<Dim>::Constant(1e300);  ///< [m]
    Vector<Dim> upper = Vector<Dim>::Constant(-1e300); ///< [m]
};

using BoundingBox = Box<2>;

/// The box with every side moved outwards by `distance` [m].
template<int Dim>
Box<Dim> enlarged(const Box<Dim>& box, double distance)
{
    return {box.lower.array() - distance, box.upper.array() + distance};
}
inline BoundingBox enlarged(const BoundingBox& box, double distance) // for boxes in braces
{
    return enlarged<2>(box, distance);
}

/// Makes the box contain a point.
template<int Dim>
void extend(Box<Dim>& box, const Vector<Dim>& point)
{
    box.lower = box.lower.cwiseMin(point);
    box.upper = box.upper.cwiseMax(point);
}

/// Makes the box contain another one; an empty one changes nothing.
template<int Dim>
void extend(Box<Dim>& box, const Box<Dim>& other)
{
    box.lower = box.lower.cwiseMin(other.lower);
    box.upper = box.upper.cwiseMax(other.upper);
}

/// The smallest box that contains every point; empty where there are none.
template<int Dim>
Box<Dim> boxAround(const std::vector<Vector<Dim>>& points)
{
    Box<Dim> box;
    for (const Vector<Dim>& point : points)
    {
        extend(box, point);
    }
    return box;
}

/// The smallest box that contains two points, and the line between them.
template<int Dim>
Box<Dim> boxAround(const Vector<Dim>& a, const Vector<Dim>& b)
{
    return {a.cwiseMin(b), a.cwiseMax(b)};
}

/// Whether a box is so far from the origin, as in coordinates of a map, that the seven digits of single
/// precision would leave too little of the distances within it to see: a coordinate is more than a hundred
/// times its largest side. An empty box is not.
template<int Dim>
bool isFarFromOrigin(const Box<Dim>& box)
{
    constexpr double far = 100;
    const double size = (box.upper - box.lower).maxCoeff();
    return size >= 0 && std::max(-box.lower.minCoeff(), box.upper.maxCoeff()) > far * size;
}

/// Whether the closed boxes share a point: boxes that only touch do meet.
template<int Dim>
bool meet(const Box<Dim>& a, const Box<Dim>& b)
{
    for (int axis = 0; axis < Dim; ++axis)
    {
        if (!(a.lower[axis] <= b.upper[axis] && b.lower[axis] <= a.upper[axis]))
        {
            return false;
        }
    }
    return true;
}

/// Whether every point of `inner` is a point of `outer`.
template<int Dim>
bool contains(const Box<Dim>& outer, const Box<Dim>& inner)
{
    for (int axis = 0; axis < Dim; ++axis)
    {
        if (!(outer.lower[axis] <= inner.lower[axis] && inner.upper[axis] <= outer.upper[axis]))
        {
            return false;
        }
    }
    return true;
}

} // namespace drystone
