// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Supports that move, and blocks that leave a box.
#include "../dynamics/Scenes.h"

#include "effects/Deletion.h"
#include "effects/SupportMotion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

using namespace drystone;
using namespace drystone::scenes;

namespace
{

/// The ground moves with velocities between points in time. \param points times [s] and velocities [m/s]
SupportMotion<2> motionOf(const Vector<2>& direction, const std::vector<std::pair<double, double>>& points)
{
    std::vector<double> times;
    std::vector<double> velocities;
    for (const auto& [time, velocity] : points)
    {
        times.push_back(time);
        velocities.push_back(velocity);
    }
    return {0, direction, tabulatedAcceleration(times, velocities, Interpolation::linear, OutOfBounds::zero)};
}

/// Likewise turning about a centre, with angular velocities.
SupportMotion<2> turningAbout(const Vector<2>& centre, const std::vector<std::pair<double, double>>& points)
{
    SupportMotion<2> motion = motionOf({1, 0}, points);
    motion.angularVelocity = motion.velocity;
    motion.velocity.reset();
    motion.centre = centre;
    return motion;
}

DynamicCase<2> blockOnGround(const Settings& settings, double width = 1, double height = 0.4)
{
    Assembly<2> assembly = ground(-20, 20);
    assembly.blocks.push_back(rectangle(-width / 2, 0, width, height));
    return sceneOf(std::move(assembly), settings);
}

void runUntil(const DynamicCase<2>& scene, Motion<2>& motion, double timeStep, double until)
{
    while (motion.state.time < until - timeStep / 2)
    {
        ASSERT_TRUE(advance(scene, motion, timeStep)) << motion.state.time;
        ASSERT_LT(relativeImbalance(motion.energy), 1e-10) << motion.state.time;
    }
}

} // namespace

TEST(SupportMotion, CarriesABlockAsAGroundThatAcceleratesLeavesItBehind)
{
    // Newmark's pulse of 0.5 g over 0.5 s, mu 0.2; seen from the ground, and from outside. The trapezoidal
    // rule takes both alike to the last digits.
    for (const bool small : {true, false})
    {
        DynamicCase<2> relative = blockOnGround({.theta = 0.5, .mu = 0.2});
        relative.schemes.smallDisplacements = small;
        DynamicCase<2> absolute = relative;
        shake(relative, std::make_shared<RectangularPulse>(PulseShape{0.5 * g, 0.5, 0}));
        absolute.effects = {std::make_shared<MovingSupports<2>>(
            std::vector{motionOf({1, 0}, {{0, 0}, {0.5, 0.25 * g}, {10, 0.25 * g}})})};
        Motion<2> fromTheGround = startMotion(relative, stateAtRest(relative.assembly));
        Motion<2> fromOutside = startMotion(absolute, stateAtRest(absolute.assembly));
        for (int step = 0; step < 1500; ++step)
        {
            ASSERT_TRUE(advance(relative, fromTheGround, 1e-3));
            ASSERT_TRUE(advance(absolute, fromOutside, 1e-3));
            const auto& outside = fromOutside.state.placements;
            ASSERT_NEAR(outside[1].translation.x() - outside[0].translation.x(),
                        fromTheGround.state.placements[1].translation.x(), 1e-9)
                << step;
            ASSERT_LT(relativeImbalance(fromOutside.energy), 1e-10);
        }
        const auto& outside = fromOutside.state.placements;
        EXPECT_NEAR(outside[0].translation.x(), 0.0625 * g + 0.25 * g, 1e-9);
        EXPECT_NEAR(outside[1].translation.x() - outside[0].translation.x(), -0.9196875, 1e-3);
        EXPECT_LT(std::abs(outside[1].translation.y()), 1e-9);
        // In the end the block goes along: the ground has given it its kinetic energy and what was lost.
        const double mass = absolute.mass[0];
        EXPECT_NEAR(fromOutside.energy.kinetic, 0.5 * mass * std::pow(0.25 * g, 2), 1e-3 * mass);
        EXPECT_GT(fromOutside.energy.externalWork, fromOutside.energy.kinetic);
        EXPECT_NEAR(fromOutside.energy.frictionLoss, 0.2 * mass * g * 0.9196875, 5e-3 * mass * g);
    }
}

