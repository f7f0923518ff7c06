// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Axonometric picture of a structure in space, painted from back to front.
///
/// Of two blocks one is in front if a plane of a face of either has the blocks on its two sides: the one on
/// the viewer's side. Faces that look away from the viewer are left out. Blocks are painted in an order that
/// obeys all of these relations (topological sorting); where there is none, because blocks overlap each other
/// in a ring, the one whose centre is farthest goes first.
#include "io/MechanismPicture.h"

#include "core/Error.h"
#include "geometry/BroadPhase.h"
#include "geometry/Rotation.h"
#include "io/Canvas.h"
#include "io/ClayColour.h"
#include "io/Ground.h"
#include "io/MarkLegend.h"
#include "io/PicturePage.h"
#include "io/space/MarkPainter.h"
#include "io/space/View.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

namespace drystone
{

namespace
{

struct ShownBlock
{
    Polyhedron shape;
    Vector<3> centre = Vector<3>::Zero();
    Box<2> box;       ///< as it is seen [m]
    double moved = 0; ///< mean displacement of its corners [m]
    bool isFixed = false;
    int block = -1; ///< in the assembly
};

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

/// How far `other` is in front of a plane of a face of `one`: positive when all of it is.
double leastHeight(const ShownBlock& other, const Vector<3>& origin, const Vector<3>& normal)
{
    double least = std::numeric_limits<double>::max();
    for (const Vector<3>& vertex : other.shape.vertices)
    {
        least = std::min(least, normal.dot(vertex - origin));
    }
    return least;
}

/// Whether `one` is to be painted before `other`.
bool isBehind(const ShownBlock& one, const ShownBlock& other, const View& view)
{
    // The plane that has the most room between the two decides; rounding must not.
    double best = -std::numeric_limits<double>::max();
    bool result = view.towardsViewer.dot(one.centre) < view.towardsViewer.dot(other.centre);
    for (const auto& [owner, stranger] : {std::pair(&one, &other), std::pair(&other, &one)})
    {
        for (const std::vector<int>& face : owner->shape.faces)
        {
            const Vector<3> normal = areaVector(owner->shape, face).normalized();
            const double slope = normal.dot(view.towardsViewer);
            if (std::abs(slope) < 1e-3)
            {
                continue;
            }
            const double room =
                leastHeight(*stranger, owner->shape.vertices[static_cast<std::size_t>(face.front())], normal);
            if (room > best)
            {
                best = room;
                // The stranger is beyond the face: in front of the owner if the face looks at the viewer.
                result = (slope > 0) == (owner == &one);
            }
        }
    }
    return result;
}

/// Whether two blocks hide parts of each other, as far as their hulls go: no line along an edge of either, as
/// it is seen, has them on its two sides. Where they do not, either may be painted first, and a relation
/// between them would only close rings of others.
bool isOverlapping(const ShownBlock& one, const ShownBlock& other, const View& view)
{
    const auto seen = [&view](const ShownBlock& block)
    {
        Polygon places;
        for (const Vector<3>& vertex : block.shape.vertices)
        {
            places.push_back(view.seen(vertex));
        }
        return places;
    };
    const Polygon ofOne = seen(one);
    const Polygon ofOther = seen(other);
    const Vector<2> extent = one.box.upper - one.box.lower + other.box.upper - other.box.lower;
    const double touching = 1e-6 * extent.maxCoeff(); // neighbours that only touch hide nothing
    const auto rangeAlong = [](const Polygon& places, const Vector<2>& direction)
    {
        double least = std::numeric_limits<double>::max();
        double most = -least;
        for (const Vector<2>& place : places)
        {
            least = std::min(least, direction.dot(place));
            most = std::max(most, direction.dot(place));
        }
        return std::pair(least, most);
    };
    for (const auto& [shape, places] : {std::pair(&one.shape, &ofOne), std::pair(&other.shape, &ofOther)})
    {
        for (const std::vector<int>& face : shape->faces)
        {
            for (std::size_t corner = 0; corner < face.size(); ++corner)
            {
                const Vector<2> edge = (*places)[face[(corner + 1) % face.size()]] - (*places)[face[corner]];
                if (edge.norm() <= touching)
                {
                    continue;
                }
                const Vector<2> across = Vector<2>(edge.y(), -edge.x()).normalized();
                const auto [leastOne, mostOne] = rangeAlong(ofOne, across);
                const auto [leastOther, mostOther] = rangeAlong(ofOther, across);
                if (std::min(mostOne, mostOther) - std::max(leastOne, leastOther) <= touching)
                {
                    return false;
                }
            }
        }
    }
    return true;
}

/// Indices of the blocks from back to front.
std::vector<int> paintingOrder(const std::vector<ShownBlock>& shown, const View& view)
{
    std::vector<Box<2>> boxes;
    std::vector<double> depth;
    for (const ShownBlock& block : shown)
    {
        boxes.push_back(block.box);
        depth.push_back(view.towardsViewer.dot(block.centre));
    }
    std::vector<std::vector<int>> after(shown.size());
    std::vector<int> before(shown.size(), 0);
    for (const auto& [one, other] : findMeetingPairs(boxes))
    {
        if (!isOverlapping(shown[one], shown[other], view))
        {
            continue;
        }
        const bool oneFirst = isBehind(shown[one], shown[other], view);
        after[oneFirst ? one : other].push_back(oneFirst ? other : one);
        ++before[oneFirst ? other : one];
    }
    // The farthest of those that may be painted; where none may, the farthest of all that are left.
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> ready;
    std::vector<Entry> all;
    for (std::size_t i = 0; i < shown.size(); ++i)
    {
        all.emplace_back(depth[i], static_cast<int>(i));
        if (before[i] == 0)
        {
            ready.push(all.back());
        }
    }
    std::sort(all.begin(), all.end());
    std::vector<char> isPainted(shown.size(), false);
    std::vector<int> order;
    auto left = all.begin();
    while (order.size() < shown.size())
    {
        int next = -1;
        if (!ready.empty())
        {
            next = ready.top().second;
            ready.pop();
        }
        else
        {
            while (isPainted[left->second])
            {
                ++left;
            }
            next = left->second;
        }
        if (isPainted[next])
        {
            continue;
        }
        isPainted[next] = true;
        order.push_back(next);
        for (const int other : after[next])
        {
            if (--before[other] == 0 && !isPainted[other])
            {
                ready.emplace(depth[other], other);
            }
        }
    }
    return order;
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
    const double blockSize = meanBlockSize(assembly);
    View view = axonometricView(picture.towardsViewer);
    const std::vector<ShownBlock> shown = shownBlocks(assembly, placements, view);
    for (const ShownBlock& block : shown)
    {
        extend<2>(view.world, block.box.lower);
        extend<2>(view.world, block.box.upper);
    }
    const std::vector<Vector<3>> ground = groundStrip(assembly, blockSize);
    for (const Vector<3>& corner : ground)
    {
        extend<2>(view.world, view.seen(corner));
    }
    if (shown.empty())
    {
        view.world = {Vector<2>::Zero(), Vector<2>::Ones()};
    }
    view.world = enlarged<2>(view.world, (ground.empty() ? 1 : 0.3) * blockSize);
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
    // As it is seen: a length of 1 m along the load, in metres of the page.
    const Vector<3> load =
        picture.load ? picture.load->direction.normalized().eval() : Vector<3>::Zero().eval();
    const Vector<2> loadOnPage = (view.onPage(load) - view.onPage(Vector<3>::Zero())) / view.scale;
    for (const LoadPlace& at : picture.loadPlaces) // over all blocks: a load is not to be hidden
    {
        paintLoadArrow(drawing, view.onPage(movedPlace(assembly, placements, at)), loadOnPage,
                       18 + 22 * at.part);
    }
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
