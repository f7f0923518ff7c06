// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analysis with Coulomb's law answers any wall: random walls with a window, each answer judged.
#include "RandomWalls.h"
#include "conic/Lifted.h"
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
    int falls = 0;  ///< answers on whose mechanism the live load does no work
    int below = 0;  ///< collapses with a multiplier below zero
    int bounds = 0; ///< upper bounds, since no pair was found
    int unstable = 0;
    std::vector<double> times; ///< over that of the associative law
};

/// \param strength of each point, in weights of the heaviest block
PlaneConeProgram programOf(unsigned number, const Strength& strength)
{
    const RandomWall wall = randomWall(number);
    const WeighedStructure structure = standing(wall.bond);
    PlaneConeProgram program = structure.program(wall.friction, structure.weightLoads());
    if (strength.cohesion > 0)
    {
        const double weight = program.load.lpNorm<Eigen::Infinity>();
        program.strength.assign(program.friction.size(), {.cohesion = weight * strength.cohesion,
                                                          .tension = weight * strength.tension});
    }
    return program;
}

template<int Rows, int Forces>
void answer(const ConeProgram<Rows, Forces>& program, Outcome& outcome)
{
    const double start = processorTime();
    const LimitAnalysis associative = solveLimitAnalysis(program);
    const double middle = processorTime();
    const LimitAnalysis result = solveNonAssociative(program);
    const double end = processorTime();
    if (associative.status == CollapseStatus::unstable)
    {
        EXPECT_EQ(result.status, CollapseStatus::unstable);
        ++outcome.unstable;
        return;
    }
    outcome.times.push_back((end - middle) / (middle - start));
    if (result.status != CollapseStatus::optimal)
    {
        EXPECT_EQ(result.status, CollapseStatus::upperBound);
        EXPECT_EQ(result.alpha, associative.alpha);
        EXPECT_EQ(result.coulomb->associative, associative.alpha);
        EXPECT_LE(result.certificate.worst(), InteriorPointSettings().tolerance);
        EXPECT_LE(result.coulomb->safe, result.alpha);
        ++outcome.bounds;
        return;
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

Outcome answerWalls(unsigned first, unsigned last, const Strength& strength = {})
{
    Outcome outcome;
    for (unsigned number = first; number <= last; ++number)
    {
        SCOPED_TRACE(testing::Message() << "wall " << number);
        answer(programOf(number, strength), outcome);
    }
    std::sort(outcome.times.begin(), outcome.times.end());
    return outcome;
}

/// The same walls in space, where friction cones are round.
Outcome answerLiftedWalls(unsigned first, unsigned last)
{
    Outcome outcome;
    for (unsigned number = first; number <= last; ++number)
    {
        SCOPED_TRACE(testing::Message() << "wall " << number);
        answer(lifted(programOf(number, {})), outcome);
    }
    std::sort(outcome.times.begin(), outcome.times.end());
    return outcome;
}

} // namespace

TEST(CoulombWalls, TwentyAreAnswered)
{
    const Outcome outcome = answerWalls(1, 20);
    EXPECT_EQ(outcome.falls, 0);
    EXPECT_EQ(outcome.bounds, 0);
    EXPECT_LE(outcome.below, 1);
}

TEST(CoulombWalls, TwentyWithCohesionAndTensionAreAnswered)
{
    const Outcome outcome = answerWalls(1, 20, {.cohesion = 0.2, .tension = 0.05});
    EXPECT_EQ(outcome.falls + outcome.bounds + outcome.below, 0);
    EXPECT_EQ(outcome.collapses, 20 - outcome.unstable);
}

TEST(CoulombWalls, FiveLiftedIntoSpaceAreAnswered)
{
    const Outcome outcome = answerLiftedWalls(1, 5);
    EXPECT_EQ(outcome.collapses, 5 - outcome.unstable);
}

// No path of it ends: with less and less dilatancy its pairs fall below zero and there are no more of them.
// What is known is the answer: nothing collapses above the associative multiplier.
TEST(CoulombWalls, AWallWithoutAnyPairIsAnsweredByABound)
{
    const Outcome outcome = answerWalls(205, 205);
    EXPECT_EQ(outcome.bounds, 1);
}

TEST(NightlyCoulombWalls, FiveHundredAreAnsweredAtTwentyTimesTheAssociativeTime)
{
    const Outcome outcome = answerWalls(1, 500);
    const double median = outcome.times[outcome.times.size() / 2];
    std::cout << outcome.collapses << " collapse, " << outcome.falls << " fall, " << outcome.unstable
              << " unstable, " << outcome.below << " below zero, " << outcome.bounds
              << " bounded from above; time over that of the associative law: median " << median
              << ", nine of ten " << outcome.times[outcome.times.size() * 9 / 10] << '\n';
    EXPECT_LE(outcome.falls + outcome.below, 5);
    EXPECT_LE(outcome.bounds, 1);
    EXPECT_EQ(outcome.collapses + outcome.falls + outcome.bounds + outcome.unstable, 500);
    EXPECT_LE(median, 20);
}

// Paths in space, of short steps, lead to a pair less often than those of the plane: of the others, five of
// twenty, bounds are known.
TEST(NightlyCoulombWalls, TwentyLiftedIntoSpaceAreAnsweredByACollapse)
{
    const Outcome outcome = answerLiftedWalls(1, 20);
    std::cout << outcome.collapses << " collapse, " << outcome.bounds
              << " bounded from above; time over that of the associative law: median "
              << outcome.times[outcome.times.size() / 2] << '\n';
    EXPECT_EQ(outcome.collapses, 20);
}

TEST(NightlyCoulombWalls, TwoHundredWithCohesionWithAndWithoutTensionAreAnswered)
{
    for (const double tension : {0.0, 0.05})
    {
        const Outcome outcome = answerWalls(1, 200, {.cohesion = 0.2, .tension = tension});
        EXPECT_LE(outcome.falls, 1);
        EXPECT_EQ(outcome.bounds + outcome.below, 0);
    }
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
