// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Masses and sizes of the blocks of a case.
#include "effects/Structure.h"

#include "assembly/BlockShape.h"

#include <algorithm>
#include <limits>

namespace drystone
{

template<int Dim>
void setStructure(Structure<Dim>& structure, Assembly<Dim> assembly, const std::vector<double>& densities)
{
    structure.assembly = std::move(assembly);
    structure.blocks = blockMasses(structure.assembly);
    structure.free = freeIndices(structure.assembly);
    setMass(structure, densities);
    structure.blockSize = meanBlockSize(structure.assembly);
    double extent = 0;
    for (const Block<Dim>& block : structure.assembly.blocks)
    {
        for (const Vector<Dim>& corner : cornersOf(block))
        {
            extent = std::max(extent, block.support < 0 ? corner.template lpNorm<Eigen::Infinity>() : 0);
        }
    }
    structure.roundingGap = 64 * std::numeric_limits<double>::epsilon() * extent;
}

template void setStructure(Structure<2>& structure, Assembly<2> assembly,
                           const std::vector<double>& densities);
template void setStructure(Structure<3>& structure, Assembly<3> assembly,
                           const std::vector<double>& densities);

template<int Dim>
double farthestMotion(const Eigen::VectorXd& displacement, double blockSize)
{
    double farthest = 0;
    for (Eigen::Index row = 0; row < displacement.size(); row += freedomCount<Dim>)
    {
        const auto turn = displacement.segment<rotationCount<Dim>>(row + Dim);
        farthest = std::max({farthest, displacement.segment<Dim>(row).template lpNorm<Eigen::Infinity>(),
                             blockSize * turn.template lpNorm<Eigen::Infinity>()});
    }
    return farthest;
}

template double farthestMotion<2>(const Eigen::VectorXd& displacement, double blockSize);
template double farthestMotion<3>(const Eigen::VectorXd& displacement, double blockSize);

} // namespace drystone
