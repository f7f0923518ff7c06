// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "timeSeries/GroundAcceleration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

using namespace drystone;

namespace
{

std::unique_ptr<GroundAcceleration> table(std::vector<double> times, std::vector<double> values,
                                          OutOfBounds outOfBounds = OutOfBounds::zero,
                                          Interpolation interpolation = Interpolation::linear)
{
    return tabulatedAcceleration(std::move(times), std::move(values), interpolation, outOfBounds);
}

/// Simpson's rule on many parts between kinks: an integral that shares no code with the one tested.
double simpson(const GroundAcceleration& ground, double from, double to)
{
    std::vector<double> stops = ground.kinks();
    std::erase_if(stops, [&](double time) { return !(time > from && time < to); });
    stops.push_back(to);
    double sum = 0;
    for (double start = from; const double stop : stops)
    {
        constexpr int parts = 200;
        const double h = (stop - start) / parts;
        for (int i = 0; i < parts; ++i)
        {
            const double a = start + i * h;
            // just inside the piece, since the function may jump at its end
            const double b = i == parts - 1 ? std::nextafter(stop, start) : a + h;
            sum += h / 6 * (ground.at(a) + 4 * ground.at(a + h / 2) + ground.at(b));
        }
        start = stop;
    }
    return sum;
}

} // namespace

TEST(RectangularPulse, GivesItsWholeImpulseWhereverItsEdgesFallInAStep)
{
    for (const double start : {0.0, 0.1, 0.1003, 0.10099999})
    {
        const RectangularPulse pulse({3, 0.25, start});
        double impulse = 0;
        for (int i = 0; i < 100; ++i)
        {
            impulse += 0.01 * pulse.mean(i * 0.01, (i + 1) * 0.01);
        }
        EXPECT_NEAR(impulse, 0.75, 1e-14);
    }
}

TEST(RectangularPulse, IsOnFromItsStartUntilJustBeforeItsEnd)
{
    const RectangularPulse pulse({-2, 0.5, 1});
    EXPECT_EQ(pulse.at(0.999999), 0);
    EXPECT_EQ(pulse.at(1), -2);
    EXPECT_EQ(pulse.at(1.499999), -2);
    EXPECT_EQ(pulse.at(1.5), 0);
    EXPECT_EQ(pulse.peak(), 2);
    EXPECT_EQ(pulse.end(), 1.5);
}

TEST(SinePulse, HalfWaveGivesTwoOverPiOfTheRectangle)
{
    const SinePulse pulse({4, 0.5, 0.2}, 1);
    EXPECT_NEAR(pulse.integral(0, 2), 4 * 0.5 * 2 / std::numbers::pi, 1e-15);
    EXPECT_NEAR(pulse.at(0.45), 4, 1e-14);
    EXPECT_EQ(pulse.peak(), 4);
}

TEST(SinePulse, WholeWaveGivesNoImpulse)
{
    const SinePulse pulse({4, 0.5, 0.2}, 2);
    EXPECT_NEAR(pulse.integral(0, 2), 0, 1e-15);
    EXPECT_NEAR(pulse.at(0.325), 4, 1e-14);
    EXPECT_NEAR(pulse.at(0.575), -4, 1e-14);
}

TEST(SinePulse, MeanOverAVanishingStepIsTheValue)
{
    const SinePulse pulse({4, 0.5, 0}, 2);
    for (const double step : {1e-3, 1e-6, 1e-9, 1e-12})
    {
        EXPECT_NEAR(pulse.mean(0.1, 0.1 + step), pulse.at(0.1 + step / 2), 4 * step + 1e-14);
    }
    EXPECT_EQ(pulse.mean(0.1, 0.1), pulse.at(0.1));
}

TEST(ConstantAcceleration, NeverEnds)
{
    const ConstantAcceleration constant(-3);
    EXPECT_EQ(constant.mean(5, 7), -3);
    EXPECT_TRUE(std::isinf(constant.end()));
    EXPECT_EQ(constant.peak(), 3);
}

TEST(Table, IsLinearBetweenItsPointsAndZeroOrHeldOutside)
{
    const auto zero = table({1, 2, 4}, {1, 3, -1});
    EXPECT_EQ(zero->at(0.5), 0);
    EXPECT_EQ(zero->at(1), 1);
    EXPECT_EQ(zero->at(1.5), 2);
    EXPECT_EQ(zero->at(3.5), 0);
    EXPECT_EQ(zero->at(5), 0);
    EXPECT_EQ(zero->integral(0, 10), 2 + 2);
    const auto held = table({1, 2, 4}, {1, 3, -1}, OutOfBounds::clamp);
    EXPECT_EQ(held->at(0.5), 1);
    EXPECT_EQ(held->at(5), -1);
    EXPECT_EQ(held->integral(0, 10), 1 + 2 + 2 - 6);
}

TEST(Table, AJumpIsATimeThatStandsTwice)
{
    const auto step = table({0, 1, 1, 2}, {0, 0, 3, 3});
    EXPECT_EQ(step->at(std::nextafter(1.0, 0.0)), 0);
    EXPECT_EQ(step->at(1), 3);
    EXPECT_EQ(step->integral(0.5, 1.5), 1.5);
    EXPECT_EQ(step->integral(0.5, 1), 0);
    EXPECT_EQ(step->integral(1, 1.25), 0.75);
    EXPECT_EQ(step->kinks(), (std::vector<double>{0, 1, 2}));
}

