// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Axonometric picture of a structure in space, painted from back to front. Faces that look away from the
/// viewer are left out.
#include "io/MechanismPicture.h"

#include "core/Error.h"
#include "geometry/Rotation.h"
#include "io/Canvas.h"
#include "io/ClayColour.h"
#include "io/Ground.h"
#include "io/MarkLegend.h"
#include "io/PicturePage.h"
#include "io/space/MarkPainter.h"
#include "io/space/PaintingOrder.h"
#include "io/space/View.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

double meanDisplacement(const Polyhedron& before, const Polyhedron& after)
{
    double sum = 0;
    for (std::size_t i = 0; i < before.vertices.size(); ++i)
    {
        sum += (after.vertices[i] - before.vertices[i]).norm();
    }
    return before.vertices.empty() ? 0 : sum / static_cast<double>(before.vertices.size());
}

std::vector<ShownBlock> shownBlocks(const Assembly<3>& assembly, const std::vector<Placement<3>>& placements,
                                    const View& view)
{
    std::vector<ShownBlock> shown;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const Block<3>& block = assembly.blocks[i];
        if (isGround(assembly, block))
        {
            continue;
        }
        ShownBlock entry;
        entry.shape = placedShape(block, placements[i]);
        entry.isFixed = block.support >= 0;
        entry.block = static_cast<int>(i);
        entry.moved = meanDisplacement(block.shape, entry.shape);
        for (const Vector<3>& vertex : entry.shape.vertices)
        {
            entry.centre += vertex / static_cast<double>(entry.shape.vertices.size());
            extend<2>(entry.box, view.seen(vertex));
        }
        shown.push_back(std::move(entry));
    }
    return shown;
}

void paintBlock(Canvas& drawing, const ShownBlock& block, const View& view, double value)
{
    std::vector<std::pair<double, const std::vector<int>*>> faces;
    for (const std::vector<int>& face : block.shape.faces)
    {
        if (areaVector(block.shape, face).dot(view.towardsViewer) > 0)
        {
            double depth = 0;
            for (const int vertex : face)
            {
                depth +=
                    view.towardsViewer.dot(block.shape.vertices[vertex]) / static_cast<double>(face.size());
            }
            faces.emplace_back(depth, &face);
        }
    }
    std::sort(faces.begin(), faces.end());
    for (const auto& [depth, face] : faces)
    {
        const Vector<3> normal = areaVector(block.shape, *face).normalized();
        // Light from above, the front brighter than the side.
        const double light = 0.80 + 0.20 * normal.z() - 0.08 * normal.y() - 0.06 * normal.x();
        Polygon outline;
        for (const int vertex : *face)
        {
            outline.push_back(view.onPage(block.shape.vertices[vertex]));
        }
        const int grey = static_cast<int>(std::clamp(205 * light + 20, 0.0, 255.0));
        drawing.polygon(outline, {.fill = block.isFixed ? fmt::format("#{0:02x}{0:02x}{0:02x}", grey)
                                                        : clayColour(value, light + 0.04),
                                  .stroke = "#3b2a22",
                                  .strokeWidth = 0.7});
    }
}

/// The ground under the structure as a plane strip, its corners; empty: there is none.
std::vector<Vector<3>> groundStrip(const Assembly<3>& assembly, double blockSize)
{
    Box<3> box;
    double top = 0;
    bool hasGround = false;
    for (const Block<3>& block : assembly.blocks)
    {
        for (const Vector<3>& vertex : block.shape.vertices)
        {
            if (isGround(assembly, block))
            {
                top = hasGround ? std::max(top, vertex.z()) : vertex.z();
                hasGround = true;
            }
            else
            {
                extend<3>(box, vertex);
            }
        }
    }
    if (!hasGround || box.lower.x() > box.upper.x())
    {
        return {};
    }
    const double margin = 0.8 * blockSize;
    return {{box.lower.x() - margin, box.lower.y() - margin, top},
            {box.upper.x() + margin, box.lower.y() - margin, top},
            {box.upper.x() + margin, box.upper.y() + margin, top},
            {box.lower.x() - margin, box.upper.y() + margin, top}};
}

