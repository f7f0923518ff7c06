// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Programs with a cohesion in place of friction: their pairs are judged by Coulomb's law itself.
#include "statics/FictitiousCohesion.h"
#include "Structures.h"
#include "conic/InteriorPoint.h"

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

/// The tools with which limit analysis uses it.
struct Judged
{
    const PlaneConeProgram& program;
    int programs = 0; ///< solved
    int rounds = 0;   ///< reported
    int mostPrograms = 100000;

    CohesionTools<3, 2> tools()
    {
        const auto to = [this](double tolerance)
        {
            return [this, tolerance](const PlaneConeProgram& turn)
            {
                ++programs;
                return solveInteriorPoint(turn, {.tolerance = tolerance});
            };
        };
        return {to(1e-2), to(1e-9),
                [this](CoulombPair& pair)
                {
                    pair.residuals = coulombResiduals(program, pair.alpha, pair.contactForce, pair.mechanism);
                    return pair.residuals.worst() <= 1e-6;
                },
                [this] { return programs >= mostPrograms; },
                [this](int round, double) { EXPECT_EQ(round, ++rounds); }};
    }
};

TEST(FictitiousCohesion, LeadsToPairsOfTheSixWalls)
{
    for (const Wall& wall : paperWalls())
    {
        SCOPED_TRACE(wall.alpha);
        const WeighedStructure structure = standing(wall.bond);
        const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
        const ConeSolution collapse = solveInteriorPoint(program);
        Judged judged{program};
        const auto pair = pairByCohesion<3, 2>(program, collapse.contactForce, judged.tools());
        ASSERT_TRUE(pair);
        EXPECT_LE(coulombResiduals(program, pair->alpha, pair->contactForce, pair->mechanism).worst(), 1e-6);
        EXPECT_LE(pair->alpha, wall.alpha + 1e-6);
        EXPECT_GE(pair->alpha, 0.8 * wall.alpha);
        EXPECT_GT(judged.rounds, 0);
    }
}

// Where joints have strengths of their own the cohesion is added to theirs, and what opens or crushes
// carries those.
TEST(FictitiousCohesion, KeepsTheStrengthsOfJoints)
{
    const WeighedStructure structure = standing(paperWalls()[2].bond);
    PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
    const double weight = structure.weightLoads().dead.lpNorm<Eigen::Infinity>();
    program.strength.assign(program.friction.size(),
                            {.cohesion = 0.1 * weight, .tension = 0.05 * weight, .crushing = 40 * weight});
    const ConeSolution collapse = solveInteriorPoint(program);
    ASSERT_EQ(collapse.status, SolveStatus::optimal);
    Judged judged{program};
    const auto pair = pairByCohesion<3, 2>(program, collapse.contactForce, judged.tools());
    ASSERT_TRUE(pair);
    EXPECT_LE(coulombResiduals(program, pair->alpha, pair->contactForce, pair->mechanism).worst(), 1e-6);
    EXPECT_LE(pair->alpha, collapse.multiplier + 1e-6);
}

TEST(FictitiousCohesion, EndsWhereItIsToldTo)
{
    const WeighedStructure structure = standing(paperWalls()[3].bond);
    const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
    const ConeSolution collapse = solveInteriorPoint(program);
    for (const int most : {0, 1, 5})
    {
        Judged judged{.program = program, .mostPrograms = most};
        EXPECT_FALSE((pairByCohesion<3, 2>(program, collapse.contactForce, judged.tools())));
        EXPECT_EQ(judged.programs, most);
    }
}

// What no pressure can carry, as a live load that lifts, has no pair and no end of rounds either.
TEST(FictitiousCohesion, ALoadThatNothingCarriesHasNoPair)
{
    const WeighedStructure structure = standing(paperWalls()[0].bond);
    PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
    const ConeSolution collapse = solveInteriorPoint(program);
    program.load = -program.load;
    Judged judged{program};
    EXPECT_FALSE((pairByCohesion<3, 2>(program, collapse.contactForce, judged.tools())));
    EXPECT_EQ(judged.programs, 1);
}

} // namespace
} // namespace drystone
