// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Moves marks with their block; single points and the middles of lines decide what is seen of them.
#include "io/space/MarkPainter.h"

#include "geometry/space/Polyhedron.h"
#include "io/Ground.h"
#include "io/MarkLegend.h"

#include <Eigen/Geometry>

#include <cmath>

namespace drystone
{
namespace
{

/// Whether a place on a block is on a face of it that looks at the viewer, or on none: not behind the block
/// itself.
bool isOnSeenFace(const Polyhedron& shape, const Vector<3>& place, const View& view, double touching)
{
    bool isOnFace = false;
    for (const std::vector<int>& face : shape.faces)
    {
        const Vector<3> normal = areaVector(shape, face).normalized();
        if (std::abs(normal.dot(place - shape.vertices[static_cast<std::size_t>(face.front())])) <= touching)
        {
            if (normal.dot(view.towardsViewer) > 1e-6)
            {
                return true;
            }
            isOnFace = true;
        }
    }
    return !isOnFace;
}

/// Points of a block as built, where they are now.
std::vector<Vector<3>> placedPoints(const Block<3>& block, const Placement<3>& placement,
                                    const std::vector<Vector<3>>& points)
{
    const Vector<3> centre = volumeProperties(block.shape).centroid;
    const double angle = placement.rotation.norm();
    const Eigen::Matrix3d rotation =
        angle > 0 ? Eigen::AngleAxisd(angle, placement.rotation / angle).toRotationMatrix()
                  : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
    std::vector<Vector<3>> places;
    for (const Vector<3>& point : points)
    {
        places.emplace_back(centre + placement.translation + rotation * (point - centre));
    }
    return places;
}

void paintMark(Canvas& drawing, const JointMark& mark, const Polyhedron& shape,
               const std::vector<Vector<3>>& places, const View& view, double touching)
{
    const auto isSeen = [&](const Vector<3>& place) { return isOnSeenFace(shape, place, view, touching); };
    if (places.size() == 1 && isSeen(places[0]))
    {
        drawing.circle(view.onPage(places[0]), 3, {.fill = hingeColour});
    }
    const bool isHinge = mark.motion == JointMotion::hinge;
    const std::size_t lines = places.size() < 2 ? 0 : isHinge ? 1 : places.size();
    for (std::size_t i = 0; i < lines; ++i)
    {
        const Vector<3>& from = places[i];
        const Vector<3>& to = places[(i + 1) % places.size()];
        if (isSeen((from + to) / 2))
        {
            drawing.line(
                view.onPage(from), view.onPage(to),
                {.stroke = isHinge ? hingeColour : slidingColour, .strokeWidth = isHinge ? 2.4 : 1.8});
        }
    }
}

} // namespace

MarksToPaint marksToPaint(const Assembly<3>& assembly, const std::vector<JointMark>& marks)
{
    MarksToPaint result{assembly, marks, {}, {}};
    result.ofBlock.resize(assembly.blocks.size());
    for (const Block<3>& block : assembly.blocks)
    {
        result.isPainted.push_back(isGround(assembly, block));
    }
    for (std::size_t i = 0; i < marks.size(); ++i)
    {
        result.ofBlock[static_cast<std::size_t>(marks[i].block)].push_back(i);
        result.ofBlock[static_cast<std::size_t>(marks[i].neighbour)].push_back(i);
    }
    return result;
}

void paintMarks(Canvas& drawing, MarksToPaint& marks, int block, const Polyhedron& shape,
                const std::vector<Placement<3>>& placements, const View& view)
{
    const auto index = static_cast<std::size_t>(block);
    marks.isPainted[index] = true;
    for (const std::size_t i : marks.ofBlock[index])
    {
        const JointMark& mark = marks.marks[i];
        const int other = mark.block == block ? mark.neighbour : mark.block;
        if (marks.isPainted[static_cast<std::size_t>(other)])
        {
            const double touching = 1e-4 * std::cbrt(std::abs(volumeProperties(shape).volume));
            paintMark(drawing, mark, shape,
                      placedPoints(marks.assembly.blocks[index], placements[index], mark.points), view,
                      touching);
        }
    }
}

} // namespace drystone
