// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Steps by Coulomb's law in which nothing slides are taken by the associative law, and those in which
/// something does are not.
#include "dynamics/StickingStep.h"

#include "SpaceScenes.h"
#include "dynamics/Advance.h"
#include "dynamics/VerifiedStep.h"
#include "effects/Restitution.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

using namespace drystone;

namespace
{

/// Square drums on top of each other, on the ground. \param mu friction
DynamicCase<3> columnOfDrums(int drums, double mu)
{
    Assembly<3> assembly;
    assembly.supports.push_back({"ground", "ground"});
    for (int drum = -1; drum < drums; ++drum)
    {
        const double half = drum < 0 ? 3 : 0.2;
        assembly.blocks.push_back(spaceScenes::boxBlock({-half, -half, 0.3 * drum},
                                                        {half, half, 0.3 * drum + 0.3}, drum < 0 ? 0 : -1));
    }
    DynamicCase<3> scene;
    const std::vector<double> densities(assembly.blocks.size(), 2000);
    setStructure(scene, std::move(assembly), densities);
    setGravity<3>(scene, {0, 0, -9.81});
    scene.contact.friction = CoulombFriction{mu, FlowRule::nonAssociative};
    scene.schemes.effects.selection = EffectSelection::automatic;
    return scene;
}

/// Velocities as of a rigid column that begins to turn about the edge of its base at x = 0.2. \param speed
/// of turning [1/s]
Motion<3> turning(const DynamicCase<3>& scene, double speed)
{
    DynamicState<3> state = stateAtRest(scene.assembly);
    for (std::size_t block = 0; block < scene.free.size(); ++block)
    {
        if (const int body = scene.free[block]; body >= 0)
        {
            const Vector<3> arm = scene.blocks[block].centroid - Vector<3>(0.2, 0, 0);
            const Vector<3> turn(0, speed, 0);
            state.velocity.segment<6>(6 * body) << turn.cross(arm), turn;
        }
    }
    return startMotion(scene, std::move(state));
}

/// Takes steps, each with all effects too. \return the largest difference, of the error allowed in gaps
double largestDifference(const DynamicCase<3>& scene, Motion<3>& motion, int steps, double timeStep)
{
    for (int step = 0; step < steps; ++step)
    {
        const Motion<3> before = motion;
        if (!advance(scene, motion, timeStep))
        {
            ADD_FAILURE() << "step " << step << " was not solved";
            break;
        }
        verifyStep(scene, before, timeStep, motion);
    }
    return motion.effectUse.largestDifference / (scene.schemes.contactTolerance * scene.blockSize);
}

TEST(StickingStep, AColumnThatRocksWithoutSlidingIsTakenByTheAssociativeLaw)
{
    const DynamicCase<3> scene = columnOfDrums(6, 0.7);
    Motion<3> motion = turning(scene, 0.2);
    EXPECT_LE(largestDifference(scene, motion, 50, 0.002), 1);
    EXPECT_EQ(motion.effectUse.sticking, 50);
    EXPECT_GT(motion.state.placements.back().translation.norm(), 0.01);
}

TEST(StickingStep, ABoxThatSlidesIsNot)
{
    const DynamicCase<3> scene = columnOfDrums(1, 0.3);
    DynamicState<3> state = stateAtRest(scene.assembly);
    state.velocity[0] = 1;
    DynamicCase<3> asGiven = scene;
    asGiven.schemes.effects.selection = EffectSelection::asGiven;
    Motion<3> motion = startMotion(scene, state);
    Motion<3> given = startMotion(asGiven, state);
    for (int step = 0; step < 50; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, 0.002));
        ASSERT_TRUE(advance(asGiven, given, 0.002));
        EXPECT_TRUE(motion.slides);
    }
    EXPECT_EQ(motion.effectUse.sticking, 0);
    EXPECT_LE(differenceOf(scene, motion.state, given.state), 1e-12);
    // Once it has come to rest it sticks, and a proof takes over.
    for (int step = 0; step < 250; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, 0.002));
    }
    EXPECT_FALSE(motion.slides);
}

TEST(StickingStep, OnlyWhereForcesThatAreNotUniqueDoNotDecide)
{
    DynamicCase<3> scene = columnOfDrums(2, 0.7);
    EXPECT_TRUE(mayStick(scene));
    DynamicCase<3> other = scene;
    other.schemes.effects.selection = EffectSelection::asGiven;
    EXPECT_FALSE(mayStick(other));
    other = scene;
    other.schemes.timeIntegration.theta = 0.5;
    EXPECT_FALSE(mayStick(other));
    other = scene;
    other.contact.restitution = Restitution{0.3};
    EXPECT_FALSE(mayStick(other));
    other = scene;
    other.contact.friction = CoulombFriction{0.7, FlowRule::associative};
    EXPECT_FALSE(mayStick(other));
}

} // namespace
