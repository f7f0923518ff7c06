// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A rocking block against Housner's equation: impact, period, order of convergence, overturning.
#include "Scenes.h"

#include "contact/Penetration.h"
#include "ensembles/References.h"

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

// Block 0.5 x 2.0 m.
constexpr double width = 0.5;
constexpr double height = 2;
const double radius = 0.5 * std::hypot(width, height);
const double slenderness = std::atan(width / height);
const double frequency2 = 3 * g / (4 * radius); // p^2

Assembly<2> slenderBlockOnGround()
{
    Assembly<2> assembly = scenes::ground(-4, 4);
    assembly.blocks.push_back(scenes::rectangle(-width / 2, 0, width, height));
    return assembly;
}

/// Stands on one corner at a rotation, and turns about it.
DynamicState<2> tilted(const DynamicCase<2>& scene, double rotation, double angularVelocity)
{
    DynamicState<2> state = stateAtRest(scene.assembly);
    const double side = rotation > 0 ? 1 : -1; // 1: on the left corner
    const Vector<2> arm(side * width / 2, height / 2);
    const Vector<2> turned(std::cos(rotation) * arm.x() - std::sin(rotation) * arm.y(),
                           std::sin(rotation) * arm.x() + std::cos(rotation) * arm.y());
    state.placements[1] = {turned - arm, rotation};
    state.velocity << -angularVelocity * turned.y(), angularVelocity * turned.x(), angularVelocity;
    return state;
}

/// Angular velocity upright of a block that turns about a corner with `angularVelocity` at `rotation`:
/// w^2/2 - p^2 (1 - cos(alpha - |rotation|)) is kept.
double velocityUpright(double rotation, double angularVelocity)
{
    const double square =
        angularVelocity * angularVelocity
        + 2 * frequency2 * (std::cos(slenderness - std::abs(rotation)) - std::cos(slenderness));
    return std::sqrt(square);
}

/// Ratio of the angular velocities after and before an impact, both taken upright. \param rotation at the
/// start: with it the phase of the step in which the impact falls
double impactRatio(const scenes::Settings& settings, double timeStep, double rotation)
{
    const DynamicCase<2> scene = scenes::sceneOf(slenderBlockOnGround(), settings);
    const double speed = 1;
    Motion<2> motion = startMotion(scene, tilted(scene, rotation, std::copysign(speed, -rotation)));
    const double before = velocityUpright(rotation, speed);
    // until it turns on the other corner, clear of the impact, which may take two steps
    for (int step = 0;
         step < 1000 && motion.state.placements[1].rotation * std::copysign(1, rotation) > -5 * timeStep;
         ++step)
    {
        EXPECT_TRUE(advance(scene, motion, timeStep)) << "at " << motion.state.time << " s";
        EXPECT_LT(scenes::relativeImbalance(motion.energy), 1e-10);
    }
    return velocityUpright(motion.state.placements[1].rotation, motion.state.velocity[2]) / before;
}

constexpr std::array bothFlowRules{FlowRule::associative, FlowRule::nonAssociative};

void expectHousnersRatio(double theta, double timeStep)
{
    const double housner = 1 - 1.5 * std::pow(std::sin(slenderness), 2); // 0.911765
    for (const FlowRule flowRule : bothFlowRules)
    {
        for (const double side : {1, -1})
        {
            for (int phase = 0; phase < 20; ++phase)
            {
                const double rotation = side * timeStep * (3 + phase / 20.0);
                EXPECT_NEAR(impactRatio({.theta = theta, .mu = 1, .flowRule = flowRule}, timeStep, rotation),
                            housner, 1e-3)
                    << "theta " << theta << ", phase " << phase << ", side " << side;
            }
        }
    }
}

TEST(Rocking, AnImpactTakesWhatHousnerSaysWhereverInTheStepItFalls)
{
    expectHousnersRatio(1, 1e-4);
}

TEST(Rocking, SoItDoesWithTheTrapezoidalRule)
{
    expectHousnersRatio(0.5, 5e-5);
}

