// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analysis with Coulomb's law answers any wall: random walls with a window, each answer judged.
#include "RandomWalls.h"
#include "statics/NonAssociative.h"

#include <gtest/gtest.h>

#include <ctime>
#include <iostream>

namespace drystone
{
namespace
{

double processorTime()
{
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Outcome
{
    int collapses = 0;
    int falls = 0; ///< answers on whose mechanism the live load does no work
    int below = 0; ///< collapses with a multiplier below zero
    int unanswered = 0;
    int unstable = 0;
    std::vector<double> times; ///< over that of the associative law
};

Outcome answerWalls(unsigned first, unsigned last)
{
    Outcome outcome;
    for (unsigned number = first; number <= last; ++number)
    {
        SCOPED_TRACE(testing::Message() << "wall " << number);
        const RandomWall wall = randomWall(number);
        const WeighedStructure structure = standing(wall.bond);
        const PlaneConeProgram program = structure.program(wall.friction, structure.weightLoads());
        const double start = processorTime();
        const LimitAnalysis associative = solveLimitAnalysis(program);
        const double middle = processorTime();
        const LimitAnalysis result = solveNonAssociative(program);
        const double end = processorTime();
        if (associative.status == CollapseStatus::unstable)
        {
            EXPECT_EQ(result.status, CollapseStatus::unstable);
            ++outcome.unstable;
            continue;
        }
        outcome.times.push_back((end - middle) / (middle - start));
        if (result.status != CollapseStatus::optimal)
        {
            EXPECT_EQ(result.status, CollapseStatus::notConverged);
            EXPECT_EQ(result.coulomb->associative, associative.alpha);
            ++outcome.unanswered;
            continue;
        }
        outcome.below += result.alpha < 0;
        EXPECT_LE(result.alpha, associative.alpha * (1 + 1e-6));
        const bool isFall = result.alpha == result.coulomb->fall;
        const double work = isFall ? 0 : 1;
        const Eigen::VectorXd mechanism =
            isFall ? result.mechanism
                   : Eigen::VectorXd(result.mechanism / program.liveLoad.dot(result.mechanism));
        const CoulombResiduals residuals =
            coulombResiduals(program, result.alpha, result.contactForce, mechanism, work);
        EXPECT_LE(residuals.worst(), 1e-6);
        (isFall ? outcome.falls : outcome.collapses) += 1;
    }
    std::sort(outcome.times.begin(), outcome.times.end());
    return outcome;
}

} // namespace

TEST(CoulombWalls, TwentyAreAnswered)
{
    const Outcome outcome = answerWalls(1, 20);
    EXPECT_EQ(outcome.falls, 0);
    EXPECT_EQ(outcome.unanswered, 0);
    EXPECT_LE(outcome.below, 1);
}

TEST(NightlyCoulombWalls, FiveHundredAreAnsweredAtTwentyTimesTheAssociativeTime)
{
    const Outcome outcome = answerWalls(1, 500);
    const double median = outcome.times[outcome.times.size() / 2];
    std::cout << outcome.collapses << " collapse, " << outcome.falls << " fall, " << outcome.unstable
              << " unstable, " << outcome.below << " below zero, " << outcome.unanswered
              << " not answered; time over that of the associative law: median " << median << ", nine of ten "
              << outcome.times[outcome.times.size() * 9 / 10] << '\n';
    EXPECT_LE(outcome.falls + outcome.below, 5);
    EXPECT_LE(outcome.unanswered, 1);
    EXPECT_LE(median, 20);
}

// The walls that the issue named, and those of its second texture with windows two units wide.
TEST(CoulombWalls, WindowsTwoUnitsWideAreAnswered)
{
    for (const Vector<2>& unit : {Vector<2>(0.5, 0.2), Vector<2>(0.4, 0.175)})
    {
        for (const double friction : {0.3, 0.4, 0.5, 0.6, 0.7, 0.8})
        {
            SCOPED_TRACE(testing::Message() << "unit " << unit.x() << ", friction " << friction);
            RunningBond bond;
            bond.unit = unit;
            bond.length = 6;
            bond.courses = 10;
            bond.openings = {{{2, 3}, {4, 7}}};
            const WeighedStructure structure = standing(bond);
            const PlaneConeProgram program = structure.program(friction, structure.weightLoads());
            const LimitAnalysis result = solveNonAssociative(program);
            if (result.status == CollapseStatus::unstable)
            {
                EXPECT_LE(friction, 0.4);
                continue;
            }
            ASSERT_EQ(result.status, CollapseStatus::optimal);
            EXPECT_LE(result.alpha, result.coulomb->associative * (1 + 1e-6));
            const Eigen::VectorXd mechanism = result.mechanism / program.liveLoad.dot(result.mechanism);
            EXPECT_LE(coulombResiduals(program, result.alpha, result.contactForce, mechanism).worst(), 1e-6);
        }
    }
}

} // namespace drystone
