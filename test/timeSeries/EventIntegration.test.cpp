// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "timeSeries/EventIntegration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace drystone;

TEST(EventIntegration, FindsWhereAnOscillatorPassesZero)
{
    const EventProblem oscillator{[](double, const double* y, double* rate)
                                  {
                                      rate[0] = y[1];
                                      rate[1] = -y[0];
                                  },
                                  [](double, const double* y) { return y[0]; }};
    const EventOutcome outcome = integrateToEvent(oscillator, 0, {1, 0}, 10);
    EXPECT_TRUE(outcome.happened);
    EXPECT_NEAR(outcome.time, std::numbers::pi / 2, 1e-12);
    EXPECT_NEAR(outcome.state[1], -1, 1e-12);
}

TEST(EventIntegration, ReachesTheEndWhenNothingHappens)
{
    const EventProblem decay{[](double, const double* y, double* rate) { rate[0] = -y[0]; },
                             [](double, const double* y) { return y[0]; }};
    const EventOutcome outcome = integrateToEvent(decay, 1, {1}, 3);
    EXPECT_FALSE(outcome.happened);
    EXPECT_EQ(outcome.time, 3);
    EXPECT_NEAR(outcome.state[0], std::exp(-2), 1e-13);
}

TEST(EventIntegration, AnEventAtTheStartIsNotTheOneSought)
{
    // a throw that returns after 2 v/g, however short
    const EventProblem flight{[](double, const double* y, double* rate)
                              {
                                  rate[0] = y[1];
                                  rate[1] = -10;
                              },
                              [](double, const double* y) { return y[0]; }};
    for (const double speed : {1.0, 1e-4, 1e-9})
    {
        const EventOutcome outcome = integrateToEvent(flight, 0, {0, speed}, 10);
        EXPECT_TRUE(outcome.happened);
        EXPECT_NEAR(outcome.time / (0.2 * speed), 1, 1e-9);
        EXPECT_NEAR(outcome.state[1] / speed, -1, 1e-9);
    }
}

TEST(EventIntegration, AnEventThatPersistsHappensAtOnce)
{
    const EventProblem fall{[](double, const double*, double* rate) { rate[0] = -1; },
                            [](double, const double* y) { return y[0]; }};
    const EventOutcome outcome = integrateToEvent(fall, 2, {0}, 10);
    EXPECT_TRUE(outcome.happened);
    EXPECT_EQ(outcome.time, 2);
}
