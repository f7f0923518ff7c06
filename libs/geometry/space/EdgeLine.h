// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Edges of polyhedra as segments of lines, and where two of them come nearest.
#pragma once

#include "geometry/space/Polyhedron.h"

#include <optional>
#include <vector>

namespace drystone
{

/// A straight edge; places on it are parts of its length, 0 at its start and 1 at its end.
struct EdgeLine
{
    Vector<3> start; ///< [m]
    Vector<3> along; ///< to its end [m]

    Vector<3> at(double part) const { return start + part * along; }
    /// The part nearest to a point, on the line of the edge: below 0 or above 1 beyond its ends.
    double nearest(const Vector<3>& point) const { return (point - start).dot(along) / along.squaredNorm(); }
};

/// Each edge of a polyhedron once.
std::vector<EdgeLine> edgesOf(const Polyhedron& polyhedron);

/// The part of one edge's line that is nearest to the line of another; nothing where they are parallel to
/// 1e-9.
std::optional<double> nearestToLine(const EdgeLine& edge, const EdgeLine& other);

/// Distance of two edges, ends included [m].
double distance(const EdgeLine& one, const EdgeLine& other);

} // namespace drystone