/// What of the page of the view shows blocks and ground, with some room around them [m].
Box<2> shownArea(const std::vector<ShownBlock>& shown, const std::vector<Vector<3>>& ground, const View& view,
                 double blockSize)
{
    Box<2> area;
    for (const ShownBlock& block : shown)
    {
        extend<2>(area, block.box.lower);
        extend<2>(area, block.box.upper);
    }
    for (const Vector<3>& corner : ground)
    {
        extend<2>(area, view.seen(corner));
    }
    if (shown.empty())
    {
        area = {Vector<2>::Zero(), Vector<2>::Ones()};
    }
    return enlarged<2>(area, (ground.empty() ? 1 : 0.3) * blockSize);
}

void paintGround(Canvas& drawing, const std::vector<Vector<3>>& strip, const View& view)
{
    if (strip.empty())
    {
        return;
    }
    Polygon outline;
    for (const Vector<3>& corner : strip)
    {
        outline.push_back(view.onPage(corner));
    }
    drawing.polygon(outline, {.fill = "#e6e6e2", .stroke = "#9a9a9a", .strokeWidth = 0.8});
}

/// A place of the load on its block where that is now [m].
Vector<3> movedPlace(const Assembly<3>& assembly, const std::vector<Placement<3>>& placements,
                     const LoadPlace& at)
{
    if (at.block < 0)
    {
        return at.place;
    }
    const Block<3>& block = assembly.blocks[static_cast<std::size_t>(at.block)];
    const Placement<3>& placement = placements[static_cast<std::size_t>(at.block)];
    return placedShape(block, placement).vertices.front()
           + turned(placement.rotation, Vector<3>(at.place - block.shape.vertices.front()));
}

} // namespace

Canvas drawnMechanism(const Assembly<3>& assembly, const std::vector<Placement<3>>& placements,
                      const MechanismPicture& picture)
{
    if (placements.size() != assembly.blocks.size())
    {
        throw FatalError(fmt::format("{} placements were given for {} blocks.", placements.size(),
                                     assembly.blocks.size()));
    }
    View view = axonometricView(picture.towardsViewer);
    const double blockSize = meanBlockSize(assembly);
    const std::vector<ShownBlock> shown = shownBlocks(assembly, placements, view);
    const std::vector<Vector<3>> ground = groundStrip(assembly, blockSize);
    // As it is seen: a length of 1 m along the load, in metres of the page, y downwards.
    const Vector<3> load =
        picture.load ? picture.load->direction.normalized().eval() : Vector<3>::Zero().eval();
    const Vector<2> loadOnPage = view.seen(load).cwiseProduct(Vector<2>(1, -1));
    std::vector<LoadTip> loads;
    for (const LoadPlace& at : picture.loadPlaces)
    {
        loads.push_back({view.seen(movedPlace(assembly, placements, at)), at.part});
    }
    view.world = areaWithLoads(picture, shownArea(shown, ground, view, blockSize), loads, loadOnPage);
    PicturePage page = makePicturePage(picture, view.world.upper - view.world.lower);
    view.scale = page.scale;
    view.corner = page.corner;
    Canvas& drawing = page.drawing;
    double furthest = 0;
    for (const ShownBlock& block : shown)
    {
        furthest = std::max(furthest, block.moved);
    }
    drawing.beginClip("view", page.corner, page.room.x(), page.room.y());
    paintGround(drawing, ground, view);
    MarksToPaint marks = marksToPaint(assembly, picture.marks);
    for (const int i : paintingOrder(shown, view))
    {
        paintBlock(drawing, shown[i], view, furthest > 0 ? shown[i].moved / furthest : 0);
        paintMarks(drawing, marks, shown[i].block, shown[i].shape, placements, view);
    }
    paintLoads(page, view.world, loads, loadOnPage); // over all blocks: a load is not to be hidden
    drawing.endClip();
    if (furthest > 0)
    {
        paintMarkLegend(drawing, picture.marks,
                        {paintClayLegend(drawing, {leftOfLegend, page.legend()}) + 20, page.legend()});
    }
    paintNotes(page, picture, loadOnPage);
    return drawing;
}

} // namespace drystone
