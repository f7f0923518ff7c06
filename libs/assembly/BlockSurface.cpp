// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Pieces of the surface of blocks.
#include "assembly/BlockSurface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace drystone
{

std::vector<SurfacePiece<2>> surfaceOf(const Assembly<2>& assembly, int block)
{
    const Polygon& outline = assembly.blocks[block].outline;
    std::vector<SurfacePiece<2>> pieces;
    for (std::size_t i = 0; i < outline.size(); ++i)
    {
        const Vector<2>& from = outline[i];
        const Vector<2>& to = outline[(i + 1) % outline.size()];
        // Counter-clockwise: outside is to the right of an edge.
        pieces.push_back(
            {block, -perpendicular(to - from).normalized(), {from, to}, assembly.blocks[block].thickness});
    }
    return pieces;
}

std::vector<SurfacePiece<3>> surfaceOf(const Assembly<3>& assembly, int block)
{
    const Polyhedron& shape = assembly.blocks[block].shape;
    std::vector<SurfacePiece<3>> pieces;
    for (const std::vector<int>& face : shape.faces)
    {
        std::vector<Vector<3>> corners;
        for (const int vertex : face)
        {
            corners.push_back(shape.vertices[vertex]);
        }
        addPolygon(pieces, block, areaVector(shape, face).normalized(), corners, 1);
    }
    return pieces;
}

void addPolygon(std::vector<SurfacePiece<3>>& pieces, int block, const Vector<3>& normal,
                const std::vector<Vector<3>>& corners, double sign)
{
    std::vector<double> areas;
    double sum = 0;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    {
        areas.push_back(normal.dot((corners[i] - corners[0]).cross(corners[i + 1] - corners[0])));
        sum += areas.back();
    }
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    {
        // The corners may go round either way: what has the sign of the sum belongs to the polygon.
        const double side = areas[i - 1] * sum < 0 ? -1 : 1;
        pieces.push_back({block, normal, {corners[0], corners[i], corners[i + 1]}, sign * side});
    }
}

double areaOf(const SurfacePiece<2>& piece)
{
    return piece.weight * (piece.corners[1] - piece.corners[0]).norm();
}

double areaOf(const SurfacePiece<3>& piece)
{
    return piece.weight * 0.5
           * (piece.corners[1] - piece.corners[0]).cross(piece.corners[2] - piece.corners[0]).norm();
}

namespace
{

/// The point of the edge from a to b where a linear function that is `atA` and `atB` vanishes.
template<int Dim>
Vector<Dim> crossing(const Vector<Dim>& a, double atA, const Vector<Dim>& b, double atB)
{
    return a + atA / (atA - atB) * (b - a);
}

void addPart(std::vector<SurfacePiece<2>>& parts, SurfacePiece<2> piece, const std::array<double, 2>& above)
{
    for (const int outside : {0, 1})
    {
        const int inside = 1 - outside;
        if (above[outside] > 0 && above[inside] < 0)
        {
            piece.corners[outside] =
                crossing<2>(piece.corners[inside], above[inside], piece.corners[outside], above[outside]);
        }
    }
    if (above[0] < 0 || above[1] < 0 || (above[0] == 0 && above[1] == 0))
    {
        parts.push_back(piece);
    }
}

void addPart(std::vector<SurfacePiece<3>>& parts, const SurfacePiece<3>& piece,
             const std::array<double, 3>& above)
{
    // Sutherland and Hodgman (1974): the triangle without what is above has up to four corners.
    std::vector<Vector<3>> kept;
    for (int i = 0; i < 3; ++i)
    {
        const int next = (i + 1) % 3;
        if (above[i] <= 0)
        {
            kept.push_back(piece.corners[i]);
        }
        if (above[i] * above[next] < 0)
        {
            kept.push_back(crossing<3>(piece.corners[i], above[i], piece.corners[next], above[next]));
        }
    }
    for (std::size_t i = 1; i + 1 < kept.size(); ++i)
    {
        parts.push_back({piece.block, piece.normal, {kept[0], kept[i], kept[i + 1]}, piece.weight});
    }
}

} // namespace

template<int Dim>
std::vector<SurfacePiece<Dim>> partBelow(const std::vector<SurfacePiece<Dim>>& pieces,
                                         const std::type_identity_t<Vector<Dim>>& direction, double offset)
{
    constexpr double rounding = 1e-14; // a top at 3 x 0.1 lies at 0.3
    std::vector<SurfacePiece<Dim>> parts;
    for (const SurfacePiece<Dim>& piece : pieces)
    {
        std::array<double, Dim> above{};
        for (int i = 0; i < Dim; ++i)
        {
            above[i] = direction.dot(piece.corners[i]) - offset;
            if (std::abs(above[i]) <= rounding * std::max(std::abs(offset), piece.corners[i].norm()))
            {
                above[i] = 0;
            }
        }
        addPart(parts, piece, above);
    }
    return parts;
}

std::array<std::pair<Vector<2>, double>, 3> quadratureOf(const SurfacePiece<2>& piece)
{
    // Simpson's rule.
    const auto& [from, to] = piece.corners;
    const double area = areaOf(piece);
    return {{{from, area / 6}, {(from + to) / 2, 4 * area / 6}, {to, area / 6}}};
}

std::array<std::pair<Vector<3>, double>, 3> quadratureOf(const SurfacePiece<3>& piece)
{
    // The middles of the edges, exact for degree 2 (Strang and Fix, 1973).
    const auto& [a, b, c] = piece.corners;
    const double third = areaOf(piece) / 3;
    return {{{(a + b) / 2, third}, {(b + c) / 2, third}, {(c + a) / 2, third}}};
}

template std::vector<SurfacePiece<2>> partBelow(const std::vector<SurfacePiece<2>>& pieces,
                                                const Vector<2>& direction, double offset);
template std::vector<SurfacePiece<3>> partBelow(const std::vector<SurfacePiece<3>>& pieces,
                                                const Vector<3>& direction, double offset);

} // namespace drystone
