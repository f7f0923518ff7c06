// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A block that slides, on ground at rest and on ground that moves, and one that bounces, against closed
/// forms.
#include "Scenes.h"

#include <gtest/gtest.h>

#include <numbers>
#include <optional>
#include <string>

namespace drystone
{
namespace
{

Assembly<2> blockOnGround()
{
    Assembly<2> assembly = scenes::ground(-4, 6);
    assembly.blocks.push_back(scenes::rectangle(0, 0, 1, 0.4));
    return assembly;
}

/// Steps, and looks at the ledger and the joint, until a time.
struct Sliding
{
    DynamicCase<2> scene;
    double timeStep;
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    double highest = 0; ///< |y| of the mass centre, from as built [m]

    void until(double time)
    {
        while (motion.state.time < time - 0.5 * timeStep)
        {
            ASSERT_TRUE(advance(scene, motion, timeStep)) << "at " << motion.state.time << " s";
            ASSERT_LT(scenes::relativeImbalance(motion.energy), 1e-10);
            const double y = motion.state.placements[1].translation.y();
            highest = std::max(highest, std::abs(y));
        }
    }
};

Sliding sliding(const scenes::Settings& settings, double timeStep)
{
    Sliding run{scenes::sceneOf(blockOnGround(), settings), timeStep};
    run.motion.state.velocity[0] = 1;
    run.motion = startMotion(run.scene, run.motion.state);
    return run;
}

TEST(SlidingBlock, ABlockStopsWhereCoulombSaysWithoutLeavingTheGround)
{
    // Backward Euler stops short by v dt/2: half a percent takes a step below 8.5e-4 s.
    Sliding run = sliding({}, 5e-4);
    ASSERT_NO_FATAL_FAILURE(run.until(0.3));
    EXPECT_NEAR(run.motion.state.placements[1].translation.x(), 0.0849473, 0.005 * 0.0849473);
    EXPECT_LT(run.highest, 1e-9);
    EXPECT_LT(run.motion.state.velocity.norm(), 1e-9);
}

// Points that give way slip a little in each step to carry a shear: a block that stands on them would creep
// on.
TEST(SlidingBlock, ABlockThatStopsOnASlopeStandsStill)
{
    const double slope = 0.35; // tan 0.365, mu 0.6
    DynamicCase<2> scene = scenes::sceneOf(blockOnGround(), {});
    setGravity<2>(scene, {g * std::sin(slope), -g * std::cos(slope)});
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    motion.state.velocity[0] = 0.3;
    motion = startMotion(scene, motion.state);
    const double timeStep = 5e-4;
    const double stops = 0.3 / (g * (0.6 * std::cos(slope) - std::sin(slope)));
    for (int step = 0; motion.state.time < stops + 0.05; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, timeStep)) << step;
        if (motion.state.time > stops + 5 * timeStep)
        {
            EXPECT_EQ(motion.state.velocity.norm(), 0) << motion.state.time - stops << " s after it stopped";
            EXPECT_EQ(motion.residuals.factorisations, 0)
                << motion.state.time - stops << " s after it stopped";
        }
    }
}

TEST(SlidingBlock, TheTrapezoidalRuleStopsItThereToTheLastDigit)
{
    Sliding run = sliding({.theta = 0.5}, 1e-3);
    ASSERT_NO_FATAL_FAILURE(run.until(0.3));
    EXPECT_NEAR(run.motion.state.placements[1].translation.x(), 0.0849473, 1e-7);
    EXPECT_LT(run.highest, 1e-9);
}

// The rule itself would turn the velocity that is left round in each step for ever, and the shear with it.
TEST(SlidingBlock, AndAtRestWhateverTheRuleAndTheFlow)
{
    for (const FlowRule flowRule : {FlowRule::nonAssociative, FlowRule::associative})
    {
        for (const double theta : {0.5, 0.6, 0.75})
        {
            Sliding run = sliding({.theta = theta, .flowRule = flowRule}, 1e-3);
            ASSERT_NO_FATAL_FAILURE(run.until(0.6));
            EXPECT_EQ(run.motion.state.velocity.norm(), 0) << theta;
            double shear = 0;
            for (const Eigen::Vector2d& force : run.motion.contactForces)
            {
                shear += force.y();
            }
            EXPECT_NEAR(shear, 0, 1e-6 * run.scene.mass.sum()) << theta;
        }
    }
}

