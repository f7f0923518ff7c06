// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The reference solutions against figures that were computed independently of this project.
#include "ensembles/References.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace drystone;

namespace
{

constexpr double g = 9.81;
const RockingBlock slender{0.5, 2.0, g};

std::unique_ptr<GroundAcceleration> rectangular(double amplitude)
{
    return std::make_unique<RectangularPulse>(PulseShape{amplitude, 0.5, 0});
}

std::unique_ptr<GroundAcceleration> halfSine(double amplitude)
{
    return std::make_unique<SinePulse>(PulseShape{amplitude, 0.5, 0}, 1);
}

std::unique_ptr<GroundAcceleration> oneSine(double amplitude)
{
    return std::make_unique<SinePulse>(PulseShape{amplitude, 0.5, 0}, 2);
}

RockingVerdict verdict(const std::unique_ptr<GroundAcceleration>& ground)
{
    return rockingMotion(slender, *ground, {}).verdict;
}

} // namespace

TEST(RockingBlock, HasTheParametersOfHousner)
{
    EXPECT_NEAR(slender.radius(), 1.03077641, 1e-8);
    EXPECT_NEAR(slender.slenderness(), 0.24497866, 1e-8);
    EXPECT_NEAR(slender.frequencyParameter(), 2.67167053, 1e-8);
    EXPECT_NEAR(slender.restitution(), 0.911765, 5e-7);
}

TEST(RockingBlock, PeriodFromHalfTheCriticalAngle)
{
    EXPECT_NEAR(rockingPeriod(slender, slender.slenderness() / 2), 1.975213, 5e-7);
    EXPECT_NEAR(rockingPeriodLinearised(slender, slender.slenderness() / 2), 1.971737, 5e-7);
}

TEST(RockingBlock, OverturnsAtTheThresholdOfEachPulse)
{
    EXPECT_NEAR(overturningThreshold(slender, rectangular, 0.3 * g, 0.4 * g) / g, 0.339036, 5e-7);
    EXPECT_NEAR(overturningThreshold(slender, halfSine, 0.4 * g, 0.6 * g) / g, 0.493767, 5e-7);
}

TEST(RockingBlock, OneSineHasASafeIslandBetweenItsOverturningThresholds)
{
    // known to one unit of the last digit
    EXPECT_NEAR(overturningThreshold(slender, oneSine, 0.5 * g, 0.7 * g) / g, 0.60626, 1e-5);
    EXPECT_NEAR(overturningThreshold(slender, oneSine, 1.5 * g, 1.6 * g) / g, 1.54692, 1e-5);
    EXPECT_NEAR(overturningThreshold(slender, oneSine, 1.6 * g, 1.7 * g) / g, 1.67415, 1e-5);
    EXPECT_EQ(verdict(oneSine(0.60 * g)), RockingVerdict::stands);
    EXPECT_EQ(verdict(oneSine(1.00 * g)), RockingVerdict::overturns);
    EXPECT_EQ(verdict(oneSine(1.60 * g)), RockingVerdict::stands);
    EXPECT_EQ(verdict(oneSine(1.70 * g)), RockingVerdict::overturns);
}

TEST(RockingBlock, DoesNotMoveBelowTheAccelerationThatLiftsIt)
{
    const auto history = rockingMotion(slender, RectangularPulse({0.2499 * g, 0.5, 0.1}), {});
    EXPECT_EQ(history.verdict, RockingVerdict::stands);
    EXPECT_EQ(history.largestRotation, 0);
    EXPECT_GT(rockingMotion(slender, RectangularPulse({0.2501 * g, 0.5, 0.1}), {}).largestRotation, 1e-6);
}

TEST(RockingBlock, MirroredMotionIsMirrored)
{
    RockingRun run;
    run.endTime = 4;
    run.untilVerdict = false;
    run.sampleTimes = {0.3, 0.9, 2.0, 3.7};
    const auto right = rockingMotion(slender, *halfSine(0.45 * g), run);
    const auto left = rockingMotion(slender, *halfSine(-0.45 * g), run);
    ASSERT_EQ(right.samples.size(), 4u);
    ASSERT_EQ(left.samples.size(), 4u);
    EXPECT_GT(right.samples[0].rotation,
              0.01); // the ground goes right, the block tips left: counter-clockwise
    for (std::size_t i = 0; i < 4; ++i)
    {
        EXPECT_EQ(right.samples[i].rotation, -left.samples[i].rotation);
    }
}