TEST(SupportMotion, MakesABlockRockAsTheGroundDoes)
{
    for (const double theta : {1.0, 0.5})
    {
        DynamicCase<2> relative = blockOnGround({.theta = theta, .mu = 5}, 0.5, 2);
        DynamicCase<2> absolute = relative;
        shake(relative, std::make_shared<RectangularPulse>(PulseShape{0.32 * g, 0.5, 0}));
        absolute.effects = {std::make_shared<MovingSupports<2>>(
            std::vector{motionOf({1, 0}, {{0, 0}, {0.5, 0.16 * g}, {10, 0.16 * g}})})};
        Motion<2> fromTheGround = startMotion(relative, stateAtRest(relative.assembly));
        Motion<2> fromOutside = startMotion(absolute, stateAtRest(absolute.assembly));
        double largest = 0;
        double difference = 0;
        for (int step = 0; step < 3000; ++step)
        {
            ASSERT_TRUE(advance(relative, fromTheGround, 1e-3));
            ASSERT_TRUE(advance(absolute, fromOutside, 1e-3));
            ASSERT_LT(relativeImbalance(fromOutside.energy), 1e-9);
            const double rotation = fromTheGround.state.placements[1].rotation;
            largest = std::max(largest, std::abs(rotation));
            difference = std::max(difference, std::abs(rotation - fromOutside.state.placements[1].rotation));
        }
        EXPECT_GT(largest, 0.1);
        EXPECT_LT(difference, 0.02 * largest) << "theta " << theta;
    }
}

TEST(SupportMotion, ThatStartsAllAtOncePushesABlockAsAPlasticImpactDoes)
{
    // 1 m/s upwards: the impulse m v works m v^2, half of which becomes kinetic energy.
    for (const double theta : {1.0, 0.5})
    {
        DynamicCase<2> scene = blockOnGround({.theta = theta});
        scene.effects = {
            std::make_shared<MovingSupports<2>>(std::vector{motionOf({0, 1}, {{0, 1}, {10, 1}})})};
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        ASSERT_NO_FATAL_FAILURE(runUntil(scene, motion, 1e-2, 0.5));
        const double mass = scene.mass[0];
        EXPECT_NEAR(motion.state.velocity[1], 1, 1e-9);
        EXPECT_NEAR(motion.state.placements[1].translation.y(), 0.5, 1e-9);
        EXPECT_NEAR(motion.energy.externalWork, mass + mass * g * 0.5, 1e-8 * mass);
        EXPECT_NEAR(motion.energy.potential, mass * g * 0.5, 1e-8 * mass);
        EXPECT_NEAR(motion.energy.kinetic, 0.5 * mass, 1e-9 * mass);
    }
}

TEST(SupportMotion, ThatSettlesTakesABlockAlongAsLongAsItFallsSlowerThanTheBlock)
{
    DynamicCase<2> scene = blockOnGround({});
    scene.effects = {std::make_shared<MovingSupports<2>>(
        std::vector{motionOf({0, -1}, {{0, 0}, {0.5, 0.25 * g}, {1, 0}})})}; // g/2 down, then g/2 up
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    const double weight = scene.mass[0] * g;
    const auto force = [&motion] { return motion.contactForces[0].x() + motion.contactForces[1].x(); };
    // Backward Euler starts with half a step's velocity too little.
    ASSERT_NO_FATAL_FAILURE(runUntil(scene, motion, 1e-3, 0.4));
    EXPECT_NEAR(force(), 0.5 * weight, 1e-6 * weight);
    ASSERT_NO_FATAL_FAILURE(runUntil(scene, motion, 1e-3, 0.9));
    EXPECT_NEAR(force(), 1.5 * weight, 1e-6 * weight);
    ASSERT_NO_FATAL_FAILURE(runUntil(scene, motion, 1e-3, 1.5));
    EXPECT_NEAR(force(), weight, 1e-6 * weight);
    EXPECT_NEAR(motion.state.placements[1].translation.y(), -0.125 * g, 1e-9);
    EXPECT_EQ(motion.state.placements[0].translation.x(), 0);
    EXPECT_LT(motion.state.velocity.norm(), 1e-9);
}

