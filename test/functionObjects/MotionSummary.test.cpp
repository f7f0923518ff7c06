// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The closing lines of a run, of states with known displacements and velocities.
#include "functionObjects/MotionSummary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace drystone;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

namespace
{

/// Two free blocks of unit size on a fixed one.
DynamicCase<2> stack()
{
    DynamicCase<2> scene;
    Assembly<2> assembly;
    assembly.blocks = {{{{0, -1}, {1, -1}, {1, 0}, {0, 0}}, 1, 0},
                       {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1, -1},
                       {{{0, 1}, {1, 1}, {1, 2}, {0, 2}}, 1, -1}};
    assembly.supports = {{"ground", "ground"}};
    setStructure(scene, std::move(assembly), {2000, 2000, 2000});
    scene.gravity = {0, -9.81};
    return scene;
}

/// The upper block at a place, at a speed.
DynamicState<2> upperAt(const DynamicCase<2>& scene, double time, double x, double speed)
{
    DynamicState<2> state = stateAtRest(scene.assembly);
    state.time = time;
    state.placements[2].translation.x() = x;
    state.velocity[3] = speed;
    return state;
}

std::vector<std::string> linesAfter(const DynamicCase<2>& scene, const std::vector<DynamicState<2>>& states)
{
    MotionSummary<2> summary(scene);
    for (const DynamicState<2>& state : states)
    {
        summary.observe(state);
    }
    return summary.lines(states.back());
}

} // namespace

TEST(MotionSummary, SaysNothingOfARunWithoutSteps)
{
    const DynamicCase<2> scene = stack();
    EXPECT_TRUE(MotionSummary<2>(scene).lines(stateAtRest(scene.assembly)).empty());
}

TEST(MotionSummary, OfBlocksThatNeverMoveSaysThatTheyStandStill)
{
    const DynamicCase<2> scene = stack();
    EXPECT_THAT(linesAfter(scene, {upperAt(scene, 0.5, 0, 0), upperAt(scene, 1, 0, 1e-9)}),
                ElementsAre("Largest displacement: 0 m", StartsWith("The blocks stand still")));
}

TEST(MotionSummary, KeepsTheLargestDisplacementWithItsBlockAndTime)
{
    const DynamicCase<2> scene = stack();
    const auto lines = linesAfter(scene, {upperAt(scene, 0.5, 0.6, 0.2), upperAt(scene, 0.75, 0.25, -0.5)});
    EXPECT_THAT(lines,
                ElementsAre("Largest displacement: 0.6 m, block 2, at 0.5 s",
                            StartsWith("The blocks move at the end, block 2 at 0.5 m/s"),
                            "Farther from their places than half the mean block size of 1 m: 0 of 2 blocks"));
}

TEST(MotionSummary, BlocksThatAreSlowForLongEnoughHaveComeToRest)
{
    const DynamicCase<2> scene = stack();
    // A fall through the block's size takes 0.45 s.
    const auto lines = linesAfter(
        scene, {upperAt(scene, 0.5, 0.6, 0.2), upperAt(scene, 1, 0.7, 0), upperAt(scene, 1.5, 0.7, 1e-9)});
    EXPECT_EQ(lines.at(1), "The blocks have come to rest, at 1 s");
    EXPECT_THAT(lines.at(2), HasSubstr("1 of 2 blocks"));
}

TEST(MotionSummary, ATurningPointIsNoRest)
{
    const DynamicCase<2> scene = stack();
    const auto lines = linesAfter(scene, {upperAt(scene, 0.9, 0.6, 0.2), upperAt(scene, 1, 0.7, 0)});
    EXPECT_THAT(lines.at(1), StartsWith("The blocks are at rest since 1 s, which may be a turning point"));
}

TEST(MotionSummary, SaysHowManyStepsMissCoulombsLaw)
{
    const DynamicCase<2> scene = stack(); // gaps may be off by 1e-7 m
    MotionSummary<2> summary(scene);
    summary.observe(upperAt(scene, 0.5, 0.3, 0.2), {.flowError = 9e-8});
    summary.observe(upperAt(scene, 0.6, 0.4, 0.2), {.flowError = 3e-6});
    const DynamicState<2> last = upperAt(scene, 0.7, 0.5, 0.2);
    summary.observe(last, {.flowError = 2e-7});
    EXPECT_EQ(summary.lines(last).back(),
              "Coulomb's law is satisfied to 3e-06 m of dilatancy in 2 of 3 steps, in "
              "the others to 1e-07 m: shorter steps miss it by less");
}

TEST(MotionSummary, SaysHowManyStepsOverlookContacts)
{
    const DynamicCase<2> scene = stack(); // blocks of 1 m
    MotionSummary<2> summary(scene);
    summary.observe(upperAt(scene, 0.5, 0.3, 0.2), {.overlookedDepth = 9e-5});
    summary.observe(upperAt(scene, 0.6, 0.4, 0.2), {.overlookedDepth = 3e-4});
    const DynamicState<2> last = upperAt(scene, 0.7, 0.5, 0.2);
    summary.observe(last, {.overlookedDepth = 2e-3});
    EXPECT_EQ(
        summary.lines(last).back(),
        "Blocks are in each other by up to 0.002 m at the end of 2 of 3 steps, the first at 0.6 s, where "
        "no contact was foreseen: shorter steps foresee it");
}

TEST(MotionSummary, SaysHowManyStepsAreWithoutRebounds)
{
    const DynamicCase<2> scene = stack(); // blocks of 1 m
    MotionSummary<2> summary(scene);
    summary.observe(upperAt(scene, 0.5, 0.3, 0.2));
    summary.observe(upperAt(scene, 0.6, 0.4, 0.2), {.isWithoutRebounds = true});
    const DynamicState<2> last = upperAt(scene, 0.7, 0.5, 0.2);
    summary.observe(last, {.isWithoutRebounds = true});
    EXPECT_EQ(summary.lines(last).back(),
              "Blocks that hit each other stay together in 2 of 3 steps, the first at 0.6 s, as by theta 1 "
              "without restitution: impacts one after the other had no end within maximumFactorisations");
}

TEST(MotionSummary, SmallDisplacementsThatAreNotSmallAreQuestioned)
{
    DynamicCase<2> scene = stack();
    const auto doubtAfter = [&scene](const DynamicState<2>& state)
    {
        MotionSummary<2> summary(scene);
        summary.observe(state);
        return summary.doubtAboutDisplacements();
    };
    EXPECT_EQ(doubtAfter(upperAt(scene, 0.5, 0.6, 0)), "");
    scene.schemes.smallDisplacements = true;
    EXPECT_EQ(doubtAfter(upperAt(scene, 0.5, 0.04, 0)), "");
    EXPECT_THAT(
        doubtAfter(upperAt(scene, 0.5, 0.6, 0)),
        StartsWith("`smallDisplacements yes;` of system/schemes holds for the structure as built, and "
                   "block 2 has moved by 0.6 m, which is 0.6 of the mean block size"));
    DynamicState<2> turned = upperAt(scene, 0.5, 0.001, 0);
    turned.placements[1].rotation = 0.3;
    EXPECT_THAT(doubtAfter(turned), HasSubstr("block 1 has turned by 0.3 rad"));
}
