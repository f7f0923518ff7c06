// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Turns blocks and contacts into cells with fields, so that VtkFile knows nothing of masonry.
#include "io/Frames.h"

#include "assembly/BlockShape.h"
#include "core/Error.h"
#include "geometry/PolygonShape.h"
#include "geometry/Turn.h"
#include "geometry/space/FacePolygon.h"
#include "io/Ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace drystone
{

namespace
{

Field emptyField(std::string name, int components, std::size_t cells, FieldType type = FieldType::real)
{
    Field field{std::move(name), components, {}, type};
    field.values.reserve(cells * static_cast<std::size_t>(components));
    return field;
}

/// Expands one value per block to one value per cell.
void spread(Field& field, const std::vector<std::size_t>& blockOfCell, std::size_t blocks)
{
    const auto components = static_cast<std::size_t>(field.components);
    if (field.values.size() != blocks * components)
    {
        throw FatalError(fmt::format("Field {} of a .vtp file has {} values in {} components for {} blocks.",
                                     field.name, field.values.size(), field.components, blocks));
    }
    std::vector<double> values;
    values.reserve(blockOfCell.size() * components);
    for (const std::size_t block : blockOfCell)
    {
        for (std::size_t c = 0; c < components; ++c)
        {
            values.push_back(field.values[block * components + c]);
        }
    }
    field.values = std::move(values);
}

/// The extent of the ground that is shown, along the horizontal axes [m]: it is wide enough to catch falling
/// blocks, and shown whole it would leave little room in the window for the structure. \param placed corners
/// of the blocks at present
template<int Dim>
Box<Dim> groundView(const Assembly<Dim>& assembly, const std::vector<std::vector<Vector<Dim>>>& placed)
{
    Box<Dim> box;
    for (std::size_t i = 0; i < placed.size(); ++i)
    {
        if (!isGround(assembly, assembly.blocks[i]))
        {
            for (const std::vector<Vector<Dim>>& corners : {cornersOf(assembly.blocks[i]), placed[i]})
            {
                for (const Vector<Dim>& corner : corners)
                {
                    extend<Dim>(box, corner);
                }
            }
        }
    }
    if (box.lower.x() > box.upper.x()) // nothing but ground
    {
        return {Vector<Dim>::Constant(std::numeric_limits<double>::lowest()),
                Vector<Dim>::Constant(std::numeric_limits<double>::max())};
    }
    return enlarged<Dim>(box, 0.25 * (box.upper - box.lower).maxCoeff());
}

bool isCoveredByFan(const Polygon& outline, std::size_t first)
{
    const std::size_t count = outline.size();
    for (std::size_t k = 1; k + 1 < count; ++k)
    {
        if (turn(outline[first], outline[(first + k) % count], outline[(first + k + 1) % count]) < 0)
        {
            return false;
        }
    }
    return true;
}

/// Cuts an outline into polygons that viewers fill correctly: they paint a fan of triangles around the first
/// corner. Most blocks, including concave ones, have a corner from which all of it is visible, and need only
/// start there. The others are cut into triangles by ear clipping. \returns indices of corners, polygon by
/// polygon
std::vector<std::vector<int>> fans(const Polygon& outline)
{
    std::vector<int> corners(outline.size());
    std::iota(corners.begin(), corners.end(), 0);
    for (std::size_t first = 0; first < outline.size(); ++first)
    {
        if (isCoveredByFan(outline, first))
        {
            std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(first), corners.end());
            return {corners};
        }
    }
    std::vector<std::vector<int>> pieces;
    for (const std::array<int, 3>& triangle : triangleCorners(outline))
    {
        pieces.emplace_back(triangle.begin(), triangle.end());
    }
    return pieces;
}

/// The polygons that show a block, as indices of its corners. \param corners where they are
std::vector<std::vector<int>> cellsOf(const Block<2>&, const std::vector<Vector<2>>& corners)
{
    return fans(corners);
}

std::vector<std::vector<int>> cellsOf(const Block<3>& block, const std::vector<Vector<3>>& corners)
{
    std::vector<std::vector<int>> cells;
    const Polyhedron placed{corners, block.shape.faces};
    for (const std::vector<int>& indices : placed.faces)
    {
        for (const std::vector<int>& piece : fans(facePolygon(placed, indices).outline))
        {
            std::vector<int>& cell = cells.emplace_back();
            for (const int corner : piece)
            {
                cell.push_back(indices[static_cast<std::size_t>(corner)]);
            }
        }
    }
    return cells;
}

/// What is taken of the ground, whose blocks may reach far beyond the others.
template<int Dim>
void clampSideways(std::vector<Vector<Dim>>& corners, const Box<Dim>& shown)
{
    for (Vector<Dim>& corner : corners)
    {
        for (int axis = 0; axis < Dim - 1; ++axis)
        {
            corner[axis] = std::clamp(corner[axis], shown.lower[axis], shown.upper[axis]);
        }
    }
}

/// Where the corners of each block are. \param placements one a block, or none: as built
template<int Dim>
std::vector<std::vector<Vector<Dim>>> cornersOfBlocks(const Assembly<Dim>& assembly,
                                                      const std::vector<Placement<Dim>>& placements)
{
    std::vector<std::vector<Vector<Dim>>> corners;
    corners.reserve(assembly.blocks.size());
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        corners.push_back(placements.empty() ? cornersOf(assembly.blocks[i])
                                             : placedCorners(assembly.blocks[i], placements[i]));
    }
    return corners;
}

