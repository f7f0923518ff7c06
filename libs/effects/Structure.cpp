// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Masses and sizes of the blocks of a case.
#include "effects/Structure.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{

void setStructure(Structure& structure, Assembly<2> assembly, const std::vector<double>& densities)
{
    structure.assembly = std::move(assembly);
    structure.blocks = blockMasses(structure.assembly);
    structure.free = freeIndices(structure.assembly);
    structure.mass = massDiagonal(structure.assembly, structure.blocks, densities);
    structure.blockSize = meanBlockSize(structure.assembly);
    double extent = 0;
    for (const Block<2>& block : structure.assembly.blocks)
    {
        for (const Vector<2>& corner : block.outline)
        {
            extent = std::max(extent, block.support < 0 ? corner.lpNorm<Eigen::Infinity>() : 0);
        }
    }
    structure.roundingGap = 64 * std::numeric_limits<double>::epsilon() * extent;
}

Eigen::VectorXd massDiagonal(const Assembly<2>& assembly, const std::vector<BlockMass<2>>& blocks,
                             const std::vector<double>& densities)
{
    const std::vector<int> free = freeIndices(assembly);
    const auto freeBlocks = std::count_if(free.begin(), free.end(), [](int index) { return index >= 0; });
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(3 * freeBlocks);
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

double farthestMotion(const Eigen::VectorXd& displacement, double blockSize)
{
    double farthest = 0;
    for (Eigen::Index row = 0; row < displacement.size(); row += 3)
    {
        farthest = std::max({farthest, displacement.segment<2>(row).lpNorm<Eigen::Infinity>(),
                             blockSize * std::abs(displacement[row + 2])});
    }
    return farthest;
}

} // namespace drystone
