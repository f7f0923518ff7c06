// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What each contact point carries: the properties of its joint, over its part of the joint's area.
#pragma once

#include "contact/ContactPoint.h"
#include "contact/ContactProperties.h"

#include <limits>

namespace drystone
{

/// Limits to the force (n, t) of a point: -tension <= n <= crushing, |t| <= cohesion + mu n; in space t has
/// two components.
struct PointLaw
{
    double mu = 0;                                             ///< friction coefficient
    double cohesion = 0;                                       ///< [N]
    double tension = 0;                                        ///< [N]
    double crushing = std::numeric_limits<double>::infinity(); ///< [N]
};

/// Name of the joint of two blocks, for patterns and messages: `3-7`, lower index first; a fixed block goes
/// by the name of its support and comes last, `12-ground`.
template<int Dim>
std::string jointName(const Assembly<Dim>& assembly, int block, int neighbour);

/// Area that each point stands for [m2]. In the plane: thickness times half the way to its neighbours in the
/// joint. The thickness is the lesser of the two blocks', or that of the free one. In space, for points at
/// the corners of a patch: of a convex one the triangles from its centroid to its edges, half of each for
/// either end; of a concave one, whose centroid may lie outside, a third of the triangles that it is divided
/// into. None is negative, they add up to the area of the patch and their moments to its own (vertexAreas of
/// space/PatchCells.h has those of points within it).
///
/// With the ends among the points a block of uniform pressure from one end inwards has its resultant where it
/// belongs to second order in their distance.
std::vector<double> pointAreas(const Assembly<2>& assembly, const std::vector<ContactPoint<2>>& points);
std::vector<double> pointAreas(const Assembly<3>& assembly, const std::vector<ContactPoint<3>>& points);

/// The law of each point.
/// \param areas that each stands for [m2]; without them those of pointAreas
/// \throws FatalIOError for a name of `joints` that no joint has, a tension beyond cohesion / mu
template<int Dim>
std::vector<PointLaw> pointLaws(const std::filesystem::path& caseDirectory,
                                const ContactProperties& properties, const Assembly<Dim>& assembly,
                                const std::vector<ContactPoint<Dim>>& points,
                                const std::vector<double>& areas);
template<int Dim>
std::vector<PointLaw> pointLaws(const std::filesystem::path& caseDirectory,
                                const ContactProperties& properties, const Assembly<Dim>& assembly,
                                const std::vector<ContactPoint<Dim>>& points)
{
    return pointLaws(caseDirectory, properties, assembly, points, pointAreas(assembly, points));
}

} // namespace drystone
