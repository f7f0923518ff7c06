// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Solids from blocks.
#include "import/export/ExportedSolids.h"

#include "geometry/PolygonShape.h"
#include "geometry/space/FacePolygon.h"

#include <algorithm>

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
std::vector<std::string> layersOf(const Assembly<Dim>& assembly)
{
    std::vector<std::string> layers(assembly.blocks.size());
    for (const Zone& zone : assembly.zones)
    {
        for (const int block : zone.blocks)
        {
            std::string& layer = layers[static_cast<std::size_t>(block)];
            layer = layer.empty() ? zone.name : layer;
        }
    }
    for (std::size_t i = 0; i < layers.size(); ++i)
    {
        const int support = assembly.blocks[i].support;
        if (support >= 0)
        {
            layers[i] = assembly.supports[static_cast<std::size_t>(support)].name;
        }
        else if (layers[i].empty())
        {
            layers[i] = "blocks";
        }
    }
    return layers;
}

template<int Dim>
std::vector<ExportedSolid> exportedSolids(const Assembly<Dim>& assembly,
                                          const std::vector<Placement<Dim>>& placements,
                                          const std::vector<double>& densities)
{
    const std::vector<std::string> layers = layersOf(assembly);
    std::vector<ExportedSolid> solids;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const Block<Dim>& block = assembly.blocks[i];
        solids.push_back({shapeOf(block, placements.empty() ? Placement<Dim>{} : placements[i]), layers[i],
                          block.support >= 0, densities.empty() ? 0 : densities[i]});
    }
    return solids;
}

template std::vector<std::string> layersOf(const Assembly<2>& assembly);
template std::vector<std::string> layersOf(const Assembly<3>& assembly);
template std::vector<ExportedSolid> exportedSolids(const Assembly<2>& assembly,
                                                   const std::vector<Placement<2>>& placements,
                                                   const std::vector<double>& densities);
template std::vector<ExportedSolid> exportedSolids(const Assembly<3>& assembly,
                                                   const std::vector<Placement<3>>& placements,
                                                   const std::vector<double>& densities);

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
    for (const std::array<Vector<2>, 3>& corners : triangulate(polygon.outline))
    {
        std::array<int, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k)
        {
            const auto nearest =
                std::min_element(polygon.outline.begin(), polygon.outline.end(),
                                 [&](const Vector<2>& a, const Vector<2>& b)
                                 { return (a - corners[k]).norm() < (b - corners[k]).norm(); });
            triangle[k] = face[static_cast<std::size_t>(nearest - polygon.outline.begin())];
        }
        triangles.push_back(triangle);
    }
    return triangles;
}

} // namespace drystone
