// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The outlines that a DXF file draws: blocks at their places, chords of arcs.
#include "core/LowerCase.h"
#include "import/DxfFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drystone
{

namespace
{

/// A transform of the plane: p becomes matrix p + shift.
struct Transform
{
    Eigen::Matrix2d matrix = Eigen::Matrix2d::Identity();
    Vector<2> shift = Vector<2>::Zero();
};

constexpr int deepest = 16;
constexpr std::size_t mostInserts = 1'000'000;

class DxfOutlines
{
public:
    DxfOutlines(const ImportedFile& source, const ChordSettings& chordSettings)
        : file(source),
          content(readDxfFile(source)),
          chords(chordSettings),
          mostCorners(std::max<std::size_t>(1'000'000, source.bytes.size()))
    {
    }

    Drawing draw()
    {
        drawing.unit = content.unit;
        if (!content.unknownUnit.empty())
        {
            drawing.ignored.push_back(content.unknownUnit);
        }
        expand(content.entities, {}, "", 0);
        for (const auto& [name, count] : content.others)
        {
            drawing.ignored.push_back(fmt::format("{} entities {}", count, name));
        }
        for (const auto& [what, count] : unused)
        {
            drawing.ignored.push_back(fmt::format("{} {}", count, what));
        }
        drawing.rounding = largestFactor * content.digits.unit();
        return std::move(drawing);
    }

private:
    /// The outlines of what is drawn, at its place. \param layer of the insert that draws it: that of
    /// entities on layer 0
    void expand(const DxfContent& drawn, const Transform& transform, const std::string& layer, int depth)
    {
        for (const DxfPolyline& polyline : drawn.polylines)
        {
            addOutline(polyline, transform, layer);
        }
        for (const DxfInsert& insert : drawn.inserts)
        {
            countInsert(insert); // those that are left out take time, too
            const std::string own = insert.layer.empty() || insert.layer == "0" ? layer : insert.layer;
            if (content.frozen.contains(lowerCase(own.empty() ? insert.layer : own)))
            {
                ++unused["inserts on layers that are frozen"];
                continue;
            }
            if (isLeftOut(insert))
            {
                continue;
            }
            const auto block = content.blocks.find(lowerCase(insert.block));
            if (block == content.blocks.end())
            {
                refuse(file, insert.line,
                       fmt::format("There is no block {} to insert.", shown(insert.block)));
            }
            if (depth >= deepest)
            {
                refuse(file, insert.line,
                       fmt::format("Blocks are inserted in each other to more than {} levels.", deepest));
            }
            const Transform outer = fromPlaneOf(insert, transform);
            for (int row = 0; row < insert.rows; ++row)
            {
                for (int column = 0; column < insert.columns; ++column)
                {
                    if (row + column > 0)
                    {
                        countInsert(insert);
                    }
                    Eigen::Matrix2d turn;
                    turn << std::cos(insert.angle), -std::sin(insert.angle), std::sin(insert.angle),
                        std::cos(insert.angle);
                    Transform inner;
                    inner.matrix = outer.matrix * turn * insert.factor.asDiagonal();
                    const Vector<2> step(column * insert.spacing.x(), row * insert.spacing.y());
                    inner.shift = outer.matrix * (insert.place + turn * step) + outer.shift
                                  - inner.matrix * block->second.base;
                    expand(block->second, inner, own, depth + 1);
                }
            }
        }
    }

    void countInsert(const DxfInsert& insert)
    {
        if (++inserted > mostInserts)
        {
            refuse(file, insert.line, fmt::format("More than {} blocks are inserted.", mostInserts));
        }
    }

    /// The transform of coordinates in the plane of an entity, which may look at the drawing from behind.
    static Transform fromPlaneOf(const DxfEntity& entity, Transform transform)
    {
        if (entity.isMirrored)
        {
            transform.matrix.col(0) *= -1;
        }
        return transform;
    }

    /// Counts what is not drawn whatever its layer, and what lies in a plane of its own.
    bool isLeftOut(const DxfEntity& entity)
    {
        if (!entity.leftOut.empty())
        {
            ++unused[std::string(entity.leftOut)];
            return true;
        }
        if (entity.isTilted)
        {
            ++unused["directions of extrusion other than z: these entities are drawn by the coordinates in "
                     "their own planes"];
        }
        return false;
    }

    void addOutline(const DxfPolyline& polyline, const Transform& transform, const std::string& layer)
    {
        if (++corners > mostCorners) // those without an outline take time, too
        {
            refuse(file, polyline.line, fmt::format("The drawing has more than {} corners.", mostCorners));
        }
        DrawnOutline outline;
        outline.layer = polyline.layer.empty() || polyline.layer == "0"
                            ? (layer.empty() ? polyline.layer : layer)
                            : polyline.layer;
        outline.line = polyline.line;
        if (content.hidden.contains(lowerCase(outline.layer)))
        {
            ++unused["outlines on layers that are off or frozen"];
            return;
        }
        if (isLeftOut(polyline))
        {
            return;
        }
        const std::size_t count = polyline.corners.size();
        const bool endsMeet = count > 3 && polyline.corners.front() == polyline.corners.back();
        if (!polyline.isClosed && !endsMeet)
        {
            ++unused["open polylines"];
            if (count > 2)
            {
                drawing.open.push_back(std::move(outline));
            }
            return;
        }
        const Transform plane = fromPlaneOf(polyline, transform);
        for (std::size_t i = 0; i < count; ++i)
        {
            addSegment(polyline, i, plane, outline.corners);
            if (corners + outline.corners.size() > mostCorners)
            {
                refuse(file, polyline.line,
                       fmt::format("The drawing has more than {} corners.", mostCorners));
            }
        }
        corners += outline.corners.size();
        largestFactor = std::max(largestFactor, plane.matrix.colwise().norm().maxCoeff());
        drawing.outlines.push_back(std::move(outline));
    }

    /// Corner i, and those of the chords of the arc that follows it. An arc of angle t has the bulge b =
    /// tan(t/4): its centre is (1 - b^2)/(4 b) chords to the left of the middle of the chord.
    void addSegment(const DxfPolyline& polyline, std::size_t i, const Transform& transform,
                    Polygon& outline) const
    {
        const auto add = [&](const Vector<2>& place)
        { outline.emplace_back(transform.matrix * place + transform.shift); };
        const Vector<2>& from = polyline.corners[i];
        const Vector<2>& to = polyline.corners[(i + 1) % polyline.corners.size()];
        const double bulge = polyline.bulges[i];
        add(from);
        const Vector<2> chord = to - from;
        if (bulge == 0 || !(chord.norm() > 0))
        {
            return;
        }
        const double angle = 4 * std::atan(bulge);
        const double wanted = std::abs(angle) / (2 * std::numbers::pi) * chords.chordsPerCircle;
        const int pieces = std::max(1, static_cast<int>(std::ceil(wanted - 1e-9)));
        if (pieces == 1)
        {
            return;
        }
        const Vector<2> centre = (from + to) / 2 + (1 - bulge * bulge) / (4 * bulge) * perpendicular(chord);
        for (int piece = 1; piece < pieces; ++piece)
        {
            const double turned = angle * piece / pieces;
            const Vector<2> arm = from - centre;
            add(centre + std::cos(turned) * arm + std::sin(turned) * perpendicular(arm));
        }
    }

    const ImportedFile& file;
    DxfFile content;
    ChordSettings chords;
    std::size_t mostCorners; ///< of all outlines: memory is bounded by the size of the file
    std::size_t corners = 0;
    std::size_t inserted = 0;
    double largestFactor = 0; ///< by which inserts scale an outline
    std::map<std::string, std::size_t> unused;
    Drawing drawing;
};

} // namespace

Drawing readDxf(const ImportedFile& file, const ChordSettings& chords)
{
    return DxfOutlines(file, chords).draw();
}

} // namespace drystone
