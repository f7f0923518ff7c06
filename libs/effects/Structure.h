// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The blocks of a case with their masses and loads: what effects may rely on all through a run.
#pragma once

#include "assembly/Assembly.h"

#include <vector>

namespace drystone
{

/// A structure as built, and its dead load.
struct Structure
{
    Assembly<2> assembly;
    std::vector<BlockMass<2>> blocks;      ///< of all blocks
    std::vector<int> free;                 ///< see freeIndices
    Eigen::VectorXd mass;                  ///< diagonal of M, 3 a free block [kg, kg, kg m2]
    Eigen::VectorXd deadLoad;              ///< likewise [N, N, N m]
    Vector<2> gravity = Vector<2>::Zero(); ///< [m/s2]
    double blockSize = 1;                  ///< mean [m]
    double roundingGap = 0; ///< a gap that small is none: what rounding leaves of the places of blocks [m]
};

/// Fills in `assembly` and what follows from it, `blocks`, `free`, `mass`, `blockSize` and `roundingGap`.
/// Loads are left alone. \param densities of all blocks [kg/m3]
void setStructure(Structure& structure, Assembly<2> assembly, const std::vector<double>& densities);

/// Diagonal of the mass matrix M: (m, m, J) of each free block [kg, kg, kg m2].
/// \param blocks mass properties of all blocks \param densities of all blocks [kg/m3]
Eigen::VectorXd massDiagonal(const Assembly<2>& assembly, const std::vector<BlockMass<2>>& blocks,
                             const std::vector<double>& densities);

/// Of any block, that of its turning about as far from its mass centre as blocks are large [m].
double farthestMotion(const Eigen::VectorXd& displacement, double blockSize);

} // namespace drystone
