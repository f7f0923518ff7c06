// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Forces at points of blocks in motion: they keep their directions and stay at their points.
#include "Scenes.h"
#include "SpaceScenes.h"

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

/// Angle of a body that a force turns about its mass centre, at a point beside it and across the arm at
/// first: t'' = c cos t, c = force times arm over the moment of inertia. By Runge and Kutta's method.
double angleUnderForce(double c, double end)
{
    const int steps = 10000;
    const double h = end / steps;
    double angle = 0;
    double rate = 0;
    for (int step = 0; step < steps; ++step)
    {
        const double k1 = c * std::cos(angle);
        const double k2 = c * std::cos(angle + h / 2 * rate);
        const double k3 = c * std::cos(angle + h / 2 * rate + h * h / 4 * k1);
        const double k4 = c * std::cos(angle + h * rate + h * h / 2 * k2);
        angle += h * rate + h * h / 6 * (k1 + k2 + k3);
        rate += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return angle;
}

TEST(MotionLoads, AForceTurnsAFreeBlockAboutAPointThatTurnsWithIt)
{
    for (const double theta : {0.5, 1.0})
    {
        DynamicCase<2> scene = scenes::sceneOf({{scenes::rectangle(0, 0, 1, 1)}, {}}, {.theta = theta});
        scene.deadLoad = pointLoad(scene.assembly, 0, {1, 0.5}, {0, 1000});
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        const double timeStep = 1e-3;
        for (int step = 0; step < 1000; ++step)
        {
            ASSERT_TRUE(advance(scene, motion, timeStep));
            ASSERT_LT(scenes::relativeImbalance(motion.energy), 1e-12);
        }
        const double angle = angleUnderForce(500 / scene.mass[2], 1);
        EXPECT_NEAR(motion.state.placements[0].rotation, angle, (theta == 0.5 ? 1e-6 : 1e-3) * angle);
        // Of an integration without dissipation the force has a potential.
        EXPECT_LT(std::abs(motion.energy.algorithmicLoss),
                  (theta == 0.5 ? 1e-6 : 3e-3) * motion.energy.kinetic);
        EXPECT_EQ(motion.energy.externalWork, 0);
    }
}

TEST(MotionLoads, OfSpaceMoveABlockAsThoseOfThePlane)
{
    DynamicCase<3> scene =
        spaceScenes::sceneOf(spaceScenes::freeBox({1, 0.5, 1}), 0.5, 0.6, Vector<3>::Zero());
    scene.deadLoad = pointLoad(scene.assembly, 0, {0.5, 0, 0}, {0, 0, 1000});
    Motion<3> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < 1000; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, 1e-3));
        ASSERT_LT(scenes::relativeImbalance(motion.energy), 1e-12);
    }
    const double angle = angleUnderForce(500 / scene.mass.tail<3>().maxCoeff(), 1);
    EXPECT_NEAR(motion.state.placements[0].rotation.y(), -angle, 1e-6 * angle);
    EXPECT_LT(std::abs(motion.energy.algorithmicLoss), 1e-6 * motion.energy.kinetic);
    EXPECT_EQ(motion.energy.externalWork, 0);
}

/// Whether a block of 0.5 x 2 m, on one corner at a rotation, overturns with as much as its weight at the
/// middle of its top.
bool overturnsUnderRoof(double rotation)
{
    const double width = 0.5;
    const double height = 2;
    Assembly<2> assembly = scenes::ground(-4, 4);
    assembly.blocks.push_back(scenes::rectangle(-width / 2, 0, width, height));
    DynamicCase<2> scene = scenes::sceneOf(assembly, {.theta = 0.5, .mu = 5});
    const Load roof = pointLoad(scene.assembly, 1, {0, height}, {0, scene.deadLoad.rows[1]});
    scene.deadLoad.rows += roof.rows;
    scene.deadLoad.firstMoments = roof.firstMoments;
    DynamicState<2> state = stateAtRest(scene.assembly);
    const Vector<2> arm(width / 2, height / 2);
    state.placements[1] = {Vector<2>(turned(rotation, arm) - arm), rotation};
    Motion<2> motion = startMotion(scene, state);
    for (int step = 0; step < 1000 && motion.state.placements[1].rotation > -0.1; ++step)
    {
        EXPECT_TRUE(advance(scene, motion, 1e-3));
        EXPECT_LT(scenes::relativeImbalance(motion.energy), 1e-10);
        if (motion.state.placements[1].rotation > 1.2 * rotation)
        {
            return true;
        }
    }
    return false;
}

TEST(MotionLoads, ABlockOverturnsWhereItsWeightAndThatOfARoofPassTheCorner)
{
    // Weight W at the mass centre and W at the top: W (b/2 - h/2 tan t) + W (b/2 - h tan t) = 0.
    const double limit = std::atan(2 * 0.5 / (3 * 2.0));
    EXPECT_FALSE(overturnsUnderRoof(0.98 * limit));
    EXPECT_TRUE(overturnsUnderRoof(1.02 * limit));
}

TEST(MotionLoads, StayAsBuiltWithSmallDisplacements)
{
    DynamicCase<2> scene = scenes::sceneOf({{scenes::rectangle(0, 0, 1, 1)}, {}}, {.theta = 0.5});
    scene.schemes.smallDisplacements = true;
    scene.deadLoad.rows = pointLoad(scene.assembly, 0, {1, 0.5}, {0, 1000}).rows;
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < 100; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, 1e-2));
    }
    EXPECT_NEAR(motion.state.placements[0].rotation, 0.5 * 500 / scene.mass[2], 1e-12);
    EXPECT_LT(scenes::relativeImbalance(motion.energy), 1e-12);
}

} // namespace
} // namespace drystone
