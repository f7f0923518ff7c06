// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The walls on which solvers are compared: the six of the paper, and square ones. Header only: targets that
/// include it link texture, statics and dynamics.
#pragma once

#include "../MadeStructure.h"
#include "assembly/Loads.h"
#include "assembly/Materials.h"
#include "dynamics/DynamicState.h"
#include "effects/Structure.h"
#include "statics/LimitAnalysis.h"

#include "../SquareWall.h"

#include <fmt/format.h>

namespace drystone
{

/// Blocks of wall 1 to 6 of the paper.
inline Assembly<2> paperWall(int number)
{
    return madeStructure(Dictionary::readFile(fmt::format(
        DRYSTONE_TUTORIALS "/limitAnalysis/masonryPanels/wall{}/system/blockTextureDict", number)));
}

/// Dead and horizontal live load on blocks of 1 kN/m3, mu 0.65.
inline PlaneConeProgram limitAnalysisOf(const Assembly<2>& assembly)
{
    const std::vector<BlockMass<2>> blocks = blockMasses(assembly);
    const std::vector<double> masses = massesOf(blocks, std::vector<double>(blocks.size(), 1000 / 9.81));
    const std::vector<ContactPoint<2>> points = findContactPoints(assembly);
    const Vector<2> gravity(0, -9.81);
    const LoadVectors loads{gravityLoad(assembly, masses, gravity),
                            inertialLoad(assembly, masses, gravity, {1, 0})};
    return limitAnalysisProgram(static_cast<int>(loads.dead.size()) / 3,
                                equilibriumColumns(assembly, blocks, points),
                                std::vector<double>(points.size(), 0.65), loads);
}

/// The first step of 0.002 s from rest, pushed by alpha times the weight.
inline PlaneConeProgram stepOf(const Assembly<2>& assembly, double alpha)
{
    PlaneConeProgram program = limitAnalysisOf(assembly);
    program.load += alpha * program.liveLoad;
    const std::vector<BlockMass<2>> blocks = blockMasses(assembly);
    const Eigen::VectorXd mass =
        massDiagonal(assembly, blocks, std::vector<double>(blocks.size(), 1000 / 9.81));
    for (int body = 0; body < program.bodies; ++body)
    {
        program.inertia.push_back((mass.segment<3>(3 * body) / (0.002 * 0.002)).asDiagonal());
    }
    program.liveLoad.resize(0);
    program.gap = Eigen::VectorXd::Zero(2 * program.points());
    return program;
}

/// Collapse multipliers of the six walls.
constexpr double paperMultipliers[6] = {0.642859, 0.579999, 0.403694, 0.331948, 0.239643, 0.347825};

} // namespace drystone
