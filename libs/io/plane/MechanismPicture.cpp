// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Lays out the structure on the page and paints it from back to front.
#include "io/MechanismPicture.h"

#include "core/Error.h"
#include "geometry/Rotation.h"
#include "io/Canvas.h"
#include "io/ClayColour.h"
#include "io/Ground.h"
#include "io/MarkLegend.h"
#include "io/PicturePage.h"
#include "io/plane/BuiltOutline.h"
#include "io/plane/PlaneView.h"
#include "io/plane/ThrustPainter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

/// The displacement of each block, as the mean over its corners, as a part of the largest; zeros where no
/// block has moved.
std::vector<double> partsOfLargestDisplacement(const Assembly<2>& assembly,
                                               const std::vector<Placement<2>>& placements)
{
    std::vector<double> result;
    for (std::size_t i = 0; i < placements.size(); ++i)
    {
        const Polygon& before = assembly.blocks[i].outline;
        const Polygon after = placedOutline(assembly.blocks[i], placements[i]);
        double sum = 0;
        for (std::size_t k = 0; k < before.size(); ++k)
        {
            sum += (after[k] - before[k]).norm();
        }
        result.push_back(before.empty() ? 0 : sum / static_cast<double>(before.size()));
    }
    const double largest = result.empty() ? 0 : *std::max_element(result.begin(), result.end());
    for (double& displacement : result)
    {
        displacement = largest > 0 ? displacement / largest : 0;
    }
    return result;
}

/// The area to be shown [m]. Ground may extend far down and to the sides: it does not enlarge the picture.
Eigen::AlignedBox2d shownArea(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                              double blockSize)
{
    Eigen::AlignedBox2d free;
    Eigen::AlignedBox2d fixed;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const Block<2>& block = assembly.blocks[i];
        Eigen::AlignedBox2d& box = isGround(assembly, block) ? fixed : free;
        for (const Vector<2>& vertex : block.outline)
        {
            box.extend(vertex);
        }
        for (const Vector<2>& vertex : placedOutline(block, placements[i]))
        {
            box.extend(vertex);
        }
    }
    if (free.isEmpty())
    {
        free = fixed;
    }
    if (free.isEmpty())
    {
        free = Eigen::AlignedBox2d(Vector<2>::Zero(), Vector<2>::Ones());
    }
    Eigen::AlignedBox2d area(free.min() - Vector<2>::Constant(0.6 * blockSize),
                             free.max() + Vector<2>::Constant(0.6 * blockSize));
    if (!(area.sizes().minCoeff() > 0))
    {
        area =
            Eigen::AlignedBox2d(area.min() - Vector<2>::Constant(0.5), area.max() + Vector<2>::Constant(0.5));
    }
    return area;
}

/// Of what is drawn as it was built.
const ShapeStyle builtLine{.stroke = "#222222", .strokeWidth = 1, .dash = {5, 4}};

/// Supports where they are, since some of them sink or are moved, with a hatch.
void paintSupports(Canvas& drawing, const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                   const PlaneView& view)
{
    // The hatch is one strip behind all of them, because the joints between ground segments have no meaning.
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        if (assembly.blocks[i].support >= 0)
        {
            drawing.polygon(view(placedOutline(assembly.blocks[i], placements[i])), {.fill = "url(#fixed)"});
        }
    }
    for (std::size_t index = 0; index < assembly.blocks.size(); ++index)
    {
        const Block<2>& block = assembly.blocks[index];
        if (block.support < 0)
        {
            continue;
        }
        const Polygon outline = placedOutline(block, placements[index]);
        if (assembly.supports[static_cast<std::size_t>(block.support)].type != "ground")
        {
            drawing.polygon(view(outline), {.stroke = "#333333", .strokeWidth = 1.2});
            if (outline != block.outline)
            {
                drawing.polygon(view(block.outline), builtLine);
            }
            continue;
        }
        // Of the ground only the surface is drawn: the edges on top as built.
        double top = block.outline.empty() ? 0 : block.outline.front().y();
        for (const Vector<2>& vertex : block.outline)
        {
            top = std::max(top, vertex.y());
        }
        for (std::size_t i = 0; i < block.outline.size(); ++i)
        {
            const std::size_t next = (i + 1) % block.outline.size();
            if (block.outline[i].y() == top && block.outline[next].y() == top)
            {
                drawing.line(view(outline[i]), view(outline[next]),
                             {.stroke = "#333333", .strokeWidth = 1.6});
            }
        }
    }
}

/// Blocks below this mean size are drawn as areas of one colour each without their joints, which would be
/// nearer to each other than lines are wide [px].
constexpr double smallBlock = 5;

/// \param moved as parts of the largest displacement, one a block
void paintBlocks(Canvas& drawing, const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                 const std::vector<double>& moved, const PlaneView& view, double blockSize)
{
    constexpr int shades = 24;
    const bool areas = blockSize * view.scale < smallBlock;
    std::vector<std::vector<Polygon>> ofShade(areas ? shades : 0);
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        if (assembly.blocks[i].support >= 0)
        {
            continue;
        }
        const Polygon outline = view(placedOutline(assembly.blocks[i], placements[i]));
        if (areas)
        {
            ofShade[static_cast<std::size_t>(std::lround(moved[i] * (shades - 1)))].push_back(outline);
        }
        else
        {
            drawing.polygon(outline, {.fill = clayColour(moved[i]), .stroke = "#3b2a22", .strokeWidth = 0.9});
        }
    }
    for (std::size_t shade = 0; shade < ofShade.size(); ++shade)
    {
        if (!ofShade[shade].empty())
        {
            // The stroke closes the seams that blended edges leave between neighbours.
            const std::string colour = clayColour(static_cast<double>(shade) / (shades - 1));
            drawing.polygons(ofShade[shade], {.fill = colour, .stroke = colour, .strokeWidth = 0.4});
        }
    }
}

