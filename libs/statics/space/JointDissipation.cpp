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
    std::vector<Vector<3>> closing; ///< A'y, for a unit of work of the live load
    std::vector<double> rate;       ///< d(closing) [W/m2]
    double dissipated = 0;          ///< at the points, by which small differences are judged
};

/// \param closing A'y of all points, likewise
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

/// Of a cell by which its points dissipate more than its area does: as in vertexAreas, triangles about the
/// centroid, whose function is shared out to the corners. \param first point of the patch \param enough
/// differences that do not matter
double lessInCell(const PatchCells& patch, const std::vector<int>& cell, const PointRates& points,
                  std::size_t first, double enough)
{
    const auto at = [first](int vertex) { return first + static_cast<std::size_t>(vertex); };
    Polygon outline;
    for (const int vertex : cell)
    {
        outline.push_back(patch.vertices[static_cast<std::size_t>(vertex)]);
    }
    const Vector<2> centroid = areaProperties(outline).centroid;
    const std::size_t corners = cell.size();
    std::vector<double> parts(corners); // area of the triangle from each corner to the next
    double area = 0;
    for (std::size_t i = 0; i < corners; ++i)
    {
        parts[i] = std::abs(cross(outline[i] - centroid, outline[(i + 1) % corners] - centroid)) / 2;
        area += parts[i];
    }
    if (!(area > 0))
    {
        return 0;
    }
    Vector<3> atCentroid = Vector<3>::Zero();
    double sharedRate = 0;
    for (std::size_t i = 0; i < corners; ++i)
    {
        const double share = (parts[i] + parts[(i + corners - 1) % corners]) / (2 * area);
        atCentroid += share * points.closing[at(cell[i])];
        sharedRate += share * points.rate[at(cell[i])];
    }
    const StressLimits& limits = points.limits[at(cell[0])];
    const double rate = rateOf(limits, atCentroid);
    double less = area / 3 * (sharedRate - rate);
    for (std::size_t i = 0; i < corners; ++i)
    {
        const std::size_t from = at(cell[i]);
        const std::size_t to = at(cell[(i + 1) % corners]);
        less += excessOver(limits, parts[i], {points.closing[from], points.closing[to], atCentroid},
                           {points.rate[from], points.rate[to], rate}, enough, mostDivisions);
    }
    return std::max(0.0, less);
}

} // namespace

std::vector<std::vector<double>> dissipatedLessByCell(const SpaceConeProgram& program,
                                                      const std::vector<PatchCells>& patches,
                                                      const Eigen::VectorXd& liveLoad,
                                                      const Eigen::VectorXd& mechanism)
{
    constexpr double negligible = 1e-5; // of what a point dissipates on average
    std::vector<std::vector<double>> less;
    for (const PatchCells& patch : patches)
    {
        less.emplace_back(patch.cells.size(), 0.0);
    }
    const double work = std::abs(liveLoad.dot(mechanism));
    if (!(work > 0) || !program.hasStrength())
    {
        return less;
    }
    const PointRates points = pointRates(program, patches, applyTransposed(program, mechanism) / work);
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

double dissipatedLess(const SpaceConeProgram& program, const std::vector<PatchCells>& patches,
                      const Eigen::VectorXd& liveLoad, const Eigen::VectorXd& mechanism)
{
    double sum = 0;
    for (const std::vector<double>& ofPatch : dissipatedLessByCell(program, patches, liveLoad, mechanism))
    {
        sum += std::accumulate(ofPatch.begin(), ofPatch.end(), 0.0);
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
