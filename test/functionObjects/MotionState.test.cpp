// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Motions in states, and back: what a step begins with is all there.
#include "functionObjects/MotionState.h"

#include "../dynamics/Scenes.h"
#include "core/Error.h"
#include "dynamics/Advance.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace drystone;

namespace
{

/// Two boxes on each other, by Coulomb's law, with the effects that steps call for.
DynamicCase<2> twoBoxes()
{
    Assembly<2> assembly = scenes::ground(-5, 15);
    assembly.blocks.push_back(scenes::rectangle(0, 0, 1, 0.5));
    assembly.blocks.push_back(scenes::rectangle(0, 0.5, 1, 0.5));
    DynamicCase<2> scene = scenes::sceneOf(
        std::move(assembly), {.mu = 0.3, .flowRule = FlowRule::nonAssociative, .tolerance = 1e-9});
    scene.schemes.effects.selection = EffectSelection::automatic;
    return scene;
}

} // namespace

// A step that follows one in which points slide, or collide, is not tried with fewer bodies: else the motion
// of a run that is continued would have other last digits.
TEST(MotionState, SaysWhatTheNextStepNeedNotTry)
{
    constexpr double timeStep = 0.002;
    const DynamicCase<2> scene = twoBoxes();
    DynamicState<2> start = stateAtRest(scene.assembly);
    start.velocity[3] = 1; // the upper one slides
    Motion<2> motion = startMotion(scene, std::move(start));
    for (int step = 0; step < 5; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, timeStep));
    }
    ASSERT_TRUE(motion.slides);
    motion.collisions = 3;
    const Time time(TimeControls{}, TimeState{});
    const State state = stateOf(scene, motion, time);
    Motion<2> continued = motionOf(scene, state);
    EXPECT_TRUE(continued.slides);
    EXPECT_EQ(continued.collisions, 3);
    for (Motion<2>* one : {&motion, &continued})
    {
        ASSERT_TRUE(advance(scene, *one, timeStep));
    }
    EXPECT_EQ(motion.state.velocity, continued.state.velocity);
    EXPECT_EQ(motion.contactForces, continued.contactForces);

    DynamicCase<2> asGiven = scene;
    asGiven.schemes.effects.selection = EffectSelection::asGiven;
    EXPECT_FALSE(stateOf(asGiven, motion, time).scalars.contains("stepSlides"));
}

TEST(MotionState, RefusesCountsThatAreNone)
{
    const DynamicCase<2> scene = twoBoxes();
    const Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    const State state = stateOf(scene, motion, Time(TimeControls{}, TimeState{}));
    ASSERT_NO_THROW(motionOf(scene, state));
    for (const char* name : {"solverIterations", "solverPrograms", "stepCollisions"})
    {
        for (const double value : {1e300, -1.0, 0.5, std::nan("")})
        {
            State damaged = state;
            damaged.scalars[name] = value;
            EXPECT_THROW(motionOf(scene, damaged), FatalIOError) << name << " " << value;
        }
    }
}
