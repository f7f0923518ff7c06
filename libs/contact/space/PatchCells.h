// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The patches of joints in space, cut into convex cells: where their contact points are, and which part of
/// the area each stands for.
#pragma once

#include "contact/ContactPoint.h"
#include "geometry/Polygon.h"

#include <vector>

namespace drystone
{

/// One patch in coordinates along its two tangents, about its first corner.
struct PatchCells
{
    std::vector<ContactPoint<3>> corners; ///< in order round it, either way
    Eigen::Matrix3d frame;                ///< contactFrame of the corners
    std::vector<Vector<2>> vertices;      ///< of the cells [m]: first the corners, in their order
    std::vector<std::vector<int>> cells;  ///< vertices of each, counter-clockwise, convex
    double extent = 0;                    ///< the longest distance between two corners, about [m]
};

/// Each patch as one cell; a concave one as several, cut along its edges that end in a re-entrant corner.
/// \param corners of each joint in order round it, as findContactPoints gives them
std::vector<PatchCells> patchCells(const std::vector<ContactPoint<3>>& corners);

/// Cuts all cells along the line normal . x = offset. Vertices within 1e-9 of the extent lie on the line.
/// \param normal a unit vector \return whether it cut any
bool cutAlong(PatchCells& patch, const Vector<2>& normal, double offset);

/// Cuts along the lines of a grid of perSide x perSide points over the patch's bounding rectangle, along its
/// longest edge. A rectangular patch has exactly the points of the grid. \param perSide at least 2
void cutIntoGrid(PatchCells& patch, int perSide);

/// Divides some cells, each into one part a corner, by lines from its centroid to the middles of its edges.
/// Cells beside them stay as they are, with a vertex of others on their edge. \param isDivided one a cell
void divideCells(PatchCells& patch, const std::vector<char>& isDivided);

/// The part of the patch's area that each vertex stands for [m2]: of each cell the triangles from its
/// centroid to its edges, half of each for either end. The areas add up to that of the patch, their moments
/// to its own.
///
/// So forces at the vertices never carry less than the patch: for a stress over a cell take at each vertex
/// its integral times the function that is 1 there and falls to 0 along straight lines, the one of the
/// centroid shared out in the proportions above. These functions add up to 1 and, times the places of their
/// vertices, to the place x, so that forces and moments are those of the stress, and where this is bounded
/// by s everywhere each force is bounded by s times the area of its vertex. The same holds for shear, whose
/// length is below the integral of its own. With more cells the limits of the vertices approach those of the
/// stress from above, with the square of the cells' size.
std::vector<double> vertexAreas(const PatchCells& patch);

/// The vertices of the patches as contact points, joint after joint.
std::vector<ContactPoint<3>> pointsOf(const std::vector<PatchCells>& patches);

/// Their areas, see vertexAreas.
std::vector<double> areasOf(const std::vector<PatchCells>& patches);

} // namespace drystone