TEST(SupportMotion, OfNoSupportIsNone)
{
    DynamicCase<2> scene = blockOnGround({});
    const auto& placements = stateAtRest(scene.assembly).placements;
    EXPECT_TRUE(supportSteps(scene.effects, scene, placements, 0, 1).empty());
    EXPECT_EQ(supportVelocities(scene.effects, scene, placements, 0, 1),
              std::vector<BlockVector<2>>(2, BlockVector<2>::Zero()));
    scene.effects = {std::make_shared<MovingSupports<2>>(std::vector{motionOf({0, 1}, {{1, 2}, {2, 2}})})};
    const auto steps = supportSteps(scene.effects, scene, placements, 0, 1.5);
    ASSERT_EQ(steps.size(), 2u);
    EXPECT_EQ(displacementAfter(steps[1]), (BlockVector<2>::Zero()));
    EXPECT_NEAR(displacementAfter(steps[0]).y(), 1, 1e-15);
    EXPECT_EQ(displacementAfter(steps[0])[2], 0);
}

TEST(SupportMotion, TurnsABlockAboutTheCentre)
{
    // A quarter turn about (1, 0) in 2 s, in ten parts: the mass centre (0, -0.5) comes to (1.5, -1).
    const DynamicCase<2> scene = sceneOf(ground(-1, 1), {});
    std::vector<Placement<2>> placements = stateAtRest(scene.assembly).placements;
    const double spin = std::numbers::pi / 4;
    const MovingSupports<2> turning({turningAbout({1, 0}, {{0, spin}, {2, spin}})});
    for (int part = 0; part < 10; ++part)
    {
        const auto steps = turning.supportSteps(scene, placements, 0.2 * part, 0.2 * (part + 1));
        const Vector<3> displacement = displacementAfter(steps[0]);
        placements[0].translation += displacement.head<2>();
        placements[0].rotation += displacement[2];
    }
    EXPECT_NEAR(placements[0].rotation, std::numbers::pi / 2, 1e-14);
    EXPECT_NEAR((placements[0].translation - Vector<2>(1.5, -0.5)).norm(), 0, 1e-14);
    const auto velocities = turning.supportVelocities(scene, placements, 1, 1);
    // The arm from (1, 0) is now (0.5, -1).
    EXPECT_NEAR((velocities[0] - Vector<3>(spin, 0.5 * spin, spin)).norm(), 0, 1e-14);
}

TEST(SupportMotion, ABlockOnATableThatTiltsIsLiftedAndSlipsAtTheAngleOfFriction)
{
    // mu 0.2: atan 0.2 = 0.1974 rad, at 0.1 rad/s after 1.974 s.
    for (const bool small : {false, true})
    {
        DynamicCase<2> scene = blockOnGround({.mu = 0.2, .tolerance = 1e-10});
        scene.schemes.smallDisplacements = small;
        scene.effects = {std::make_shared<MovingSupports<2>>(
            std::vector{turningAbout({0, 0}, {{0, 0}, {0.1, 0.1}, {10, 0.1}})})}; // 0.005 rad less
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        const auto slip = [&]
        {
            // In the frame of the table the mass centre was built at (0, 0.2).
            const Placement<2>& block = motion.state.placements[1];
            const double angle = motion.state.placements[0].rotation;
            const Vector<2> centre = Vector<2>(0, 0.2) + block.translation;
            return std::cos(angle) * centre.x() + std::sin(angle) * centre.y();
        };
        const auto runUntil = [&](double until)
        {
            while (motion.state.time < until - 1e-3)
            {
                ASSERT_TRUE(advance(scene, motion, 5e-3)) << motion.state.time;
            }
        };
        if (small) // loads and lever arms as built: it only turns along
        {
            ASSERT_NO_FATAL_FAILURE(runUntil(0.2));
            EXPECT_NEAR(motion.state.placements[1].rotation, 0.015, 1e-6);
            continue;
        }
        ASSERT_NO_FATAL_FAILURE(runUntil(1.99)); // 0.194 rad
        EXPECT_NEAR(motion.state.placements[0].rotation, 0.194, 1e-12);
        EXPECT_NEAR(motion.state.placements[1].rotation, 0.194, 1e-6);
        EXPECT_LT(std::abs(slip()), 1e-4);
        const double lifted = scene.mass[0] * g * motion.state.placements[1].translation.y();
        EXPECT_NEAR(motion.energy.potential, lifted, 1e-9);
        EXPECT_NEAR(motion.energy.externalWork, lifted, 1e-3 * std::abs(lifted) + 0.05 * scene.mass[0]);
        EXPECT_LT(relativeImbalance(motion.energy), 1e-8);
        ASSERT_NO_FATAL_FAILURE(runUntil(3)); // 0.295 rad: s'' = g (sin - mu cos), sideways
        EXPECT_LT(slip(), -0.05);
    }
}

