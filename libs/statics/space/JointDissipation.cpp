// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Integration of the dissipation over the cells of patches.
#include "statics/JointDissipation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace drystone
{
namespace
{

constexpr int mostDivisions = 8;

/// Of a joint per area [Pa].
struct StressLimits
{
    double mu = 0;
    Strength strength;
};

/// d(c).
double rateOf(const StressLimits& limits, const Vector<3>& closing)
{
    const double slip = closing.tail<2>().norm();
    const double squeezed = closing[0] + limits.mu * slip;
    double rate = limits.strength.cohesion * slip + limits.strength.tension * std::max(0.0, -squeezed);
    if (squeezed > 0 && limits.strength.isBounded()) // otherwise it is rounding
    {
        rate += limits.strength.crushing * squeezed;
    }
    return rate;
}

/// Of a triangle by which its sum over the corners exceeds the integral. \param rates at the corners
/// \param enough differences that do not matter
double excessOver(const StressLimits& limits, double area, const std::array<Vector<3>, 3>& closing,
                  const std::array<double, 3>& rates, double enough, int divisions)
{
    std::array<Vector<3>, 3> middle; // opposite to each corner
    std::array<double, 3> middleRates{};
    double less = 0;
    for (int i = 0; i < 3; ++i)
    {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        middle[i] = (closing[j] + closing[k]) / 2;
        middleRates[i] = rateOf(limits, middle[i]);
        // A corner is one of a part, of a third of a quarter of the area; a middle one of three.
        less += area / 4 * ((rates[j] + rates[k]) / 2 - middleRates[i]);
    }
    if (less <= enough || divisions == 0)
    {
        return less;
    }
    double excess = less;
    for (int i = 0; i < 3; ++i)
    {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        excess += excessOver(limits, area / 4, {closing[i], middle[k], middle[j]},
                             {rates[i], middleRates[k], middleRates[j]}, enough / 4, divisions - 1);
    }
    return excess + excessOver(limits, area / 4, middle, middleRates, enough / 4, divisions - 1);
}

/// What the points of all patches say of a mechanism.
struct PointRates
{
    std::vector<StressLimits> limits;
    std::vector<Vector<3>> closing; ///< see closingRates
    std::vector<double> rate;       ///< d(closing) [W/m2]
    double dissipated = 0;          ///< at the points, by which small differences are judged
};

/// Closing rates of all points: A'y for a unit of work of the live load, of a settlement A'y - g for the unit
/// movement. Empty where the mechanism does no work.
Eigen::VectorXd closingRates(const SpaceConeProgram& program, const Eigen::VectorXd& liveLoad,
                             const Eigen::VectorXd& mechanism)
{
    if (program.gap.size() > 0)
    {
        return applyTransposed(program, mechanism) - program.gap;
    }
    const double work = std::abs(liveLoad.dot(mechanism));
    return work > 0 ? Eigen::VectorXd(applyTransposed(program, mechanism) / work) : Eigen::VectorXd();
}

/// \param closing of all points, likewise
PointRates pointRates(const SpaceConeProgram& program, const std::vector<PatchCells>& patches,
                      const Eigen::VectorXd& closing)
{
    PointRates points;
    std::size_t point = 0;
    for (const PatchCells& patch : patches)
    {
        for (const double area : vertexAreas(patch))
        {
            const Strength& whole = program.strength[point];
            StressLimits limits{program.friction[point], whole};
            limits.strength.cohesion = area > 0 ? whole.cohesion / area : 0;
            limits.strength.tension = area > 0 ? whole.tension / area : 0;
            limits.strength.crushing =
                area > 0 ? whole.crushing / area : std::numeric_limits<double>::infinity();
            points.closing.emplace_back(closing.segment<3>(3 * static_cast<Eigen::Index>(point)));
            points.rate.push_back(rateOf(limits, points.closing.back()));
            points.dissipated += area * points.rate.back();
            points.limits.push_back(limits);
            ++point;
        }
    }
    return points;
}

/// A cell as triangles about its centroid, as in vertexAreas, whose function is shared out to the corners.
struct Triangles
{
    std::vector<double> parts; ///< area of the triangle from each corner to the next [m2]
    double area = 0;

    /// Of the cell that a corner stands for.
    double areaOf(std::size_t corner) const
    {
        return (parts[corner] + parts[(corner + parts.size() - 1) % parts.size()]) / 2;
    }
};

Triangles trianglesOf(const PatchCells& patch, const std::vector<int>& cell)
{
    Polygon outline;
    for (const int vertex : cell)
    {
        outline.push_back(patch.vertices[static_cast<std::size_t>(vertex)]);
    }
    const Vector<2> centroid = areaProperties(outline).centroid;
    Triangles triangles;
    for (std::size_t i = 0; i < cell.size(); ++i)
    {
        const Vector<2> next = outline[(i + 1) % cell.size()] - centroid;
        triangles.parts.push_back(std::abs(cross(outline[i] - centroid, next)) / 2);
        triangles.area += triangles.parts.back();
    }
    return triangles;
}

/// Of a cell by which its points dissipate more than its area does. \param first point of the patch \param
/// enough differences that do not matter
double lessInCell(const PatchCells& patch, const std::vector<int>& cell, const PointRates& points,
                  std::size_t first, double enough)
{
    const auto at = [first](int vertex) { return first + static_cast<std::size_t>(vertex); };
    const Triangles triangles = trianglesOf(patch, cell);
    if (!(triangles.area > 0))
    {
        return 0;
    }
    Vector<3> atCentroid = Vector<3>::Zero();
    double sharedRate = 0;
    for (std::size_t i = 0; i < cell.size(); ++i)
    {
        const double share = triangles.areaOf(i) / triangles.area;
        atCentroid += share * points.closing[at(cell[i])];
        sharedRate += share * points.rate[at(cell[i])];
    }
    const StressLimits& limits = points.limits[at(cell[0])];
    const double rate = rateOf(limits, atCentroid);
    double less = triangles.area / 3 * (sharedRate - rate);
    for (std::size_t i = 0; i < cell.size(); ++i)
    {
        const std::size_t from = at(cell[i]);
        const std::size_t to = at(cell[(i + 1) % cell.size()]);
        less += excessOver(limits, triangles.parts[i], {points.closing[from], points.closing[to], atCentroid},
                           {points.rate[from], points.rate[to], rate}, enough, mostDivisions);
    }
    return std::max(0.0, less);
}

/// The part of a cell that one of its vertices stands for.
struct VertexPart
{
    std::size_t cell;
    double area;    ///< [m2]
    Vector<3> away; ///< closing at its centre less that at the vertex
};

/// Of each vertex. \param closing of each, linear over the patch
std::vector<std::vector<VertexPart>> partsOfVertices(const PatchCells& patch,
                                                     const std::vector<Vector<3>>& closing)
{
    std::vector<std::vector<VertexPart>> parts(patch.vertices.size());
    for (std::size_t k = 0; k < patch.cells.size(); ++k)
    {
        const std::vector<int>& cell = patch.cells[k];
        const auto at = [&](std::size_t i) -> const Vector<3>&
        { return closing[static_cast<std::size_t>(cell[i % cell.size()])]; };
        const Triangles triangles = trianglesOf(patch, cell);
        if (!(triangles.area > 0))
        {
            continue;
        }
        Vector<3> atCentroid = Vector<3>::Zero();
        for (std::size_t i = 0; i < cell.size(); ++i)
        {
            atCentroid += triangles.areaOf(i) / triangles.area * at(i);
        }
        for (std::size_t i = 0; i < cell.size(); ++i)
        {
            const std::size_t before = i + cell.size() - 1;
            // Two halves of triangles, each with the vertex, the middle of an edge and the centroid.
            const auto centre = [&](std::size_t other) -> Vector<3>
            { return (at(i) + (at(i) + at(other)) / 2 + atCentroid) / 3; };
            const double area = triangles.areaOf(i);
            const Vector<3> sum = triangles.parts[i] / 2 * centre(i + 1)
                                  + triangles.parts[before % cell.size()] / 2 * centre(before);
            parts[static_cast<std::size_t>(cell[i])].push_back(
                {k, area, area > 0 ? Vector<3>(sum / area - at(i)) : Vector<3>(Vector<3>::Zero())});
        }
    }
    return parts;
}

/// Adds to cells by how much less work a force does where stress can carry it, off its vertex: first in
/// the parts where it does the most. \param used share of what the vertex bears
void addCarriedLess(std::vector<VertexPart> parts, const Vector<3>& force, double used,
                    std::vector<double>& ofCells)
{
    double needed = 0;
    for (const VertexPart& part : parts)
    {
        needed += used * part.area;
    }
    std::sort(parts.begin(), parts.end(),
              [&](const VertexPart& a, const VertexPart& b)
              { return force.dot(a.away) > force.dot(b.away); });
    double left = needed;
    for (const VertexPart& part : parts)
    {
        const double taken = std::min(left, part.area);
        if (!(taken > 0))
        {
            break;
        }
        ofCells[part.cell] -= taken / needed * std::sqrt(taken / part.area) * force.dot(part.away);
        left -= taken;
    }
}

std::vector<std::vector<double>> nothingOfCells(const std::vector<PatchCells>& patches)
{
    std::vector<std::vector<double>> nothing;
    for (const PatchCells& patch : patches)
    {
        nothing.emplace_back(patch.cells.size(), 0.0);
    }
    return nothing;
}

} // namespace

std::vector<std::vector<double>> dissipatedLessByCell(const SpaceConeProgram& program,
                                                      const std::vector<PatchCells>& patches,
                                                      const Eigen::VectorXd& liveLoad,
                                                      const Eigen::VectorXd& mechanism)
{
    constexpr double negligible = 1e-5; // of what a point dissipates on average
    std::vector<std::vector<double>> less = nothingOfCells(patches);
    const Eigen::VectorXd closing = closingRates(program, liveLoad, mechanism);
    if (closing.size() == 0 || !program.hasStrength())
    {
        return less;
    }
    const PointRates points = pointRates(program, patches, closing);
    const double enough =
        negligible * points.dissipated / static_cast<double>(std::max<std::size_t>(1, points.rate.size()));
    std::size_t first = 0;
    for (std::size_t joint = 0; joint < patches.size(); ++joint)
    {
        const PatchCells& patch = patches[joint];
        for (std::size_t k = 0; k < patch.cells.size(); ++k)
        {
            less[joint][k] = lessInCell(patch, patch.cells[k], points, first, enough);
        }
        first += patch.vertices.size();
    }
    return less;
}

std::vector<std::vector<double>> carriedLessByCell(const SpaceConeProgram& program,
                                                   const std::vector<PatchCells>& patches,
                                                   const Eigen::VectorXd& liveLoad,
                                                   const Eigen::VectorXd& mechanism,
                                                   const Eigen::VectorXd& contactForce)
{
    std::vector<std::vector<double>> less = nothingOfCells(patches);
    const Eigen::VectorXd closingOfAll = closingRates(program, liveLoad, mechanism);
    if (closingOfAll.size() == 0 || !program.hasCrushing())
    {
        return less;
    }
    std::size_t point = 0;
    for (std::size_t joint = 0; joint < patches.size(); ++joint)
    {
        const PatchCells& patch = patches[joint];
        std::vector<Vector<3>> closing;
        for (std::size_t vertex = 0; vertex < patch.vertices.size(); ++vertex)
        {
            closing.emplace_back(closingOfAll.segment<3>(3 * static_cast<Eigen::Index>(point + vertex)));
        }
        for (std::vector<VertexPart>& parts : partsOfVertices(patch, closing))
        {
            const Vector<3> force = contactForce.segment<3>(3 * static_cast<Eigen::Index>(point));
            const double used = std::clamp(force[0] / program.strength[point].crushing, 0.0, 1.0);
            addCarriedLess(std::move(parts), force, used, less[joint]);
            ++point;
        }
        for (double& ofCell : less[joint])
        {
            ofCell = std::max(0.0, ofCell);
        }
    }
    return less;
}

double sumOf(const std::vector<std::vector<double>>& less)
{
    double sum = 0;
    for (const std::vector<double>& ofPatch : less)
    {
        sum = std::accumulate(ofPatch.begin(), ofPatch.end(), sum);
    }
    return sum;
}

void refineJoints(JointPoints<3>& joints, const std::vector<std::vector<double>>& less)
{
    constexpr double divided = 0.8; // of the whole
    std::vector<double> largestFirst;
    for (const std::vector<double>& ofPatch : less)
    {
        largestFirst.insert(largestFirst.end(), ofPatch.begin(), ofPatch.end());
    }
    std::sort(largestFirst.begin(), largestFirst.end(), std::greater<>());
    const double whole = std::accumulate(largestFirst.begin(), largestFirst.end(), 0.0);
    double sum = 0;
    double least = 0; // of a cell that is divided
    for (std::size_t i = 0; i < largestFirst.size() && sum < divided * whole; ++i)
    {
        least = largestFirst[i];
        sum += least;
    }
    std::vector<std::size_t> pointsBefore;
    for (std::size_t joint = 0; joint < joints.patches.size(); ++joint)
    {
        PatchCells& patch = joints.patches[joint];
        pointsBefore.push_back(patch.vertices.size());
        std::vector<char> isDivided;
        for (const double ofCell : less[joint])
        {
            isDivided.push_back(ofCell > 0 && ofCell >= least);
        }
        divideCells(patch, isDivided);
    }
    shareOut(joints, pointsBefore);
}

} // namespace drystone