void addVector(Field& field, const double* values)
{
    field.values.insert(field.values.end(), values, values + field.components);
}

void addRotation(Field& field, const Placement<2>& placement)
{
    addVector(field, &placement.rotation);
}

void addRotation(Field& field, const Placement<3>& placement)
{
    addVector(field, placement.rotation.data());
}

/// By how much the corners of a block have moved.
template<int Dim>
std::vector<Vector<Dim>> movesOf(const Block<Dim>& block, std::vector<Vector<Dim>> placed)
{
    const std::vector<Vector<Dim>> built = cornersOf(block);
    for (std::size_t k = 0; k < placed.size(); ++k)
    {
        placed[k] -= built[k];
    }
    return placed;
}

/// Adds the cells of a block. \param moved of each of its corners \return how many they are
template<int Dim>
std::size_t addBlockCells(PolyData<Dim>& data, Field& pointDisplacement, const Block<Dim>& block,
                          const std::vector<Vector<Dim>>& placed, const std::vector<Vector<Dim>>& moved)
{
    const auto cells = cellsOf(block, placed);
    for (const std::vector<int>& cell : cells)
    {
        data.cellSizes.push_back(static_cast<int>(cell.size()));
        for (const int corner : cell)
        {
            data.points.push_back(placed[static_cast<std::size_t>(corner)]);
            addVector(pointDisplacement, moved[static_cast<std::size_t>(corner)].data());
        }
    }
    return cells.size();
}

} // namespace

