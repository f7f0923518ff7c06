// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Masses of blocks in the plane.
#include "effects/Structure.h"

#include <algorithm>

namespace drystone
{

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

void setMass(Structure<2>& structure, const std::vector<double>& densities)
{
    structure.mass = massDiagonal(structure.assembly, structure.blocks, densities);
}

MassMatrix<2> massAt(const Structure<2>& structure, const std::vector<Placement<2>>&)
{
    return structure.mass;
}

} // namespace drystone