TEST(Rocking, WithTheTrapezoidalRuleSoItDoesAtLongSteps)
{
    const double housner = 1 - 1.5 * std::pow(std::sin(slenderness), 2);
    for (const double timeStep : {4e-3, 1e-3, 1e-4})
    {
        double error = 0;
        for (int phase = 0; phase < 20; ++phase)
        {
            const double rotation = timeStep * (3 + phase / 20.0);
            error =
                std::max(error, std::abs(impactRatio({.theta = 0.5, .mu = 1}, timeStep, rotation) - housner));
        }
        std::cout << "step " << timeStep << " s: ratio off by at most " << error << '\n';
        EXPECT_LT(error, 1e-4 * timeStep / 1e-3 + 1e-5);
    }
}

/// Four times the time from release, at half the critical angle, to upright.
double period(const scenes::Settings& settings, double timeStep, double side = 1)
{
    const DynamicCase<2> scene = scenes::sceneOf(slenderBlockOnGround(), settings);
    Motion<2> motion = startMotion(scene, tilted(scene, side * slenderness / 2, 0));
    while (motion.state.time < 1)
    {
        const double rotation = side * motion.state.placements[1].rotation;
        const double speed = -side * motion.state.velocity[2];
        if (rotation < 2 * timeStep * speed)
        {
            // speed t + a t^2/2 = rotation, a the angular acceleration upright
            const double a = frequency2 * std::sin(slenderness);
            return 4 * (motion.state.time + (std::sqrt(speed * speed + 2 * a * rotation) - speed) / a);
        }
        EXPECT_TRUE(advance(scene, motion, timeStep)) << "at " << motion.state.time << " s";
        EXPECT_LT(scenes::relativeImbalance(motion.energy), 1e-10);
    }
    ADD_FAILURE() << "it does not return";
    return 0;
}

TEST(Rocking, PeriodOfFreeRockingIsThatOfHousnersEquation)
{
    for (const double theta : {1.0, 0.5})
    {
        for (const FlowRule flowRule : bothFlowRules)
        {
            for (const double side : {1, -1})
            {
                EXPECT_NEAR(period({.theta = theta, .mu = 1, .flowRule = flowRule}, 1e-3, side), 1.975213,
                            0.005 * 1.975213);
            }
        }
    }
}

/// A solver that ends inside the cones leaves some force at points that are far apart. They do not collide.
TEST(Rocking, NoCornerIsHitThatOnlyASolverPressesOn)
{
    const double exact = rockingPeriod({width, height, g}, slenderness / 2);
    for (const SolverType solver : {SolverType::interiorPoint, SolverType::augmentedLagrangian})
    {
        for (const double tolerance : {1e-4, 1e-6, 1e-8})
        {
            for (const double timeStep : {0.01, 0.002})
            {
                EXPECT_NEAR(period({.theta = 0.5,
                                    .mu = 1,
                                    .flowRule = FlowRule::associative,
                                    .tolerance = tolerance,
                                    .solver = solver},
                                   timeStep),
                            exact, 2e-3 * exact)
                    << nameOf(solver) << ", tolerance " << tolerance << ", step " << timeStep;
            }
        }
    }
}

/// Slope of the logarithm of the error of the period over that of the step, by least squares.
double orderOfConvergence(double theta, const std::vector<double>& timeSteps)
{
    const double exact = rockingPeriod({width, height, g}, slenderness / 2);
    double sumX = 0, sumY = 0, sumXX = 0, sumXY = 0;
    for (const double timeStep : timeSteps)
    {
        const double error = std::abs(period({.theta = theta, .mu = 1}, timeStep) / exact - 1);
        const double x = std::log(timeStep);
        const double y = std::log(error);
        sumX += x;
        sumY += y;
        sumXX += x * x;
        sumXY += x * y;
        std::cout << "theta " << theta << ", step " << timeStep << " s: relative error " << error << '\n';
    }
    const double n = static_cast<double>(timeSteps.size());
    return (n * sumXY - sumX * sumY) / (n * sumXX - sumX * sumX);
}

TEST(Rocking, BackwardEulerIsOfFirstOrder)
{
    EXPECT_NEAR(orderOfConvergence(1, {8e-3, 4e-3, 2e-3, 1e-3, 5e-4}), 1, 0.05);
}

TEST(Rocking, TheTrapezoidalRuleIsOfSecondOrder)
{
    EXPECT_NEAR(orderOfConvergence(0.5, {8e-3, 4e-3, 2e-3, 1e-3}), 2, 0.1);
}

enum class Verdict
{
    stands,
    overturns,
    rocks ///< neither within six seconds
};

