// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A program of somebody else: the collapse multiplier of a wall by the libraries alone, without a case.
#include "assembly/Loads.h"
#include "contact/ContactPoint.h"
#include "contact/Equilibrium.h"
#include "statics/LimitAnalysis.h"
#include "texture/RunningBond.h"
#include "texture/Supports.h"

#include <fmt/format.h>

int main()
{
    using namespace drystone;
    // 1. Wall 1 of Portioli, Cascini & Landolfo 2017, on the ground.
    RunningBond bond;
    Assembly<2> assembly = makeAssembly(bond);
    Ground ground;
    ground.segment = 0.5 * bond.unit.x();
    addGround(assembly, "ground", ground);

    // 2. Where its blocks touch, and what they weigh.
    const std::vector<BlockMass<2>> masses = blockMasses(assembly);
    const std::vector<ContactPoint<2>> points = findContactPoints(assembly);
    std::vector<double> weights;
    int freeBlocks = 0;
    for (std::size_t block = 0; block < assembly.blocks.size(); ++block)
    {
        weights.push_back(1000 * masses[block].volume);
        freeBlocks += assembly.blocks[block].support < 0;
    }

    // 3. Its own weight, and alpha times that to the right, until it collapses.
    const Vector<2> down(0, -1);
    const LoadVectors loads{gravityLoad(assembly, weights, down),
                            inertialLoad(assembly, weights, down, {1, 0})};
    const LimitAnalysis analysis =
        solveLimitAnalysis(limitAnalysisProgram(freeBlocks, equilibriumColumns(assembly, masses, points),
                                                std::vector<double>(points.size(), 0.65), loads));
    fmt::print("alpha = {:.6f}\n", analysis.alpha);
    return analysis.status == CollapseStatus::optimal ? 0 : 2;
}
