// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Structures that the tests of statics share: the six walls of the paper, blocks on the ground.
#pragma once

#include "contact/Equilibrium.h"
#include "statics/LimitAnalysis.h"
#include "texture/RunningBond.h"
#include "texture/Supports.h"

#include <algorithm>

namespace drystone
{

/// A structure with what limit analysis needs of it.
struct WeighedStructure
{
    Assembly<2> assembly;
    std::vector<BlockMass<2>> masses;
    std::vector<ContactPoint<2>> points;
    std::vector<double> weights; ///< of all blocks, for unit weight 1000 N/m3

    explicit WeighedStructure(Assembly<2> built) : assembly(std::move(built))
    {
        masses = blockMasses(assembly);
        points = findContactPoints(assembly);
        for (const auto& mass : masses)
        {
            weights.push_back(1000 * mass.volume);
        }
    }

    int freeBlocks() const
    {
        int count = 0;
        for (const auto& block : assembly.blocks)
        {
            count += block.support < 0;
        }
        return count;
    }

    /// Dead load down, live load the blocks' own weights along (1 0).
    LoadVectors weightLoads(double unit = 1) const
    {
        const Vector<2> down(0, -unit);
        return {gravityLoad(assembly, weights, down), inertialLoad(assembly, weights, down, {1, 0})};
    }

    PlaneConeProgram program(double mu, const LoadVectors& loads) const
    {
        return limitAnalysisProgram(freeBlocks(), equilibriumColumns(assembly, masses, points),
                                    std::vector<double>(points.size(), mu), loads);
    }
};

struct Wall
{
    RunningBond bond;
    int blocks;
    int points;
    double alpha;
};

/// Table 1 of Portioli, Cascini & Landolfo 2017; multipliers to six digits from two LP codes.
inline std::vector<Wall> paperWalls()
{
    const auto wall = [](double length, int courses, FirstCourse first, std::vector<Opening> openings)
    {
        RunningBond bond;
        bond.length = length;
        bond.courses = courses;
        bond.firstCourse = first;
        bond.openings = std::move(openings);
        return bond;
    };
    using enum FirstCourse;
    return {
        {wall(5, 6, half, {}), 33, 174, 0.642859},
        {wall(5, 10, half, {}), 55, 290, 0.579999},
        {wall(4, 11, full, {{{1.5, 3}, {2.5, 8}}}), 46, 212, 0.403694},
        {wall(5, 11, half, {{{1, 3}, {2, 8}}, {{3, 3}, {4, 8}}}), 55, 240, 0.331948},
        {wall(3, 19, half, {{{1, 3}, {2, 8}}, {{1, 11}, {2, 16}}}), 61, 244, 0.239643},
        {wall(7, 21, half,
              {{{1.5, 4}, {2.5, 9}}, {{4.5, 4}, {5.5, 9}}, {{1.5, 12}, {2.5, 17}}, {{4.5, 12}, {5.5, 17}}}),
         146, 702, 0.347825},
    };
}

inline WeighedStructure standing(const RunningBond& bond)
{
    Assembly<2> assembly = makeAssembly(bond);
    Ground ground;
    ground.segment = 0.5 * bond.unit.x();
    addGround(assembly, "ground", ground);
    return WeighedStructure(std::move(assembly));
}

/// The structure seen from behind: x reversed.
inline Assembly<2> mirrored(Assembly<2> assembly)
{
    for (auto& block : assembly.blocks)
    {
        for (auto& vertex : block.outline)
        {
            vertex.x() = -vertex.x();
        }
        std::reverse(block.outline.begin(), block.outline.end());
    }
    return assembly;
}

inline Block<2> rectangle(double x0, double y0, double x1, double y1, int support = -1)
{
    return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, 1, support};
}

} // namespace drystone
