// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Programs that are solved several at once have the answers that they have by themselves.
#include "Towers.h"

#include "conic/Certificate.h"
#include "conic/InteriorPoint.h"
#include "conic/lanes/LaneSolver.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <random>

namespace drystone
{
namespace
{

constexpr double tolerance = 1e-9;

std::vector<ConeSolution> solved(LaneSolver& solver, const std::vector<PlaneConeProgram>& programs)
{
    std::vector<const PlaneConeProgram*> pointers;
    for (const PlaneConeProgram& program : programs)
    {
        EXPECT_TRUE(LaneSolver::takes(program));
        pointers.push_back(&program);
    }
    return solver.solve(pointers, tolerance);
}

/// Programs of the same points with frictions and loads of their own.
std::vector<PlaneConeProgram> varied(const PlaneConeProgram& program, int count, std::mt19937& random)
{
    std::uniform_real_distribution<double> share(-1, 1);
    std::vector<PlaneConeProgram> programs(static_cast<std::size_t>(count), program);
    for (PlaneConeProgram& each : programs)
    {
        const double mu = 0.6 + 0.4 * share(random);
        std::fill(each.friction.begin(), each.friction.end(), mu);
        for (Eigen::Index row = 0; row < each.load.size(); ++row)
        {
            each.load[row] *= 1 + 0.3 * share(random);
            each.liveLoad[row] *= 1 + 0.3 * share(random);
        }
    }
    return programs;
}

bool areEqual(const ConeSolution& one, const ConeSolution& other)
{
    return one.status == other.status && one.iterations == other.iterations
           && one.multiplier == other.multiplier && one.contactForce == other.contactForce
           && one.displacement == other.displacement && one.forceOfLoadAlone == other.forceOfLoadAlone;
}

/// Boxes anywhere in the plane, each of which stands on one or two that came before it, or on the ground.
PlaneConeProgram randomProgram(int bodies, std::mt19937& random)
{
    std::uniform_real_distribution<double> share(-1, 1);
    PlaneConeProgram program;
    program.bodies = bodies;
    program.load = program.liveLoad = Eigen::VectorXd::Zero(3 * bodies);
    for (int body = 0; body < bodies; ++body)
    {
        const int supports = body == 0 ? 1 : 2;
        for (int support = 0; support < supports; ++support)
        {
            const double side = supports == 1 ? 0 : support == 0 ? -0.35 : 0.35;
            const int below = body - 1 - support;
            for (const double at : {-0.15 - (supports == 1 ? 0.3 : 0), 0.15 + (supports == 1 ? 0.3 : 0)})
            {
                ConeColumns<3, 2> columns;
                columns.first = body;
                columns.second = std::max(below, -1);
                columns.onFirst = uprightColumns(Eigen::Vector2d(side + at, -0.5 + 0.1 * share(random)));
                if (columns.second >= 0)
                {
                    columns.onSecond = -uprightColumns(Eigen::Vector2d(at - side + 0.1 * share(random), 0.5));
                }
                program.contacts.push_back(columns);
                program.friction.push_back(0.7);
            }
        }
        program.load[3 * body + 1] = -1;
        program.liveLoad[3 * body] = 1;
    }
    return program;
}

TEST(LaneSolver, TowersCollapseAtTheirMultipliers)
{
    LaneSolver solver;
    for (const int boxes : {1, 2, 3, 8, 20})
    {
        std::vector<PlaneConeProgram> programs;
        std::vector<double> multipliers;
        for (int lane = 0; lane < LaneSolver::lanes(); ++lane)
        {
            const Tower tower = evenTower(boxes, 1 + lane, 0.05 + 0.1 * lane, 3);
            programs.push_back(planeLimitAnalysis(tower));
            multipliers.push_back(towerMultiplier(tower, 2));
        }
        const std::vector<ConeSolution> solutions = solved(solver, programs);
        for (std::size_t lane = 0; lane < programs.size(); ++lane)
        {
            EXPECT_EQ(solutions[lane].status, SolveStatus::optimal) << boxes << " boxes, lane " << lane;
            EXPECT_NEAR(solutions[lane].multiplier, multipliers[lane], 1e-9 * multipliers[lane]);
            EXPECT_LE(certifyOptimal(programs[lane], solutions[lane]).worst(), tolerance);
        }
    }
}

TEST(LaneSolver, RandomProgramsHaveTheAnswersOfTheInteriorPoint)
{
    std::mt19937 random(24);
    LaneSolver solver;
    int answered = 0;
    int optimal = 0;
    for (int trial = 0; trial < 40; ++trial)
    {
        const std::vector<PlaneConeProgram> programs =
            varied(randomProgram(2 + trial, random), LaneSolver::lanes(), random);
        const std::vector<ConeSolution> solutions = solved(solver, programs);
        for (std::size_t lane = 0; lane < programs.size(); ++lane)
        {
            const ConeSolution alone = solveInteriorPoint(programs[lane], {.tolerance = tolerance});
            optimal += alone.status == SolveStatus::optimal;
            if (solutions[lane].status == SolveStatus::optimal)
            {
                ++answered;
                ASSERT_EQ(alone.status, SolveStatus::optimal) << trial << " " << lane;
                EXPECT_NEAR(solutions[lane].multiplier, alone.multiplier,
                            2e-9 * std::max(1.0, std::abs(alone.multiplier)));
            }
        }
    }
    EXPECT_GT(optimal, 36 * LaneSolver::lanes());
    EXPECT_GT(answered, 0.95 * optimal);
}

TEST(LaneSolver, AnAnswerDoesNotDependOnItsNeighboursByASingleBit)
{
    std::mt19937 random(5);
    const std::vector<PlaneConeProgram> programs =
        varied(planeLimitAnalysis(evenTower(7, 2, 0.6, 3)), 3 * LaneSolver::lanes(), random);
    LaneSolver one;
    std::vector<ConeSolution> alone;
    for (const PlaneConeProgram& program : programs)
    {
        alone.push_back(solved(one, {program}).front());
        EXPECT_EQ(alone.back().status, SolveStatus::optimal);
    }
    for (int trial = 0; trial < 20; ++trial)
    {
        LaneSolver fresh;
        LaneSolver& solver = trial % 2 == 0 ? fresh : one;
        std::vector<std::size_t> order(programs.size());
        std::iota(order.begin(), order.end(), 0);
        std::shuffle(order.begin(), order.end(), random);
        order.resize(1 + static_cast<std::size_t>(trial) % programs.size());
        std::vector<PlaneConeProgram> together;
        for (const std::size_t index : order)
        {
            together.push_back(programs[index]);
        }
        const std::vector<ConeSolution> solutions = solved(solver, together);
        for (std::size_t lane = 0; lane < order.size(); ++lane)
        {
            EXPECT_TRUE(areEqual(solutions[lane], alone[order[lane]])) << trial << " " << lane;
        }
    }
}

TEST(LaneSolver, ProgramsThatBeginFromOthersHaveTheSameAnswersInFewerIterations)
{
    std::mt19937 random(7);
    for (const PlaneConeProgram& program :
         {planeLimitAnalysis(evenTower(7, 2, 0.6, 3)), randomProgram(12, random)})
    {
        const std::vector<PlaneConeProgram> programs = varied(program, 40, random);
        LaneSolver fromScratch;
        LaneSolver begun;
        begun.beginFrom(varied(program, 11, random));
        int longer = 0;
        int shorter = 0;
        for (const PlaneConeProgram& each : programs)
        {
            const ConeSolution one = solved(fromScratch, {each}).front();
            const ConeSolution other = solved(begun, {each}).front();
            EXPECT_EQ(one.status, other.status);
            if (one.status == SolveStatus::optimal)
            {
                EXPECT_NEAR(other.multiplier, one.multiplier, 2e-9 * std::max(1.0, std::abs(one.multiplier)));
                EXPECT_LE(certifyOptimal(each, other).worst(), tolerance);
                EXPECT_EQ(other.forceOfLoadAlone.size(), one.forceOfLoadAlone.size());
                longer += one.iterations;
                shorter += other.iterations;
            }
        }
        EXPECT_LT(shorter, 0.9 * longer);
    }
}

TEST(LaneSolver, AnAnswerThatBeginsFromOthersDoesNotDependOnItsNeighboursByASingleBit)
{
    std::mt19937 random(8);
    const PlaneConeProgram program = planeLimitAnalysis(evenTower(7, 2, 0.6, 3));
    const std::vector<PlaneConeProgram> programs = varied(program, 5 * LaneSolver::lanes() + 1, random);
    const std::vector<PlaneConeProgram> references = varied(program, 5, random);
    const PlaneConeProgram other = planeLimitAnalysis(evenTower(4));
    LaneSolver together;
    together.beginFrom(references);
    for (const bool isFirst : {true, false})
    {
        // The second time after programs of other points, and in other lanes.
        std::vector<PlaneConeProgram> batch = programs;
        if (!isFirst)
        {
            solved(together, {other});
            std::reverse(batch.begin(), batch.end());
        }
        const std::vector<ConeSolution> solutions = solved(together, batch);
        for (std::size_t lane = 0; lane < batch.size(); ++lane)
        {
            LaneSolver alone;
            alone.beginFrom(references);
            EXPECT_TRUE(areEqual(solutions[lane], solved(alone, {batch[lane]}).front())) << lane;
        }
    }
}

TEST(LaneSolver, ReferencesWithoutASolutionAreLeftOut)
{
    const PlaneConeProgram good = planeLimitAnalysis(evenTower(4));
    PlaneConeProgram falls = good;
    falls.load[3 * 3] = 50;
    PlaneConeProgram broken = good;
    broken.load[1] = std::numeric_limits<double>::quiet_NaN();
    LaneSolver fromScratch;
    const ConeSolution expected = solved(fromScratch, {good}).front();
    for (const std::vector<PlaneConeProgram>& references :
         {std::vector<PlaneConeProgram>{falls}, {broken}, {broken, falls, good}})
    {
        LaneSolver solver;
        solver.beginFrom(references);
        const ConeSolution solution = solved(solver, {good}).front();
        EXPECT_EQ(solution.status, SolveStatus::optimal);
        EXPECT_NEAR(solution.multiplier, expected.multiplier, 1e-9 * expected.multiplier);
        EXPECT_EQ(solved(solver, {falls}).front().status, SolveStatus::notConverged);
    }
}

TEST(LaneSolver, WhatHasNoSolutionIsNotAnsweredAndDisturbsNoOther)
{
    const PlaneConeProgram good = planeLimitAnalysis(evenTower(4));
    PlaneConeProgram falls = good;
    falls.load[3 * 3] = 50; // pushed off by the dead load
    PlaneConeProgram unlimited = good;
    unlimited.liveLoad = unlimited.load; // pressed onto the ground
    PlaneConeProgram broken = good;
    broken.load[1] = std::numeric_limits<double>::quiet_NaN();
    LaneSolver solver;
    const ConeSolution alone = solved(solver, {good}).front();
    ASSERT_EQ(alone.status, SolveStatus::optimal);
    for (const PlaneConeProgram& bad : {falls, unlimited, broken})
    {
        const std::vector<ConeSolution> solutions = solved(solver, {bad, good});
        EXPECT_EQ(solutions[0].status, SolveStatus::notConverged);
        EXPECT_TRUE(areEqual(solutions[1], alone));
    }
}

TEST(LaneSolver, ForcesThatCarryTheLoadAloneAreFound)
{
    const PlaneConeProgram program = planeLimitAnalysis(evenTower(5));
    LaneSolver solver;
    ConeSolution resting;
    resting.contactForce = solved(solver, {program}).front().forceOfLoadAlone;
    ASSERT_EQ(resting.contactForce.size(), 2 * program.points());
    resting.displacement = Eigen::VectorXd::Zero(3 * program.bodies);
    PlaneConeProgram dead = program;
    dead.liveLoad.resize(0);
    EXPECT_LE(certifyOptimal(dead, resting).worst(), tolerance);
}

TEST(LaneSolver, ItTakesFrictionAndLoadsOnly)
{
    const PlaneConeProgram program = planeLimitAnalysis(evenTower(2));
    EXPECT_TRUE(LaneSolver::takes(program));
    const auto isTaken = [&](const auto& change)
    {
        PlaneConeProgram other = program;
        change(other);
        return LaneSolver::takes(other);
    };
    EXPECT_FALSE(isTaken([](PlaneConeProgram& other) { other.liveLoad.resize(0); }));
    EXPECT_FALSE(isTaken([](PlaneConeProgram& other) { other.strength.resize(other.contacts.size()); }));
    EXPECT_FALSE(
        isTaken([](PlaneConeProgram& other) { other.gap = Eigen::VectorXd::Zero(2 * other.points()); }));
    EXPECT_FALSE(isTaken([](PlaneConeProgram& other) { other.friction[1] = 0; }));
    EXPECT_FALSE(isTaken([](PlaneConeProgram& other) { other.friction[1] = 0.7; }));
    EXPECT_FALSE(isTaken([](PlaneConeProgram& other)
                         { std::fill(other.friction.begin(), other.friction.end(), 10.0); }));
    PlaneConeProgram moved = program;
    moved.contacts[0].onFirst(2, 0) += 1e-9;
    EXPECT_FALSE(LaneSolver::areAlike(program, moved));
    EXPECT_TRUE(LaneSolver::areAlike(program, program));
    LaneSolver solver;
    EXPECT_THROW(solver.solve({}, tolerance), std::invalid_argument);
}

} // namespace
} // namespace drystone