// Impacts of no more than rounding were solved to 1% of the velocities that blocks have, not of their change,
// and left more than they had found: in steps of 2.5 ms 622 J of what friction takes were lost in them.
TEST(SlidingBlock, ABlockThatDragsTheOneOnItHasNoImpacts)
{
    for (const double timeStep : {0.01, 0.005, 0.0025})
    {
        Assembly<2> assembly = scenes::ground(-40, 40);
        assembly.blocks.push_back(scenes::rectangle(-3, 0, 6, 0.2));
        assembly.blocks.push_back(scenes::rectangle(-0.5, 0.2, 1, 0.5));
        Sliding run{scenes::sceneOf(assembly, {.theta = 0.5, .mu = 0.3}), timeStep};
        run.motion.state.velocity[0] = 2;
        run.motion = startMotion(run.scene, run.motion.state);
        ASSERT_NO_FATAL_FAILURE(run.until(0.2));
        EXPECT_LE(run.motion.energy.impactLoss, 1e-4 * run.motion.energy.frictionLoss) << timeStep;
        EXPECT_NEAR(run.motion.state.velocity[3], 0.3 * g * 0.2, 1e-5) << timeStep;
        EXPECT_NEAR(run.motion.state.velocity[4], 0, 1e-5) << timeStep;
    }
}

// Of two bricks one stands on the ground as built, the other falls on it: what `joints` says of bricks on the
// ground is said of both.
TEST(SlidingBlock, AJointThatIsMadeInMotionHasTheFrictionOfItsZones)
{
    const auto placementsAt = [](double ofAll, std::optional<double> ofBricks)
    {
        Assembly<2> assembly = blockOnGround();
        assembly.blocks.push_back(scenes::rectangle(2, 0.1, 1, 0.4));
        assembly.zones = {{"brick", {1, 2}}};
        DynamicCase<2> scene = scenes::sceneOf(std::move(assembly), {.mu = ofAll});
        if (ofBricks)
        {
            const std::string name = "brick-ground";
            scene.contact.joints = {
                {NamePattern{name, [name](const std::string& other) { return other == name; }},
                 JointProperties{JointFriction{*ofBricks}, {}, {}, {}}}};
            scene.jointFriction = frictionOfJoints(scene.contact, scene.assembly);
        }
        DynamicState<2> state = stateAtRest(scene.assembly);
        state.velocity[0] = -1;
        state.velocity[3] = 1;
        Motion<2> motion = startMotion(scene, state);
        for (int step = 0; step < 200; ++step)
        {
            EXPECT_TRUE(advance(scene, motion, 2e-3)) << step;
        }
        return motion.state.placements;
    };
    const auto expected = placementsAt(0.2, std::nullopt);
    const auto found = placementsAt(0.8, 0.2);
    const auto ofOtherFriction = placementsAt(0.8, std::nullopt);
    for (const std::size_t block : {1, 2})
    {
        EXPECT_EQ(found[block].translation, expected[block].translation) << block;
        EXPECT_GT((found[block].translation - ofOtherFriction[block].translation).norm(), 0.01) << block;
    }
}

// Patterns are slow to match: blocks that meet are looked up once, not in each step.
TEST(SlidingBlock, NamesOfBlocksThatMeetAreMatchedOnce)
{
    Assembly<2> assembly = blockOnGround();
    assembly.blocks.push_back(scenes::rectangle(2, 0.001, 1, 0.4));
    DynamicCase<2> scene = scenes::sceneOf(std::move(assembly), {.mu = 0.8});
    int matched = 0;
    const auto countedMatch = [&matched](const std::string&)
    {
        ++matched;
        return true;
    };
    scene.contact.joints = {
        {NamePattern{".*", countedMatch}, JointProperties{JointFriction{0.2}, {}, {}, {}}}};
    scene.jointFriction = frictionOfJoints(scene.contact, scene.assembly);
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    const int asBuilt = matched;
    for (int step = 0; step < 50; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, 2e-3)) << step;
    }
    EXPECT_EQ(matched, asBuilt + 1);
    EXPECT_EQ(frictionAt(scene, motion), std::vector<double>(4, 0.2));
    EXPECT_EQ(matched, asBuilt + 1);
}

