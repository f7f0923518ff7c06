// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Motion in space against numbers that others computed in closed form or to 13 digits: sliding that turns
/// and spins, rocking on a corner, a pulse along a diagonal. Steps of first order are extrapolated from two
/// lengths.
#include "../MadeStructure.h"
#include "SpaceScenes.h"
#include "dictionary/Dictionary.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

using namespace drystone;
using namespace drystone::spaceScenes;

namespace
{

/// Where a block is, how far it is turned about z, and when it stopped.
struct Course
{
    Vector<3> way = Vector<3>::Zero();
    double turn = 0;
    double stopped = 0; ///< the end of the last step with a velocity [s]
};

/// The block that is last, moved for some time in steps of theta 1, with a velocity at the start.
Course courseOf(const DynamicCase<3>& scene, const BlockVector<3>& velocity, double time, double timeStep)
{
    Motion<3> motion = startMotion(scene, stateAtRest(scene.assembly));
    motion.state.velocity.tail<6>() = velocity;
    Course course;
    const auto steps = std::lround(time / timeStep);
    for (int step = 1; step <= steps; ++step)
    {
        EXPECT_TRUE(advance(scene, motion, timeStep)) << "step " << step;
        course.stopped = motion.state.velocity.norm() > 1e-8 ? step * timeStep : course.stopped;
    }
    course.way = motion.state.placements.back().translation;
    course.turn = motion.state.placements.back().rotation.z();
    return course;
}

/// As if the step were nothing; when it stopped is that of the shorter one.
Course extrapolated(const DynamicCase<3>& scene, const BlockVector<3>& velocity, double time, double timeStep)
{
    const Course coarse = courseOf(scene, velocity, time, timeStep);
    const Course fine = courseOf(scene, velocity, time, timeStep / 2);
    return {2 * fine.way - coarse.way, 2 * fine.turn - coarse.turn, fine.stopped};
}

BlockVector<3> moving(const Vector<3>& velocity, double spin = 0)
{
    BlockVector<3> result = BlockVector<3>::Zero();
    result.head<3>() = velocity;
    result[5] = spin;
    return result;
}

/// Its flat face on ground under z = 0, a corner to +y, the centroid over the origin.
Assembly<3> triangularPrismOnGround(double side, double height)
{
    Assembly<3> assembly;
    assembly.supports.push_back({"ground", "ground"});
    assembly.blocks.push_back(boxBlock({-5, -5, -1}, {5, 5, 0}, 0));
    std::vector<Vector<3>> below;
    std::vector<Vector<3>> above;
    for (const double degrees : {90.0, 210.0, 330.0})
    {
        const double angle = degrees * std::numbers::pi / 180;
        const double radius = side / std::sqrt(3.0);
        below.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
        above.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
    }
    Block<3> prism;
    prism.shape = makePrism(below, above);
    assembly.blocks.push_back(prism);
    return assembly;
}

/// A prism along x in a groove of two faces at 45 degrees to the horizontal.
Assembly<3> prismInGroove()
{
    const auto along = [](const std::vector<Vector<2>>& outline, double from, double to)
    {
        std::vector<Vector<3>> first;
        std::vector<Vector<3>> last;
        for (const Vector<2>& corner : outline)
        {
            first.emplace_back(from, corner.x(), corner.y());
            last.emplace_back(to, corner.x(), corner.y());
        }
        return makePrism(first, last);
    };
    Assembly<3> assembly;
    assembly.supports.push_back({"ground", "ground"});
    for (const std::vector<Vector<2>>& outline :
         {std::vector<Vector<2>>{{0, 0}, {2, 0}, {2, 2}}, {{0, 0}, {-2, 2}, {-2, 0}}})
    {
        assembly.blocks.emplace_back();
        assembly.blocks.back().shape = along(outline, -4, 4);
        assembly.blocks.back().support = 0;
    }
    assembly.blocks.emplace_back();
    assembly.blocks.back().shape = along({{0, 0}, {0.2, 0.2}, {-0.2, 0.2}}, -1, 1);
    return assembly;
}

} // namespace

// The velocity turns down the slope as friction, against it, takes it away.
TEST(SpaceMotionReferences, ABoxStartedAlongTheContourOfASlopeTurnsDownAndStops)
{
    const double slope = 20 * std::numbers::pi / 180;
    const DynamicCase<3> scene =
        sceneOf(boxOnGround({1, 1, 0.2}, 0), 1, 0.5, {0, -g * std::sin(slope), -g * std::cos(slope)});
    const Course course = extrapolated(scene, moving({1, 0, 0}), 0.5, 1e-3);
    EXPECT_NEAR(course.way.x(), 0.12504400, 1e-5);
    EXPECT_NEAR(-course.way.y(), 0.08398821, 1e-5);
    EXPECT_NEAR(course.stopped, 0.46151142, 2e-3);
    EXPECT_NEAR(course.turn, 0, 1e-6);
}

