// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Whether polyhedra touch.
#include "contact/SupportPaths.h"

#include "geometry/space/EdgeLine.h"
#include "geometry/space/FacePolygon.h"

#include <algorithm>

namespace drystone
{

bool touch(const Block<3>& one, const Block<3>& other, double tolerance)
{
    const auto isOn = [tolerance](const Polyhedron& shape)
    { return [&shape, tolerance](const Vector<3>& corner) { return distance(shape, corner) <= tolerance; }; };
    if (std::any_of(one.shape.vertices.begin(), one.shape.vertices.end(), isOn(other.shape))
        || std::any_of(other.shape.vertices.begin(), other.shape.vertices.end(), isOn(one.shape)))
    {
        return true;
    }
    const std::vector<EdgeLine> edges = edgesOf(one.shape);
    const std::vector<EdgeLine> edgesOfOther = edgesOf(other.shape);
    return std::any_of(edges.begin(), edges.end(),
                       [&](const EdgeLine& edge)
                       {
                           return std::any_of(edgesOfOther.begin(), edgesOfOther.end(),
                                              [&](const EdgeLine& crossing)
                                              { return distance(edge, crossing) <= tolerance; });
                       });
}

} // namespace drystone