namespace
{

/// A block slides at 3 m/s over the edge of the ground at x = 1; another one rests.
DynamicCase<2> blockOverTheEdge()
{
    Assembly<2> assembly = ground(-5, 1);
    assembly.blocks.push_back(rectangle(0, 0, 0.4, 0.4));
    assembly.blocks.push_back(rectangle(-3, 0, 1, 1));
    return sceneOf(std::move(assembly), {.mu = 0.1});
}

DynamicState<2> slidingOff(const DynamicCase<2>& scene)
{
    DynamicState<2> state = stateAtRest(scene.assembly);
    state.velocity[0] = 3;
    return state;
}

} // namespace

TEST(Deletion, ABlockThatLeavesTheBoxStopsThereAndTakesItsEnergyWithIt)
{
    const DynamicCase<2> followed = blockOverTheEdge();
    DynamicCase<2> scene = followed;
    scene.effects = {std::make_shared<BlockDeletion<2>>(Deletion<2>{{{-10, -1}, {10, 10}}})};
    Motion<2> motion = startMotion(scene, slidingOff(scene));
    Motion<2> reference = startMotion(followed, slidingOff(followed));
    double kineticThere = 0;
    double workBefore = 0;
    int step = 0;
    for (; step < 2000 && !motion.effectStates[0].flags[1]; ++step)
    {
        workBefore = motion.energy.externalWork;
        ASSERT_TRUE(advance(scene, motion, 1e-3));
        ASSERT_TRUE(advance(followed, reference, 1e-3));
        ASSERT_LT(relativeImbalance(motion.energy), 1e-10);
        kineticThere = 0.5 * followed.mass.dot(reference.state.velocity.cwiseAbs2());
    }
    ASSERT_TRUE(motion.effectStates[0].flags[1]);
    EXPECT_FALSE(motion.effectStates[0].flags[2]);
    // Until it is out, nothing is different.
    EXPECT_EQ(motion.state.placements[1].translation, reference.state.placements[1].translation);
    EXPECT_LT(scene.blocks[1].centroid.y() + motion.state.placements[1].translation.y(), -1);
    EXPECT_NEAR(motion.energy.externalWork - workBefore, -kineticThere, 1e-9 * kineticThere);
    EXPECT_LT(motion.energy.kinetic, 1e-20);
    const Placement<2> last = motion.state.placements[1];
    for (int more = 0; more < 100; ++more)
    {
        ASSERT_TRUE(advance(scene, motion, 1e-3));
    }
    EXPECT_EQ(motion.state.placements[1].translation, last.translation);
    EXPECT_EQ(motion.state.placements[1].rotation, last.rotation);
    EXPECT_LT(relativeImbalance(motion.energy), 1e-10);
    EXPECT_EQ(motion.points.size(), 2u); // of the other block
    // A run that starts from this state knows which block is out.
    const Motion<2> again = startMotion(scene, motion.state);
    EXPECT_EQ(again.effectStates[0].flags, motion.effectStates[0].flags);
}

TEST(Deletion, WhatStandsOnABlockThatIsDeletedFalls)
{
    // A tray with a load slides to the right; its centre leaves the box, that of the load has not yet.
    Assembly<2> assembly = ground(-5, 5);
    assembly.blocks.push_back(rectangle(0, 0, 1, 0.4));
    assembly.blocks.push_back(rectangle(0.1, 0.4, 0.5, 0.2));
    DynamicCase<2> scene = sceneOf(std::move(assembly), {.mu = 0.1});
    scene.effects = {std::make_shared<BlockDeletion<2>>(Deletion<2>{{{-1, -10}, {0.6, 10}}})};
    DynamicState<2> state = stateAtRest(scene.assembly);
    state.velocity[0] = state.velocity[3] = 1;
    Motion<2> motion = startMotion(scene, state);
    int step = 0;
    for (; step < 500 && !motion.effectStates[0].flags[1]; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, 1e-3));
    }
    ASSERT_TRUE(motion.effectStates[0].flags[1]);
    ASSERT_FALSE(motion.effectStates[0].flags[2]);
    const double height = motion.state.placements[2].translation.y();
    for (int more = 0; more < 100; ++more)
    {
        ASSERT_TRUE(advance(scene, motion, 1e-3));
    }
    EXPECT_NEAR(motion.state.placements[2].translation.y() - height, -0.5 * g * 1e-6 * 100 * 101, 1e-9);
    EXPECT_LT(relativeImbalance(motion.energy), 1e-10);
}

