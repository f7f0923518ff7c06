// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Supports of space that move: what stands on them moves as in the plane, and about any axis.
#include "ExtrudedScenes.h"
#include "Scenes.h"
#include "SpaceScenes.h"

#include "effects/JointBonds.h"
#include "effects/SupportMotion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace drystone;

namespace
{

using Points = std::vector<std::pair<double, double>>;

std::shared_ptr<const GroundAcceleration> history(const Points& points)
{
    std::vector<double> times, values;
    for (const auto& [time, value] : points)
    {
        times.push_back(time);
        values.push_back(value);
    }
    return tabulatedAcceleration(times, values, Interpolation::linear, OutOfBounds::zero);
}

template<int Dim>
void move(DynamicCase<Dim>& scene, const Vector<Dim>& direction, const Points& velocity,
          const Vector<Dim>& centre, const Turn<Dim>& axis, const Points& angularVelocity)
{
    SupportMotion<Dim> motion;
    motion.support = 0;
    motion.direction = direction;
    motion.velocity = history(velocity);
    motion.centre = centre;
    motion.axis = axis;
    motion.angularVelocity = history(angularVelocity);
    scene.effects.push_back(std::make_shared<MovingSupports<Dim>>(std::vector{motion}));
}

} // namespace

// Two bricks on a table that is pushed and tilted: they slide, and the upper one falls.
TEST(SpaceSupports, BricksOnATableThatMovesMoveAsInThePlane)
{
    Assembly<2> assembly = scenes::ground(-0.5, 0.5, 0.2);
    assembly.blocks.push_back(scenes::rectangle(-0.2, 0, 0.4, 0.2));
    assembly.blocks.push_back(scenes::rectangle(-0.1, 0.2, 0.3, 0.2));
    const Points velocity{{0, 0}, {0.1, 1}, {0.3, 1}, {0.4, 0}};
    const Points spin{{0.4, 0}, {0.6, 1.5}, {0.8, 0}};
    for (const double theta : {1.0, 0.5})
    {
        DynamicCase<2> flat = scenes::sceneOf(assembly, {.theta = theta, .mu = 0.4, .tolerance = 1e-10});
        DynamicCase<3> solid = spaceScenes::sceneOf(extruded(assembly), theta, 0.4, {0, 0, -g});
        move<2>(flat, {1, 0}, velocity, {0.1, -0.1}, 1, spin);
        move<3>(solid, {1, 0, 0}, velocity, {0.1, 0.3, -0.1}, {0, -1, 0}, spin);
        Motion<2> inPlane = startMotion(flat, stateAtRest(flat.assembly));
        Motion<3> inSpace = startMotion(solid, stateAtRest(solid.assembly));
        double worst = 0;
        for (int step = 1; step <= 1200; ++step)
        {
            ASSERT_TRUE(advance(flat, inPlane, 1e-3)) << step;
            ASSERT_TRUE(advance(solid, inSpace, 1e-3)) << step;
            worst = std::max(worst, apart(inPlane.state, inSpace.state));
        }
        EXPECT_LE(worst, 2e-4) << "theta " << theta;
        EXPECT_LE(scenes::relativeImbalance(inSpace.energy), 1e-9) << "theta " << theta;
        EXPECT_GT(std::abs(inPlane.state.placements[2].rotation), 0.1);
    }
}

