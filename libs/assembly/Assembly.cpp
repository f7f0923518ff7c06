// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Numbering of free blocks and mass properties.
#include "assembly/Assembly.h"

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

} // namespace drystone
