// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Random assemblies: limit analysis and a time step of each, judged independently and compared with GLPK.
///
///     build/test/test_randomAssemblies                          200 of them
///     DRYSTONE_SEED=123 build/test/test_randomAssemblies        that one, with what came of it
#include "Judge.h"

#include "conic/AugmentedLagrangian.h"
#include "dynamics/DynamicState.h"
#include "dynamics/ThetaStep.h"
#include "peers/Peers.h"
#include "statics/LimitAnalysis.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

namespace drystone
{
namespace
{

/// What the answers to many assemblies were.
struct Tally
{
    std::map<std::string, int> answers;
    int compared = 0;               ///< with GLPK
    double furthest = 0;            ///< relative difference of a multiplier from GLPK's
    double worst = 0;               ///< figure of the judge over its tolerance
    std::vector<unsigned> unsolved; ///< to the default tolerance of 1e-9
    std::vector<unsigned> hopeless; ///< those of them that are not solved to 1e-6 either
};

constexpr double tolerance = 1e-7;

/// Each figure over its tolerance.
void expectWithin(double error, double size, const char* what, Tally& tally)
{
    const double share = error / (tolerance * size);
    tally.worst = std::isnan(share) ? share : std::max(tally.worst, share);
    EXPECT_LE(error, tolerance * size) << what;
}

void judgeLimitAnalysis(const RandomAssembly& structure, const LimitAnalysis& result, const Judge& judge,
                        Tally& tally)
{
    const Eigen::VectorXd& c = result.contactForce;
    const Eigen::VectorXd& y = result.mechanism;
    switch (result.status)
    {
    case CollapseStatus::optimal:
    {
        ++tally.answers["optimal"];
        const Eigen::VectorXd load = structure.loads.dead + result.alpha * structure.loads.live;
        const double force =
            judge.size(structure.loads.dead) + std::abs(result.alpha) * judge.size(structure.loads.live);
        const double motion = judge.motionSize(y);
        const double work = structure.loads.live.dot(y);
        expectWithin(judge.size(judge.resultant(c, load)), force, "balance", tally);
        expectWithin(judge.outsideCones(c), force, "cones", tally);
        expectWithin(judge.outsideFlow(y), motion, "flow", tally);
        EXPECT_GE(result.alpha,
                  -tolerance * judge.size(structure.loads.dead) / judge.size(structure.loads.live));
        EXPECT_GT(work, 0) << "the live load does work on the mechanism";
        // No mechanism shows a lower multiplier: alpha L'y = -f'y.
        expectWithin(std::abs(result.alpha * work + structure.loads.dead.dot(y)), force * motion, "gap",
                     tally);
        expectWithin(judge.power(c, y), force * motion * static_cast<double>(structure.points.size()),
                     "complementarity", tally);
        break;
    }
    case CollapseStatus::unstable:
        ++tally.answers["unstable"];
        EXPECT_GT(structure.loads.dead.dot(y), 0);
        // The dead load does work; what is left of flow may only spoil less than that.
        EXPECT_LE(judge.outsideFlow(y) * judge.size(structure.loads.dead),
                  0.01 * structure.loads.dead.dot(y));
        expectWithin(judge.outsideFlow(y), judge.motionSize(y), "flow", tally);
        break;
    case CollapseStatus::unbounded:
    {
        ++tally.answers["unbounded"];
        const double force = judge.size(structure.loads.live);
        expectWithin(judge.size(judge.resultant(c, structure.loads.live)), force, "balance", tally);
        expectWithin(judge.outsideCones(c), force, "cones", tally);
        break;
    }
    case CollapseStatus::upperBound:
        ADD_FAILURE() << "a bound is an answer of Coulomb's law alone";
        break;
    case CollapseStatus::notConverged:
        ++tally.answers["notConverged"];
        break;
    }
}

/// GLPK's answer counts only when our certificate confirms it.
void compareWithGlpk(const PlaneConeProgram& program, const LimitAnalysis& result, Tally& tally)
{
    const auto peer = glpk();
    if (!peer)
    {
        return;
    }
    const auto answer = peer->solve(AnyConeProgram(program), 1e-9);
    if (!answer || !(certifyOptimal(program, answer->solution).worst() <= 1e-8))
    {
        return;
    }
    const double other = answer->solution.multiplier;
    if (result.status == CollapseStatus::optimal)
    {
        ++tally.compared;
        const double apart =
            std::abs(result.alpha - other) / std::max({std::abs(result.alpha), std::abs(other), 1e-3});
        tally.furthest = std::max(tally.furthest, apart);
        EXPECT_LE(apart, 1e-6) << "alpha " << result.alpha << ", of GLPK " << other;
    }
    EXPECT_NE(result.status, CollapseStatus::unbounded) << "GLPK: collapse at " << other;
}

void judgeStep(const RandomAssembly& structure, const Judge& judge, Tally& tally)
{
    // Pushed by a third of the live load, from rest.
    const double timeStep = 0.002 * std::sqrt(structure.size);
    Eigen::VectorXd mass(3 * structure.freeBlocks());
    for (std::size_t block = 0; block < structure.blocks.size(); ++block)
    {
        if (const int row = 3 * structure.free[block]; row >= 0)
        {
            const double density = structure.masses[block] / structure.blocks[block].volume;
            mass.segment<3>(row) << structure.masses[block], structure.masses[block],
                density * structure.blocks[block].inertia(0, 0);
        }
    }
    const Eigen::VectorXd load =
        structure.loads.dead
        + structure.loads.live / 3 * (judge.size(structure.loads.dead) / judge.size(structure.loads.live));
    const auto columns = equilibriumColumns(structure.assembly, structure.blocks, structure.points);
    const PlaneConeProgram program =
        thetaStepProgram(mass, Eigen::VectorXd::Zero(mass.size()), load, structure.points, columns,
                         std::vector<double>(structure.points.size(), structure.mu), {1, timeStep});
    SolverChoice automatic;
    const ConeSolution solution = solveConeProgram(program, automatic);
    if (solution.status != SolveStatus::optimal)
    {
        ++tally.answers["step not solved"];
        return;
    }
    ++tally.answers["step solved"];
    const Eigen::VectorXd& y = solution.displacement;
    const Eigen::VectorXd inertial = mass.cwiseProduct(y) / (timeStep * timeStep);
    const double force = judge.size(load);
    double fall = 0;
    for (Eigen::Index row = 0; row < mass.size(); row += 3)
    {
        fall = std::max(fall, load.segment<2>(row).norm() / mass[row] * timeStep * timeStep);
    }
    expectWithin(judge.size(judge.resultant(solution.contactForce, load - inertial)), force, "step: balance",
                 tally);
    expectWithin(judge.outsideCones(solution.contactForce), force, "step: cones", tally);
    expectWithin(judge.outsideFlow(y), std::max(fall, judge.motionSize(y)), "step: flow", tally);
    expectWithin(judge.power(solution.contactForce, y),
                 force * std::max(fall, judge.motionSize(y)) * static_cast<double>(structure.points.size()),
                 "step: complementarity", tally);
}

void judgeSeed(unsigned seed, Tally& tally)
{
    const RandomAssembly structure = randomAssembly(seed);
    SCOPED_TRACE(fmt::format("DRYSTONE_SEED={} ({}, {} blocks, mu {:g}, size {:g} m)", seed, structure.family,
                             structure.freeBlocks(), structure.mu, structure.size));
    const Judge judge(structure);
    const PlaneConeProgram program = limitAnalysisProgram(
        structure.freeBlocks(), equilibriumColumns(structure.assembly, structure.blocks, structure.points),
        std::vector<double>(structure.points.size(), structure.mu), structure.loads);
    const LimitAnalysis result = solveLimitAnalysis(program);
    if (result.status == CollapseStatus::notConverged)
    {
        tally.unsolved.push_back(seed);
        if (solveLimitAnalysis(program, {.tolerance = 1e-6}).status == CollapseStatus::notConverged)
        {
            tally.hopeless.push_back(seed);
        }
    }
    judgeLimitAnalysis(structure, result, judge, tally);
    compareWithGlpk(program, result, tally);
    judgeStep(structure, judge, tally);
}

void print(const Tally& tally)
{
    for (const auto& [answer, count] : tally.answers)
    {
        fmt::print("{}: {}\n", answer, count);
    }
    fmt::print("compared with GLPK: {}, at most {:.1e} apart; worst figure of the judge {:.1e}\n",
               tally.compared, tally.furthest, tolerance * tally.worst);
    fmt::print("limit analysis not solved to 1e-9: {}, not to 1e-6: {}\n", tally.unsolved.size(),
               fmt::join(tally.hopeless, " "));
    fmt::print("their seeds: {}\n", fmt::join(tally.unsolved, " "));
}

void judgeSeeds(unsigned first, unsigned count)
{
    Tally tally;
    if (const char* seed = std::getenv("DRYSTONE_SEED"))
    {
        first = static_cast<unsigned>(std::strtoul(seed, nullptr, 10));
        count = 1;
    }
    for (unsigned seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed)
    {
        judgeSeed(seed, tally);
    }
    print(tally);
    // Not to converge is no wrong answer, but of ten thousand none to four are not solved, by how the
    // processor rounds.
    EXPECT_LE(tally.unsolved.size(), count / 1000);
    EXPECT_EQ(tally.hopeless.size(), 0U);
    EXPECT_LE(tally.answers["step not solved"], static_cast<int>(count / 100 + 1));
}

TEST(RandomAssemblies, TwoHundredAreSolvedOrHonestlyNotAndAgreeWithGlpk)
{
    judgeSeeds(1, 200);
}

// Loads that the blocks balance but for 8e-6 and 5e-6 of them, which takes an exact proof, and a tower that
// slides under its own weight and whose least multiplier, below zero, has a gap of 1.5e-9.
TEST(RandomAssemblies, WhatHardlyFallsIsToldFromWhatStands)
{
    Tally tally;
    for (const unsigned seed : {4723U, 8663U, 1152U})
    {
        judgeSeed(seed, tally);
    }
    EXPECT_EQ(tally.answers["unstable"], 3);
}

// Programs in which the interior point breaks down, some with a friction of 1e-12: by upper bounds. One may
// be missed, since that hangs on rounding: 1380 is without fused operations, none with AVX2 or AVX-512.
TEST(RandomAssemblies, UpperBoundsFindWhatTheInteriorPointDoesNot)
{
    Tally tally;
    for (const unsigned seed : {1380U, 5751U, 6277U, 7527U, 10413U, 1062U, 1218U, 3652U, 5526U})
    {
        judgeSeed(seed, tally);
    }
    EXPECT_GE(tally.answers["optimal"], 8);
}

// Collapses whose forces or mechanisms double precision leaves at 1e-6.
TEST(RandomAssemblies, TwiceAsManyDigitsSolveWhatDoublePrecisionDoesNot)
{
    Tally tally;
    for (const unsigned seed : {1380U, 2531U, 4659U, 7164U})
    {
        judgeSeed(seed, tally);
    }
    EXPECT_EQ(tally.answers["optimal"], 4);
    EXPECT_TRUE(tally.unsolved.empty());
}

// Displacements of thousands for a unit of work, so that what is left of the balance counts.
TEST(RandomAssemblies, LargeDisplacementsDoNotKeepTheObjectivesApart)
{
    Tally tally;
    for (const unsigned seed : {3448U, 1369U, 10844U, 7578U})
    {
        judgeSeed(seed, tally);
    }
    EXPECT_EQ(tally.answers["notConverged"], 0);
}

TEST(NightlyRandomAssemblies, TenThousandAreSolvedOrHonestlyNotAndAgreeWithGlpk)
{
    judgeSeeds(1001, 10000);
}

} // namespace
} // namespace drystone