TEST(Table, IntegralOfEveryInterpolationAgreesWithQuadrature)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> value(-3, 3);
    std::vector<double> times;
    std::vector<double> values;
    for (double time = 0.3; times.size() < 40; time += 0.1 + 0.03 * (value(random) + 3))
    {
        times.push_back(time);
        values.push_back(value(random));
    }
    for (const auto interpolation :
         {Interpolation::linear, Interpolation::cubic, Interpolation::akima, Interpolation::steffen})
    {
        for (const auto beyond : {OutOfBounds::zero, OutOfBounds::clamp})
        {
            const auto motion = table(times, values, beyond, interpolation);
            for (int i = 0; i < 50; ++i)
            {
                const double from = 2 * value(random) + 5;
                const double to = from + std::abs(value(random));
                EXPECT_NEAR(motion->integral(from, to), simpson(*motion, from, to), 1e-10);
            }
            for (std::size_t i = 0; i + 1 < times.size(); ++i)
            {
                EXPECT_NEAR(motion->at(times[i]), values[i], 1e-14);
            }
        }
    }
}

TEST(Table, SteffenStaysWithinItsPointsAndCubicMayNot)
{
    const std::vector<double> times{0, 1, 2, 3, 4, 5};
    const std::vector<double> values{0, 0, 0, 1, 1, 1};
    EXPECT_EQ(table(times, values, OutOfBounds::clamp, Interpolation::steffen)->peak(), 1);
    EXPECT_GT(table(times, values, OutOfBounds::clamp, Interpolation::cubic)->peak(), 1.02);
}

TEST(Table, OfFewPointsAsksForStepsThatFollowItsPulses)
{
    const double never = std::numeric_limits<double>::infinity();
    const auto longest = [](std::vector<double> times, std::vector<double> values, double time,
                            Interpolation interpolation = Interpolation::linear)
    {
        return tabulatedAcceleration(std::move(times), std::move(values), interpolation, OutOfBounds::clamp)
            ->stepBounds(time)
            .longest;
    };
    const std::vector<double> jumps{0, 1, 1, 1.2, 1.2, 2.2, 3};
    const std::vector<double> steps{0, 0, 5, 5, 1, 1, 0};
    for (const auto& [time, expected] :
         {std::pair{0.5, never}, {1, 0.01}, {1.1, 0.01}, {1.2, 0.09}, {2.5, 0.09}, {3, never}})
    {
        EXPECT_NEAR(std::min(longest(jumps, steps, time), 9.0), std::min(expected, 9.0), 1e-12) << time;
    }
    // A ramp that stands for a jump is part of its pulse, and a change of sign parts two.
    EXPECT_NEAR(longest({0, 0.001, 2, 2.001}, {0, 3, 3, 0}, 0), 2.001 / 20, 1e-12);
    EXPECT_NEAR(longest({0, 1, 2, 3, 4}, {0, 1, -3, 0, 2}, 1.24), 1.25 / 20, 1e-12);
    EXPECT_NEAR(longest({0, 1, 2, 3, 4}, {0, 1, -3, 0, 2}, 1.26), 1.75 / 20, 1e-12);
    EXPECT_NEAR(longest({0, 1, 2, 3, 4}, {0, 1, -3, 0, 2}, 3), 1.0 / 20, 1e-12);
    EXPECT_NEAR(longest({0, 1, 2}, {0, 1, 0}, 1, Interpolation::cubic), 2.0 / 20, 1e-12);
    EXPECT_NEAR(longest({0, 1, 1.001}, {5, -1e-9, 0}, 0.5), 1.0 / 20, 1e-12);
    EXPECT_EQ(longest({0, 1, 1.001}, {5, -1e-9, 0}, 1), never);
    // Samples are what the steps end at.
    std::vector<double> times;
    for (std::size_t i = 0; i <= fewestSamples; ++i)
    {
        times.push_back(static_cast<double>(i));
    }
    EXPECT_EQ(longest(times, std::vector<double>(times.size(), 1), 0.5), never);
}

TEST(Table, OfOnePointIsConstantWhenHeld)
{
    EXPECT_EQ(table({1}, {3}, OutOfBounds::clamp)->at(20), 3);
    EXPECT_EQ(table({1}, {3}, OutOfBounds::zero)->at(1), 0);
}

TEST(Table, RefusesWhatIsNotAFunctionOfTime)
{
    EXPECT_THROW(table({}, {}), std::domain_error);
    EXPECT_THROW(table({0, 1}, {1}), std::domain_error);
    EXPECT_THROW(table({0, 2, 1}, {1, 1, 1}), std::domain_error);
    EXPECT_THROW(table({0, 1}, {1, NAN}), std::domain_error);
    EXPECT_THROW(table({0, 1, 1}, {1, 1, 1}, OutOfBounds::zero, Interpolation::cubic), std::domain_error);
    EXPECT_THROW(table({0, 1}, {1, 1}, OutOfBounds::zero, Interpolation::akima), std::domain_error);
}
