// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks of space, or parts of them, as convex solids: what contacts are searched between. Internal to
/// MovingContacts.
#pragma once

#include "assembly/Assembly.h"
#include "geometry/space/Polyhedron.h"

#include <vector>

namespace drystone
{

/// A convex polyhedron with one face in each plane and its edges. Faces run counter-clockwise seen from
/// outside.
struct ConvexSolid
{
    /// Between two faces; runs counter-clockwise round the first.
    struct Edge
    {
        int from;
        int to;
        int face;
        int otherFace;
    };
    std::vector<Vector<3>> vertices; ///< [m]
    std::vector<std::vector<int>> faces;
    std::vector<Vector<3>> normals; ///< of the faces, outwards
    std::vector<Edge> edges;
    double thickness =
        0; ///< least distance of two parallel planes that hold it between them, one of a face [m]
};

/// \param shape convex; pieces of one plane become one face, vertices along a straight edge none
/// \param tolerance by which vertices may be off a plane [m]
ConvexSolid convexSolid(const Polyhedron& shape, double tolerance);

/// A vertex of a face.
const Vector<3>& pointOf(const ConvexSolid& solid, int face);

/// The least that a vertex is above a point, along a direction of length one [m].
double leastAlong(const ConvexSolid& solid, const Vector<3>& normal, const Vector<3>& point);

/// The edge between two vertices, in either order; -1: none.
int edgeBetween(const ConvexSolid& solid, int from, int to);

/// The solid where its block is. \param centroid of the block as built
ConvexSolid placed(ConvexSolid solid, const Vector<3>& centroid, const Placement<3>& placement);

/// Blocks as convex solids where they are, each placed when it is first asked for. Of the lists none is
/// owned.
class PlacedSolids
{
public:
    /// \param asBuilt the solids of each block \param centroidsOfBlocks as built
    PlacedSolids(const std::vector<std::vector<ConvexSolid>>& asBuilt,
                 const std::vector<Vector<3>>& centroidsOfBlocks,
                 const std::vector<Placement<3>>& placementsOfBlocks);

    const std::vector<ConvexSolid>& of(int block);
    const std::vector<Placement<3>>& placements() const { return *where; }

private:
    const std::vector<std::vector<ConvexSolid>>* solids;
    const std::vector<Vector<3>>* centroids;
    const std::vector<Placement<3>>* where;
    std::vector<std::vector<ConvexSolid>> there;
};

} // namespace drystone
