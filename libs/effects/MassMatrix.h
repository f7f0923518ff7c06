// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The mass matrix M of the free blocks where they are: what time stepping and effects weigh velocities with.
#pragma once

#include "geometry/Vector.h"

#include <vector>

namespace drystone
{

/// A vector with the rows of one block (ux uy rz; ux uy uz rx ry rz), and a matrix of them.
template<int Dim>
using BlockVector = Eigen::Matrix<double, freedomCount<Dim>, 1>;
template<int Dim>
using BlockMatrix = Eigen::Matrix<double, freedomCount<Dim>, freedomCount<Dim>>;

/// M, a block on its diagonal for each free block: masses [kg] and, about the mass centre, the inertia [kg
/// m2], in space a tensor that turns with the block.
template<int Dim>
struct MassMatrix;

template<>
struct MassMatrix<2>
{
    Eigen::VectorXd diagonal; ///< (m, m, J) of each free block

    MassMatrix() = default;
    MassMatrix(Eigen::VectorXd ofBlocks) : diagonal(std::move(ofBlocks)) {}
};

template<>
struct MassMatrix<3>
{
    std::vector<double> masses;           ///< m of each free block
    std::vector<Eigen::Matrix3d> tensors; ///< J likewise, in the axes of space
};

/// M v; of one block its own part. \param v rows of each free block; of one its own: with accelerations
/// [m/s2, rad/s2] these are forces [N, N m] \param body index among the free blocks
Eigen::VectorXd times(const MassMatrix<2>& mass, const Eigen::VectorXd& v);
Eigen::VectorXd times(const MassMatrix<3>& mass, const Eigen::VectorXd& v);
BlockVector<2> times(const MassMatrix<2>& mass, int body, const BlockVector<2>& v);
BlockVector<3> times(const MassMatrix<3>& mass, int body, const BlockVector<3>& v);

/// v'M v, likewise: with velocities twice the kinetic energy [J].
double squareOf(const MassMatrix<2>& mass, const Eigen::VectorXd& v);
double squareOf(const MassMatrix<3>& mass, const Eigen::VectorXd& v);
double squareOf(const MassMatrix<2>& mass, int body, const BlockVector<2>& v);
double squareOf(const MassMatrix<3>& mass, int body, const BlockVector<3>& v);

/// f'M^-1 f of forces.
double inverseSquareOf(const MassMatrix<2>& mass, const Eigen::VectorXd& f);
double inverseSquareOf(const MassMatrix<3>& mass, const Eigen::VectorXd& f);

/// M over a number.
MassMatrix<2> over(MassMatrix<2> mass, double divisor);
MassMatrix<3> over(MassMatrix<3> mass, double divisor);

/// The part of one block.
BlockMatrix<2> blockOf(const MassMatrix<2>& mass, int body);
BlockMatrix<3> blockOf(const MassMatrix<3>& mass, int body);

/// B^-1 rows, B the inertia of a block: a mass times the unit matrix, and a tensor or a moment of inertia.
BlockVector<2> solveBlock(const BlockMatrix<2>& inertia, const BlockVector<2>& rows);
BlockVector<3> solveBlock(const BlockMatrix<3>& inertia, const BlockVector<3>& rows);

} // namespace drystone
