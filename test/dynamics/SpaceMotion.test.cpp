// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Motion in space, against closed forms and an integration to 13 digits by
/// others: sliding in any direction, free rotation, rocking on an edge; and where it ends.
#include "../ReportOf.h"
#include "SpaceScenes.h"

#include "contact/Penetration.h"
#include "core/Error.h"
#include "effects/MassDamping.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace drystone;
using namespace drystone::spaceScenes;

namespace
{

/// Angular momentum in space of a free block.
Vector<3> angularMomentum(const DynamicCase<3>& scene, const Motion<3>& motion)
{
    return times(massAt(scene, motion.state.placements), motion.state.velocity).tail<3>();
}

/// Angular velocity in the axes of a block as built.
Vector<3> bodyVelocity(const Motion<3>& motion)
{
    return turned(Vector<3>(-motion.state.placements[0].rotation),
                  Vector<3>(motion.state.velocity.tail<3>()));
}

} // namespace

// mu g decelerates: from 1 m/s to rest in 1/(mu g) = 0.1698946653 s over 1/(2 mu g) = 0.0849473327 m. A step
// takes the velocity of its end, theta 1, so the way is short by dt/2 times the velocity.
TEST(SpaceMotion, ABlockSlidesAsFarInEveryDirection)
{
    constexpr double timeStep = 1e-3;
    constexpr double mu = 0.6;
    for (const FlowRule flowRule : {FlowRule::nonAssociative, FlowRule::associative})
    {
        for (const double degrees : {0.0, 30.0, 45.0})
        {
            const double angle = degrees * std::numbers::pi / 180;
            const Vector<3> direction(std::cos(angle), std::sin(angle), 0);
            const DynamicCase<3> scene = sceneOf(boxOnGround({1, 1, 0.2}, 0), 1, mu, {0, 0, -g}, flowRule);
            Motion<3> motion = startMotion(scene, stateAtRest(scene.assembly));
            motion.state.velocity.head<3>() = direction;
            ASSERT_EQ(motion.points.size(), 4u);
            double stopped = 0;
            for (int step = 1; step <= 200; ++step)
            {
                ASSERT_TRUE(advance(scene, motion, timeStep)) << degrees << " degrees, step " << step;
                stopped = motion.state.velocity.head<2>().norm() > 1e-9 ? step * timeStep : stopped;
            }
            const Vector<3>& way = motion.state.placements[1].translation;
            EXPECT_NEAR(stopped, 0.1698946653, timeStep) << degrees;
            // sum of dt v over the steps: v0 T/2 - dt v0/2 with T = v0/(mu g), to second order
            EXPECT_NEAR(way.dot(direction), 0.0849473327 - 0.5 * timeStep, 2e-5) << degrees;
            EXPECT_NEAR(way.dot(Vector<3>(-direction.y(), direction.x(), 0)), 0, 1e-7) << degrees;
            EXPECT_NEAR(motion.state.placements[1].rotation.norm(), 0, 1e-6) << degrees;
        }
    }
}

// Normals that leave the vertical by a rounding have shear in the directions that they had.
TEST(SpaceMotion, WithThetaBelowOneBlocksThatSlideOnLevelJointsMoveAsOnSlantingOnes)
{
    Assembly<3> level;
    level.supports.push_back({"ground", "ground"});
    level.blocks = {boxBlock({-5, -5, -1}, {5, 5, 0}, 0), boxBlock({0, 0, 0}, {0.5, 0.4, 0.3}),
                    boxBlock({0, 0, 0.3}, {0.5, 0.4, 0.6})};
    constexpr double size = 0.4;
    const Vector<3> thrown(0.5, 0.3, 0); // the lower one [m/s]
    const auto run = [&](const Vector<3>& turn, FlowRule flowRule)
    {
        Assembly<3> assembly = level;
        for (Block<3>& block : assembly.blocks)
        {
            for (Vector<3>& vertex : block.shape.vertices)
            {
                vertex = turned(turn, vertex);
            }
        }
        const DynamicCase<3> scene =
            sceneOf(std::move(assembly), 0.5, 0.6, turned(turn, Vector<3>(0, 0, -g)), flowRule);
        DynamicState<3> start = stateAtRest(scene.assembly);
        start.velocity.head<3>() = turned(turn, thrown);
        Motion<3> motion = startMotion(scene, std::move(start));
        std::vector<double> energies{motion.energy.kinetic};
        for (int step = 0; step < 10; ++step)
        {
            EXPECT_TRUE(advance(scene, motion, 0.005)) << step;
            energies.push_back(motion.energy.kinetic + motion.energy.potential);
            for (std::size_t i = 0; i < motion.points.size(); ++i)
            {
                EXPECT_GT(motion.points[i].gap, -1e-6 * size) << "step " << step << ", point " << i;
            }
        }
        return energies;
    };
    for (const FlowRule flowRule : {FlowRule::associative, FlowRule::nonAssociative})
    {
        const std::vector<double> onLevel = run({0, 0, 0}, flowRule);
        const std::vector<double> onSlanting = run({0.2, 0.5, 0}, flowRule);
        // By Coulomb's law which of several forces are found depends on rounding.
        const double apart = (flowRule == FlowRule::associative ? 1e-6 : 1e-2) * onLevel[0];
        for (std::size_t step = 1; step < onLevel.size(); ++step)
        {
            EXPECT_LE(onLevel[step], onLevel[step - 1] + 1e-4 * onLevel[0]) << step; // 36.9 J more, once
            EXPECT_NEAR(onLevel[step], onSlanting[step], apart) << step;
        }
    }
}

