// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Cells by Voro++, in polyhedra of our own.
#include "texture/Voronoi.h"

#include <voro++/voro++.hh>

#include <algorithm>
#include <cmath>
#include <random>

namespace drystone
{

namespace
{

/// Voro++ distinguishes places by absolute tolerances, made for cells of about 1: what cells much smaller or
/// larger are multiplied by, a power of two, so that no digit changes.
double scaleOf(const Vector<3>& size, std::size_t points)
{
    constexpr double smallest = 0.02;
    constexpr double largest = 20;
    const double mean = std::cbrt(size.prod() / static_cast<double>(points));
    return mean < smallest || mean > largest ? std::exp2(-std::round(std::log2(mean))) : 1;
}

std::vector<Polyhedron> scaledCells(const Vector<3>& size, const std::vector<Vector<3>>& points)
{
    // Some five points in each bin of the search.
    const double bin = std::cbrt(5 * size.prod() / static_cast<double>(points.size()));
    int bins[3];
    for (int axis = 0; axis < 3; ++axis)
    {
        bins[axis] = std::max(1, static_cast<int>(size[axis] / bin));
    }
    voro::container container(0, size.x(), 0, size.y(), 0, size.z(), bins[0], bins[1], bins[2], false, false,
                              false, 8);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        container.put(static_cast<int>(i), points[i].x(), points[i].y(), points[i].z());
    }
    std::vector<Polyhedron> cells(points.size());
    voro::c_loop_all loop(container);
    voro::voronoicell cell;
    if (loop.start())
    {
        do
        {
            if (!container.compute_cell(cell, loop))
            {
                continue;
            }
            Polyhedron& shape = cells[static_cast<std::size_t>(loop.pid())];
            std::vector<double> coordinates;
            cell.vertices(loop.x(), loop.y(), loop.z(), coordinates);
            for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3)
            {
                shape.vertices.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
            }
            // Each face as its number of corners, then their indices.
            std::vector<int> indices;
            cell.face_vertices(indices);
            for (std::size_t i = 0; i < indices.size();)
            {
                const auto first = indices.begin() + static_cast<std::ptrdiff_t>(i) + 1;
                shape.faces.emplace_back(first, first + indices[i]);
                i += 1 + static_cast<std::size_t>(indices[i]);
            }
            if (volumeProperties(shape).volume < 0)
            {
                for (std::vector<int>& face : shape.faces)
                {
                    std::reverse(face.begin(), face.end());
                }
            }
        } while (loop.inc());
    }
    return cells;
}

} // namespace

std::vector<Polyhedron> voronoiCells(const Vector<3>& size, const std::vector<Vector<3>>& points)
{
    const double scale = scaleOf(size, points.size());
    std::vector<Vector<3>> scaledPoints = points;
    for (Vector<3>& point : scaledPoints)
    {
        point *= scale;
    }
    std::vector<Polyhedron> cells = scaledCells(scale * size, scaledPoints);
    for (Polyhedron& cell : cells)
    {
        for (Vector<3>& vertex : cell.vertices)
        {
            vertex /= scale;
        }
    }
    return cells;
}

std::vector<Vector<3>> uniformPoints(const Vector<3>& size, int count, int seed)
{
    // std::uniform_real_distribution differs between libraries: 32 bits of the generator, in the middle of
    // their steps.
    std::mt19937 random(static_cast<unsigned>(seed));
    const auto uniform = [&random] { return (static_cast<double>(random()) + 0.5) / 4294967296.0; };
    std::vector<Vector<3>> points;
    for (int i = 0; i < count; ++i)
    {
        const double x = size.x() * uniform();
        const double y = size.y() * uniform();
        points.emplace_back(x, y, size.z() * uniform());
    }
    return points;
}

} // namespace drystone
