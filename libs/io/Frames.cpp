// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Turns blocks and contacts into cells with fields, so that VtkFile knows nothing of masonry.
#include "io/Frames.h"

#include "core/Error.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
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

/// The extent of the ground that is shown, in x [m]: it is wide enough to catch falling blocks, and shown
/// whole it would leave little room in the window for the structure.
struct GroundView
{
    double lower = std::numeric_limits<double>::max();
    double upper = std::numeric_limits<double>::lowest();
};

bool isGround(const Assembly<2>& assembly, const Block<2>& block)
{
    return block.support >= 0 && assembly.supports[static_cast<std::size_t>(block.support)].type == "ground";
}

/// \param placed outlines of the blocks at present
GroundView groundView(const Assembly<2>& assembly, const std::vector<Polygon>& placed)
{
    GroundView view;
    double bottom = std::numeric_limits<double>::max();
    double top = std::numeric_limits<double>::lowest();
    for (std::size_t i = 0; i < placed.size(); ++i)
    {
        if (isGround(assembly, assembly.blocks[i]))
        {
            continue;
        }
        for (const Polygon& outline : {assembly.blocks[i].outline, placed[i]})
        {
            for (const Vector<2>& vertex : outline)
            {
                view.lower = std::min(view.lower, vertex.x());
                view.upper = std::max(view.upper, vertex.x());
                bottom = std::min(bottom, vertex.y());
                top = std::max(top, vertex.y());
            }
        }
    }
    if (view.lower > view.upper) // nothing but ground
    {
        return {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};
    }
    const double margin = 0.25 * std::max(view.upper - view.lower, top - bottom);
    return {view.lower - margin, view.upper + margin};
}

/// Twice the area of a triangle, positive when it runs counter-clockwise.
double turn(const Vector<2>& a, const Vector<2>& b, const Vector<2>& c)
{
    return cross(b - a, c - a);
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

/// Whether no other corner lies in the triangle at corner i, so that it can be cut off.
bool isEar(const Polygon& outline, std::size_t i)
{
    const std::size_t count = outline.size();
    const Vector<2>& a = outline[(i + count - 1) % count];
    const Vector<2>& b = outline[i];
    const Vector<2>& c = outline[(i + 1) % count];
    if (!(turn(a, b, c) > 0))
    {
        return false;
    }
    return std::none_of(outline.begin(), outline.end(),
                        [&](const Vector<2>& p) {
                            return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0
                                   && turn(c, a, p) >= 0;
                        });
}

/// Cuts an outline into polygons that viewers fill correctly: they paint a fan of triangles around the first
/// corner. Most blocks, including concave ones, have a corner from which all of it is visible, and need only
/// start there. The others are cut into triangles by ear clipping.
std::vector<Polygon> fans(Polygon outline)
{
    for (std::size_t first = 0; first < outline.size(); ++first)
    {
        if (isCoveredByFan(outline, first))
        {
            std::rotate(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(first), outline.end());
            return {outline};
        }
    }
    std::vector<Polygon> pieces;
    while (outline.size() > 3)
    {
        std::size_t ear = 0;
        while (ear + 1 < outline.size()
               && !isEar(outline, ear)) // an outline that crosses itself may have none
        {
            ++ear;
        }
        const std::size_t count = outline.size();
        pieces.push_back({outline[(ear + count - 1) % count], outline[ear], outline[(ear + 1) % count]});
        outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    pieces.push_back(outline);
    return pieces;
}

} // namespace

PolyData blockFrame(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                    std::vector<Field> fields)
{
    const std::size_t count = assembly.blocks.size();
    if (!placements.empty() && placements.size() != count)
    {
        throw FatalError(fmt::format("{} placements were given for {} blocks.", placements.size(), count));
    }

    Field blockId = emptyField("blockId", 1, count, FieldType::integer);
    Field support = emptyField("support", 1, count, FieldType::integer);
    Field displacement = emptyField("displacement", 2, count);
    Field rotation = emptyField("rotation", 1, count);
    PolyData data;
    data.kind = CellKind::polygon;
    std::vector<std::size_t> blockOfCell;
    std::vector<Polygon> placed;
    placed.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
    {
        placed.push_back(placements.empty() ? assembly.blocks[i].outline
                                            : placedOutline(assembly.blocks[i], placements[i]));
    }
    const GroundView shown = groundView(assembly, placed);
    for (std::size_t i = 0; i < count; ++i)
    {
        const Placement<2> placement = placements.empty() ? Placement<2>{} : placements[i];
        if (isGround(assembly, assembly.blocks[i]))
        {
            for (Vector<2>& vertex : placed[i])
            {
                vertex.x() = std::clamp(vertex.x(), shown.lower, shown.upper);
            }
        }
        for (const Polygon& piece : fans(placed[i]))
        {
            data.cellSizes.push_back(static_cast<int>(piece.size()));
            data.points.insert(data.points.end(), piece.begin(), piece.end());
            blockOfCell.push_back(i);
        }
        blockId.values.push_back(static_cast<double>(i));
        support.values.push_back(assembly.blocks[i].support);
        displacement.values.push_back(placement.translation.x());
        displacement.values.push_back(placement.translation.y());
        rotation.values.push_back(placement.rotation);
    }
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

PolyData contactFrame(const std::vector<ContactPoint<2>>& points, const std::vector<Vector<2>>& forces,
                      const std::vector<ContactState>& states, std::vector<Field> fields)
{
    const std::size_t count = points.size();
    if (forces.size() != count || states.size() != count)
    {
        throw FatalError(fmt::format("{} contact forces and {} states were given for {} contact points.",
                                     forces.size(), states.size(), count));
    }

    PolyData data;
    data.kind = CellKind::point;
    data.points.reserve(count);
    Field contactForce = emptyField("contactForce", 2, count);
    Field normalForce = emptyField("normalForce", 1, count);
    Field tangentialForce = emptyField("tangentialForce", 1, count);
    Field gap = emptyField("gap", 1, count);
    Field state = emptyField("state", 1, count, FieldType::integer);
    Field block = emptyField("block", 1, count, FieldType::integer);
    Field neighbour = emptyField("neighbour", 1, count, FieldType::integer);
    for (std::size_t i = 0; i < count; ++i)
    {
        const ContactPoint<2>& point = points[i];
        const Vector<2> force = forces[i].x() * point.normal + forces[i].y() * tangent(point);
        data.points.push_back(point.position);
        contactForce.values.push_back(force.x());
        contactForce.values.push_back(force.y());
        normalForce.values.push_back(forces[i].x());
        tangentialForce.values.push_back(forces[i].y());
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

void writeAssembly(const std::filesystem::path& file, const Assembly<2>& assembly)
{
    writeVtp(file, blockFrame(assembly));
}

} // namespace drystone
