// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Masses of blocks in space, whose inertia turns with them.
#include "effects/Structure.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace drystone
{

void setMass(Structure<3>& structure, const std::vector<double>& densities)
{
    const auto freeBlocks =
        std::count_if(structure.free.begin(), structure.free.end(), [](int index) { return index >= 0; });
    structure.mass = Eigen::VectorXd::Zero(6 * freeBlocks);
    structure.principalAxes.assign(static_cast<std::size_t>(freeBlocks), Eigen::Matrix3d::Identity());
    for (std::size_t block = 0; block < structure.free.size(); ++block)
    {
        if (structure.free[block] >= 0)
        {
            const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(structure.blocks[block].inertia);
            const double mass = densities[block] * structure.blocks[block].volume;
            structure.mass.segment<6>(6 * structure.free[block]) << mass, mass, mass,
                densities[block] * axes.eigenvalues();
            structure.principalAxes[static_cast<std::size_t>(structure.free[block])] = axes.eigenvectors();
        }
    }
}

MassMatrix<3> massAt(const Structure<3>& structure, const std::vector<Placement<3>>& placements)
{
    MassMatrix<3> mass;
    mass.masses.resize(structure.principalAxes.size());
    mass.tensors.resize(structure.principalAxes.size());
    for (std::size_t block = 0; block < structure.free.size(); ++block)
    {
        if (structure.free[block] >= 0)
        {
            const auto body = static_cast<std::size_t>(structure.free[block]);
            Eigen::Matrix3d axes = structure.principalAxes[body];
            for (int axis = 0; axis < 3; ++axis)
            {
                axes.col(axis) = turned(placements[block].rotation, Vector<3>(axes.col(axis)));
            }
            const auto own = structure.mass.segment<6>(6 * structure.free[block]);
            mass.masses[body] = own[0];
            mass.tensors[body] = axes * own.tail<3>().asDiagonal() * axes.transpose();
        }
    }
    return mass;
}

} // namespace drystone