// On a table that starts at once they slide until they have its velocity, which changes slowly from then on.
// With theta 1/2 what was left of theirs in the step in which they stop turned round in each step after it.
TEST(SpaceSupports, BricksThatHaveStoppedSlidingMoveWithTheTable)
{
    Assembly<2> assembly = scenes::ground(-0.5, 0.5, 0.2);
    assembly.blocks.push_back(scenes::rectangle(-0.2, 0, 0.4, 0.2));
    assembly.blocks.push_back(scenes::rectangle(-0.1, 0.2, 0.3, 0.2));
    constexpr double timeStep = 1e-3;
    const Points velocity{{0, 0}, {0.0103, 0}, {0.0103, 0.5}, {0.4, 0.5}, {0.6, 0.7}, {1, 0.7}};
    for (const double theta : {0.5, 0.7})
    {
        DynamicCase<2> flat = scenes::sceneOf(assembly, {.theta = theta, .mu = 0.4, .tolerance = 1e-10});
        DynamicCase<3> solid = spaceScenes::sceneOf(extruded(assembly), theta, 0.4, {0, 0, -g});
        move<2>(flat, {1, 0}, velocity, {0, 0}, 1, {{0, 0}, {1, 0}});
        move<3>(solid, {1, 0, 0}, velocity, {0, 0, 0}, {0, -1, 0}, {{0, 0}, {1, 0}});
        Motion<2> inPlane = startMotion(flat, stateAtRest(flat.assembly));
        Motion<3> inSpace = startMotion(solid, stateAtRest(solid.assembly));
        for (int step = 1; step <= 800; ++step)
        {
            const double lost = inPlane.energy.algorithmicLoss;
            const double lostInSpace = inSpace.energy.algorithmicLoss;
            ASSERT_TRUE(advance(flat, inPlane, timeStep)) << step;
            ASSERT_TRUE(advance(solid, inSpace, timeStep)) << step;
            // Bricks that the table takes along at once lose what they slid by, and the table works on them.
            EXPECT_GE(inPlane.energy.algorithmicLoss - lost, -1e-9 * inPlane.energy.kinetic) << step;
            EXPECT_GE(inSpace.energy.algorithmicLoss - lostInSpace, -1e-9 * inSpace.energy.kinetic) << step;
            const double now = step * timeStep;
            // While the table is accelerated they are behind it, as any steady motion by the theta method.
            const double change = now > 0.4 + timeStep / 2 && now < 0.6 + timeStep / 2 ? timeStep : 0;
            const double ofTable = std::clamp(0.5 + (now - 0.4), 0.5, 0.7) - (theta - 0.5) * change;
            for (int block = 0; block < 2 && now > 0.3; ++block)
            {
                EXPECT_NEAR(inPlane.state.velocity[3 * block], ofTable, 1e-6) << theta << " at " << now;
                EXPECT_NEAR(inSpace.state.velocity[6 * block], ofTable, 1e-6) << theta << " at " << now;
            }
        }
        EXPECT_LE(scenes::relativeImbalance(inPlane.energy), 1e-9) << theta;
        EXPECT_LE(scenes::relativeImbalance(inSpace.energy), 1e-9) << theta;
    }
}

// Walls of a support that turns come nearer to each other by the chords of their ways: flush between them a
// block had no room, in impacts with theta below 1 and in steps without friction. About an axis across.
TEST(SpaceSupports, ABlockFlushBetweenWallsThatTurnTurnsWithThem)
{
    using spaceScenes::boxBlock;
    for (const double mu : {0.0, 0.3})
    {
        for (const double theta : {0.5, 1.0})
        {
            Assembly<3> assembly;
            assembly.supports.push_back({"socket", "socket"});
            assembly.blocks = {boxBlock({-0.5, -0.5, -0.2}, {0.5, 0.5, 0}, 0),
                               boxBlock({-0.5, -0.5, 0}, {-0.2, 0.5, 0.3}, 0),
                               boxBlock({0.2, -0.5, 0}, {0.5, 0.5, 0.3}, 0),
                               boxBlock({-0.2, -0.5, 0}, {0.2, -0.2, 0.3}, 0),
                               boxBlock({-0.2, 0.2, 0}, {0.2, 0.5, 0.3}, 0),
                               boxBlock({-0.2, -0.2, 0}, {0.2, 0.2, 0.5})};
            DynamicCase<3> scene = spaceScenes::sceneOf(assembly, theta, mu, {0, 0, -g});
            scene.solution.tolerance = 1e-9;
            const Vector<3> axis = Vector<3>(1, 2, 3).normalized();
            const Vector<3> centre(1, 0.3, 0);
            move<3>(scene, {1, 0, 0}, {{0, 0}, {1, 0}}, centre, axis, {{0, 0.5}, {1, 0.5}});
            Motion<3> motion = startMotion(scene, stateAtRest(scene.assembly));
            for (int step = 0; step < 200; ++step)
            {
                ASSERT_TRUE(advanceOrShorten(scene, motion, 2e-3).isSolved)
                    << mu << " " << theta << " " << step;
            }
            const Vector<3> turn = 0.5 * motion.state.time * axis;
            const Vector<3> arm = Vector<3>(0, 0, 0.25) - centre;
            const Placement<3>& block = motion.state.placements[5];
            EXPECT_LE((block.translation - swing(turn, arm)).norm(), 1e-6) << mu << " " << theta;
            EXPECT_LE((block.rotation - turn).norm(), 1e-6) << mu << " " << theta;
        }
    }
}

