// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Cells between planes: convex polyhedra as lists of polygons, cut by one plane after another.
#include "geometry/space/ConvexParts.h"

#include "geometry/Box.h"
#include "geometry/space/FacePolygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace drystone
{
namespace
{

using Points = std::vector<Vector<3>>;

struct Plane
{
    Vector<3> point;
    Vector<3> normal;

    double height(const Vector<3>& place) const { return normal.dot(place - point); }
    Plane turnedRound() const { return {point, -normal}; }
};

/// A plane polygon, counter-clockwise seen from where its normal points.
struct Facet
{
    Plane plane;
    Points corners;
};

using Cell = std::vector<Facet>;

Points cornersOf(const Polyhedron& polyhedron, const std::vector<int>& face)
{
    Points corners;
    for (const int vertex : face)
    {
        corners.push_back(polyhedron.vertices[static_cast<std::size_t>(vertex)]);
    }
    return corners;
}

Facet facetOf(const Polyhedron& polyhedron, const std::vector<int>& face)
{
    Facet facet;
    facet.corners = cornersOf(polyhedron, face);
    facet.plane.normal = areaVector(polyhedron, face).normalized();
    facet.plane.point = Vector<3>::Zero();
    for (const Vector<3>& corner : facet.corners)
    {
        facet.plane.point += corner / static_cast<double>(facet.corners.size());
    }
    return facet;
}

/// The part of a polygon behind a plane (Sutherland & Hodgman 1974). Corners within the tolerance are on it.
/// A concave one keeps a bridge without area where it falls apart.
Points behind(const Points& polygon, const Plane& plane, double tolerance)
{
    Points kept;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const Vector<3>& here = polygon[i];
        const Vector<3>& next = polygon[(i + 1) % polygon.size()];
        const double above = plane.height(here);
        const double nextAbove = plane.height(next);
        if (above <= tolerance)
        {
            kept.push_back(here);
        }
        const bool crosses =
            std::min(above, nextAbove) < -tolerance && std::max(above, nextAbove) > tolerance;
        if (crosses)
        {
            kept.push_back(here + above / (above - nextAbove) * (next - here));
        }
    }
    return kept;
}

/// Area over extent [m].
double widthOf(const Points& polygon)
{
    Vector<3> area = Vector<3>::Zero();
    double extent = 0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    {
        area += 0.5 * (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]);
    }
    for (const Vector<3>& corner : polygon)
    {
        extent = std::max(extent, (corner - polygon[0]).norm());
    }
    return extent > 0 ? area.norm() / extent : 0;
}

/// The polygon in which a plane cuts a cell, from corners in any order, some of them there several times.
Points roundOf(const Points& corners, const Vector<3>& normal, double tolerance)
{
    Points round;
    Vector<3> middle = Vector<3>::Zero();
    for (const Vector<3>& corner : corners)
    {
        const auto isThere = [&](const Vector<3>& other) { return (other - corner).norm() <= tolerance; };
        if (std::none_of(round.begin(), round.end(), isThere))
        {
            round.push_back(corner);
            middle += corner;
        }
    }
    if (round.size() < 3)
    {
        return {};
    }
    middle /= static_cast<double>(round.size());
    const Vector<3> along = normal.unitOrthogonal();
    const Vector<3> across = normal.cross(along);
    const auto angleOf = [&](const Vector<3>& corner)
    { return std::atan2((corner - middle).dot(across), (corner - middle).dot(along)); };
    std::sort(round.begin(), round.end(),
              [&](const Vector<3>& a, const Vector<3>& b) { return angleOf(a) < angleOf(b); });
    return round;
}

/// The part of a cell behind a plane; empty where it is thinner than the tolerance.
Cell cellBehind(const Cell& cell, const Plane& plane, double tolerance)
{
    Cell kept;
    Points onPlane;
    double deepest = 0;
    for (const Facet& facet : cell)
    {
        Points corners = behind(facet.corners, plane, tolerance);
        for (const Vector<3>& corner : corners)
        {
            const double height = plane.height(corner);
            deepest = std::max(deepest, -height);
            if (std::abs(height) <= tolerance)
            {
                onPlane.push_back(corner);
            }
        }
        // What is left of a facet next to the plane is a corner or an edge of it.
        if (corners.size() > 2 && widthOf(corners) > 0.5 * tolerance)
        {
            kept.push_back({facet.plane, std::move(corners)});
        }
    }
    if (deepest <= tolerance)
    {
        return {};
    }
    const auto isOfPlane = [&](const Facet& facet)
    {
        return std::all_of(facet.corners.begin(), facet.corners.end(),
                           [&](const Vector<3>& corner)
                           { return std::abs(plane.height(corner)) <= tolerance; });
    };
    Points cap = roundOf(onPlane, plane.normal, tolerance);
    if (cap.size() > 2 && std::none_of(kept.begin(), kept.end(), isOfPlane))
    {
        kept.push_back({plane, std::move(cap)});
    }
    return kept;
}

/// A box around the polyhedron that leaves its size free on all sides.
Cell cellAround(const Polyhedron& polyhedron)
{
    const Box<3> box = boxAround<3>(polyhedron.vertices);
    const double reach = (box.upper - box.lower).norm();
    const Polyhedron solid =
        makeBox(Vector<3>(box.lower.array() - reach), Vector<3>(box.upper.array() + reach));
    Cell cell;
    for (const std::vector<int>& face : solid.faces)
    {
        cell.push_back(facetOf(solid, face));
    }
    return cell;
}