TEST(RockingBlock, FreeRockingLosesTheSameShareInEachImpactAndEnds)
{
    RockingRun run;
    run.start.rotation = 0.1;
    run.untilVerdict = false;
    run.endTime = 60;
    const auto history = rockingMotion(slender, ConstantAcceleration(0), run);
    ASSERT_GT(history.impacts.size(), 100u);
    const double speed = std::abs(history.impacts[0].velocityBefore);
    for (std::size_t i = 0; i < 30; ++i)
    {
        EXPECT_NEAR(std::abs(history.impacts[i].velocityBefore) / speed, std::pow(slender.restitution(), i),
                    1e-9);
    }
    EXPECT_EQ(history.last.rotation, 0);
    EXPECT_EQ(history.last.angularVelocity, 0);
    EXPECT_EQ(history.last.time, 60);
}

TEST(RockingBlock, EnergyAtTheFirstImpactIsThePotentialEnergyAtTheStart)
{
    RockingRun run;
    run.start.rotation = 0.12;
    run.endTime = 1;
    run.untilVerdict = false;
    const auto history = rockingMotion(slender, ConstantAcceleration(0), run);
    const double alpha = slender.slenderness();
    const double p = slender.frequencyParameter();
    const double speed = p * std::sqrt(2 * (std::cos(alpha - 0.12) - std::cos(alpha)));
    EXPECT_NEAR(history.impacts.at(0).velocityBefore, -speed, 1e-12);
}

TEST(SlidingBlock, ClosedForms)
{
    EXPECT_NEAR(slidingDistance(1, 0.6), 0.0849473, 5e-8);
    EXPECT_NEAR(newmarkPulseDistance(0.5 * g, 0.5, 0.2), 0.9196875, 1e-12);
    EXPECT_EQ(newmarkPulseDistance(0.2 * g, 0.5, 0.2), 0);
}

TEST(SlidingBlock, IntegratedMotionUnderAPulseReachesTheClosedForm)
{
    const auto states = slidingMotion(RectangularPulse({0.5 * g, 0.5, 0.1}), 0.2, {0.05, 0.6, 1.3, 10});
    ASSERT_EQ(states.size(), 4u);
    EXPECT_EQ(states[0].displacement, 0);
    EXPECT_NEAR(states[1].velocity, -0.3 * g * 0.5, 1e-12);
    EXPECT_LT(states[2].velocity, 0);
    EXPECT_NEAR(states[3].displacement, -newmarkPulseDistance(0.5 * g, 0.5, 0.2), 1e-11);
    EXPECT_EQ(states[3].velocity, 0);
}

TEST(SlidingBlock, SlidesBothWaysUnderASineAndComesToRest)
{
    const SinePulse sine({0.6 * g, 2, 0}, 8);
    const auto there = slidingMotion(sine, 0.3, {0.3, 0.5, 5});
    EXPECT_LT(there[0].velocity, 0);
    EXPECT_GT(there[1].velocity, 0);
    EXPECT_EQ(there[2].velocity, 0);
    // no faster than without friction, and the same mirrored
    EXPECT_LT(std::abs(there[0].velocity), sine.integral(0, 0.3));
    const auto back = slidingMotion(SinePulse({-0.6 * g, 2, 0}, 8), 0.3, {0.3, 0.5, 5});
    for (std::size_t i = 0; i < 3; ++i)
    {
        EXPECT_EQ(back[i].displacement, -there[i].displacement);
    }
    for (const double mu : {0.6, 0.61})
    {
        EXPECT_EQ(slidingMotion(sine, mu, {5})[0].displacement, 0);
    }
}

TEST(BouncingBlock, HeightIsContinuousAndEachTopIsLowerByTheSquareOfTheRestitution)
{
    const double fall = std::sqrt(2 / g);
    EXPECT_DOUBLE_EQ(bouncingHeight(1, 0.8, 0), 1);
    EXPECT_NEAR(bouncingHeight(1, 0.8, fall), 0, 1e-12);
    EXPECT_NEAR(bouncingHeight(1, 0.8, fall * 1.8), 0.64, 1e-12);
    EXPECT_NEAR(bouncingHeight(1, 0.8, fall * (1 + 1.6 + 0.64)), 0.8 * 0.8 * 0.64, 1e-12);
    EXPECT_EQ(bouncingHeight(1, 0.8, 5), 0);
    EXPECT_NEAR(bouncingHeight(1, 0.8, bouncingTime(1, 0.8) - 1e-9), 0, 1e-12);
}

TEST(BouncingBlock, RestsAfterTheSumOfItsHops)
{
    EXPECT_DOUBLE_EQ(bouncingTime(1, 0.8), 9 * std::sqrt(2 / g));
    EXPECT_NEAR(bouncingTime(1, 0.8), 4.063714, 2e-6);
    EXPECT_THROW(bouncingTime(1, 1), std::domain_error);
}
