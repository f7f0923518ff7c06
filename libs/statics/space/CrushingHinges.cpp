// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Hinges of joints in space: where zones that crush end.
#include "statics/CrushingHinges.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace drystone
{
namespace
{

constexpr int directionsTried = 48;
constexpr double nearLimit =
    0.02; ///< of the width: what lies this near to it may be beyond between two tries

/// A patch in coordinates in which its second moments of area are those of the unit circle in every
/// direction, so that long patches have no directions between those tried. Limits of moments stay what they
/// are under affine maps.
struct RoundPatch
{
    Vector<2> centroid = Vector<2>::Zero();                ///< of the patch [m]
    Eigen::Matrix2d toRound = Eigen::Matrix2d::Identity(); ///< of what is measured from the centroid
    std::vector<Polygon> cells;                            ///< convex, counter-clockwise
    double area = 0;                                       ///< of the cells
};

RoundPatch roundPatchOf(const PatchCells& patch)
{
    RoundPatch result;
    double area = 0;
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
    const auto forTriangles = [&](const auto& visit)
    {
        for (const std::vector<int>& cell : patch.cells)
        {
            for (std::size_t i = 1; i + 1 < cell.size(); ++i)
            {
                const Vector<2> a = patch.vertices[cell[0]] - result.centroid;
                const Vector<2> b = patch.vertices[cell[i]] - result.centroid;
                const Vector<2> c = patch.vertices[cell[i + 1]] - result.centroid;
                visit(cross(b - a, c - a) / 2, a, b, c);
            }
        }
    };
    Vector<2> first = Vector<2>::Zero();
    forTriangles(
        [&](double part, const Vector<2>& a, const Vector<2>& b, const Vector<2>& c)
        {
            area += part;
            first += part / 3 * (a + b + c);
        });
    result.centroid = first / area;
    forTriangles(
        [&](double part, const Vector<2>& a, const Vector<2>& b, const Vector<2>& c)
        {
            const Vector<2> sum = a + b + c;
            second += part / 12
                      * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
        });
    const Eigen::Matrix2d factor = Eigen::Matrix2d((second / area).llt().matrixL());
    result.toRound = factor.inverse(); // its diagonal is positive: cells stay counter-clockwise
    result.area = area * result.toRound.determinant();
    for (const std::vector<int>& cell : patch.cells)
    {
        Polygon polygon;
        for (const int vertex : cell)
        {
            polygon.emplace_back(result.toRound * (patch.vertices[vertex] - result.centroid));
        }
        result.cells.push_back(std::move(polygon));
    }
    return result;
}

/// The part of a patch beyond a line, normal . x >= offset.
struct Zone
{
    double offset = 0;
    double area = 0;
    Vector<2> moment = Vector<2>::Zero(); ///< first moment of area
    double edge = 0;                      ///< length of the line within the patch
};

Zone zoneBeyond(const RoundPatch& patch, const Vector<2>& normal, double offset)
{
    Zone zone;
    zone.offset = offset;
    const Vector<2> along = perpendicular(normal);
    for (const Polygon& cell : patch.cells)
    {
        // Triangles about the first corner found beyond.
        std::optional<Vector<2>> first;
        Vector<2> last = Vector<2>::Zero();
        const auto addCorner = [&](const Vector<2>& corner)
        {
            if (!first)
            {
                first = corner;
            }
            else
            {
                const double part = cross(last - *first, corner - *first) / 2;
                zone.area += part;
                zone.moment += part / 3 * (*first + last + corner);
            }
            last = corner;
        };
        double lower = 1e300;
        double upper = -1e300;
        for (std::size_t i = 0; i < cell.size(); ++i)
        {
            const Vector<2>& from = cell[i];
            const Vector<2>& to = cell[(i + 1) % cell.size()];
            const double sideFrom = normal.dot(from) - offset;
            const double sideTo = normal.dot(to) - offset;
            if (sideFrom >= 0)
            {
                addCorner(from);
            }
            if ((sideFrom > 0 && sideTo < 0) || (sideFrom < 0 && sideTo > 0))
            {
                const Vector<2> between = from + sideFrom / (sideFrom - sideTo) * (to - from);
                addCorner(between);
                lower = std::min(lower, along.dot(between));
                upper = std::max(upper, along.dot(between));
            }
        }
        zone.edge += std::max(upper - lower, 0.0);
    }
    return zone;
}

struct Reach
{
    double lower = 1e300, upper = -1e300;
};

Reach reachOf(const RoundPatch& patch, const Vector<2>& normal)
{
    Reach reach;
    for (const Polygon& cell : patch.cells)
    {
        for (const Vector<2>& corner : cell)
        {
            reach.lower = std::min(reach.lower, normal.dot(corner));
            reach.upper = std::max(reach.upper, normal.dot(corner));
        }
    }
    return reach;
}

/// The zone of an area on the side of a normal: Newton's method, held between bounds.
Zone zoneOfArea(const RoundPatch& patch, const Vector<2>& normal, double area)
{
    Reach bounds = reachOf(patch, normal);
    Zone zone = zoneBeyond(patch, normal, (bounds.lower + bounds.upper) / 2);
    for (int i = 0; i < 100; ++i)
    {
        const double excess = zone.area - area;
        if (std::abs(excess) <= 1e-15 * patch.area)
        {
            break;
        }
        (excess > 0 ? bounds.lower : bounds.upper) = zone.offset;
        double offset = zone.offset + excess / zone.edge;
        if (!(offset > bounds.lower && offset < bounds.upper))
        {
            offset = (bounds.lower + bounds.upper) / 2;
        }
        if (offset == zone.offset)
        {
            break;
        }
        zone = zoneBeyond(patch, normal, offset);
    }
    return zone;
}

/// How far a resultant lies beyond the zone on one side, for every area of the zone.
struct Beyond
{
    double angle = 0; ///< of the side's normal [rad]
    double part = 0;  ///< by how much of the patch's width there, negative where it lies within
    double slope = 0; ///< derivative of the distance by the angle
    Zone zone;
};

Vector<2> normalAt(double angle)
{
    return {std::cos(angle), std::sin(angle)};
}

Beyond beyondAt(const RoundPatch& patch, const Vector<2>& resultant, double area, double angle)
{
    Beyond result;
    result.angle = angle;
    const Vector<2> normal = normalAt(angle);
    result.zone = zoneOfArea(patch, normal, area);
    const Vector<2> apart = resultant - result.zone.moment / area;
    const Reach reach = reachOf(patch, normal);
    result.part = normal.dot(apart) / (reach.upper - reach.lower);
    // The zone is the one that lies farthest to this side: to first order its change adds nothing.
    result.slope = perpendicular(normal).dot(apart);
    return result;
}

/// The side beyond which a resultant lies farthest.
Beyond farthestBeyond(const RoundPatch& patch, const Vector<2>& resultant, double area)
{
    constexpr double step = 2 * std::numbers::pi / directionsTried;
    std::array<Beyond, directionsTried> tried;
    for (int i = 0; i < directionsTried; ++i)
    {
        tried[static_cast<std::size_t>(i)] = beyondAt(patch, resultant, area, i * step);
    }
    Beyond best = *std::max_element(tried.begin(), tried.end(),
                                    [](const Beyond& one, const Beyond& two) { return one.part < two.part; });
    for (std::size_t i = 0; i < tried.size() && best.part > -nearLimit; ++i)
    {
        Beyond lower = tried[i];
        Beyond upper = tried[(i + 1) % tried.size()];
        if (!(lower.slope > 0 && upper.slope < 0))
        {
            continue;
        }
        upper.angle = lower.angle + step;
        while (upper.angle - lower.angle > 1e-12)
        {
            const Beyond middle = beyondAt(patch, resultant, area, (lower.angle + upper.angle) / 2);
            (middle.slope > 0 ? lower : upper) = middle;
        }
        if (lower.part > best.part)
        {
            best = lower;
        }
    }
    return best;
}

/// Cuts a patch where forces want a hinge, if they do.
bool cutAtHinge(PatchCells& patch, const RoundPatch& round, const Strength& total,
                const Eigen::VectorXd& forces, std::size_t first, std::size_t points, double tolerance)
{
    double resultant = total.tension;
    Vector<2> moment = Vector<2>::Zero(); // about the centroid, where the tension acts
    for (std::size_t i = 0; i < points; ++i)
    {
        const double normal = forces[3 * static_cast<Eigen::Index>(first + i)];
        resultant += normal;
        moment += normal * (patch.vertices[i] - round.centroid);
    }
    const double share = resultant / (total.crushing + total.tension);
    if (!(share > 0) || share >= 1)
    {
        return false;
    }
    const Beyond farthest = farthestBeyond(round, round.toRound * (moment / resultant), share * round.area);
    if (!(farthest.part > tolerance))
    {
        return false;
    }
    // n . toRound (x - centroid) = offset
    const Vector<2> normal = round.toRound.transpose() * normalAt(farthest.angle);
    const double length = normal.norm();
    return cutAlong(patch, normal / length, (farthest.zone.offset + normal.dot(round.centroid)) / length);
}

} // namespace

bool addCrushingHinges(JointPoints<3>& joints, const std::vector<Eigen::VectorXd>& contactForces,
                       double tolerance)
{
    bool isAny = false;
    std::vector<std::size_t> pointsBefore;
    std::size_t first = 0;
    for (PatchCells& patch : joints.patches)
    {
        const std::size_t points = patch.vertices.size();
        pointsBefore.push_back(points);
        Strength total;
        total.crushing = 0;
        for (std::size_t i = first; i < first + points; ++i)
        {
            total.tension += joints.strength[i].tension;
            total.crushing += joints.strength[i].crushing;
        }
        if (total.isBounded())
        {
            const RoundPatch round = roundPatchOf(patch);
            for (const Eigen::VectorXd& forces : contactForces)
            {
                isAny = cutAtHinge(patch, round, total, forces, first, points, tolerance) || isAny;
            }
        }
        first += points;
    }
    shareOut(joints, pointsBefore);
    return isAny;
}

} // namespace drystone
