// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The mass matrix of blocks in the plane: diagonal, the same wherever they are.
#include "effects/MassMatrix.h"

namespace drystone
{

Eigen::VectorXd times(const MassMatrix<2>& mass, const Eigen::VectorXd& v)
{
    return mass.diagonal.cwiseProduct(v);
}

BlockVector<2> times(const MassMatrix<2>& mass, int body, const BlockVector<2>& v)
{
    return mass.diagonal.segment<3>(3 * body).cwiseProduct(v);
}

double squareOf(const MassMatrix<2>& mass, const Eigen::VectorXd& v)
{
    return mass.diagonal.dot(v.cwiseAbs2());
}

double squareOf(const MassMatrix<2>& mass, int body, const BlockVector<2>& v)
{
    return mass.diagonal.segment<3>(3 * body).dot(v.cwiseAbs2());
}

double inverseSquareOf(const MassMatrix<2>& mass, const Eigen::VectorXd& f)
{
    return f.cwiseAbs2().cwiseQuotient(mass.diagonal).sum();
}

MassMatrix<2> over(MassMatrix<2> mass, double divisor)
{
    mass.diagonal /= divisor;
    return mass;
}

BlockMatrix<2> blockOf(const MassMatrix<2>& mass, int body)
{
    return mass.diagonal.segment<3>(3 * body).asDiagonal();
}

BlockVector<2> solveBlock(const BlockMatrix<2>& inertia, const BlockVector<2>& rows)
{
    return rows.cwiseQuotient(inertia.diagonal());
}

} // namespace drystone
