// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Settlement against hand calculations, and with the certificate of the program.
#include "statics/Settlement.h"
#include "Structures.h"

#include <gtest/gtest.h>

using namespace drystone;

namespace
{

/// The blocks of support 1 move.
LimitAnalysis settle(std::vector<Block<2>> blocks, double mu, const Vector<2>& direction)
{
    Assembly<2> assembly;
    assembly.supports = {{"stays", "blocks"}, {"moves", "blocks"}};
    assembly.blocks = std::move(blocks);
    const WeighedStructure structure(std::move(assembly));
    PlaneConeProgram program = structure.program(mu, structure.weightLoads());
    program.liveLoad.resize(0);
    program.gap = settlementGaps(structure.assembly, structure.points, {1, direction});
    return solveSettlement(program);
}

/// A beam of length 4 and height 1 on two supports of width 1, with its weight 4000.
LimitAnalysis settle(double mu, const Vector<2>& direction)
{
    return settle({rectangle(0, 0, 4, 1), rectangle(0, -1, 1, 0, 0), rectangle(3, -1, 4, 0, 1)}, mu,
                  direction);
}

/// The rest stands without the support: the reaction is 0, with forces that say so and a proof of R >= 0.
void expectNoReaction(const LimitAnalysis& result, double weight)
{
    EXPECT_EQ(result.status, CollapseStatus::optimal);
    EXPECT_NEAR(result.alpha, 0, 1e-9 * weight);
    EXPECT_LE(result.certificate.worst(), 1e-9);
}

} // namespace

TEST(Settlement, OfABeamTurnsItAboutTheNearEdgeOfTheOtherSupport)
{
    // Moments about x = 1, with the reaction at x = 4: V 3 = W 1.
    const LimitAnalysis down = settle(0.5, {0, -1});
    EXPECT_EQ(down.status, CollapseStatus::optimal);
    EXPECT_NEAR(down.alpha, 4000.0 / 3, 1e-5);
    EXPECT_LE(down.certificate.worst(), 1e-9);
    EXPECT_NEAR(down.mechanism[2], -1.0 / 3, 1e-7);
}

TEST(Settlement, UpwardsIsHeldByTheMostThatTheSupportCanBear)
{
    // The beam lifts off about x = 0, the reaction at x = 3: V 3 = W 2.
    EXPECT_NEAR(settle(0.5, {0, 1}).alpha, -8000.0 / 3, 1e-5);
}

TEST(Settlement, SidewaysIsHeldByFriction)
{
    // Outwards: the support slides away and drags at the beam with mu V, V between W/3 and 2 W/3; the left
    // support must hold it with as much. At best mu W/2 on either.
    EXPECT_NEAR(settle(0.5, {1, 0}).alpha, -1000, 1e-5);
    EXPECT_NEAR(settle(0, {1, 0}).alpha, 0, 1e-5);
}

TEST(Settlement, OfABeamThatCannotStandIsUnstable)
{
    Assembly<2> assembly;
    assembly.supports = {{"left", "blocks"}, {"right", "blocks"}};
    assembly.blocks = {rectangle(0, 0, 4, 1), rectangle(0, -1, 1, 0, 0), rectangle(1, -1, 1.5, 0, 1)};
    const WeighedStructure structure(std::move(assembly));
    PlaneConeProgram program = structure.program(0.5, structure.weightLoads());
    program.liveLoad.resize(0);
    program.gap = settlementGaps(structure.assembly, structure.points, {1, {0, -1}});
    EXPECT_EQ(solveSettlement(program).status, CollapseStatus::unstable);
}

TEST(Settlement, OfASupportThatNeedNotCarryAnythingHasNoReaction)
{
    for (const double mu : {0.0, 0.3, 0.7, 10.0})
    {
        SCOPED_TRACE(mu);
        // A block half on what stays and half on what sinks, its weight just above the edge between.
        expectNoReaction(settle({rectangle(0, 0, 2, 1), rectangle(0, -1, 1, 0, 0), rectangle(1, -1, 2, 0, 1)},
                                mu, {0, -1}),
                         2000);
        // More than half of it on what stays.
        expectNoReaction(
            settle({rectangle(0, 0, 2, 1), rectangle(0, -1, 1.2, 0, 0), rectangle(1.2, -1, 2, 0, 1)}, mu,
                   {0, -1}),
            2000);
        // A slab on three pads, of which that in the middle sinks.
        expectNoReaction(settle({rectangle(0, 0, 2, 0.2), rectangle(0, -1, 0.2, 0, 0),
                                 rectangle(0.9, -1, 1.1, 0, 1), rectangle(1.8, -1, 2, 0, 0)},
                                mu, {0, -1}),
                         400);
    }
}

TEST(Settlement, OfASupportThatIsLockedInIsUnbounded)
{
    // A block between the support, which is pushed against it from the left, and what stays on its right.
    const LimitAnalysis result = settle({rectangle(0, 0, 1, 1), rectangle(-1, -1, 2, 0, 0),
                                         rectangle(1, 0, 2, 1, 0), rectangle(-1, 0, 0, 1, 1)},
                                        0.5, {1, 0});
    EXPECT_EQ(result.status, CollapseStatus::unbounded);
    EXPECT_LE(result.certificate.worst(), 1e-9);
}