// Numbers of an integration by an explicit method of order 8 to 1e-13: brick .5 x .3 x .2, x longest.
TEST(SpaceMotion, AFreeBrickTurnsOverAboutItsMiddleAxisAndKeepsEnergyAndMomentum)
{
    struct Turning
    {
        Vector<3> velocity = Vector<3>::Zero(); ///< in the axes of the brick, at the end [rad/s]
        Eigen::Vector4d quaternion = Eigen::Vector4d::Zero(); ///< w x y z, at the end
        std::vector<double> flips;                            ///< where w_y is zero [s]
    };
    const auto run = [](double timeStep, double theta, double restitution)
    {
        DynamicCase<3> scene = sceneOf(freeBox({0.5, 0.3, 0.2}), theta, 0, {0, 0, 0});
        if (restitution > 0)
        {
            scene.contact.restitution = Restitution{restitution};
        }
        DynamicState<3> start = stateAtRest(scene.assembly);
        start.velocity.tail<3>() << 0.05, 4, 0.02;
        Motion<3> motion = startMotion(scene, std::move(start));
        const Vector<3> momentum = angularMomentum(scene, motion);
        const double energy = motion.energy.kinetic;
        const int steps = static_cast<int>(std::lround(10 / timeStep));
        Turning result;
        for (int step = 1; step <= steps; ++step)
        {
            const double before = bodyVelocity(motion).y();
            EXPECT_TRUE(advance(scene, motion, timeStep));
            const double after = bodyVelocity(motion).y();
            if ((before > 0) != (after > 0))
            {
                result.flips.push_back((step - 1 + before / (before - after)) * timeStep);
            }
        }
        EXPECT_LT((angularMomentum(scene, motion) - momentum).norm(), 1e-10 * momentum.norm());
        EXPECT_NEAR(motion.energy.kinetic, energy, 1e-10 * energy);
        EXPECT_NEAR(imbalance(motion.energy), 0, 1e-10 * energy);
        result.velocity = bodyVelocity(motion);
        const Vector<3>& rotation = motion.state.placements[0].rotation;
        const double half = rotation.norm() / 2;
        result.quaternion << std::cos(half), std::sin(half) * rotation.normalized();
        return result;
    };
    const Vector<3> exact(2.9076827, 0.294449809, 3.215869369);
    const Eigen::Vector4d exactQuaternion(-0.650660731, 0.462133944, -0.341920175, -0.496148592);
    const Turning coarse = run(4e-3, 0.5, 0);
    const Turning fine = run(2e-3, 0.5, 0);
    // Of second order: a quarter of the error, and extrapolated a hundredth.
    const double error = (fine.velocity - exact).norm();
    EXPECT_NEAR((coarse.velocity - exact).norm() / error, 4, 0.2);
    EXPECT_LT(((4 * fine.velocity - coarse.velocity) / 3 - exact).norm(), 2e-3 * error + 1e-6);
    ASSERT_EQ(coarse.flips.size(), 2u);
    ASSERT_EQ(fine.flips.size(), 2u);
    const auto flip = [&](std::size_t i) { return (4 * fine.flips[i] - coarse.flips[i]) / 3; };
    EXPECT_NEAR(flip(0), 3.46726547, 2e-5);
    EXPECT_NEAR(flip(1), 3.46726547 + 6.48940626, 2e-5);
    // q and -q are the same.
    const auto likeExact = [&](const Eigen::Vector4d& q) -> Eigen::Vector4d
    { return q.dot(exactQuaternion) < 0 ? -q : q; };
    EXPECT_LT(((4 * likeExact(fine.quaternion) - likeExact(coarse.quaternion)) / 3 - exactQuaternion).norm(),
              2e-5);
    // With restitution blocks fly by the mean of their velocities whatever theta is.
    for (const double theta : {0.75, 1.0})
    {
        const Turning flying = run(4e-3, theta, 0.5);
        EXPECT_LT((flying.velocity - coarse.velocity).norm(), 1e-8);
        EXPECT_LT((likeExact(flying.quaternion) - likeExact(coarse.quaternion)).norm(), 1e-8);
    }
}

