// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Walls of which a part moves: the others are held by proof, wake up when it asks for them, and the motion
/// is that of all blocks together.
#include "../MadeStructure.h"
#include "Scenes.h"

#include "dynamics/HeldBlocks.h"
#include "dynamics/VerifiedStep.h"
#include "effects/JointBonds.h"
#include "timeSeries/GroundAcceleration.h"

#include <gtest/gtest.h>

using namespace drystone;
using namespace drystone::scenes;

namespace
{

constexpr double stepOfHeldBlocks = 0.005;

/// A wall of 12 x 12 units with a stone that overhangs its right end, by more than half where it is to fall.
DynamicCase<2> wallWithStone(double overhang, FlowRule flowRule = FlowRule::associative)
{
    Assembly<2> assembly = madeStructure(Dictionary::readString(
        "texture { type runningBond; unit (0.4 0.175); length 12; courses 12; firstCourse full; }\n"
        "supports { ground { type ground; segment 0.5; } }\n"));
    assembly.blocks.push_back(rectangle(12 * 0.4 - 0.4 + overhang, 12 * 0.175, 0.4, 0.2));
    DynamicCase<2> scene =
        sceneOf(std::move(assembly), {.mu = 0.65, .flowRule = flowRule, .tolerance = 1e-9});
    scene.schemes.effects.selection = EffectSelection::automatic;
    return scene;
}

long awakeOf(const Motion<2>& motion)
{
    return std::count(motion.isAwake.begin(), motion.isAwake.end(), true);
}

} // namespace

TEST(HeldBlocks, OnlyTheStoneThatFallsIsSimulatedAndItFallsAsWithEverythingOn)
{
    const DynamicCase<2> scene = wallWithStone(0.24);
    DynamicCase<2> everything = scene;
    everything.schemes.effects.selection = EffectSelection::asGiven;
    everything.schemes.contactTolerance /= 100; // 40 steps add up
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    Motion<2> reference = motion;
    int held = 0;
    for (int step = 0; step < 40; ++step)
    {
        const Motion<2> before = motion;
        ASSERT_TRUE(advance(scene, motion, stepOfHeldBlocks)) << step;
        verifyStep(scene, before, stepOfHeldBlocks, motion);
        ASSERT_TRUE(advance(everything, reference, stepOfHeldBlocks)) << step;
        held += !motion.isAwake.empty() ? 1 : 0;
        EXPECT_LE(awakeOf(motion), 40) << step;
    }
    EXPECT_GE(held, 30);
    EXPECT_LT(motion.state.placements.back().translation.y(), -0.01);
    EXPECT_LT(motion.effectUse.largestDifference, 1e-7 * scene.blockSize);
    EXPECT_LT(differenceOf(scene, motion.state, reference.state), 1e-7);
    EXPECT_LT(relativeImbalance(motion.energy), 1e-7);
}

TEST(HeldBlocks, ByCoulombsLawAllBlocksAreSimulatedWhereAnythingMoves)
{
    const DynamicCase<2> scene = wallWithStone(0.24, FlowRule::nonAssociative);
    EXPECT_NE(whyAllBlocks(scene, scene.flowRule()), "");
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < 10; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, stepOfHeldBlocks));
        EXPECT_TRUE(motion.isAwake.empty());
    }
    EXPECT_LT(motion.state.placements.back().translation.y(), -5e-4);
}

// Its motion dies out into the wall, block by block, and the forces beside it are near what friction allows:
// there is no border where it ends. Both runs are within what a step is allowed of one that is solved a
// hundred times closer.
TEST(HeldBlocks, ACornerThatFallsIsSimulatedWithItsSurroundingsOnly)
{
    constexpr int steps = 12;
    DynamicCase<2> scene =
        sceneOf(madeStructure(Dictionary::readString(
                    "texture { type runningBond; unit (0.4 0.175); length 24; courses 24; firstCourse full;\n"
                    "openings ( { from (20 18); to (24 20); } ); }\n"
                    "supports { ground { type ground; segment 0.5; } }\n")),
                {.mu = 0.65, .flowRule = FlowRule::associative, .tolerance = 1e-9});
    std::vector<Motion<2>> motions;
    int held = 0;
    double awake = 0;
    for (const EffectSelection selection : {EffectSelection::automatic, EffectSelection::asGiven})
    {
        scene.schemes.effects.selection = selection;
        motions.push_back(startMotion(scene, stateAtRest(scene.assembly)));
        for (int step = 0; step < steps; ++step)
        {
            ASSERT_TRUE(advance(scene, motions.back(), 0.01)) << step;
            held += !motions.back().isAwake.empty() ? 1 : 0;
            awake += motions.back().isAwake.empty() ? 0 : static_cast<double>(awakeOf(motions.back()));
        }
    }
    EXPECT_GE(held, steps - 3);
    EXPECT_LT(awake, 0.3 * held * static_cast<double>(scene.free.size()));
    const auto& placements = motions.front().state.placements;
    EXPECT_TRUE(std::any_of(placements.begin(), placements.end(),
                            [](const auto& placement) { return placement.translation.y() < -0.05; }));
    EXPECT_LT(relativeImbalance(motions.front().energy), 1e-7);
    scene.solution.tolerance = 1e-11;
    Motion<2> closer = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < steps; ++step)
    {
        ASSERT_TRUE(advance(scene, closer, 0.01)) << step;
    }
    for (const Motion<2>& motion : motions)
    {
        EXPECT_LT(differenceOf(scene, motion.state, closer.state), steps * 1e-6 * scene.blockSize);
    }
}

TEST(HeldBlocks, AStoneThatStandsNeedsNoStepAtAll)
{
    const DynamicCase<2> scene = wallWithStone(0.1);
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < 5; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, stepOfHeldBlocks));
        EXPECT_EQ(awakeOf(motion), 0);
        EXPECT_FALSE(motion.isAwake.empty());
    }
}