/// A place on a block where that is now [m]. \param index of the block; none below 0
Vector<2> movedPlace(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements, int index,
                     const Vector<3>& asBuilt)
{
    const Vector<2> place = asBuilt.head<2>();
    if (index < 0)
    {
        return place;
    }
    const Block<2>& block = assembly.blocks[static_cast<std::size_t>(index)];
    const Placement<2>& placement = placements[static_cast<std::size_t>(index)];
    return placedOutline(block, placement).front()
           + turned(placement.rotation, place - block.outline.front());
}

/// Where loads act on blocks that have moved.
std::vector<LoadTip> loadTips(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                              const std::vector<LoadPlace>& places)
{
    std::vector<LoadTip> tips;
    for (const LoadPlace& at : places)
    {
        tips.push_back({movedPlace(assembly, placements, at.block, at.place), at.part});
    }
    return tips;
}

/// A hinge as a point, a sliding joint as a line, on the block that moves more.
void paintMarks(Canvas& drawing, const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                const std::vector<JointMark>& marks, const std::vector<double>& moved, const PlaneView& view)
{
    for (const JointMotion motion : {JointMotion::sliding, JointMotion::hinge}) // hinges over lines
    {
        for (const JointMark& mark : marks)
        {
            const bool isNeighbour =
                moved[static_cast<std::size_t>(mark.neighbour)] > moved[static_cast<std::size_t>(mark.block)];
            const auto onPage = [&](const Vector<3>& place) {
                return view(
                    movedPlace(assembly, placements, isNeighbour ? mark.neighbour : mark.block, place));
            };
            if (mark.motion == motion && motion == JointMotion::hinge)
            {
                drawing.circle(onPage(mark.points.front()), 3.5, {.fill = hingeColour});
            }
            else if (mark.motion == motion && mark.points.size() == 2)
            {
                drawing.line(onPage(mark.points.front()), onPage(mark.points.back()),
                             {.stroke = slidingColour, .strokeWidth = 2});
            }
        }
    }
}

/// What colours, marks and lines mean, under the picture. \param isMoving whether blocks are where they were
/// not built \param largestForce of the thrust [N]
void paintLegend(PicturePage& page, const MechanismPicture& picture, const std::vector<JointMark>& marks,
                 bool isMoving, double largestForce)
{
    Canvas& drawing = page.drawing;
    const double y = page.legend();
    double x = leftOfLegend; // also of a structure that is narrower than its legend
    if (isMoving)
    {
        x = paintClayLegend(drawing, {x, y}) + 18;
        drawing.line({x, y + 7}, {x + 30, y + 7}, builtLine);
        drawing.text({x + 36, y + 11}, "as built", {.size = 12});
        x += 36 + textWidth("as built", 12) + 18;
    }
    x = paintMarkLegend(drawing, marks, {x, y});
    if (!picture.thrust.empty())
    {
        paintThrustLegend(drawing, largestForce, {x, y});
    }
}

} // namespace

Canvas drawnMechanism(const Assembly<2>& assembly, const std::vector<Placement<2>>& placements,
                      const MechanismPicture& picture)
{
    if (placements.size() != assembly.blocks.size())
    {
        throw FatalError(fmt::format("{} placements were given for {} blocks.", placements.size(),
                                     assembly.blocks.size()));
    }

    const double blockSize = meanBlockSize(assembly);
    const Vector<3> load =
        picture.load ? picture.load->direction.normalized().eval() : Vector<3>::Zero().eval();
    const Vector<2> loadOnPage(load.x(), -load.y());
    const std::vector<LoadTip> loads = loadTips(assembly, placements, picture.loadPlaces);
    const Eigen::AlignedBox2d structure = shownArea(assembly, placements, blockSize);
    const Box<2> area = areaWithLoads(picture, {structure.min(), structure.max()}, loads, loadOnPage);
    PlaneView view;
    view.world = {area.lower, area.upper};
    PicturePage page = makePicturePage(picture, view.world.sizes());
    view.scale = page.scale;
    view.corner = page.corner;
    Canvas& drawing = page.drawing;

    const std::vector<double> moved = partsOfLargestDisplacement(assembly, placements);
    const bool isMoving = std::any_of(moved.begin(), moved.end(), [](double part) { return part > 0; });
    drawing.defineHatch("fixed", "#9a9a9a", 7);
    drawing.beginClip("view", page.corner, page.room.x(), page.room.y());
    paintSupports(drawing, assembly, placements, view);
    paintBlocks(drawing, assembly, placements, moved, view, blockSize);
    if (isMoving)
    {
        for (const OutlinePiece& piece : builtOutline(assembly, 1e-6 * blockSize))
        {
            drawing.line(view(piece.from), view(piece.to), builtLine);
        }
    }
    double largestForce = 0;
    if (!picture.thrust.empty())
    {
        largestForce = paintThrust(drawing, assembly, picture.thrust, view, blockSize);
    }
    const std::vector<JointMark> marks =
        blockSize * view.scale < smallBlock ? std::vector<JointMark>() : picture.marks;
    paintMarks(drawing, assembly, placements, marks, moved, view);
    paintLoads(page, area, loads, loadOnPage);
    drawing.endClip();

    paintLegend(page, picture, marks, isMoving, largestForce);
    paintNotes(page, picture, loadOnPage);
    return drawing;
}

} // namespace drystone