// As of a number with too many digits in constant/g, or of the centre of a support: contact points were
// looked for where there is nothing, and the program ended.
TEST(SpaceMotion, AStepThatMovesBlocksBeyondNumbersIsNotTaken)
{
    for (const double gravity : {1e30, 1e160, 1e300})
    {
        const DynamicCase<3> scene = sceneOf(boxOnGround({1, 1, 1}, 0), 1, 0.5, {0, 0, -gravity});
        Motion<3> motion = startMotion(scene, stateAtRest(scene.assembly));
        EXPECT_FALSE(advance(scene, motion, 0.01)) << gravity;
        EXPECT_EQ(motion.attempt.fault, StepFault::movesTooFar) << gravity;
        EXPECT_TRUE(motion.state.velocity.isZero(0));
    }
}

// No moment acts on a free brick but that of damping, along its momentum: however it turns, that keeps its
// direction and decays as exp(-a t).
TEST(SpaceMotion, TheMomentumOfADampedBrickThatTurnsDecaysWithoutTurning)
{
    constexpr double damping = 3;
    constexpr double end = 0.5;
    const auto errorOf = [](double theta, double timeStep)
    {
        DynamicCase<3> scene = sceneOf(freeBox({0.5, 0.3, 0.2}), theta, 0, {0, 0, 0});
        scene.effects.push_back(std::make_shared<MassDamping<3>>(Damping{damping, {}}));
        DynamicState<3> start = stateAtRest(scene.assembly);
        start.velocity.tail<3>() << 2, 6, 3;
        Motion<3> motion = startMotion(scene, std::move(start));
        const Vector<3> momentum = angularMomentum(scene, motion);
        const double energy = motion.energy.kinetic;
        const int steps = static_cast<int>(std::lround(end / timeStep));
        for (int step = 0; step < steps; ++step)
        {
            EXPECT_TRUE(advance(scene, motion, timeStep));
        }
        EXPECT_NEAR(imbalance(motion.energy), 0, 1e-10 * energy);
        const double decay = theta == 1 ? std::pow(1 + damping * timeStep, -steps) : std::exp(-damping * end);
        return (angularMomentum(scene, motion) - decay * momentum).norm() / momentum.norm();
    };
    EXPECT_LT(errorOf(1, 4e-3), 1e-10); // as theta 1 has the decay
    const double coarse = errorOf(0.5, 4e-3);
    EXPECT_LT(coarse, 1e-4);
    EXPECT_NEAR(coarse / errorOf(0.5, 2e-3), 4, 0.2); // of second order
}

// The axis of a free square prism goes round the momentum at L/J (J across the axis), on a cone.
// A turn of half a radian in a step is not found by the iteration that finds those of less: the step is
// shorter then. Such bricks got up to twice their energy.
TEST(SpaceMotion, AFreeBrickThatTurnsFarInAStepGainsNoEnergy)
{
    constexpr double timeStep = 0.1;
    for (const double theta : {0.5, 0.75, 1.0})
    {
        for (const double restitution : {0.0, 0.3})
        {
            for (const double turn : {0.3, 0.5, 0.9, 2.0, 6.0}) // in a step
            {
                SCOPED_TRACE(testing::Message()
                             << "theta " << theta << " e " << restitution << " turn " << turn);
                DynamicCase<3> scene = sceneOf(freeBox({1, 0.5, 0.25}), theta, 0, {0, 0, 0});
                if (restitution > 0)
                {
                    scene.contact.restitution = Restitution{restitution};
                }
                DynamicState<3> start = stateAtRest(scene.assembly);
                start.velocity.tail<3>() = turn / timeStep * Vector<3>(0.1, 0.1, 0.99);
                Motion<3> motion = startMotion(scene, std::move(start));
                const Vector<3> momentum = angularMomentum(scene, motion);
                const double energy = motion.energy.kinetic;
                for (int step = 0; step < 40; ++step)
                {
                    ASSERT_TRUE(advanceOrShorten(scene, motion, timeStep).isSolved) << step;
                    // The mean of two steps keeps energy as a pendulum does.
                    EXPECT_LE(motion.energy.kinetic,
                              (theta == 0.5 || restitution > 0 ? 1.1 : 1 + 1e-9) * energy);
                    EXPECT_LE(std::abs(imbalance(motion.energy)), 1e-6 * energy);
                    EXPECT_LE((angularMomentum(scene, motion) - momentum).norm(), 1e-6 * momentum.norm());
                }
            }
        }
    }
}

