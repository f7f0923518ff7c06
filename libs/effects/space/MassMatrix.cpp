// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The mass matrix of blocks in space: a mass and a tensor each.
#include "effects/MassMatrix.h"

#include <Eigen/Cholesky>

namespace drystone
{

Eigen::VectorXd times(const MassMatrix<3>& mass, const Eigen::VectorXd& v)
{
    Eigen::VectorXd result(v.size());
    for (std::size_t body = 0; body < mass.masses.size(); ++body)
    {
        const auto row = 6 * static_cast<Eigen::Index>(body);
        result.segment<6>(row) = times(mass, static_cast<int>(body), v.segment<6>(row));
    }
    return result;
}

BlockVector<3> times(const MassMatrix<3>& mass, int body, const BlockVector<3>& v)
{
    const auto index = static_cast<std::size_t>(body);
    BlockVector<3> result;
    result << mass.masses[index] * v.head<3>(), mass.tensors[index] * v.tail<3>();
    return result;
}

double squareOf(const MassMatrix<3>& mass, const Eigen::VectorXd& v)
{
    return times(mass, v).dot(v);
}

double squareOf(const MassMatrix<3>& mass, int body, const BlockVector<3>& v)
{
    return times(mass, body, v).dot(v);
}

double inverseSquareOf(const MassMatrix<3>& mass, const Eigen::VectorXd& f)
{
    double sum = 0;
    for (std::size_t body = 0; body < mass.masses.size(); ++body)
    {
        const BlockVector<3> own = f.segment<6>(6 * static_cast<Eigen::Index>(body));
        sum += solveBlock(blockOf(mass, static_cast<int>(body)), own).dot(own);
    }
    return sum;
}

MassMatrix<3> over(MassMatrix<3> mass, double divisor)
{
    for (std::size_t body = 0; body < mass.masses.size(); ++body)
    {
        mass.masses[body] /= divisor;
        mass.tensors[body] /= divisor;
    }
    return mass;
}

BlockMatrix<3> blockOf(const MassMatrix<3>& mass, int body)
{
    const auto index = static_cast<std::size_t>(body);
    BlockMatrix<3> block = BlockMatrix<3>::Zero();
    block.diagonal().head<3>().setConstant(mass.masses[index]);
    block.bottomRightCorner<3, 3>() = mass.tensors[index];
    return block;
}

BlockVector<3> solveBlock(const BlockMatrix<3>& inertia, const BlockVector<3>& rows)
{
    BlockVector<3> result;
    result << rows.head<3>().cwiseQuotient(inertia.diagonal().head<3>()),
        inertia.bottomRightCorner<3, 3>().llt().solve(rows.tail<3>());
    return result;
}

} // namespace drystone