TEST(SlidingBlock, AssociativeFrictionHoversAtMuTimesTheStepTimesTheVelocity)
{
    // What this flow rule does, in proportion to the step; not what blocks do.
    for (const double timeStep : {1e-3, 2.5e-4})
    {
        // It hops when it is let go, for friction acts by an impulse; at 0.1 s it has long landed.
        Sliding run = sliding({.flowRule = FlowRule::associative}, timeStep);
        ASSERT_NO_FATAL_FAILURE(run.until(0.1));
        const double speed = run.motion.state.velocity[0];
        ASSERT_GT(speed, 0.1);
        EXPECT_NEAR(run.motion.state.placements[1].translation.y(), 0.6 * timeStep * speed,
                    1e-6 * 0.6 * timeStep * speed);
    }
}

TEST(SlidingBlock, ABasePulseLeavesABlockBehindAsNewmarkSays)
{
    for (const double theta : {1.0, 0.5})
    {
        for (const FlowRule flowRule : {FlowRule::associative, FlowRule::nonAssociative})
        {
            for (const double direction : {1, -1})
            {
                Sliding run{
                    scenes::sceneOf(blockOnGround(), {.theta = theta, .mu = 0.2, .flowRule = flowRule}),
                    1e-3};
                const PulseShape pulse{direction * 0.5 * g, 0.5, 0};
                scenes::shake(run.scene, std::make_shared<RectangularPulse>(pulse));
                ASSERT_NO_FATAL_FAILURE(run.until(1.5));
                EXPECT_NEAR(run.motion.state.placements[1].translation.x(), -direction * 0.9196875,
                            0.005 * 0.9196875);
                if (flowRule == FlowRule::nonAssociative)
                {
                    EXPECT_LT(run.highest, 1e-9);
                }
            }
        }
    }
}

/// Adds a motion of the ground along y.
void heave(DynamicCase<2>& scene, std::shared_ptr<const GroundAcceleration> acceleration)
{
    GroundMotion::Component component;
    component.direction = Eigen::Vector3d::UnitY();
    component.acceleration = std::move(acceleration);
    GroundMotion ground = groundMotionOf(scene.effects);
    ground.components.push_back(component);
    setGroundMotion(scene.effects, ground);
}

// With adjustTimeStep steps end where a record changes. Between such instants and others no step was left
// that is so short that the last digits of the places of blocks are velocities: the block was thrown up by
// 0.1 m/s.
TEST(SlidingBlock, ARecordIsFollowedWithoutShortSteps)
{
    std::vector<double> times;
    std::vector<double> accelerations;
    for (int i = 0; i <= 50; ++i)
    {
        times.push_back(0.04 * i);
        accelerations.push_back(5 * std::sin(0.36 * i));
    }
    const std::shared_ptr<const GroundAcceleration> record(
        tabulatedAcceleration(times, accelerations, Interpolation::linear, OutOfBounds::zero));
    for (const FlowRule flowRule : {FlowRule::nonAssociative, FlowRule::associative})
    {
        DynamicCase<2> scene = scenes::sceneOf(blockOnGround(), {.mu = 0.3, .flowRule = flowRule});
        scenes::shake(scene, record);
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        TimeControls controls;
        controls.deltaT = 0.005;
        controls.endTime = 2;
        controls.adjustTimeStep = true;
        scene.schemes.maxDeltaT = 0.005;
        Time time(controls, {0, controls.deltaT});
        chooseTimeStep(scene, motion, controls.deltaT, time);
        double fastest = 0;
        while (time.loop())
        {
            ASSERT_TRUE(advance(scene, motion, time));
            fastest = std::max(fastest, std::abs(motion.state.velocity[1]));
        }
        EXPECT_EQ(time.index(), 400);
        EXPECT_GT(motion.largestKinetic, 0.03 * scene.mass[0]) << "it slides";
        EXPECT_GT(motion.energy.impactLoss + motion.energy.frictionLoss, 0);
        if (flowRule == FlowRule::nonAssociative)
        {
            EXPECT_LT(fastest, 1e-6);
            EXPECT_LT(std::abs(motion.energy.impactLoss), 1e-6 * motion.energy.frictionLoss);
        }
    }
}