TEST(SpaceMotion, AFreeSquarePrismPrecesses)
{
    constexpr double timeStep = 1e-3;
    const DynamicCase<3> scene = sceneOf(freeBox({0.3, 0.3, 0.6}), 0.5, 0, {0, 0, 0});
    DynamicState<3> start = stateAtRest(scene.assembly);
    start.velocity.tail<3>() << 1, 0, 8;
    Motion<3> motion = startMotion(scene, std::move(start));
    const Vector<3> momentum = angularMomentum(scene, motion).normalized();
    const auto axis = [&] { return turned(motion.state.placements[0].rotation, Vector<3>(0, 0, 1)); };
    const double cone = std::acos(axis().dot(momentum));
    EXPECT_NEAR(cone * 180 / std::numbers::pi, 17.35402464, 1e-8);
    const Vector<3> first = (axis() - axis().dot(momentum) * momentum).normalized();
    const int steps = 1000;
    for (int step = 1; step <= steps; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, timeStep));
        ASSERT_NEAR(std::acos(axis().dot(momentum)), cone, 1e-9) << step;
    }
    const Vector<3> last = (axis() - axis().dot(momentum) * momentum).normalized();
    const double turn = std::atan2(first.cross(last).dot(momentum), first.dot(last));
    // 3.35 rad in one second, more than half a turn; the step is of second order.
    EXPECT_NEAR(turn < 0 ? turn + 2 * std::numbers::pi : turn, 3.35261092, 1e-4);
}

// As in the plane: b .25, h 1 (half sizes), let go from half the critical angle, which takes the face down
// after a quarter of 1.97521286 s.
TEST(SpaceMotion, APrismRocksOnAnEdgeInEveryDirection)
{
    constexpr double timeStep = 1e-4;
    for (const double degrees : {0.0, 30.0})
    {
        const double turn = degrees * std::numbers::pi / 180;
        const DynamicCase<3> scene = sceneOf(boxOnGround({0.5, 0.4, 2}, turn), 1, 5, {0, 0, -g});
        DynamicState<3> state = stateAtRest(scene.assembly);
        const double tilt = 0.5 * std::atan(0.25);
        const Vector<3> rotation = tilt * turned(Vector<3>(0, 0, turn), Vector<3>(0, 1, 0));
        const Vector<3> edge = turned(Vector<3>(0, 0, turn), Vector<3>(0.25, 0, 0));
        const Vector<3> arm = scene.blocks[1].centroid - edge;
        state.placements[1] = {turned(rotation, arm) - arm, rotation};
        Motion<3> motion = startMotion(scene, std::move(state));
        double impact = 0;
        const Vector<3> over = turned(Vector<3>(0, 0, turn), Vector<3>(0, 1, 0));
        for (int step = 1; step <= 6000 && impact == 0; ++step)
        {
            ASSERT_TRUE(advance(scene, motion, timeStep)) << degrees << " step " << step;
            impact = motion.state.placements[1].rotation.dot(over) <= 1e-9 ? step * timeStep : 0;
        }
        EXPECT_NEAR(impact, 1.97521286 / 4, 3 * timeStep) << degrees;
    }
}

