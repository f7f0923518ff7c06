// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The blocks of a case with their masses and loads: what effects may rely on all through a run.
#pragma once

#include "assembly/Assembly.h"
#include "assembly/Loads.h"
#include "effects/MassMatrix.h"
#include "geometry/Rotation.h"

#include <vector>

namespace drystone
{

/// A structure as built, and its dead load.
template<int Dim>
struct Structure
{
    using Axes = Eigen::Matrix<double, rotationCount<Dim>, rotationCount<Dim>>;

    Assembly<Dim> assembly;
    std::vector<BlockMass<Dim>> blocks; ///< of all blocks
    std::vector<int> free;              ///< see freeIndices
    /// Masses and moments of inertia of each free block, in space about its principal axes: (m m J) or (m m m
    /// J1 J2 J3) [kg, kg m2]. In the plane the diagonal of M.
    Eigen::VectorXd mass;
    std::vector<Axes> principalAxes;           ///< of each free block as built, columns; in the plane empty
    Load deadLoad;                             ///< its rows are those of M [N, N m]
    Vector<Dim> gravity = Vector<Dim>::Zero(); ///< [m/s2]
    double blockSize = 1;                      ///< mean [m]
    double roundingGap = 0; ///< a gap that small is none: what rounding leaves of the places of blocks [m]
};

/// Fills in `assembly` and what follows from it, `blocks`, `free`, `mass`, `principalAxes`, `blockSize` and
/// `roundingGap`. Loads are left alone. \param densities of all blocks [kg/m3]
template<int Dim>
void setStructure(Structure<Dim>& structure, Assembly<Dim> assembly, const std::vector<double>& densities);

/// M with the blocks where they are.
MassMatrix<2> massAt(const Structure<2>& structure, const std::vector<Placement<2>>& placements);
MassMatrix<3> massAt(const Structure<3>& structure, const std::vector<Placement<3>>& placements);

/// Diagonal of M in the plane: (m, m, J) of each free block [kg, kg, kg m2].
/// \param blocks mass properties of all blocks \param densities of all blocks [kg/m3]
Eigen::VectorXd massDiagonal(const Assembly<2>& assembly, const std::vector<BlockMass<2>>& blocks,
                             const std::vector<double>& densities);

/// Fills in `mass` and `principalAxes` from `assembly`, `blocks` and `free`.
void setMass(Structure<2>& structure, const std::vector<double>& densities);
void setMass(Structure<3>& structure, const std::vector<double>& densities);

/// Of any block, that of its turning about as far from its mass centre as blocks are large [m].
template<int Dim>
double farthestMotion(const Eigen::VectorXd& displacement, double blockSize);

} // namespace drystone
