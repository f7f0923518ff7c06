// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Impacts within steps: how errors fall with the step when blocks collide where they meet.
#include "Scenes.h"

#include "ensembles/References.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace drystone
{
namespace
{

/// When a block dropped flat from 1 m is at rest [s].
double timeAtRest(const scenes::Settings& settings, double timeStep, double phase)
{
    Assembly<2> assembly = scenes::ground(-4, 4);
    assembly.blocks.push_back(scenes::rectangle(0, 0, 1, 0.4));
    const DynamicCase<2> scene = scenes::sceneOf(assembly, settings);
    const double early = phase * timeStep;
    DynamicState<2> start = stateAtRest(scene.assembly);
    start.placements[1].translation.y() = 1 - 0.5 * g * early * early;
    start.velocity[1] = -g * early;
    Motion<2> motion = startMotion(scene, start);
    double atRest = 0;
    while (motion.state.time < 1.1 * bouncingTime(1, settings.restitution))
    {
        if (!advance(scene, motion, timeStep))
        {
            ADD_FAILURE() << "not solved at " << motion.state.time << " s";
            return 0;
        }
        atRest = motion.state.velocity.norm() > 1e-6 ? motion.state.time : atRest;
    }
    return atRest + early;
}

/// The largest error over phases of the step [s].
double errorOfRest(scenes::Settings settings, double timeStep)
{
    double error = 0;
    for (const double phase : {0.0, 0.3, 0.7})
    {
        error = std::max(
            error, std::abs(timeAtRest(settings, timeStep, phase) - bouncingTime(1, settings.restitution)));
    }
    return error;
}

// A step in which a block lands is parted there; each point has its own impulse of the parts, in small
// displacements as in large ones.
TEST(ImpactInstants, EveryPointOfAPartedStepHasAnImpulseOfItsOwn)
{
    for (const bool small : {false, true})
    {
        Assembly<2> assembly = scenes::ground(-4, 4);
        assembly.blocks.push_back(scenes::rectangle(0, 0, 1, 0.4));
        DynamicCase<2> scene = scenes::sceneOf(assembly, {.theta = 0.5, .restitution = 0.5});
        scene.schemes.smallDisplacements = small;
        DynamicState<2> start = stateAtRest(scene.assembly);
        start.placements[1].translation.y() = 5e-3;
        start.velocity[1] = -1;
        Motion<2> motion = startMotion(scene, start);
        ASSERT_TRUE(advance(scene, motion, 1e-2));
        EXPECT_GT(motion.state.velocity[1], 0) << "it has rebounded";
        const std::vector<Vector<2>>& forces = meanContactForces(motion);
        ASSERT_EQ(forces.size(), 2u);
        EXPECT_GT(forces[0].x(), 0);
        EXPECT_NEAR(forces[0].x(), forces[1].x(), 1e-6 * forces[0].x()) << (small ? "small" : "large");
    }
}

// A plate that lands flat and sideways: impulses P = (1 + e) m v and mu P, of which friction takes mu P times
// the mean of its velocities sideways, and the normal forces m v^2 (1 - e^2)/2.
TEST(ImpactInstants, FrictionOfAnImpactIsFrictionLoss)
{
    constexpr double mu = 0.2;
    constexpr double restitution = 0.5;
    for (const double theta : {0.5, 1.0})
    {
        Assembly<2> assembly = scenes::ground(-40, 40);
        assembly.blocks.push_back(scenes::rectangle(0, 0, 1, 0.02));
        const DynamicCase<2> scene = scenes::sceneOf(
            assembly,
            {.theta = theta, .mu = mu, .flowRule = FlowRule::nonAssociative, .restitution = restitution});
        DynamicState<2> start = stateAtRest(scene.assembly);
        start.placements[1].translation.y() = 0.5;
        start.velocity[0] = 6;
        Motion<2> motion = startMotion(scene, start);
        while (motion.state.time < 0.4)
        {
            ASSERT_TRUE(advance(scene, motion, 1e-3));
        }
        const double mass = scene.mass(0, 0);
        const double fall = std::sqrt(2 * g * 0.5);
        const double drag = mu * (1 + restitution) * fall;
        EXPECT_NEAR(motion.energy.frictionLoss / (mass * drag * (6 - drag / 2)), 1, 0.01) << theta;
        EXPECT_NEAR(motion.energy.impactLoss / (mass * fall * fall * (1 - restitution * restitution) / 2), 1,
                    0.02)
            << theta;
    }
}

TEST(ImpactInstants, ABounceEndsWithinTwoStepsOfItsTimeForEveryTheta)
{
    for (const double theta : {1.0, 0.75, 0.5})
    {
        for (const double timeStep : {4e-3, 1e-3})
        {
            const double located = errorOfRest({.theta = theta, .restitution = 0.8}, timeStep);
            const double before = errorOfRest(
                {.theta = theta, .restitution = 0.8, .impacts = ImpactInstant::stepStart}, timeStep);
            std::cout << "theta " << theta << ", step " << timeStep << " s: at rest " << located
                      << " s off, with impacts at the start of steps " << before << " s\n";
            EXPECT_LT(located, 2 * timeStep) << "theta " << theta;
        }
    }
}

const RockingBlock slender{0.5, 2, g};

DynamicCase<2> rockingScene(const scenes::Settings& settings, const std::vector<double>& cuts = {})
{
    Assembly<2> assembly = scenes::ground(-4, cuts.empty() ? 4 : cuts.front());
    assembly.blocks.push_back(scenes::rectangle(-0.25, 0, 0.5, 2));
    for (std::size_t i = 0; i < cuts.size(); ++i)
    {
        const double right = i + 1 < cuts.size() ? cuts[i + 1] : 4;
        assembly.blocks.push_back(scenes::rectangle(cuts[i], -1, right - cuts[i], 1));
        assembly.blocks.back().support = 0;
    }
    return scenes::sceneOf(assembly, settings);
}

/// The time of the third return to upright of a block released at half its critical angle: two impacts are
/// behind it [s].
double thirdReturn(const scenes::Settings& settings, double timeStep, const std::vector<double>& cuts = {})
{
    const DynamicCase<2> scene = rockingScene(settings, cuts);
    DynamicState<2> start = stateAtRest(scene.assembly);
    const double rotation = slender.slenderness() / 2;
    const Vector<2> arm(0.25, 1);
    start.placements[1] = {Eigen::Rotation2Dd(rotation) * arm - arm, rotation};
    Motion<2> motion = startMotion(scene, start);
    int returns = 0;
    while (motion.state.time < 5)
    {
        const double before = motion.state.placements[1].rotation;
        const double then = motion.state.time;
        const double speed = motion.state.velocity[2];
        EXPECT_TRUE(advance(scene, motion, timeStep)) << "at " << motion.state.time << " s";
        const double after = motion.state.placements[1].rotation;
        returns += before * after < 0 || (after == 0 && before != 0) ? 1 : 0;
        if (returns == 3)
        {
            // speed t + a t^2/2 = rotation, a the angular acceleration upright
            const double a = std::pow(slender.frequencyParameter(), 2) * std::sin(slender.slenderness());
            const double v = std::abs(speed);
            return then + (std::sqrt(v * v + 2 * a * std::abs(before)) - v) / a;
        }
    }
    ADD_FAILURE() << "it does not return three times";
    return 0;
}

double exactThirdReturn()
{
    RockingRun run;
    run.start.rotation = slender.slenderness() / 2;
    run.untilVerdict = false;
    run.endTime = 5;
    return rockingMotion(slender, ConstantAcceleration(0), run).impacts.at(2).time;
}

TEST(ImpactInstants, WithTheTrapezoidalRuleRockingIsOfSecondOrderThroughItsImpacts)
{
    const double exact = exactThirdReturn();
    for (const double timeStep : {8e-3, 4e-3, 2e-3, 1e-3})
    {
        const auto errorOf = [&](ImpactInstant impacts, double step)
        {
            double error = 0;
            for (const double phase : {0.0, 0.03, 0.07}) // of the step, by its length
            {
                error = std::max(error, std::abs(thirdReturn({.theta = 0.5, .mu = 1, .impacts = impacts},
                                                             step * (1 + phase))
                                                     / exact
                                                 - 1));
            }
            return error;
        };
        const double located = errorOf(ImpactInstant::located, timeStep);
        std::cout << "step " << timeStep << " s: third return " << located
                  << " off, with impacts at the start of steps "
                  << errorOf(ImpactInstant::stepStart, timeStep) << '\n';
        EXPECT_LT(located, 1e-5 * std::pow(timeStep / 1e-3, 2) + 1e-6);
    }
}

// Its joint then has points that land together with the corner, between it and the one it turns on.
TEST(ImpactInstants, ABlockRocksOnGroundInPiecesAsOnOne)
{
    constexpr double timeStep = 2e-3;
    const scenes::Settings settings{.theta = 0.5, .mu = 1};
    const double exact = exactThirdReturn();
    for (const std::vector<double>& cuts : {std::vector<double>{0}, std::vector<double>{-0.1, 0.1},
                                            std::vector<double>{-0.2, -0.1, 0, 0.1, 0.2}})
    {
        EXPECT_NEAR(thirdReturn(settings, timeStep, cuts) / exact, 1, 4e-5) << cuts.size() + 1 << " pieces";
    }
}

/// Three blocks in a row without friction, of masses 1, 1, 2, collide twice, at velocities that elastic
/// impacts exchange in turn: v1 = -2/3, v2 = 0, v3 = 4/3 after a start with v1 = 2. Both impacts are of whole
/// faces, so that no block turns, wherever in the step they fall.
void collideInARow(const scenes::Settings& settings, double gap, double timeStep)
{
    Assembly<2> assembly = scenes::ground(-20, 20);
    assembly.blocks.push_back(scenes::rectangle(0, 0, 1, 1));
    assembly.blocks.push_back(scenes::rectangle(2, 0, 1, 1));
    assembly.blocks.push_back(scenes::rectangle(3 + gap, 0, 2, 1));
    const DynamicCase<2> scene = scenes::sceneOf(assembly, settings);
    DynamicState<2> start = stateAtRest(scene.assembly);
    start.velocity[0] = 2;
    Motion<2> motion = startMotion(scene, start);
    const bool isLocated = settings.impacts == ImpactInstant::located;
    while (motion.state.time < 2)
    {
        ASSERT_TRUE(advance(scene, motion, timeStep));
        EXPECT_TRUE(!isLocated || motion.restitutionShare > 0.999); // else gravity adds to what is closing
    }
    const double secondImpact = 0.5 + gap / 2;
    const double error = isLocated ? 1e-3 : 3; // in steps, at 1 m/s
    EXPECT_NEAR(motion.state.placements[3].translation.x(), 4.0 / 3 * (motion.state.time - secondImpact),
                error * timeStep);
    for (const auto& [block, velocity] : {std::pair{0, -2.0 / 3}, {1, 0.0}, {2, 4.0 / 3}})
    {
        EXPECT_NEAR(motion.state.velocity[3 * block], velocity, 1e-5);
        EXPECT_NEAR(motion.state.velocity[3 * block + 1], 0, 1e-4);
        EXPECT_NEAR(motion.state.velocity[3 * block + 2], 0, 1e-4);
    }
}

TEST(ImpactInstants, BlocksInARowCollideFaceToFace)
{
    for (const ImpactInstant instant : {ImpactInstant::located, ImpactInstant::stepStart})
    {
        for (const double gap : {0.5, 0.513})
        {
            for (const double theta : {0.5, 0.7, 1.0})
            {
                for (const double timeStep : {0.02, 0.0097})
                {
                    SCOPED_TRACE(fmt::format("{}, gap {}, theta {}, step {}",
                                             instant == ImpactInstant::located ? "located" : "step start",
                                             gap, theta, timeStep));
                    collideInARow({.theta = theta, .mu = 0, .restitution = 1, .impacts = instant}, gap,
                                  timeStep);
                }
            }
        }
    }
}

// Elastic blocks in a row, the fourth of which would arrive exactly at the end of a step: its face carries
// forces of rounding there, which do not say which of its corners collide.
TEST(ImpactInstants, FacesThatMeetOnTheEndOfAStepCollideAsAWhole)
{
    for (const double theta : {0.5, 0.7, 1.0})
    {
        Assembly<2> assembly = scenes::ground(-50, 50);
        for (int block = 0; block < 5; ++block)
        {
            assembly.blocks.push_back(scenes::rectangle(1.3 * block, 10, 1, 1));
        }
        const DynamicCase<2> scene = scenes::sceneOf(
            assembly,
            {.theta = theta, .restitution = 1, .gravity = {0, 0}, .impacts = ImpactInstant::stepStart});
        DynamicState<2> start = stateAtRest(scene.assembly);
        start.velocity[0] = 2;
        Motion<2> motion = startMotion(scene, start);
        while (motion.state.time < 0.65)
        {
            ASSERT_TRUE(advance(scene, motion, 0.01));
        }
        EXPECT_NEAR(motion.state.velocity[3 * 4], 2, 1e-6) << theta;
        EXPECT_LT(motion.state.velocity.head(3 * 4).norm(), 1e-6) << theta;
        EXPECT_LT(motion.state.velocity.tail(2).norm(), 1e-6) << theta;
    }
}

// Four blocks that bounce far from each other meet the ground in the same steps: each as if it was alone.
TEST(ImpactInstants, BlocksThatDoNotTouchDoNotMoveTheInstantsOfOthers)
{
    constexpr double timeStep = 0.01;
    const auto after = [&](int count)
    {
        Assembly<2> assembly = scenes::ground(-1, 40);
        for (int block = 0; block < count; ++block)
        {
            assembly.blocks.push_back(scenes::rectangle(5 * block, 1 + 0.004 * block, 1, 0.4));
        }
        const DynamicCase<2> scene = scenes::sceneOf(assembly, {.theta = 0.5, .mu = 0.6, .restitution = 1});
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        while (motion.state.time < 0.6 - 0.5 * timeStep)
        {
            EXPECT_TRUE(advance(scene, motion, timeStep));
        }
        return motion.state.velocity[1];
    };
    const double landing = std::sqrt(2 / g);
    const double exact = g * landing - g * (0.6 - landing);
    EXPECT_NEAR(after(1), exact, 1e-6);
    EXPECT_NEAR(after(4), exact, 1e-6);
}

/// Whether the block overturns under one whole sine of 0.5 s.
bool overturns(const scenes::Settings& settings, double amplitude, double timeStep)
{
    DynamicCase<2> scene = rockingScene(settings);
    scenes::shake(scene, std::make_shared<SinePulse>(PulseShape{amplitude * g, 0.5, 0}, 2.0));
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    const Placement<2>& block = motion.state.placements[1];
    const double barrier = scene.mass[0] * g * (slender.radius() - 1);
    while (motion.state.time < 10 && std::abs(block.rotation) < 1)
    {
        EXPECT_TRUE(advance(scene, motion, timeStep)) << "at " << motion.state.time << " s";
        if (motion.state.time > 0.5 && std::abs(block.rotation) < slender.slenderness()
            && motion.energy.kinetic + motion.energy.potential < barrier)
        {
            return false;
        }
    }
    return true;
}

/// The lower border of the amplitudes above 1.5 g at which it stands again [g].
double islandBorder(const scenes::Settings& settings, double timeStep)
{
    double low = 1.45;
    double high = 1.6;
    EXPECT_TRUE(overturns(settings, low, timeStep));
    EXPECT_FALSE(overturns(settings, high, timeStep));
    while (high - low > 1e-5)
    {
        const double middle = 0.5 * (low + high);
        (overturns(settings, middle, timeStep) ? low : high) = middle;
    }
    return high;
}

TEST(ImpactInstants, TheSafeIslandOfOneSineBeginsWhereHousnersEquationHasIt)
{
    const double timeStep = 1e-3;
    const auto errorOf = [&](const scenes::Settings& settings)
    { return islandBorder(settings, timeStep) / 1.54692 - 1; };
    const double located = errorOf({.theta = 0.5, .mu = 10});
    std::cout << "step " << timeStep << " s: the island begins " << located
              << " off, with impacts at the start of steps "
              << errorOf({.theta = 0.5, .mu = 10, .impacts = ImpactInstant::stepStart}) << ", with theta 1 "
              << errorOf({.theta = 1, .mu = 10}) << '\n';
    EXPECT_NEAR(located, 0, 1e-4);
}

TEST(IntegrationError, IsTheLossOfTheSchemeInFreeRockingAndProportionalToTheStep)
{
    double before = 0;
    for (const double timeStep : {2e-3, 1e-3})
    {
        const DynamicCase<2> scene = rockingScene({.theta = 1, .mu = 1});
        DynamicState<2> start = stateAtRest(scene.assembly);
        const double rotation = slender.slenderness() / 2;
        const Vector<2> arm(0.25, 1);
        start.placements[1] = {Eigen::Rotation2Dd(rotation) * arm - arm, rotation};
        Motion<2> motion = startMotion(scene, start);
        while (motion.state.time < 1.2) // through the first impact, at 0.494 s
        {
            ASSERT_TRUE(advance(scene, motion, timeStep));
            if (motion.state.time < 0.48)
            {
                EXPECT_NEAR(motion.smoothLoss, motion.energy.algorithmicLoss, 1e-9 * motion.energy.opening)
                    << "at " << motion.state.time << " s";
            }
        }
        EXPECT_LT(motion.smoothLoss, 0.25 * motion.energy.algorithmicLoss); // most of it is the impact's
        if (before > 0)
        {
            // The bounded share of the impact's own step is of second order.
            EXPECT_NEAR(motion.smoothLoss / before, 0.5, 0.12);
        }
        before = motion.smoothLoss;
    }
}

} // namespace
} // namespace drystone
