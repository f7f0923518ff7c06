// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Joints as parts of the surfaces of both their blocks.
#include "contact/CoveredSurface.h"

#include "contact/PointsOfJoints.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// The normal of the face that a joint is in. A joint lies halfway between two faces that may be turned by
/// 1e-3 against each other; with the normal of the face itself both are chosen, or neither.
template<int Dim>
Vector<Dim> normalOfFace(const Assembly<Dim>& assembly, int block, const Vector<Dim>& outwards)
{
    const std::vector<SurfacePiece<Dim>> surface = surfaceOf(assembly, block);
    return std::max_element(surface.begin(), surface.end(),
                            [&](const auto& a, const auto& b)
                            { return a.normal.dot(outwards) < b.normal.dot(outwards); })
        ->normal;
}

void addSide(std::vector<SurfacePiece<2>>& pieces, const Assembly<2>& assembly, int block, int other,
             const Vector<2>& outwards, const std::vector<Vector<2>>& ends)
{
    const Block<2>& own = assembly.blocks[block];
    const Block<2>& beside = assembly.blocks[other];
    const double thickness = beside.support >= 0 ? own.thickness : std::min(own.thickness, beside.thickness);
    pieces.push_back(
        {block, normalOfFace(assembly, block, outwards), {ends.front(), ends.back()}, -thickness});
}

void addSide(std::vector<SurfacePiece<3>>& pieces, const Assembly<3>& assembly, int block, int /*other*/,
             const Vector<3>& outwards, const std::vector<Vector<3>>& corners)
{
    addPolygon(pieces, block, normalOfFace(assembly, block, outwards), corners, -1);
}

} // namespace

template<int Dim>
std::vector<SurfacePiece<Dim>> coveredSurface(const Assembly<Dim>& assembly)
{
    const std::vector<ContactPoint<Dim>> points = findContactPoints(assembly);
    std::vector<SurfacePiece<Dim>> pieces;
    for (const PointRange& joint : pointsOfJoints(points))
    {
        const ContactPoint<Dim>& point = points[joint.begin];
        std::vector<Vector<Dim>> corners;
        for (std::size_t i = joint.begin; i < joint.end; ++i)
        {
            corners.push_back(points[i].position);
        }
        addSide(pieces, assembly, point.block, point.neighbour, -point.normal, corners);
        addSide(pieces, assembly, point.neighbour, point.block, point.normal, corners);
    }
    return pieces;
}

template std::vector<SurfacePiece<2>> coveredSurface(const Assembly<2>& assembly);
template std::vector<SurfacePiece<3>> coveredSurface(const Assembly<3>& assembly);

} // namespace drystone