// What rests has no bound on its steps but those of the record, however long it has rested: the length that
// was wanted grew without bound, and with it the part of it within which instants were taken for one.
TEST(SlidingBlock, ARecordThatBeginsLateIsNotSteppedOver)
{
    std::vector<double> times;
    std::vector<double> accelerations;
    for (int i = 0; i <= 900; ++i)
    {
        times.push_back(0.01 * i);
        accelerations.push_back(i < 800 ? 0 : 5 * std::sin(2 * std::numbers::pi * 0.01 * i));
    }
    DynamicCase<2> scene = scenes::sceneOf(blockOnGround(), {.mu = 0.3});
    scenes::shake(scene, std::shared_ptr<const GroundAcceleration>(tabulatedAcceleration(
                             times, accelerations, Interpolation::linear, OutOfBounds::zero)));
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    TimeControls controls;
    controls.deltaT = 0.001;
    controls.endTime = 10;
    controls.adjustTimeStep = true;
    Time time(controls, {0, controls.deltaT});
    chooseTimeStep(scene, motion, controls.deltaT, time);
    double longest = 0;
    while (time.loop())
    {
        ASSERT_TRUE(advance(scene, motion, time));
        longest = time.value() < 9 ? std::max(longest, time.deltaT()) : longest;
    }
    EXPECT_LE(longest, 0.01 + 1e-9);
    EXPECT_GT(motion.largestKinetic, 0.03 * scene.mass[0]) << "it slides";
}

TEST(SlidingBlock, AGroundThatAlsoRisesPressesTheBlockOn)
{
    // In units of g, for half a second: 0.5 along x and v along y. The block is left behind at first by
    // 0.5 - mu (1 + v); then it slows down by mu.
    const double mu = 0.2;
    for (const double rise : {0.3, -0.4, -0.999})
    {
        const double left = 0.5 - mu * (1 + rise);
        const double speed = left * 0.5;
        const double distance = g * (0.5 * left * 0.25 + speed * speed / (2 * mu));
        Sliding run{scenes::sceneOf(blockOnGround(), {.theta = 0.5, .mu = mu}), 1e-3};
        scenes::shake(run.scene, std::make_shared<RectangularPulse>(PulseShape{0.5 * g, 0.5, 0}));
        heave(run.scene, std::make_shared<RectangularPulse>(PulseShape{rise * g, 0.5, 0}));
        ASSERT_NO_FATAL_FAILURE(run.until(2));
        EXPECT_NEAR(run.motion.state.placements[1].translation.x(), -distance, 1e-5 * distance) << rise;
        EXPECT_LT(run.highest, 1e-9) << rise;
    }
}

TEST(SlidingBlock, FromAGroundThatSinksFasterThanItFallsABlockLiftsOff)
{
    // 1.5 g downwards for 0.2 s: relative to the ground the block rises at 0.5 g, and its shear is gone.
    Sliding run{scenes::sceneOf(blockOnGround(), {.theta = 0.5, .mu = 0.2}), 1e-3};
    scenes::shake(run.scene, std::make_shared<RectangularPulse>(PulseShape{0.5 * g, 0.2, 0}));
    heave(run.scene, std::make_shared<RectangularPulse>(PulseShape{-1.5 * g, 0.2, 0}));
    ASSERT_NO_FATAL_FAILURE(run.until(0.2));
    EXPECT_NEAR(run.motion.state.placements[1].translation.x(), -0.01 * g, 1e-9);
    EXPECT_NEAR(run.motion.state.placements[1].translation.y(), 0.01 * g, 1e-9);
}

TEST(SlidingBlock, WithTheGroundRisingItTakesMoreToMakeItSlide)
{
    // It slides from 0.2 (1 + 0.3) g on.
    for (const double horizontal : {0.259, 0.261})
    {
        Sliding run{scenes::sceneOf(blockOnGround(), {.mu = 0.2}), 1e-3};
        scenes::shake(run.scene, std::make_shared<ConstantAcceleration>(horizontal * g));
        heave(run.scene, std::make_shared<ConstantAcceleration>(0.3 * g));
        ASSERT_NO_FATAL_FAILURE(run.until(0.5));
        const double expected = std::max(0.0, horizontal - 0.26) * g * 0.125;
        EXPECT_NEAR(-run.motion.state.placements[1].translation.x(), expected, 0.01 * expected + 1e-12);
    }
}