// 3 mu g/r with r half the diagonal, the four corners carrying what they will: they are equally far away.
TEST(SpaceMotionReferences, ABoxThatSpinsOnItsCornersStops)
{
    const DynamicCase<3> scene = sceneOf(boxOnGround({0.6, 0.4, 0.1}, 0), 1, 0.3, {0, 0, -g});
    const Course course = extrapolated(scene, moving({0, 0, 0}, 5), 0.25, 1e-3);
    EXPECT_NEAR(course.turn, 0.51046994, 1e-5);
    EXPECT_NEAR(course.stopped, 0.20418798, 1e-3);
    EXPECT_NEAR(course.way.norm(), 0, 1e-6);
}

// On three points, whose forces are determined. Once at an instant and once at its end.
TEST(SpaceMotionReferences, APrismOnThreePointsSlidesAndSpins)
{
    const DynamicCase<3> scene = sceneOf(triangularPrismOnGround(0.6, 0.1), 1, 0.3, {0, 0, -g});
    const Course early = extrapolated(scene, moving({1, 0, 0}, 5), 0.1, 1e-3);
    EXPECT_NEAR(early.way.x(), 0.0956136, 1e-5);
    EXPECT_NEAR(early.way.y(), 0.0014372, 1e-5);
    EXPECT_NEAR(early.turn, 0.3502882, 1e-5);
    const Course whole = extrapolated(scene, moving({1, 0, 0}, 5), 0.45, 1e-3);
    EXPECT_NEAR(whole.way.x(), 0.241312, 2e-5);
    EXPECT_NEAR(whole.way.y(), 0.012474, 2e-5);
    EXPECT_NEAR(whole.turn, 0.581944, 2e-5);
    EXPECT_NEAR(whole.stopped, 0.419598, 1e-3);
}

// Each face carries N = W/(2 cos h), so that friction without dilatancy is mu W/cos h.
TEST(SpaceMotionReferences, APrismInAGrooveSlidesWithoutRising)
{
    const double mu = 0.3;
    DynamicCase<3> scene = sceneOf(prismInGroove(), 1, mu, {0, 0, -g});
    const Course course = extrapolated(scene, moving({1, 0, 0}), 0.25, 1e-3);
    EXPECT_NEAR(course.way.x(), 0.12013367, 1e-5);
    EXPECT_NEAR(course.stopped, 1 / 4.16203051, 1e-3);
    EXPECT_NEAR(course.way.z(), 0, 1e-7);

    // Tilted it can slide from atan(mu/cos h) = 22.98976777 degrees on. But as long as it rests, friction
    // across the groove may press it into the faces, and forces that hold it exist up to the associative
    // multiplier 0.444749590 (law 6 of the references of limit analysis): tan 23.9772 degrees. Between the
    // two both satisfy Coulomb's law, and a prism that rests goes on to rest. Beyond, it slides by the
    // friction without that pressure.
    for (const auto& [degrees, slides] :
         {std::pair(22.9, false), std::pair(23.96, false), std::pair(23.98, true), std::pair(24.0, true),
          std::pair(24.1, true), std::pair(24.3, true), std::pair(24.5, true)})
    {
        const double tilt = degrees * std::numbers::pi / 180;
        setGravity(scene, {g * std::sin(tilt), 0, -g * std::cos(tilt)});
        const Course tilted = extrapolated(scene, moving({0, 0, 0}), 0.2, 1e-3);
        const double acceleration = g * (std::sin(tilt) - mu / std::sqrt(0.5) * std::cos(tilt));
        EXPECT_NEAR(tilted.way.x(), slides ? acceleration * 0.2 * 0.2 / 2 : 0, 1e-7) << degrees;
    }
    // One that moves, however slowly, goes on.
    const double tilt = 23.1 * std::numbers::pi / 180;
    setGravity(scene, {g * std::sin(tilt), 0, -g * std::cos(tilt)});
    const double acceleration = g * (std::sin(tilt) - mu / std::sqrt(0.5) * std::cos(tilt));
    EXPECT_NEAR(extrapolated(scene, moving({1e-3, 0, 0}), 0.2, 1e-3).way.x(),
                1e-3 * 0.2 + acceleration * 0.2 * 0.2 / 2, 1e-6);
}

