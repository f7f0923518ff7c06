// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The equilibrium matrix A0: what contact forces do to the blocks.
#pragma once

#include "contact/ContactPoint.h"

namespace drystone
{

/// The columns of A0 that belong to one contact point (paper: Portioli, Cascini & Landolfo 2017, eq. 1).
///
/// A column is MINUS the generalised force of a unit contact force about the block's centroid, so that
/// equilibrium under the loads f reads A0 c = f and the gaps after displacements dx are g0 - A0' dx. Rows ux
/// uy rz [-, -, m], columns normal tangent; in space ux uy uz rx ry rz, columns normal tangent1 tangent2. On
/// the neighbour the force is reversed.
template<int Dim>
struct ContactColumns
{
    using Matrix = Eigen::Matrix<double, freedomCount<Dim>, Dim>;

    int block = -1;     ///< free index (see freeIndices) of ContactPoint::block, or -1 when it is fixed
    int neighbour = -1; ///< free index of ContactPoint::neighbour, or -1 when it is fixed
    Matrix onBlock = Matrix::Zero();
    Matrix onNeighbour = Matrix::Zero();
};

/// Columns of A0, one entry for each contact point in their order: A0 is 3b x 2k in the plane and 6b x 3k in
/// space, b free blocks, k points. \param masses of all blocks, fixed ones included, in the order of
/// Assembly::blocks (only centroids are used)
template<int Dim>
std::vector<ContactColumns<Dim>> equilibriumColumns(const Assembly<Dim>& assembly,
                                                    const std::vector<BlockMass<Dim>>& masses,
                                                    const std::vector<ContactPoint<Dim>>& points);

} // namespace drystone
