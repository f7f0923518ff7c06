// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analyses that are solved several at once have the answers that they have one by one.
#include "Structures.h"

#include "conic/form/Form.h"
#include "statics/LaneAnalyses.h"
#include "statics/SolveCase.h"

#include <gtest/gtest.h>

#include <random>

namespace drystone
{
namespace
{

LimitAnalysisCase<2> caseOf(const PlaneConeProgram& program)
{
    LimitAnalysisCase<2> structure;
    structure.program = program;
    structure.solution.tolerance = 1e-9;
    return structure;
}

/// A wall with friction of its own in each lane.
std::vector<LimitAnalysisCase<2>> withFrictions(const WeighedStructure& wall, int count, std::mt19937& random)
{
    std::lognormal_distribution<double> friction(std::log(0.65), 0.3);
    std::vector<LimitAnalysisCase<2>> cases;
    for (int i = 0; i < count; ++i)
    {
        cases.push_back(caseOf(wall.program(friction(random), wall.weightLoads())));
    }
    return cases;
}

TEST(LaneAnalyses, TheSixWallsHaveTheAnswersThatTheyHaveOneByOne)
{
    std::mt19937 random(1);
    LaneSolver lanes;
    SymbolicAnalysis kept;
    std::size_t left = 0;
    for (const Wall& wall : paperWalls())
    {
        std::vector<LimitAnalysisCase<2>> cases =
            withFrictions(standing(wall.bond), 3 * LaneSolver::lanes() + 1, random);
        const std::vector<std::optional<LimitAnalysis>> answers = solveInLanes(cases, lanes, kept);
        for (std::size_t i = 0; i < cases.size(); ++i)
        {
            if (!answers[i])
            {
                ++left;
                continue;
            }
            const LimitAnalysis alone = solveLimitAnalyses(cases[i]).front();
            EXPECT_EQ(answers[i]->status, alone.status);
            EXPECT_NEAR(answers[i]->alpha, alone.alpha, 1e-9 * alone.alpha);
            EXPECT_LE(answers[i]->certificate.worst(), 1e-9);
            EXPECT_EQ(answers[i]->variables, alone.variables);
        }
    }
    EXPECT_LE(left, 1U) << "for the ordinary solver";
}

TEST(LaneAnalyses, WallsThatBeginFromOthersHaveTheAnswersThatTheyHaveOneByOne)
{
    std::mt19937 random(3);
    const std::vector<Wall> walls = paperWalls();
    for (const Wall& wall : {walls[0], walls[5]})
    {
        LaneSolver lanes;
        beginLanesFrom(withFrictions(standing(wall.bond), 8, random), lanes);
        std::vector<LimitAnalysisCase<2>> cases =
            withFrictions(standing(wall.bond), 2 * LaneSolver::lanes() + 1, random);
        cases.back().program.load *= 1.3; // other densities, and another direction of the live load
        cases.back().program.liveLoad += 0.1 * cases.back().program.load;
        SymbolicAnalysis kept;
        const std::vector<std::optional<LimitAnalysis>> answers = solveInLanes(cases, lanes, kept);
        for (std::size_t i = 0; i < cases.size(); ++i)
        {
            ASSERT_TRUE(answers[i]);
            const LimitAnalysis alone = solveLimitAnalyses(cases[i]).front();
            EXPECT_EQ(answers[i]->status, alone.status);
            EXPECT_NEAR(answers[i]->alpha, alone.alpha, 1e-9 * alone.alpha);
            EXPECT_LE(answers[i]->certificate.worst(), 1e-9);
        }
    }
}

TEST(LaneAnalyses, AnAnswerDoesNotDependOnWhatIsSolvedWithIt)
{
    std::mt19937 random(2);
    const std::vector<Wall> walls = paperWalls();
    std::vector<LimitAnalysisCase<2>> cases = withFrictions(standing(walls[2].bond), 9, random);
    const std::vector<LimitAnalysisCase<2>> others = withFrictions(standing(walls[0].bond), 5, random);
    cases.insert(cases.begin() + 3, others.begin(), others.end());
    LaneSolver lanes;
    SymbolicAnalysis kept;
    const std::vector<std::optional<LimitAnalysis>> together = solveInLanes(cases, lanes, kept);
    for (std::size_t i = 0; i < cases.size(); ++i)
    {
        LaneSolver fresh;
        SymbolicAnalysis own;
        const std::optional<LimitAnalysis> alone =
            solveInLanes(std::vector<LimitAnalysisCase<2>>{cases[i]}, fresh, own).front();
        ASSERT_TRUE(together[i] && alone);
        EXPECT_EQ(together[i]->alpha, alone->alpha);
        EXPECT_EQ(together[i]->contactForce, alone->contactForce);
        EXPECT_EQ(together[i]->mechanism, alone->mechanism);
    }
}

TEST(LaneAnalyses, WhatDoesNotStandOrHasNoLimitIsLeftToTheOrdinarySolver)
{
    const WeighedStructure wall = standing(paperWalls()[0].bond);
    const LoadVectors loads = wall.weightLoads();
    const LimitAnalysisCase<2> good = caseOf(wall.program(0.65, loads));
    LimitAnalysisCase<2> falls = good;
    falls.program.load += 2 * loads.live;
    LimitAnalysisCase<2> unlimited = good;
    unlimited.program.liveLoad = loads.dead;
    LaneSolver lanes;
    SymbolicAnalysis kept;
    const std::vector<std::optional<LimitAnalysis>> answers =
        solveInLanes(std::vector<LimitAnalysisCase<2>>{falls, good, unlimited}, lanes, kept);
    EXPECT_FALSE(answers[0]);
    ASSERT_TRUE(answers[1]);
    EXPECT_NEAR(answers[1]->alpha, paperWalls()[0].alpha, 1e-6);
    EXPECT_FALSE(answers[2]);
}

TEST(LaneAnalyses, OtherLawsAndQuestionsAreNotForLanes)
{
    const WeighedStructure wall = standing(paperWalls()[0].bond);
    const LimitAnalysisCase<2> good = caseOf(wall.program(0.65, wall.weightLoads()));
    EXPECT_TRUE(isForLanes(good));
    const auto isTaken = [&](const auto& change)
    {
        LimitAnalysisCase<2> other = good;
        change(other);
        return isForLanes(other);
    };
    EXPECT_FALSE(isTaken([](auto& other) { other.multiplier = Multiplier::both; }));
    EXPECT_FALSE(isTaken([](auto& other) { other.loads.positions.resize(1); }));
    EXPECT_FALSE(isTaken([](auto& other) { other.combinations.resize(1); }));
    EXPECT_FALSE(isTaken([](auto& other) { other.solution.writeIterations = true; }));
    EXPECT_FALSE(isTaken([](auto& other) { other.solution.writeProgram = WriteProgram::always; }));
    EXPECT_FALSE(isTaken([](auto& other) { other.solution.solver = SolverType::gaussSeidel; }));
    EXPECT_FALSE(isTaken([](auto& other) { other.solution.maximumIterations = 3; }));
    EXPECT_FALSE(isTaken([](auto& other) { other.solution.correctors = 0; }));
    EXPECT_TRUE(isTaken([](auto& other) { other.solution.maximumIterations = 1000; }));
    EXPECT_TRUE(isTaken([](auto& other) { other.solution.solver = SolverType::interiorPoint; }));
    EXPECT_TRUE(isTaken([](auto& other) { other.solution.tolerance = 1e-7; }));
    EXPECT_FALSE(isTaken([](auto& other) { other.program.strength.resize(other.program.contacts.size()); }));
}

} // namespace
} // namespace drystone
