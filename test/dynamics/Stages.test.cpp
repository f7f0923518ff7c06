// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Each stage of a step by itself, on one block whose step is known in closed form; their times; and the
/// retry.
#include "Scenes.h"

#include "dynamics/Step.h"
#include "effects/JointBonds.h"
#include "effects/MassDamping.h"

#include <gtest/gtest.h>

#include <thread>

using namespace drystone;
using namespace drystone::scenes;

namespace
{

constexpr double stepOfStages = 0.01;

/// One block of 1 m x 1 m, its lower edge at a height above the ground.
DynamicCase<2> blockAt(double height, const Settings& settings = {})
{
    Assembly<2> assembly = ground(-5, 5);
    assembly.blocks.push_back(rectangle(0, height, 1, 1));
    return sceneOf(std::move(assembly), settings);
}

/// The stages before the solution.
void prepare(Step<2>& step)
{
    findContacts(step);
    assemble(step);
    contribute(step);
    beginAgain(step);
}

} // namespace

TEST(Stages, FindContactsFindsTheCornersOfABlockThatTouchesAndNoneOfOneFarAbove)
{
    for (const double height : {0.0, 2.0})
    {
        const DynamicCase<2> scene = blockAt(height);
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        Step<2> step(scene, motion, stepOfStages, {});
        findContacts(step);
        EXPECT_EQ(step.points.size(), height == 0 ? 2u : 0u);
        EXPECT_EQ(step.columns.size(), step.points.size());
        for (const ContactPoint<2>& point : step.points)
        {
            EXPECT_EQ(point.gap, 0);
        }
    }
}

TEST(Stages, FindContactsKeepsTheLeverArmsOfTheStartForImpactsOfTheTrapezoidalRule)
{
    for (const double theta : {1.0, 0.5})
    {
        const DynamicCase<2> scene = blockAt(0, {.theta = theta});
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        Step<2> step(scene, motion, stepOfStages, {});
        findContacts(step);
        EXPECT_EQ(step.arrivals.size(), theta < 1 ? step.points.size() : 0u);
    }
}

TEST(Stages, AssembleMakesTheProgramOfEquation9)
{
    const DynamicCase<2> scene = blockAt(0);
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    motion.state.velocity << 0.5, 0, 0;
    Step<2> step(scene, motion, stepOfStages, {});
    findContacts(step);
    assemble(step);
    const double mass = scene.mass[0];
    EXPECT_DOUBLE_EQ(step.program.inertia[0](0, 0), mass / (stepOfStages * stepOfStages));
    EXPECT_DOUBLE_EQ(step.program.load[0], mass * 0.5 / stepOfStages);
    EXPECT_DOUBLE_EQ(step.program.load[1], -mass * g);
    EXPECT_EQ(step.program.friction, std::vector<double>(2, 0.6));
    EXPECT_DOUBLE_EQ(step.guess.displacement[0], 0.5 * stepOfStages);
}

TEST(Stages, ContributeChangesNothingWithoutEffectsAndAddsTheInertiaOfDampingWithIt)
{
    DynamicCase<2> scene = blockAt(0);
    for (const double coefficient : {0.0, 3.0})
    {
        scene.effects.clear();
        if (coefficient > 0)
        {
            scene.effects = {std::make_shared<MassDamping<2>>(Damping{coefficient})};
        }
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        Step<2> step(scene, motion, stepOfStages, {});
        findContacts(step);
        assemble(step);
        const PlaneConeProgram rigid = step.program;
        contribute(step);
        EXPECT_EQ(step.program.gap, rigid.gap);
        EXPECT_EQ(step.program.load, rigid.load);
        EXPECT_DOUBLE_EQ(step.program.inertia[0](0, 0) - rigid.inertia[0](0, 0),
                         coefficient / stepOfStages * scene.mass[0]);
    }
}

TEST(Stages, SolveGivesABlockAtRestItsWeightAndOneInTheAirItsFall)
{
    for (const double height : {0.0, 2.0})
    {
        const DynamicCase<2> scene = blockAt(height);
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        Step<2> step(scene, motion, stepOfStages, {});
        prepare(step);
        solve(step);
        ASSERT_TRUE(step.solved.isSolved);
        const double weight = scene.mass[0] * g;
        if (height == 0)
        {
            const Eigen::VectorXd& force = step.solved.result.contactForce;
            EXPECT_NEAR(force[0] + force[2], weight, 1e-9 * weight);
            EXPECT_EQ(step.solved.result.displacement.norm(), 0);
        }
        else
        {
            EXPECT_NEAR(step.solved.result.displacement[1], -g * stepOfStages * stepOfStages, 1e-15);
        }
        EXPECT_EQ(motion.state.velocity.norm(), 0) << "solve moves nothing";
    }
}

TEST(Stages, CollideThrowsABlockBackAndAsksForAnotherSolution)
{
    for (const double restitution : {0.0, 0.5})
    {
        const DynamicCase<2> scene = blockAt(0, {.restitution = restitution});
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        motion.state.velocity << 0, -1, 0;
        Step<2> step(scene, motion, stepOfStages, {});
        prepare(step);
        solve(step);
        EXPECT_EQ(collide(step), restitution > 0);
        EXPECT_NEAR(step.solved.velocity[1], restitution > 0 ? restitution : -1, 1e-9);
        const double lost = 0.5 * scene.mass[0] * (1 - restitution * restitution);
        EXPECT_NEAR(step.solved.lostInImpacts, restitution > 0 ? lost : 0, 1e-6 * lost);
        solve(step);
        EXPECT_FALSE(collide(step));
    }
}

