// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// States of a structure in motion.
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