/// When a block dropped from 1 m has come to rest. \param phase part of a step by which it is released early
double timeAtRest(const scenes::Settings& settings, double timeStep, double phase)
{
    const DynamicCase<2> scene = scenes::sceneOf(blockOnGround(), settings);
    const double early = phase * timeStep;
    DynamicState<2> start = stateAtRest(scene.assembly);
    start.placements[1].translation.y() = 1 - 0.5 * g * early * early;
    start.velocity[1] = -g * early;
    Motion<2> motion = startMotion(scene, start);
    double atRest = 0;
    double energy = motion.energy.opening;
    while (motion.state.time < 4.5)
    {
        EXPECT_TRUE(advance(scene, motion, timeStep)) << "at " << motion.state.time << " s";
        EXPECT_LT(scenes::relativeImbalance(motion.energy), 1e-10);
        const double next = motion.energy.kinetic + motion.energy.potential;
        EXPECT_LT(next, energy + 1e-10 * motion.energy.opening);
        energy = next;
        if (motion.state.velocity.norm() > 1e-6)
        {
            atRest = motion.state.time;
        }
    }
    return atRest + early;
}

void expectRestInTime(double theta, double timeStep)
{
    double first = 1e9;
    double last = 0;
    for (int phase = 0; phase < 10; ++phase)
    {
        const double time = timeAtRest({.theta = theta, .restitution = 0.8}, timeStep, 0.1 * phase);
        EXPECT_NEAR(time, 4.063714, 0.01 * 4.063714) << "phase " << phase;
        first = std::min(first, time);
        last = std::max(last, time);
    }
    std::cout << "theta " << theta << ", step " << timeStep << " s: at rest after " << first << " to " << last
              << " s\n";
    EXPECT_LT(last - first, 0.001 * 4.063714);
}

TEST(BouncingBlock, AnImpactDoesNotThrowASlidingBlockUpWhateverTheFlowRuleOfTheSteps)
{
    // u_n+ = e u_n-; friction takes mu (1 + e) u_n- of the sliding. The associative law would add mu u_t+.
    const double mu = 0.1;
    const double restitution = 0.5;
    for (const FlowRule flowRule : {FlowRule::associative, FlowRule::nonAssociative})
    {
        for (const double theta : {1.0, 0.5})
        {
            Assembly<2> assembly = scenes::ground(-8, 8);
            assembly.blocks.push_back(scenes::rectangle(0, 0, 1, 0.4));
            const DynamicCase<2> scene = scenes::sceneOf(assembly, {.theta = theta,
                                                                    .mu = mu,
                                                                    .flowRule = flowRule,
                                                                    .restitution = restitution,
                                                                    .gravity = {0, 0}});
            DynamicState<2> start = stateAtRest(scene.assembly);
            start.placements.back().translation.y() = 0.0025;
            start.velocity << 1, -3, 0;
            Motion<2> motion = startMotion(scene, start);
            for (int step = 0; step < 10; ++step)
            {
                ASSERT_TRUE(advance(scene, motion, 1e-3));
            }
            EXPECT_NEAR(motion.state.velocity[0], 1 - mu * (1 + restitution) * 3, 1e-9) << theta;
            EXPECT_NEAR(motion.state.velocity[1], restitution * 3, 1e-9) << theta;
            EXPECT_NEAR(motion.state.velocity[2], 0, 1e-9) << theta;
        }
    }
}

TEST(BouncingBlock, ABlockComesToRestInTimeWhateverThePhaseOfTheStep)
{
    // Backward Euler takes g dt of the velocity from each flight: an error of first order.
    expectRestInTime(1, 1e-4);
}

TEST(BouncingBlock, SoItDoesWithTheTrapezoidalRule)
{
    expectRestInTime(0.5, 2.5e-4);
}

} // namespace
} // namespace drystone
