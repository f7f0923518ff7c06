// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Joints that are stated, from the interfaces that a file has.
#include "import/SolidJoints.h"

#include "assembly/StatedJoints.h"
#include "core/Log.h"
#include "geometry/space/FacePolygon.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

/// The blocks that a solid of the file became: all in one row.
struct BlockRange
{
    std::size_t first = 0;
    std::size_t end = 0;
};

std::vector<BlockRange> blocksOfSolids(const std::vector<int>& solidOf, std::size_t solids)
{
    std::vector<BlockRange> ranges(solids);
    for (std::size_t block = 0; block < solidOf.size(); ++block)
    {
        BlockRange& range = ranges[static_cast<std::size_t>(solidOf[block])];
        range = {range.end == 0 ? block : range.first, block + 1};
    }
    return ranges;
}

/// The one of the blocks of a solid on whose surface all points lie, or are nearest to lying.
int nearestBlock(const BlockRange& range, const std::vector<Block<3>>& blocks,
                 const std::vector<Vector<3>>& points)
{
    std::size_t nearest = range.first;
    double least = 1e300;
    for (std::size_t block = range.first; range.end - range.first > 1 && block < range.end; ++block)
    {
        double farthest = 0;
        for (std::size_t i = 0; i < points.size() && farthest < least; ++i)
        {
            farthest = std::max(farthest, distanceFromSurface(blocks[block].shape, points[i]));
        }
        if (farthest < least)
        {
            least = farthest;
            nearest = block;
        }
    }
    return static_cast<int>(nearest);
}

/// How far points are at most from the plane of a face. \param normal of the face
double farthestFromPlane(const std::vector<Vector<3>>& points, const Vector<3>& onFace,
                         const Vector<3>& normal)
{
    double farthest = 0;
    for (const Vector<3>& point : points)
    {
        farthest = std::max(farthest, std::abs(normal.dot(point - onFace)));
    }
    return farthest;
}

/// 1 where the normal points into the block with the lower index, else -1; 0 where no face of the two lies
/// along the joint. The face in whose plane all its points lie, or are nearest to lying, decides: a sloping
/// face that begins at an edge of the joint, as that of a skewback, has but two of them.
double sideOf(const StatedJoint<3>& joint, const std::vector<Block<3>>& blocks)
{
    constexpr double along = 0.9;
    double nearest = 1e300;
    double sign = 0;
    for (const auto& [block, side] : {std::pair(joint.block, -1.0), std::pair(joint.neighbour, 1.0)})
    {
        const Polyhedron& shape = blocks[static_cast<std::size_t>(block)].shape;
        for (const std::vector<int>& face : shape.faces)
        {
            const Vector<3> normal = areaVector(shape, face).normalized();
            const double cosine = joint.normal.dot(normal);
            const double distance = farthestFromPlane(joint.points, shape.vertices[face.front()], normal);
            if (std::abs(cosine) > along && distance < nearest)
            {
                nearest = distance;
                sign = cosine > 0 ? side : -side;
            }
        }
    }
    return sign;
}

/// A joint from an interface: the normal is that of its outline, turned into the block with the lower index.
StatedJoint<3> jointOf(const SolidInterface& interface, const std::vector<BlockRange>& blocksOf,
                       const std::vector<Block<3>>& blocks, const SolidSettings& settings,
                       const ImportedFile& file)
{
    StatedJoint<3> joint;
    Vector<3> centre = Vector<3>::Zero();
    for (const Vector<3>& point : interface.points)
    {
        joint.points.push_back(inMetres(point, settings));
        centre += joint.points.back();
    }
    centre /= static_cast<double>(joint.points.size());
    const int one = nearestBlock(blocksOf[static_cast<std::size_t>(interface.solid)], blocks, joint.points);
    const int other =
        nearestBlock(blocksOf[static_cast<std::size_t>(interface.neighbour)], blocks, joint.points);
    joint.block = std::min(one, other);
    joint.neighbour = std::max(one, other);
    Vector<3> area = Vector<3>::Zero();
    for (std::size_t i = 0; i < joint.points.size(); ++i)
    {
        area += momentOf(Vector<3>(joint.points[i] - centre),
                         Vector<3>(joint.points[(i + 1) % joint.points.size()] - centre));
    }
    joint.normal = area / area.norm();
    if (!(area.norm() > 0) || !joint.normal.allFinite())
    {
        refuse(file, 0,
               fmt::format("The interface of blocks {} and {} has no area. Remove it, or leave the joints to "
                           "`interfaces ignored;`.",
                           joint.block, joint.neighbour));
    }
    const double sign = sideOf(joint, blocks);
    if (sign == 0)
    {
        refuse(
            file, 0,
            fmt::format("The interface of blocks {} and {} about ({:.6g} {:.6g} {:.6g}) lies along no face "
                        "of either. Correct it, or leave the joints to `interfaces ignored;`.",
                        joint.block, joint.neighbour, centre.x(), centre.y(), centre.z()));
    }
    if (sign < 0)
    {
        joint.normal = -joint.normal;
        std::reverse(joint.points.begin(), joint.points.end());
    }
    return joint;
}

void stateJoints(Assembly<3>& assembly, const Solids& solids, const std::vector<int>& solidOf,
                 const SolidSettings& settings, const ImportedFile& file)
{
    const std::vector<BlockRange> blocksOf = blocksOfSolids(solidOf, solids.solids.size());
    for (const SolidInterface& interface : solids.interfaces)
    {
        assembly.statedJoints.push_back(jointOf(interface, blocksOf, assembly.blocks, settings, file));
    }
    sortByPair(assembly.statedJoints);
}

} // namespace

Vector<3> inMetres(const Vector<3>& ofFile, const SolidSettings& settings)
{
    const Vector<3> place = settings.scale * ofFile;
    return (settings.up == UpAxis::y ? Vector<3>(place.x(), -place.z(), place.y()) : place) + settings.offset;
}

void chooseJoints(Assembly<3>& assembly, const Solids& solids, const std::vector<int>& solidOf,
                  const SolidSettings& settings, const ImportedFile& file)
{
    const Interfaces usual = solids.interfaces.empty() ? Interfaces::ignored : Interfaces::contacts;
    if (settings.interfaces.value_or(usual) == Interfaces::contacts)
    {
        if (solids.interfaces.empty())
        {
            refuse(file, 0,
                   "The file has no interfaces: joints cannot be taken from it. Remove `interfaces "
                   "contacts;`.");
        }
        stateJoints(assembly, solids, solidOf, settings, file);
        info("Import: the {} interfaces of the file are the joints{}", solids.interfaces.size(),
             settings.interfaces ? "" : "; with `interfaces ignored;` they are found from the shapes");
    }
    else if (!solids.interfaces.empty())
    {
        info("Import: the {} interfaces of the file are not used, joints are found from the shapes; "
             "`interfaces contacts;` makes them the joints",
             solids.interfaces.size());
    }
}

} // namespace drystone