/// The least and the greatest height of a facet above a plane.
std::pair<double, double> heightsOf(const Facet& facet, const Plane& plane)
{
    std::pair<double, double> heights(std::numeric_limits<double>::infinity(),
                                      -std::numeric_limits<double>::infinity());
    for (const Vector<3>& corner : facet.corners)
    {
        const double height = plane.height(corner);
        heights = {std::min(heights.first, height), std::max(heights.second, height)};
    }
    return heights;
}

/// Whether a face goes through the inside of a cell.
bool goesThrough(const Facet& face, const Cell& cell, double tolerance)
{
    Points left = face.corners;
    for (const Facet& facet : cell)
    {
        // Not what lies in its surface.
        left = behind(left, {facet.plane.point - 2 * tolerance * facet.plane.normal, facet.plane.normal}, 0);
        if (left.size() < 3)
        {
            return false;
        }
    }
    return widthOf(left) > tolerance;
}

Vector<3> middleOf(const Cell& cell)
{
    Vector<3> sum = Vector<3>::Zero();
    double count = 0;
    for (const Facet& facet : cell)
    {
        for (const Vector<3>& corner : facet.corners)
        {
            sum += corner;
            ++count;
        }
    }
    return sum / count;
}

/// With vertices that its facets share.
Polyhedron polyhedronOf(const Cell& cell, double tolerance)
{
    Polyhedron polyhedron;
    for (const Facet& facet : cell)
    {
        std::vector<int> face;
        for (const Vector<3>& corner : facet.corners)
        {
            const auto there =
                std::find_if(polyhedron.vertices.begin(), polyhedron.vertices.end(),
                             [&](const Vector<3>& vertex) { return (vertex - corner).norm() <= tolerance; });
            const auto index = static_cast<int>(there - polyhedron.vertices.begin());
            if (there == polyhedron.vertices.end())
            {
                polyhedron.vertices.push_back(corner);
            }
            if (face.empty() || (face.back() != index && face.front() != index))
            {
                face.push_back(index);
            }
        }
        if (face.size() > 2)
        {
            polyhedron.faces.push_back(std::move(face));
        }
    }
    return polyhedron;
}

/// The cells of a solid, divided from one that holds it.
class Division
{
public:
    Division(const Polyhedron& polyhedron, double within, std::size_t mostParts)
        : solid(polyhedron), tolerance(within), most(mostParts)
    {
        for (const std::vector<int>& face : solid.faces)
        {
            faces.push_back(facetOf(solid, face));
        }
    }

    /// \return whether they are not too many
    bool divide()
    {
        Cell cell = cellAround(solid);
        // Planes that all is behind of first: they divide nothing.
        for (const Facet& face : faces)
        {
            const auto isBehind = [&](const Vector<3>& vertex)
            { return face.plane.height(vertex) <= tolerance; };
            if (std::all_of(solid.vertices.begin(), solid.vertices.end(), isBehind))
            {
                cell = cellBehind(cell, face.plane, tolerance);
            }
        }
        return divide(cell);
    }

    std::vector<Polyhedron> parts;

private:
    bool divide(const Cell& cell)
    {
        if (cell.empty())
        {
            return true;
        }
        const std::optional<Plane> plane = bestPlane(cell);
        if (plane)
        {
            return ++cuts <= most && divide(cellBehind(cell, *plane, tolerance))
                   && divide(cellBehind(cell, plane->turnedRound(), tolerance));
        }
        if (distance(solid, middleOf(cell)) == 0)
        {
            parts.push_back(polyhedronOf(cell, tolerance));
        }
        return parts.size() <= most;
    }

    /// Of the planes of faces that go through a cell that which cuts the fewest of them, and of such that
    /// which has the most in it.
    std::optional<Plane> bestPlane(const Cell& cell) const
    {
        std::vector<const Facet*> through;
        for (const Facet& face : faces)
        {
            if (goesThrough(face, cell, tolerance))
            {
                through.push_back(&face);
            }
        }
        std::optional<Plane> best;
        std::pair<std::ptrdiff_t, std::ptrdiff_t> fewest;
        for (const Facet* face : through)
        {
            std::pair<std::ptrdiff_t, std::ptrdiff_t> cost(0, 0);
            for (const Facet* other : through)
            {
                const auto [least, highest] = heightsOf(*other, face->plane);
                cost.first += least < -tolerance && highest > tolerance;
                cost.second -= least >= -tolerance && highest <= tolerance;
            }
            if (!best || cost < fewest)
            {
                fewest = cost;
                best = face->plane;
            }
        }
        return best;
    }

    const Polyhedron& solid;
    const double tolerance;
    const std::size_t most;
    std::vector<Facet> faces;
    std::size_t cuts = 0;
};

} // namespace

std::vector<Polyhedron> convexParts(const Polyhedron& polyhedron, double tolerance, std::size_t most)
{
    Division division(polyhedron, tolerance, most);
    return division.divide() ? std::move(division.parts) : std::vector<Polyhedron>();
}

} // namespace drystone
