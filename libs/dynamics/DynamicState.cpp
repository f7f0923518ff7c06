// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/DynamicState.h"

namespace drystone
{

DynamicState stateAtRest(const Assembly<2>& assembly)
{
    DynamicState state;
    state.placements.resize(assembly.blocks.size());
    Eigen::Index freeBlocks = 0;
    for (const Block<2>& block : assembly.blocks)
    {
        freeBlocks += block.support < 0 ? 1 : 0;
    }
    state.velocity = Eigen::VectorXd::Zero(3 * freeBlocks);
    return state;
}

Eigen::VectorXd massDiagonal(const Assembly<2>& assembly, const std::vector<BlockMass<2>>& blocks,
                             const std::vector<double>& densities)
{
    const std::vector<int> free = freeIndices(assembly);
    Eigen::VectorXd mass = stateAtRest(assembly).velocity;
    for (std::size_t block = 0; block < free.size(); ++block)
    {
        if (free[block] >= 0)
        {
            const double translation = densities[block] * blocks[block].volume;
            const double rotation = densities[block] * blocks[block].inertia(0, 0);
            mass.segment<3>(3 * free[block]) << translation, translation, rotation;
        }
    }
    return mass;
}

std::vector<BlockMass<2>> placedMasses(std::vector<BlockMass<2>> blocks,
                                       const std::vector<Placement<2>>& placements)
{
    for (std::size_t block = 0; block < blocks.size(); ++block)
    {
        blocks[block].centroid += placements[block].translation;
    }
    return blocks;
}

} // namespace drystone
