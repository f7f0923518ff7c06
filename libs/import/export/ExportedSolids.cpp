// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Gives blocks of the plane their thickness, and every block a layer.
#include "import/export/ExportedSolids.h"

#include "geometry/PolygonShape.h"
#include "geometry/space/FacePolygon.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace drystone
{

namespace
{

Polyhedron shapeOf(const Block<3>& block, const Placement<3>& placement)
{
    return placedShape(block, placement);
}

Polyhedron shapeOf(const Block<2>& block, const Placement<2>& placement)
{
    std::vector<Vector<3>> atBack;
    std::vector<Vector<3>> atFront;
    for (const Vector<2>& corner : placedOutline(block, placement))
    {
        atBack.emplace_back(corner.x(), block.thickness, corner.y());
        atFront.emplace_back(corner.x(), 0, corner.y());
    }
    return makePrism(atBack, atFront);
}

} // namespace

template<int Dim>
std::vector<std::vector<std::string>> groupsOfBlocks(const Assembly<Dim>& assembly)
{
    std::vector<std::vector<std::string>> names(assembly.blocks.size());
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        if (const int support = assembly.blocks[i].support; support >= 0)
        {
            names[i].push_back(assembly.supports[static_cast<std::size_t>(support)].name);
        }
    }
    for (const Zone& zone : assembly.zones)
    {
        for (const int block : zone.blocks)
        {
            std::vector<std::string>& ofBlock = names[static_cast<std::size_t>(block)];
            if (std::find(ofBlock.begin(), ofBlock.end(), zone.name) == ofBlock.end())
            {
                ofBlock.push_back(zone.name);
            }
        }
    }
    return names;
}

template<int Dim>
std::vector<std::string> layersOf(const Assembly<Dim>& assembly)
{
    std::vector<std::string> layers;
    for (const std::vector<std::string>& zones : groupsOfBlocks(assembly))
    {
        layers.push_back(zones.empty() ? "blocks" : zones.front());
    }
    return layers;
}

template<int Dim>
std::vector<ExportedSolid> exportedSolids(const Assembly<Dim>& assembly,
                                          const std::vector<Placement<Dim>>& placements,
                                          const std::vector<double>& densities)
{
    std::vector<std::vector<std::string>> zones = groupsOfBlocks(assembly);
    const std::vector<std::string> layers = layersOf(assembly);
    std::vector<ExportedSolid> solids;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const Block<Dim>& block = assembly.blocks[i];
        solids.push_back({shapeOf(block, placements.empty() ? Placement<Dim>{} : placements[i]), layers[i],
                          block.support >= 0, densities.empty() ? 0 : densities[i], std::move(zones[i])});
    }
    return solids;
}

int flattenedBlock(const std::vector<ExportedSolid>& solids, int decimals)
{
    constexpr double least = 0.5;
    const double unit = std::pow(10, decimals);
    for (std::size_t block = 0; block < solids.size(); ++block)
    {
        Polyhedron rounded = solids[block].shape;
        for (Vector<3>& vertex : rounded.vertices)
        {
            vertex = (vertex * unit).array().round() / unit;
        }
        if (!(volumeProperties(rounded).volume > least * volumeProperties(solids[block].shape).volume))
        {
            return static_cast<int>(block);
        }
    }
    return -1;
}

std::vector<std::array<int, 3>> trianglesOf(const Polyhedron& shape, const std::vector<int>& face)
{
    std::vector<std::array<int, 3>> triangles;
    const FacePolygon polygon = facePolygon(shape, face);
    if (isConvex(polygon.outline))
    {
        for (std::size_t i = 1; i + 1 < face.size(); ++i)
        {
            triangles.push_back({face[0], face[i], face[i + 1]});
        }
        return triangles;
    }
    for (const auto& [a, b, c] : triangleCorners(polygon.outline))
    {
        triangles.push_back({face[static_cast<std::size_t>(a)], face[static_cast<std::size_t>(b)],
                             face[static_cast<std::size_t>(c)]});
    }
    return triangles;
}

template std::vector<std::vector<std::string>> groupsOfBlocks(const Assembly<2>& assembly);
template std::vector<std::vector<std::string>> groupsOfBlocks(const Assembly<3>& assembly);
template std::vector<std::string> layersOf(const Assembly<2>& assembly);
template std::vector<std::string> layersOf(const Assembly<3>& assembly);
template std::vector<ExportedSolid> exportedSolids(const Assembly<2>& assembly,
                                                   const std::vector<Placement<2>>& placements,
                                                   const std::vector<double>& densities);
template std::vector<ExportedSolid> exportedSolids(const Assembly<3>& assembly,
                                                   const std::vector<Placement<3>>& placements,
                                                   const std::vector<double>& densities);

} // namespace drystone