TEST(Deletion, ABlockOutsideFromTheStartIsNotComputed)
{
    DynamicCase<2> scene = blockOverTheEdge();
    scene.effects = {std::make_shared<BlockDeletion<2>>(Deletion<2>{{{-10, -1}, {0, 10}}})};
    Motion<2> motion = startMotion(scene, slidingOff(scene));
    EXPECT_EQ(motion.energy.opening, 0);
    ASSERT_NO_FATAL_FAILURE(runUntil(scene, motion, 1e-2, 1));
    EXPECT_EQ(motion.state.placements[1].translation.x(), 0);
    EXPECT_EQ(motion.state.velocity.norm(), 0);
}

TEST(SupportMotion, WhatHasNoEffectDegreesAndMillimetresAreQuestioned)
{
    const Assembly<2> assembly = ground(-1, 1);
    const auto warnings = [&](const std::string& motion)
    {
        testing::internal::CaptureStderr();
        readSupportMotions(Dictionary::readString("ground { " + motion + " }", "constant/supportMotion"),
                           assembly);
        return testing::internal::GetCapturedStderr();
    };
    using testing::AllOf;
    using testing::HasSubstr;
    EXPECT_EQ(warnings("direction (1 0); velocity ((0 0) (1 1));"), "");
    EXPECT_EQ(warnings("centre (1 0); rotation ((0 0) (1 3));"), "");
    EXPECT_THAT(warnings("rotation ((0 0) (1 90));"),
                AllOf(HasSubstr("`(time 1.57079633)`"), HasSubstr("constant/supportMotion/ground/rotation")));
    EXPECT_THAT(warnings("direction (1 0); rotation ((0 0) (1 1));"),
                HasSubstr("direction has no effect without displacement or velocity"));
    EXPECT_THAT(warnings("direction (1 0); velocity ((0 0) (1 1)); centre (1 0);"),
                HasSubstr("centre has no effect without rotation or angularVelocity"));
    // The ground is 2 m wide and 1 m deep.
    EXPECT_EQ(warnings("direction (0 -1); displacement ((0 0) (1 2.2));"), "");
    EXPECT_THAT(warnings("direction (0 -1); displacement ((0 0) (1 20) (2 0));"),
                AllOf(HasSubstr("The support moves 20 m away, farther than the whole structure of 2.236 m"),
                      HasSubstr("in millimetres, it would be 0.02 m"),
                      HasSubstr("constant/supportMotion/ground/displacement")));
    EXPECT_THAT(warnings("direction (1 0); velocity ((0 0) (0.5 -50) (0.5 50) (1 0));"),
                AllOf(HasSubstr("The support moves 12.5 m away"), HasSubstr("Velocities are in m/s"),
                      HasSubstr("constant/supportMotion/ground/velocity")));
    EXPECT_EQ(warnings("direction (1 0); velocity ((0 0) (0.01 50) (0.02 -50) (0.03 0));"), "");
}

TEST(Deletion, TheLogSaysWhichBlocksLeave)
{
    const BlockDeletion<2> deletion(Deletion<2>{{{-1, -1}, {1, 1}}});
    EffectState before, after;
    before.flags = {false, true, false, false};
    after.flags = {true, true, false, true};
    EXPECT_EQ(deletion.stepText(before, after),
              "Deletion: blocks 0 3 left the box, 3 are out and computed no further");
    EXPECT_EQ(deletion.stepText(after, after), "");
    before.flags[0] = true;
    EXPECT_EQ(deletion.stepText(before, after),
              "Deletion: block 3 left the box, 3 are out and computed no further");
}
