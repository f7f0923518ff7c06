// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Welding by a grid of cells, each some tolerances wide: a node is in the cell of its first point.
#include "import/space/Weld.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace drystone
{

namespace
{

using Cell = std::array<double, 3>; ///< integers, which may be beyond those of a machine

struct CellHash
{
    std::size_t operator()(const Cell& cell) const
    {
        std::uint64_t hash = 0xcbf29ce484222325U;
        for (const double index : cell)
        {
            hash = (hash ^ std::bit_cast<std::uint64_t>(index + 0.0)) * 0x9e3779b97f4a7c15U;
            hash ^= hash >> 29U;
        }
        return hash;
    }
};

/// Cells of the grid.
struct Cells
{
    std::array<Cell, 8> cell{};
    std::size_t count = 0;
};

/// Those that a box smaller than a cell meets: one, or two next to each other, along each axis.
Cells cellsBetween(const Cell& lowest, const Cell& highest)
{
    Cells cells;
    cells.cell[cells.count++] = lowest;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
        const std::size_t before = highest[axis] != lowest[axis] ? cells.count : 0;
        for (std::size_t i = 0; i < before; ++i)
        {
            Cell& other = cells.cell[cells.count++];
            other = cells.cell[i];
            other[axis] = highest[axis];
        }
    }
    return cells;
}

} // namespace

std::vector<int> weld(const std::vector<Vector<3>>& points, double tolerance, const std::vector<int>& owners)
{
    std::unordered_multimap<Cell, int, CellHash> nodesIn;
    nodesIn.reserve(points.size());
    std::vector<Vector<3>> places;
    std::vector<int> lastOwner;
    std::vector<int> result;
    result.reserve(points.size());
    constexpr double cellSize = 8; // tolerances: few points are near to another cell
    const double size = cellSize * tolerance;
    const auto cellOf = [&](const Vector<3>& point) -> Cell
    {
        Cell cell{};
        for (int axis = 0; axis < 3; ++axis)
        {
            cell[static_cast<std::size_t>(axis)] =
                tolerance > 0 ? std::floor(point[axis] / size) : point[axis];
        }
        return cell;
    };
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const int owner = owners.empty() ? -1 : owners[i];
        const Vector<3> reach = Vector<3>::Constant(tolerance);
        const Cells near = cellsBetween(cellOf(points[i] - reach), cellOf(points[i] + reach));
        int node = -1; // the first that is near enough
        for (std::size_t cell = 0; cell < near.count; ++cell)
        {
            const auto [first, last] = nodesIn.equal_range(near.cell[cell]);
            for (auto found = first; found != last; ++found)
            {
                const auto index = static_cast<std::size_t>(found->second);
                const bool isTaken = owner >= 0 && lastOwner[index] == owner;
                if (!isTaken && (points[i] - places[index]).norm() <= tolerance
                    && (node < 0 || found->second < node))
                {
                    node = found->second;
                }
            }
        }
        if (node < 0)
        {
            node = static_cast<int>(places.size());
            places.push_back(points[i]);
            lastOwner.push_back(owner);
            nodesIn.emplace(cellOf(points[i]), node);
        }
        lastOwner[static_cast<std::size_t>(node)] = owner;
        result.push_back(node);
    }
    return result;
}

} // namespace drystone