TEST(Stages, CollideFindsTheInstantAtWhichAFallingBlockMeetsTheGround)
{
    const double height = 1e-3;
    const DynamicCase<2> scene = blockAt(height, {.restitution = 0.5});
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    motion.state.velocity << 0, -1, 0;
    Step<2> step(scene, motion, stepOfStages, {ImpactInstant::located, 1e-3 * stepOfStages, 0});
    prepare(step);
    solve(step);
    EXPECT_FALSE(collide(step));
    EXPECT_FALSE(step.solved.isSolved);
    const double instant = (std::sqrt(1 + 2 * g * height) - 1) / g; // of h = t + g t^2/2
    EXPECT_NEAR(step.solved.length * stepOfStages, instant, 1e-6 * instant);
}

TEST(Stages, ReviewAsksForAnotherSolutionWhenABondBreaksAndNotWithoutOne)
{
    for (const double strength : {0.0, 1e3, 1e6})
    {
        Settings settings;
        settings.gravity = {0, g}; // pulls the block off the ground: 17.7 kN on a joint of 1 m2
        DynamicCase<2> scene = blockAt(0, settings);
        if (strength > 0)
        {
            scene.contact.cohesion = JointStrength{strength};
            scene.contact.tension = JointStrength{strength};
            scene.effects = {std::make_shared<JointBonds<2>>(jointBonds(scene.contact, scene.assembly))};
        }
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        Step<2> step(scene, motion, stepOfStages, {});
        prepare(step);
        solve(step);
        ASSERT_TRUE(step.solved.isSolved);
        EXPECT_EQ(review(step), strength == 1e3);
        EXPECT_EQ(step.program.hasStrength(), strength == 1e6);
    }
}

TEST(Stages, MoveAndAccountGiveAFallItsPlaceVelocityAndEnergy)
{
    const DynamicCase<2> scene = blockAt(2);
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    Step<2> step(scene, motion, stepOfStages, {});
    prepare(step);
    solve(step);
    ASSERT_FALSE(collide(step));
    ASSERT_FALSE(review(step));
    move(step);
    EXPECT_NEAR(motion.state.velocity[1], -g * stepOfStages, 1e-14);
    EXPECT_NEAR(motion.state.placements[1].translation.y(), -g * stepOfStages * stepOfStages, 1e-15);
    EXPECT_DOUBLE_EQ(motion.state.time, stepOfStages);
    EXPECT_EQ(motion.energy.kinetic, 0) << "the ledger is kept by account";
    measureEnergy(step);
    EXPECT_FALSE(createsEnergy(step));
    account(step);
    EXPECT_NEAR(motion.energy.kinetic, 0.5 * scene.mass[0] * std::pow(g * stepOfStages, 2), 1e-9);
    EXPECT_LT(relativeImbalance(motion.energy), 1e-12);
}

TEST(Stages, EachHasItsTimeAndTheyAddUpOverSteps)
{
    StageTimes times;
    {
        const StageTimer timer(times, Stage::move);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_GE(times.of(Stage::move), 0.005);
    EXPECT_EQ(times.total(), times.of(Stage::move));

    const DynamicCase<2> scene = blockAt(0, {.mu = 0.1});
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    motion.state.velocity << 1, 0, 0;
    decltype(StageTimes::seconds) before{};
    for (int count = 0; count < 3; ++count)
    {
        ASSERT_TRUE(advance(scene, motion, stepOfStages));
        for (const auto& [name, stage] : namesOf(Stage{}))
        {
            if (stage == Stage::rest) // only with `selection automatic`
            {
                EXPECT_EQ(motion.stageTimes.of(stage), 0);
                continue;
            }
            EXPECT_GT(motion.stageTimes.of(stage), before[static_cast<std::size_t>(stage)]) << name;
        }
        before = motion.stageTimes.seconds;
    }
}

TEST(ShortenedSteps, AreHalvedUntilTheyAreSolvedWithoutKnowingATime)
{
    // One iteration of the interior point solves nothing.
    DynamicCase<2> scene = blockAt(0, {.mu = 0.1, .tolerance = 1e-11, .solver = SolverType::interiorPoint});
    scene.solution.maximumIterations = 1;
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    motion.state.velocity << 1, 0, 0.5;
    const Motion<2> before = motion;
    const ShortenedStep failed = advanceOrShorten(scene, motion, stepOfStages);
    EXPECT_FALSE(failed.isSolved);
    EXPECT_DOUBLE_EQ(failed.timeStep, stepOfStages / 1024);
    EXPECT_EQ(motion.attempt.retries, 10);
    EXPECT_EQ(motion.state.time, before.state.time);
    EXPECT_EQ(motion.state.velocity, before.state.velocity);

    scene.solution.maximumIterations = 100;
    const ShortenedStep taken = advanceOrShorten(scene, motion, stepOfStages);
    EXPECT_TRUE(taken.isSolved);
    EXPECT_EQ(taken.timeStep, stepOfStages);
    EXPECT_EQ(motion.residuals.retries, 0);
    EXPECT_DOUBLE_EQ(motion.state.time, stepOfStages);
}