template<int Dim>
PolyData<Dim> blockFrame(const Assembly<Dim>& assembly, const std::vector<Placement<Dim>>& placements,
                         std::vector<Field> fields)
{
    const std::size_t count = assembly.blocks.size();
    if (!placements.empty() && placements.size() != count)
    {
        throw FatalError(fmt::format("{} placements were given for {} blocks.", placements.size(), count));
    }

    Field blockId = emptyField("blockId", 1, count, FieldType::integer);
    Field support = emptyField("support", 1, count, FieldType::integer);
    Field displacement = emptyField("displacement[m]", Dim, count);
    Field rotation = emptyField("rotation[rad]", rotationCount<Dim>, count);
    Field pointDisplacement{"pointDisplacement[m]", Dim, {}, FieldType::real};
    PolyData<Dim> data;
    data.kind = CellKind::polygon;
    std::vector<std::size_t> blockOfCell;
    std::vector<std::vector<Vector<Dim>>> placed = cornersOfBlocks(assembly, placements);
    const Box<Dim> shown = groundView(assembly, placed);
    for (std::size_t i = 0; i < count; ++i)
    {
        const Placement<Dim> placement = placements.empty() ? Placement<Dim>{} : placements[i];
        const std::vector<Vector<Dim>> moved = movesOf(assembly.blocks[i], placed[i]);
        if (isGround(assembly, assembly.blocks[i]))
        {
            clampSideways<Dim>(placed[i], shown);
        }
        blockOfCell.insert(blockOfCell.end(),
                           addBlockCells(data, pointDisplacement, assembly.blocks[i], placed[i], moved), i);
        blockId.values.push_back(static_cast<double>(i));
        support.values.push_back(assembly.blocks[i].support);
        addVector(displacement, placement.translation.data());
        addRotation(rotation, placement);
    }
    data.pointFields.push_back(std::move(pointDisplacement));
    data.fields = {std::move(blockId), std::move(support), std::move(displacement), std::move(rotation)};
    std::move(fields.begin(), fields.end(), std::back_inserter(data.fields));
    if (blockOfCell.size() != count)
    {
        for (Field& field : data.fields)
        {
            spread(field, blockOfCell, count);
        }
    }
    return data;
}

template<int Dim>
PolyData<Dim> contactFrame(const std::vector<ContactPoint<Dim>>& points,
                           const std::vector<Vector<Dim>>& forces, const std::vector<ContactState>& states,
                           std::vector<Field> fields)
{
    const std::size_t count = points.size();
    if (forces.size() != count || states.size() != count)
    {
        throw FatalError(fmt::format("{} contact forces and {} states were given for {} contact points.",
                                     forces.size(), states.size(), count));
    }

    PolyData<Dim> data;
    data.kind = CellKind::point;
    data.points.reserve(count);
    Field contactForce = emptyField("contactForce[N]", Dim, count);
    Field normalForce = emptyField("normalForce[N]", 1, count);
    Field tangentialForce = emptyField("tangentialForce[N]", 1, count);
    Field gap = emptyField("gap[m]", 1, count);
    Field state = emptyField("state", 1, count, FieldType::integer);
    Field block = emptyField("block", 1, count, FieldType::integer);
    Field neighbour = emptyField("neighbour", 1, count, FieldType::integer);
    for (std::size_t i = 0; i < count; ++i)
    {
        const ContactPoint<Dim>& point = points[i];
        const Vector<Dim> force = contactFrame(point) * forces[i];
        data.points.push_back(point.position);
        addVector(contactForce, force.data());
        normalForce.values.push_back(forces[i].x());
        tangentialForce.values.push_back(Dim == 2 ? forces[i].y()
                                                  : forces[i].template tail<Dim - 1>().norm());
        gap.values.push_back(point.gap);
        state.values.push_back(static_cast<double>(states[i]));
        block.values.push_back(point.block);
        neighbour.values.push_back(point.neighbour);
    }
    data.fields = {std::move(contactForce),    std::move(state), std::move(normalForce),
                   std::move(tangentialForce), std::move(gap),   std::move(block),
                   std::move(neighbour)};
    std::move(fields.begin(), fields.end(), std::back_inserter(data.fields));
    return data;
}

template PolyData<2> blockFrame(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                                std::vector<Field> fields);
template PolyData<2> contactFrame(const std::vector<ContactPoint<2>>& points,
                                  const std::vector<Vector<2>>& forces,
                                  const std::vector<ContactState>& states, std::vector<Field> fields);
template PolyData<3> blockFrame(const Assembly<3>& assembly, const std::vector<Placement<3>>& placements,
                                std::vector<Field> fields);
template PolyData<3> contactFrame(const std::vector<ContactPoint<3>>& points,
                                  const std::vector<Vector<3>>& forces,
                                  const std::vector<ContactState>& states, std::vector<Field> fields);

} // namespace drystone