// One that stands on a table rocks if the table is accelerated by more than b/h g, however it began to move.
TEST(SpaceSupports, ABlockOnATableThatIsAcceleratedRocksAboveItsSlenderness)
{
    Assembly<2> assembly = scenes::ground(-0.5, 1, 0.2);
    assembly.blocks.push_back(scenes::rectangle(0, 0, 0.3, 1));
    constexpr double timeStep = 2e-3;
    for (const double theta : {0.5, 0.6, 0.7, 0.9, 0.99, 1.0})
    {
        for (const double share : {0.95, 1.05})
        {
            const double acceleration = share * 0.3 * g;
            const Points velocity{{0, 0}, {0.05, 0.01}, {0.1, 0.01}, {0.3, 0.01 + 0.2 * acceleration}};
            DynamicCase<2> flat = scenes::sceneOf(assembly, {.theta = theta, .mu = 0.6, .tolerance = 1e-10});
            DynamicCase<3> solid = spaceScenes::sceneOf(extruded(assembly), theta, 0.6, {0, 0, -g});
            move<2>(flat, {1, 0}, velocity, {0, 0}, 1, {{0, 0}, {1, 0}});
            move<3>(solid, {1, 0, 0}, velocity, {0, 0, 0}, {0, -1, 0}, {{0, 0}, {1, 0}});
            Motion<2> inPlane = startMotion(flat, stateAtRest(flat.assembly));
            Motion<3> inSpace = startMotion(solid, stateAtRest(solid.assembly));
            for (int step = 1; step <= 150; ++step)
            {
                ASSERT_TRUE(advance(flat, inPlane, timeStep)) << step;
                ASSERT_TRUE(advance(solid, inSpace, timeStep)) << step;
            }
            // About the edge, by the moment beyond that of the weight, which grows with the turn.
            const double inertia = 4.0 / 3 * (0.15 * 0.15 + 0.5 * 0.5);
            const double rate = std::sqrt((0.5 * g + 0.15 * acceleration) / inertia);
            const double turn =
                share > 1 ? (share - 1) * 0.15 * g / inertia * (std::cosh(0.2 * rate) - 1) / (rate * rate)
                          : 0;
            EXPECT_NEAR(inPlane.state.placements.back().rotation, turn, 0.02 * turn + 1e-9) << theta;
            EXPECT_NEAR(inSpace.state.placements.back().rotation.norm(), turn, 0.02 * turn + 1e-9) << theta;
            EXPECT_LE(scenes::relativeImbalance(inPlane.energy), 1e-9) << theta;
            EXPECT_LE(scenes::relativeImbalance(inSpace.energy), 1e-9) << theta;
        }
    }
}

// About the vertical, so slowly that friction takes a block along.
TEST(SpaceSupports, ABlockTurnsWithATurntable)
{
    DynamicCase<3> scene =
        spaceScenes::sceneOf(spaceScenes::boxOnGround({0.3, 0.2, 0.2}, 0.2), 1, 0.6, {0, 0, -g});
    move<3>(scene, {1, 0, 0}, {{0, 0}, {1, 0}}, {0.5, 0.3, 0}, {0, 0, 1}, {{0, 0}, {0.5, 0.8}, {1, 0}});
    Motion<3> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < 1200; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, 1e-3)) << step;
    }
    const Placement<3>& placement = motion.state.placements[1];
    EXPECT_LE((placement.rotation - Vector<3>(0, 0, 0.4)).norm(), 1e-6);
    const Vector<3> arm(-0.5, -0.3, 0);
    EXPECT_LE((placement.translation - swing(Vector<3>(0, 0, 0.4), arm)).norm(), 1e-6);
    EXPECT_LE(motion.state.velocity.norm(), 1e-9);
}

