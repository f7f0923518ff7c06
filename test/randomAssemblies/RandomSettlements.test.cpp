// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Random settlements, judged independently and compared with GLPK.
///
///     DRYSTONE_SEED=123 build/test/test_randomAssemblies --gtest_filter=*Settlements*       that one
#include "Judge.h"

#include "peers/Peers.h"
#include "statics/Settlement.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

namespace drystone
{
namespace
{

constexpr double tolerance = 1e-7;

/// What the answers to many settlements were.
struct Tally
{
    std::map<std::string, int> answers;
    int compared = 0;    ///< with GLPK
    double furthest = 0; ///< difference of a reaction from GLPK's, over the largest load on a block
};

void judgeReaction(const RandomAssembly& structure, const LimitAnalysis& result, const Judge& judge)
{
    const Eigen::VectorXd& c = result.contactForce;
    const Eigen::VectorXd& y = result.mechanism;
    const double force = judge.size(structure.loads.dead);
    const double motion = std::max(1.0, judge.motionSize(y)); // that of the support is 1
    EXPECT_LE(judge.size(judge.resultant(c, structure.loads.dead)), tolerance * force) << "balance";
    EXPECT_LE(judge.outsideCones(c), tolerance * force) << "cones";
    EXPECT_LE(judge.outsideFlow(y), tolerance * motion) << "flow";
    EXPECT_NEAR(judge.reaction(c), result.alpha, tolerance * force) << "reaction";
    // No forces give less: the dead load does the reaction's work on the mechanism.
    EXPECT_LE(std::abs(result.alpha - structure.loads.dead.dot(y)), tolerance * force * motion) << "proof";
}

void judgeSettlement(unsigned seed, Tally& tally)
{
    const RandomAssembly structure = randomSettlement(seed);
    SCOPED_TRACE(fmt::format("DRYSTONE_SEED={} ({}, {} blocks, mu {:g}, size {:g} m, direction {:g} {:g})",
                             seed, structure.family, structure.freeBlocks(), structure.mu, structure.size,
                             structure.loads.movement->direction.x(),
                             structure.loads.movement->direction.y()));
    PlaneConeProgram program = limitAnalysisProgram(
        structure.freeBlocks(), equilibriumColumns(structure.assembly, structure.blocks, structure.points),
        std::vector<double>(structure.points.size(), structure.mu), structure.loads);
    program.gap = settlementGaps(structure.assembly, structure.points, *structure.loads.movement);
    const Judge judge(structure);
    const double weight = judge.size(structure.loads.dead);
    const LimitAnalysis result = solveSettlement(program);
    std::string answer = "not converged";
    switch (result.status)
    {
    case CollapseStatus::optimal:
        answer = std::abs(result.alpha) <= tolerance * weight ? "reaction 0" : "reaction";
        judgeReaction(structure, result, judge);
        break;
    case CollapseStatus::unstable:
        answer = "unstable";
        EXPECT_GT(structure.loads.dead.dot(result.mechanism), 0);
        break;
    case CollapseStatus::unbounded:
    {
        answer = "unbounded";
        // Forces in balance by themselves that push the support against its movement, as far as one likes.
        const Eigen::VectorXd& c = result.contactForce;
        const Eigen::VectorXd none = Eigen::VectorXd::Zero(structure.loads.dead.size());
        EXPECT_LE(judge.size(judge.resultant(c, none)), tolerance) << "balance";
        EXPECT_LE(judge.outsideCones(c), tolerance) << "cones";
        EXPECT_NEAR(judge.reaction(c), -1, tolerance) << "push";
        break;
    }
    case CollapseStatus::upperBound:
        ADD_FAILURE() << "a bound is an answer of Coulomb's law alone";
        break;
    case CollapseStatus::notConverged:
    {
        // Allowed only where it is not known whether the blocks stand at all: their loads are out of balance
        // by 1e-5 of their size or less.
        PlaneConeProgram dead = program;
        dead.gap.resize(0);
        EXPECT_EQ(solveInteriorPoint(dead).status, SolveStatus::notConverged)
            << "certificate " << result.certificate.primalResidual << " " << result.certificate.dualResidual
            << " " << result.certificate.dualityGap << ", reaction " << result.alpha / weight;
        EXPECT_LE(result.certificate.primalResidual, 1e-4);
        break;
    }
    }
    ++tally.answers[answer];
    if (const auto peer = glpk())
    {
        const auto other = peer->solve(AnyConeProgram(program), 1e-9);
        if (other && certifyOptimal(program, other->solution).worst() <= 1e-8)
        {
            EXPECT_EQ(result.status, CollapseStatus::optimal);
            const double apart =
                std::abs(result.alpha - program.gap.dot(other->solution.contactForce)) / weight;
            EXPECT_LE(apart, 1e-6) << "reaction " << result.alpha / weight;
            ++tally.compared;
            tally.furthest = std::max(tally.furthest, apart);
        }
    }
}

void judgeSettlements(unsigned first, unsigned count)
{
    Tally tally;
    if (const char* seed = std::getenv("DRYSTONE_SEED"))
    {
        first = static_cast<unsigned>(std::strtoul(seed, nullptr, 10));
        count = 1;
    }
    for (unsigned seed = first; seed < first + count; ++seed)
    {
        judgeSettlement(seed, tally);
    }
    for (const auto& [answer, number] : tally.answers)
    {
        fmt::print("{}: {}\n", answer, number);
    }
    fmt::print("compared with GLPK: {}, at most {:.1e} apart\n", tally.compared, tally.furthest);
    EXPECT_LE(tally.answers["not converged"], static_cast<int>(count / 300));
    EXPECT_GE(tally.answers["reaction 0"], static_cast<int>(count / 8));
    if (glpk())
    {
        EXPECT_GE(tally.compared, static_cast<int>(count / 2));
    }
}

TEST(RandomSettlements, SixtyFiveAreAnsweredAndAgreeWithGlpk)
{
    judgeSettlements(1, 65);
}

TEST(NightlyRandomSettlements, FiveThousandAreAnsweredAndAgreeWithGlpk)
{
    judgeSettlements(101, 5000);
}

} // namespace
} // namespace drystone
