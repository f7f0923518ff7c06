// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Numbering of free blocks, mass properties, placed outlines.
#include "assembly/Assembly.h"

#include "geometry/Rotation.h"

#include <Eigen/Geometry>

#include <cmath>

namespace drystone
{

template<int Dim>
std::vector<int> freeIndices(const Assembly<Dim>& assembly)
{
    std::vector<int> indices;
    indices.reserve(assembly.blocks.size());
    int count = 0;
    for (const Block<Dim>& block : assembly.blocks)
    {
        indices.push_back(block.support < 0 ? count++ : -1);
    }
    return indices;
}

template std::vector<int> freeIndices(const Assembly<2>& assembly);
template std::vector<int> freeIndices(const Assembly<3>& assembly);

template<>
BlockMass<2> blockMass(const Block<2>& block)
{
    const AreaProperties area = areaProperties(block.outline);
    BlockMass<2> mass;
    mass.volume = area.area * block.thickness;
    mass.centroid = area.centroid;
    mass.inertia(0, 0) = area.polarMoment * block.thickness;
    return mass;
}

template<>
BlockMass<3> blockMass(const Block<3>& block)
{
    const VolumeProperties properties = volumeProperties(block.shape);
    return {properties.volume, properties.centroid, properties.inertia};
}

template<int Dim>
std::vector<BlockMass<Dim>> blockMasses(const Assembly<Dim>& assembly)
{
    std::vector<BlockMass<Dim>> masses;
    masses.reserve(assembly.blocks.size());
    for (const Block<Dim>& block : assembly.blocks)
    {
        masses.push_back(blockMass(block));
    }
    return masses;
}

template std::vector<BlockMass<2>> blockMasses(const Assembly<2>& assembly);
template std::vector<BlockMass<3>> blockMasses(const Assembly<3>& assembly);

double meanBlockSize(const Assembly<2>& assembly)
{
    double area = 0;
    int count = 0;
    for (const Block<2>& block : assembly.blocks)
    {
        if (block.support < 0)
        {
            area += std::abs(areaProperties(block.outline).area);
            ++count;
        }
    }
    return count > 0 ? std::sqrt(area / count) : 0;
}

double meanBlockSize(const Assembly<3>& assembly)
{
    double volume = 0;
    int count = 0;
    for (const Block<3>& block : assembly.blocks)
    {
        if (block.support < 0)
        {
            volume += std::abs(volumeProperties(block.shape).volume);
            ++count;
        }
    }
    return count > 0 ? std::cbrt(volume / count) : 0;
}

std::vector<Placement<2>> moved(std::vector<Placement<2>> placements, const std::vector<int>& free,
                                const Eigen::VectorXd& displacement, double share)
{
    for (std::size_t block = 0; block < free.size(); ++block)
    {
        if (free[block] >= 0)
        {
            placements[block].translation += share * displacement.segment<2>(3 * free[block]);
            placements[block].rotation += share * displacement[3 * free[block] + 2];
        }
    }
    return placements;
}

std::vector<Placement<3>> moved(std::vector<Placement<3>> placements, const std::vector<int>& free,
                                const Eigen::VectorXd& displacement, double share)
{
    for (std::size_t block = 0; block < free.size(); ++block)
    {
        if (free[block] >= 0)
        {
            const auto own = displacement.segment<6>(6 * free[block]);
            placements[block].translation += share * own.head<3>();
            placements[block].rotation = composed(placements[block].rotation, share * own.tail<3>());
        }
    }
    return placements;
}

Polygon placed(const Polygon& outline, const Vector<2>& centre, const Placement<2>& placement)
{
    // centre + (vertex - centre) would round
    if (placement.rotation == 0 && placement.translation.isZero(0))
    {
        return outline;
    }
    const double cosine = std::cos(placement.rotation);
    const double sine = std::sin(placement.rotation);
    const Vector<2> moved = centre + placement.translation;
    Polygon result;
    result.reserve(outline.size());
    for (const Vector<2>& vertex : outline)
    {
        const Vector<2> arm = vertex - centre;
        result.emplace_back(moved.x() + (cosine * arm.x() - sine * arm.y()),
                            moved.y() + (sine * arm.x() + cosine * arm.y()));
    }
    return result;
}

Polygon placedOutline(const Block<2>& block, const Placement<2>& placement)
{
    return placed(block.outline, areaProperties(block.outline).centroid, placement);
}

Polyhedron placedShape(const Block<3>& block, const Placement<3>& placement)
{
    if (placement.rotation.isZero(0) && placement.translation.isZero(0))
    {
        return block.shape;
    }
    const Vector<3> centre = volumeProperties(block.shape).centroid;
    const double angle = placement.rotation.norm();
    const Eigen::Matrix3d turn = angle > 0
                                     ? Eigen::AngleAxisd(angle, placement.rotation / angle).toRotationMatrix()
                                     : Eigen::Matrix3d::Identity();
    Polyhedron result = block.shape;
    for (Vector<3>& vertex : result.vertices)
    {
        vertex = centre + placement.translation + turn * (vertex - centre);
    }
    return result;
}

} // namespace drystone