// Let go on one corner, tilted across its diagonal by half the critical angle: it falls flat, and goes on
// about the opposite corner with 1 - 2 d2/J of its angular velocity.
TEST(SpaceMotionReferences, APrismOnOneCornerGoesOnAboutTheOppositeOne)
{
    constexpr double timeStep = 2e-4;
    const DynamicCase<3> scene = sceneOf(boxOnGround({0.5, 0.5, 2}, 0), 1, 1, {0, 0, -g});
    DynamicState<3> state = stateAtRest(scene.assembly);
    const Vector<3> axis = Vector<3>(-1, 1, 0).normalized(); // turns towards the corner at +x +y
    const Vector<3> rotation = 0.33983691 / 2 * axis;
    const Vector<3> arm = scene.blocks[1].centroid - Vector<3>(0.25, 0.25, 0);
    state.placements[1] = {turned(rotation, arm) - arm, rotation};
    Motion<3> motion = startMotion(scene, std::move(state));
    double before = 0;
    double after = 0;
    int step = 0;
    while (after == 0 && step < 5000)
    {
        ++step;
        before = motion.state.velocity.tail<3>().norm();
        ASSERT_TRUE(advance(scene, motion, timeStep)) << step;
        after = motion.state.placements[1].rotation.dot(axis) <= 1e-9 ? motion.state.velocity.tail<3>().norm()
                                                                      : 0;
    }
    EXPECT_NEAR(step * timeStep, 0.49823113, 3 * timeStep);
    EXPECT_NEAR(before, 0.77588575, 2e-3);
    // What theta 1 leaves of an impact within a step shows after it.
    ASSERT_TRUE(advance(scene, motion, timeStep));
    after = motion.state.velocity.tail<3>().norm();
    EXPECT_NEAR(after / 0.77588575, 0.83098592, 5e-3);
    EXPECT_NEAR(motion.state.velocity.tail<3>().normalized().dot(axis), -1, 1e-6);
}

// A slender prism rocks where the arm of its weight is, and falls under a pulse that is strong enough.
TEST(SpaceMotionReferences, APulseAlongTheDiagonalRocksAndOverturns)
{
    constexpr double timeStep = 1e-3;
    constexpr double pulse = 0.5;
    const auto largestTilt = [&](const Vector<3>& direction, double intensity)
    {
        DynamicCase<3> scene = sceneOf(boxOnGround({0.5, 0.5, 2}, 0), 1, 1, {0, 0, -g});
        Motion<3> motion = startMotion(scene, stateAtRest(scene.assembly));
        double largest = 0;
        for (int step = 0; step < 4000 && largest < 0.6; ++step)
        {
            setGravity(scene,
                       (step * timeStep < pulse - 1e-9 ? intensity * g : 0) * direction - Vector<3>(0, 0, g));
            EXPECT_TRUE(advance(scene, motion, timeStep)) << step;
            const double tilt = motion.state.placements[1].rotation.norm();
            if (tilt < largest - 1e-3)
            {
                break; // on its way back
            }
            largest = std::max(largest, tilt);
        }
        return largest;
    };
    const Vector<3> diagonal = Vector<3>(1, 1, 0).normalized();
    EXPECT_LT(largestTilt(diagonal, 0.353), 1e-6);
    EXPECT_GT(largestTilt(diagonal, 0.3545), 1e-5);
    EXPECT_LT(largestTilt({1, 0, 0}, 0.2495), 1e-6);
    EXPECT_GT(largestTilt({1, 0, 0}, 0.2505), 1e-5);
    EXPECT_LT(largestTilt(diagonal, 0.4785), 0.34); // below the critical angle of 0.3398
    EXPECT_GE(largestTilt(diagonal, 0.4833), 0.6);
}

// Below the lowest collapse known of Coulomb's law, 0.203232297, nothing moves; above the associative
// multiplier, 0.207494721, the front leaves its return. Between the two it rests as it stands.
TEST(SpaceMotionReferences, AnLWallMovesByCoulombsLawWhereLimitAnalysisSaysSo)
{
    const Assembly<3> assembly = madeStructure<3>(
        Dictionary::readString("dimensions 3; supports { ground { type ground; } }\n"
                               "texture { type walls; unit (0.4 0.2 0.2); bond running; courses 6;\n"
                               "walls { front { from (0 0); length 3; }\n"
                               "left { from (0 0); direction (0 1); length 1; thickness right; } } }\n"));
    DynamicCase<3> scene = sceneOf(assembly, 1, 0.65, {0, 0, -g});
    for (const auto& [share, moves] : {std::pair(0.2032, false), std::pair(0.2076, true)})
    {
        setGravity(scene, {0, -share * g, -g});
        Motion<3> motion = startMotion(scene, stateAtRest(scene.assembly));
        double farthest = 0;
        for (int step = 1; step <= 10; ++step)
        {
            ASSERT_TRUE(advance(scene, motion, 0.002)) << share << ", step " << step;
        }
        for (const Placement<3>& placement : motion.state.placements)
        {
            farthest = std::max(farthest, -placement.translation.y());
        }
        EXPECT_EQ(farthest > 1e-8, moves) << share << ": " << farthest;
    }
}