Verdict verdictAfter(const scenes::Settings& settings, std::shared_ptr<const GroundAcceleration> pulse)
{
    DynamicCase<2> scene = scenes::sceneOf(slenderBlockOnGround(), settings);
    const double still = pulse->end();
    scenes::shake(scene, std::move(pulse));
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    const Placement<2>& block = motion.state.placements[1];
    while (motion.state.time < 6)
    {
        EXPECT_TRUE(advance(scene, motion, 1e-3)) << "at " << motion.state.time << " s";
        EXPECT_LT(scenes::relativeImbalance(motion.energy), 1e-10);
        // far beyond the critical angle, or turned back after the end of the pulse
        if (std::abs(block.rotation) > 1)
        {
            return Verdict::overturns;
        }
        if (motion.state.time > still && std::abs(block.rotation) < 1e-2)
        {
            return Verdict::stands;
        }
    }
    return Verdict::rocks;
}

template<class MakePulse>
void expectOverturningAt(double threshold, const MakePulse& pulse)
{
    for (const double direction : {1, -1})
    {
        for (const scenes::Settings& settings :
             {scenes::Settings{.theta = 1, .mu = 1, .flowRule = FlowRule::nonAssociative},
              scenes::Settings{.theta = 1, .mu = 1, .flowRule = FlowRule::associative},
              scenes::Settings{.theta = 0.5, .mu = 1, .flowRule = FlowRule::nonAssociative}})
        {
            const PulseShape below{direction * 0.99 * threshold * g, 0.5, 0};
            const PulseShape above{direction * 1.01 * threshold * g, 0.5, 0};
            EXPECT_EQ(verdictAfter(settings, pulse(below)), Verdict::stands) << direction;
            EXPECT_EQ(verdictAfter(settings, pulse(above)), Verdict::overturns) << direction;
        }
    }
}

TEST(Rocking, ARectangularPulseOverturnsAtItsThreshold)
{
    expectOverturningAt(0.339036,
                        [](const PulseShape& shape) { return std::make_shared<RectangularPulse>(shape); });
}

TEST(Rocking, AHalfSinePulseOverturnsAtItsThreshold)
{
    expectOverturningAt(0.493767,
                        [](const PulseShape& shape) { return std::make_shared<SinePulse>(shape, 1.0); });
}

/// A block that leans on its lower corner, at one place with the upper corner of a fixed one. Its faces rise
/// by atan(0.27) to both sides and those below fall by atan(0.2), 26 degrees together: beyond what makes
/// faces a joint.
Assembly<2> cornerOnCorner()
{
    Assembly<2> assembly;
    assembly.supports.push_back({"ground", "ground"});
    assembly.blocks.push_back({{{-1, -0.2}, {-1, -1}, {1, -1}, {1, -0.2}, {0, 0}}, 1, 0});
    assembly.blocks.push_back({{{0, 0}, {1, 0.27}, {1, 1}, {-1, 1}, {-1, 0.27}}, 1, -1});
    return assembly;
}

TEST(Rocking, ABlockTurnsOnACornerThatStandsOnACornerFromRestWithoutSinkingIn)
{
    for (const double theta : {1.0, 0.5})
    {
        for (const double rotation : {0.0, 0.02, -0.02})
        {
            const DynamicCase<2> scene = scenes::sceneOf(cornerOnCorner(), {.theta = theta});
            DynamicState<2> state = stateAtRest(scene.assembly);
            const Vector<2> arm = areaProperties(scene.assembly.blocks[1].outline).centroid;
            state.placements[1] = {Eigen::Rotation2Dd(rotation) * arm - arm, rotation};
            Motion<2> motion = startMotion(scene, state);
            const double energyAtStart = motion.energy.kinetic + motion.energy.potential;
            for (int step = 0; step < 60; ++step)
            {
                ASSERT_TRUE(advance(scene, motion, 0.005));
                const Placement<2>& block = motion.state.placements[1];
                const Vector<2> corner = block.translation + arm - Eigen::Rotation2Dd(block.rotation) * arm;
                EXPECT_LT(penetration(scene.assembly, motion.state.placements).depth, 1e-6) << step;
                EXPECT_LT(corner.norm(), 1e-5) << step << " with theta " << theta;
                EXPECT_LT(motion.energy.kinetic + motion.energy.potential, energyAtStart + 1e-3);
            }
            EXPECT_GE(motion.state.placements[1].rotation * rotation, rotation * rotation);
        }
    }
}

} // namespace
} // namespace drystone