TEST(HeldBlocks, AStepThatIsNotSolvedLeavesThemHeld)
{
    DynamicCase<2> scene = wallWithStone(0.24);
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < 3; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, stepOfHeldBlocks));
    }
    ASSERT_GT(awakeOf(motion), 0);
    ASSERT_FALSE(motion.isAwake.empty());
    const std::vector<char> isAwake = motion.isAwake;
    const std::vector<int> bodies = motion.bodies;
    scene.solution.maximumIterations = 1;
    ASSERT_FALSE(advance(scene, motion, stepOfHeldBlocks));
    EXPECT_EQ(motion.isAwake, isAwake);
    EXPECT_EQ(motion.bodies, bodies);
}

// The ground pushes the wall beyond what it carries while the stone falls: all of it wakes up and moves.
TEST(HeldBlocks, BlocksThatArePushedWakeUp)
{
    DynamicCase<2> scene = wallWithStone(0.24);
    shake(scene, std::make_shared<RectangularPulse>(PulseShape{12, 1, 0.1}));
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    bool wasHeld = false;
    for (int step = 0; step < 40; ++step)
    {
        const Motion<2> before = motion;
        ASSERT_TRUE(advance(scene, motion, stepOfHeldBlocks)) << step;
        verifyStep(scene, before, stepOfHeldBlocks, motion);
        wasHeld = wasHeld || (awakeOf(motion) > 0 && motion.state.time < 0.1);
    }
    EXPECT_TRUE(wasHeld);
    EXPECT_TRUE(motion.isAwake.empty());
    EXPECT_LT(motion.state.placements[100].translation.x(), -1e-3);
    EXPECT_LT(motion.effectUse.largestDifference, 1e-7 * scene.blockSize);
}

// Which points take part in an impact follows from forces, of which those of held blocks are one choice of
// many.
TEST(HeldBlocks, BlocksRestWhileAStoneFliesAndAreSimulatedWhereItHits)
{
    DynamicCase<2> scene = wallWithStone(-0.1);
    scene.contact.restitution = Restitution{0.2};
    DynamicState<2> state = stateAtRest(scene.assembly);
    state.placements.back().translation.y() = 0.05;
    Motion<2> motion = startMotion(scene, state);
    int held = 0;
    int all = 0;
    for (int step = 0; step < 30; ++step)
    {
        const Motion<2> before = motion;
        ASSERT_TRUE(advance(scene, motion, stepOfHeldBlocks)) << step;
        verifyStep(scene, before, stepOfHeldBlocks, motion);
        held += !motion.isAwake.empty() && awakeOf(motion) == 1 ? 1 : 0;
        all += motion.isAwake.empty() ? 1 : 0;
    }
    EXPECT_GE(held, 15);
    EXPECT_GE(all, 1);
    EXPECT_LT(motion.effectUse.largestDifference, 1e-7 * scene.blockSize);
}

TEST(HeldBlocks, NotWithThetaBelowOne)
{
    DynamicCase<2> scene = wallWithStone(0.24);
    EXPECT_EQ(whyAllBlocks(scene, scene.flowRule()), "");
    scene.schemes.timeIntegration.theta = 0.9;
    EXPECT_NE(whyAllBlocks(scene, scene.flowRule()), "");
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < 10; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, stepOfHeldBlocks));
        EXPECT_TRUE(motion.isAwake.empty());
    }
}

// Bonds of blocks that rest, which friction holds too.
TEST(HeldBlocks, BlocksWithBondsRestWhileOthersFall)
{
    DynamicCase<2> scene = wallWithStone(0.24);
    scene.contact.cohesion = JointStrength{100};
    scene.contact.tension = JointStrength{20};
    scene.effects.push_back(std::make_shared<JointBonds<2>>(jointBonds(scene.contact, scene.assembly)));
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    int held = 0;
    for (int step = 0; step < 40; ++step)
    {
        const Motion<2> before = motion;
        ASSERT_TRUE(advance(scene, motion, stepOfHeldBlocks)) << step;
        verifyStep(scene, before, stepOfHeldBlocks, motion);
        held += !motion.isAwake.empty() && awakeOf(motion) > 0 ? 1 : 0;
    }
    EXPECT_GE(held, 20);
    EXPECT_LT(motion.state.placements.back().translation.y(), -0.01);
    EXPECT_LT(motion.effectUse.largestDifference, 1e-7 * scene.blockSize);
}

// The paper's wall 2 breaks into more bodies in each step: what is tried in vain is tried less and less
// often.
TEST(HeldBlocks, AWallThatBreaksTakesHardlyMoreFactorisationsThanWithEverythingOn)
{
    std::vector<long> factorisations;
    for (const EffectSelection selection : {EffectSelection::asGiven, EffectSelection::automatic})
    {
        DynamicCase<2> scene = sceneOf(madeStructure(Dictionary::readFile(
                                           std::string(DRYSTONE_TUTORIALS)
                                           + "/limitAnalysis/masonryPanels/wall2/system/blockTextureDict")),
                                       {.mu = 0.65, .flowRule = FlowRule::associative, .tolerance = 1e-9});
        scene.schemes.effects.selection = selection;
        shake(scene, std::make_shared<ConstantAcceleration>(-6.258769)); // 1.1 times its multiplier
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        long sum = 0;
        for (int step = 0; step < 500; ++step)
        {
            ASSERT_TRUE(advance(scene, motion, 0.002)) << step;
            sum += motion.residuals.factorisations;
        }
        factorisations.push_back(sum);
    }
    EXPECT_LT(factorisations[1], 1.2 * factorisations[0]) << factorisations[0];
}