// With theta 1/2 impacts are apart from the steps, and their impulses belong to the mean forces of the step:
// at the corners of a hundred boxes that fall flat by 1 mm and stop, with what carries their weight.
TEST(SpaceMotion, BoxesThatFallFlatStopByTheImpulsesOfTheirCorners)
{
    constexpr double timeStep = 1e-3;
    constexpr double height = 1e-3;
    Assembly<3> assembly;
    assembly.supports.push_back({"ground", "ground"});
    assembly.blocks.push_back(boxBlock({-1, -1, -1}, {21, 21, 0}, 0));
    for (int i = 0; i < 100; ++i)
    {
        const Vector<3> corner(2 * (i % 10), 2 * (i / 10), 0);
        assembly.blocks.push_back(boxBlock(corner, corner + Vector<3>(1, 1, 0.5)));
    }
    const DynamicCase<3> scene = sceneOf(std::move(assembly), 0.5, 0.6, {0, 0, -g});
    DynamicState<3> start = stateAtRest(scene.assembly);
    for (std::size_t block = 1; block < start.placements.size(); ++block)
    {
        start.placements[block].translation.z() = height;
    }
    Motion<3> motion = startMotion(scene, start);
    const double weight = 1000 * g;
    Vector<3> impulse = Vector<3>::Zero(); // of all contact forces
    for (int step = 0; step < 30; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, timeStep)) << step;
        const auto& forces = motion.meanForces.empty() ? motion.contactForces : motion.meanForces;
        ASSERT_EQ(forces.size(), 400u);
        for (const Vector<3>& force : forces)
        {
            impulse += timeStep * force;
        }
    }
    EXPECT_LE(motion.state.velocity.lpNorm<Eigen::Infinity>(), 1e-9);
    EXPECT_NEAR(impulse[0], 100 * weight * 30 * timeStep, 1e-6 * 100 * weight * 30 * timeStep);
    EXPECT_LE(impulse.tail<2>().norm(), 1e-6 * impulse[0]);
    EXPECT_NEAR(motion.state.placements[1].translation.z(), 0, 1e-9);
}

// A frictionless angle, 1 x 1 x 0.2 m, slides over the rim of the ground and falls; slides into a box and
// pushes it; one whose notch has a hundred teeth is followed only.
TEST(SpaceMotion, BlocksThatAreNotConvexFindContactsAsTheirConvexParts)
{
    std::vector<Vector<3>> corner{{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0},
                                  {0.3, 0.5, 0},   {0.3, -0.3, 0}, {-0.5, -0.3, 0}};
    const auto prism = [](const std::vector<Vector<3>>& bottom)
    {
        std::vector<Vector<3>> top = bottom;
        for (Vector<3>& vertex : top)
        {
            vertex.z() = 0.2;
        }
        return makePrism(bottom, top);
    };
    const auto run = [](const DynamicCase<3>& scene, int steps)
    {
        Motion<3> motion = startMotion(scene, stateAtRest(scene.assembly));
        motion.state.velocity.head<3>() = Vector<3>(1, 0, 0);
        for (int step = 0; step < steps; ++step)
        {
            EXPECT_TRUE(advance(scene, motion, 1e-3)) << step;
            EXPECT_LE(penetration(scene.assembly, motion.state.placements).depth, 2e-6) << step;
        }
        return motion;
    };
    Assembly<3> assembly = boxOnGround({1, 1, 0.2}, 0);
    assembly.blocks[1].shape = prism(corner);
    assembly.blocks[0] = boxBlock({-0.6, -0.6, -1}, {0.6, 0.6, 0}, 0);
    const Motion<3> over = run(sceneOf(assembly, 1, 0, {0, 0, -g}), 1000);
    EXPECT_LT(over.state.placements[1].translation.z(), -0.5);

    assembly.blocks[0] = boxBlock({-5, -5, -1}, {5, 5, 0}, 0);
    assembly.blocks.push_back(boxBlock({0.6, -1, 0}, {1, 1, 1}));
    const DynamicCase<3> intoABox = sceneOf(assembly, 1, 0, {0, 0, -g});
    const Motion<3> pushing = run(intoABox, 300);
    const Eigen::VectorXd& velocity = pushing.state.velocity;
    EXPECT_NEAR(intoABox.mass[0] * (1 - velocity[0]), intoABox.mass[6] * velocity[6],
                1e-6 * intoABox.mass[0]);
    EXPECT_GT(velocity[6], 0.05);

    corner.erase(corner.begin() + 3, corner.begin() + 5);
    for (int tooth = 100; tooth > -100; --tooth)
    {
        corner.insert(corner.end() - 1, Vector<3>(0.3 - (tooth % 2 ? 0.001 : 0), 0.1 + 0.003 * tooth, 0));
    }
    assembly.blocks[1].shape = prism(corner);
    assembly.blocks.pop_back();
    assembly.blocks[0] = boxBlock({-0.6, -0.6, -1}, {0.6, 0.6, 0}, 0);
    const DynamicCase<3> toothed = sceneOf(assembly, 1, 0, {0, 0, -g});
    Motion<3> motion = startMotion(toothed, stateAtRest(toothed.assembly));
    EXPECT_EQ(motion.contacts->parts(1), 0u);
    motion.state.velocity.head<3>() = Vector<3>(1, 0, 0);
    EXPECT_THAT(reportOf(
                    [&]
                    {
                        for (int step = 0; step < 300; ++step)
                        {
                            ASSERT_TRUE(advance(toothed, motion, 1e-3));
                        }
                    }),
                testing::HasSubstr("has left the face of"));
}
