// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// States of a structure in motion.
#include "dynamics/DynamicState.h"

#include "geometry/Rotation.h"

namespace drystone
{

template<int Dim>
DynamicState<Dim> stateAtRest(const Assembly<Dim>& assembly)
{
    DynamicState<Dim> state;
    state.placements.resize(assembly.blocks.size());
    Eigen::Index freeBlocks = 0;
    for (const Block<Dim>& block : assembly.blocks)
    {
        freeBlocks += block.support < 0 ? 1 : 0;
    }
    state.velocity = Eigen::VectorXd::Zero(freedomCount<Dim> * freeBlocks);
    return state;
}

template<int Dim>
std::vector<BlockMass<Dim>> placedMasses(std::vector<BlockMass<Dim>> blocks,
                                         const std::vector<Placement<Dim>>& placements)
{
    for (std::size_t block = 0; block < blocks.size(); ++block)
    {
        blocks[block].centroid += placements[block].translation;
    }
    return blocks;
}

template<int Dim>
Eigen::VectorXd turnedWithBlocks(Eigen::VectorXd velocity, const Eigen::VectorXd& displacement)
{
    if constexpr (Dim == 3)
    {
        for (Eigen::Index row = Dim; row < velocity.size(); row += freedomCount<Dim>)
        {
            velocity.segment<3>(row) =
                turned(Vector<3>(displacement.segment<3>(row)), Vector<3>(velocity.segment<3>(row)));
        }
    }
    return velocity;
}

template Eigen::VectorXd turnedWithBlocks<2>(Eigen::VectorXd velocity, const Eigen::VectorXd& displacement);
template DynamicState<2> stateAtRest(const Assembly<2>& assembly);
template std::vector<BlockMass<2>> placedMasses(std::vector<BlockMass<2>> blocks,
                                                const std::vector<Placement<2>>& placements);
template Eigen::VectorXd turnedWithBlocks<3>(Eigen::VectorXd velocity, const Eigen::VectorXd& displacement);
template DynamicState<3> stateAtRest(const Assembly<3>& assembly);
template std::vector<BlockMass<3>> placedMasses(std::vector<BlockMass<3>> blocks,
                                                const std::vector<Placement<3>>& placements);

} // namespace drystone