// With theta below 1 closings at the rounding of fast velocities made each step begin with an impact, to
// which bonds are no strength: a plate that they hold on a table came loose at half of what they can.
TEST(SpaceSupports, ABondedPlateStaysOnATableThatTurnsFasterAndFaster)
{
    for (const FlowRule flowRule : {FlowRule::associative, FlowRule::nonAssociative})
    {
        for (const double theta : {0.5, 0.6, 1.0})
        {
            Assembly<3> assembly;
            assembly.supports.push_back({"table", "table"});
            assembly.blocks = {spaceScenes::boxBlock({-1, -1, -0.2}, {1, 1, 0}, 0),
                               spaceScenes::boxBlock({0, 0, 0}, {0.4, 0.3, 0.05})};
            DynamicCase<3> scene = spaceScenes::sceneOf(assembly, theta, 0.5, {0, 0, -g}, flowRule);
            scene.contact.cohesion = JointStrength{1000};
            scene.contact.tension = JointStrength{2000};
            scene.effects.push_back(
                std::make_shared<JointBonds<3>>(jointBonds(scene.contact, scene.assembly)));
            // 100 rad/s2: the bonds and friction hold up to r (c A + mu m g)/J = 179 rad/s2.
            move<3>(scene, {1, 0, 0}, {{0, 0}, {1, 0}}, {0.2, 0.15, 0}, {0, 0, 1}, {{0, 0}, {1, 100}});
            Motion<3> motion = startMotion(scene, stateAtRest(scene.assembly));
            for (int step = 0; step < 700; ++step)
            {
                ASSERT_TRUE(advance(scene, motion, 1e-3)) << step;
            }
            const Placement<3>& plate = motion.state.placements[1];
            const Placement<3>& table = motion.state.placements[0];
            // By Coulomb's law forces of theta 1 slip by what points give way.
            EXPECT_LE(turnBetween(table.rotation, plate.rotation).norm(), 1e-5) << "theta " << theta;
            EXPECT_LE(plate.translation.norm(), 1e-6) << "theta " << theta;
        }
    }
}

// By the associative law, which makes bonds rigid, what the first linearisation leaves of gaps stressed four
// points of a joint against each other up to their strength: bonds that bear a hundredth of it broke.
TEST(SpaceSupports, ABondedStackStaysOnATableThatIsTurnedOver)
{
    for (const double theta : {0.5, 0.9, 1.0})
    {
        for (const double timeStep : {0.01, 0.0025})
        {
            Assembly<3> assembly;
            assembly.supports.push_back({"table", "table"});
            assembly.blocks = {spaceScenes::boxBlock({-1, -1, -0.3}, {1, 1, 0}, 0),
                               spaceScenes::boxBlock({0.2, 0.3, 0}, {0.6, 0.6, 0.2}),
                               spaceScenes::boxBlock({0.25, 0.35, 0.2}, {0.55, 0.55, 0.5})};
            DynamicCase<3> scene =
                spaceScenes::sceneOf(assembly, theta, 0.5, {0, 0, -g}, FlowRule::associative);
            scene.contact.cohesion = JointStrength{1e6};
            scene.contact.tension = JointStrength{1e6};
            scene.effects.push_back(
                std::make_shared<JointBonds<3>>(jointBonds(scene.contact, scene.assembly)));
            move<3>(scene, {1, 0, 0}, {{0, 0}, {1, 0}}, {0.5, 0.2, -0.4}, Vector<3>(0.2, 1, 0.3).normalized(),
                    {{0, 0}, {0.5, 1.5}, {4, 1.5}});
            Motion<3> motion = startMotion(scene, stateAtRest(scene.assembly));
            for (double time = 0; time < 2; time += timeStep)
            {
                ASSERT_TRUE(advance(scene, motion, timeStep)) << time;
            }
            const Placement<3>& table = motion.state.placements[0];
            for (const std::size_t block : {1, 2})
            {
                SCOPED_TRACE(testing::Message() << "theta " << theta << " step " << timeStep << " " << block);
                const Placement<3>& stone = motion.state.placements[block];
                const Vector<3> arm = scene.blocks[block].centroid - scene.blocks[0].centroid;
                EXPECT_LE(turnBetween(table.rotation, stone.rotation).norm(), 1e-8);
                EXPECT_LE((stone.translation - table.translation - swing(table.rotation, arm)).norm(), 1e-8);
            }
            double largest = 0; // in rest it bears 215 N
            for (const Vector<3>& force : motion.contactForces)
            {
                largest = std::max(largest, force.norm());
            }
            EXPECT_LE(largest, 1e4);
        }
    }
}
