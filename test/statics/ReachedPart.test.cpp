// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A part of a large structure stands for the whole: the same multipliers, with the certificate of the whole;
/// and nothing where no part does.
#include "statics/ReachedPart.h"

#include "LocalLoads.h"
#include "conic/form/Form.h"

#include <gtest/gtest.h>

#include <random>

using namespace drystone;

namespace
{

constexpr double tolerance = 1e-9;

template<int Rows, int Forces>
std::optional<LimitAnalysis> byPart(const ConeProgram<Rows, Forces>& program)
{
    CarriedDeadLoad<Rows, Forces> carried;
    SymbolicAnalysis symbolic;
    return analyseReachedPart(program, {.tolerance = tolerance}, carried, symbolic);
}

/// Expects an answer from part of the blocks, which is that of all. \return blocks that were simulated
template<int Rows, int Forces>
int expectSameAsWhole(const ConeProgram<Rows, Forces>& program)
{
    const std::optional<LimitAnalysis> part = byPart(program);
    if (!part)
    {
        ADD_FAILURE() << "no part stood for the whole";
        return program.bodies;
    }
    const LimitAnalysis whole = solveLimitAnalysis(program, {.tolerance = tolerance});
    EXPECT_EQ(part->status, CollapseStatus::optimal);
    EXPECT_EQ(whole.status, CollapseStatus::optimal);
    EXPECT_NEAR(part->alpha, whole.alpha, 1e-7 * whole.alpha);
    // Asked again, of what is returned, in the program of the whole.
    ConeSolution solution;
    solution.multiplier = part->alpha;
    solution.contactForce = part->contactForce;
    solution.displacement = part->mechanism / program.liveLoad.dot(part->mechanism);
    EXPECT_LE(certifyOptimal(program, solution).worst(), tolerance);
    return simulatedBlocks(*part);
}

TEST(ReachedPart, OfAViaductTheSpanThatIsLoadedAndItsNeighbours)
{
    const Assembly<2> assembly = viaduct(20);
    const auto program = underForce<2>(assembly, 0.7, 10 * voussoirsOfSpan + 8, {0, -1});
    EXPECT_LE(expectSameAsWhole(program), program.bodies / 3);
}

TEST(ReachedPart, OfAWallTheCornerThatIsPulledOff)
{
    const Assembly<2> assembly = squareWall(30);
    const auto program = underForce<2>(assembly, 0.65, freeBlocksOf(assembly) - 1, {1, 0.2});
    EXPECT_LE(expectSameAsWhole(program), program.bodies / 5);
}

TEST(ReachedPart, InSpaceTheCornerOfAHouse)
{
    const Assembly<3> assembly = cornerOfHouse();
    const auto program = underForce<3>(assembly, 0.6, freeBlocksOf(assembly) - 1, {0.3, 1, 0.2});
    EXPECT_LE(expectSameAsWhole(program), program.bodies / 3);
}

TEST(ReachedPart, WithStrengths)
{
    const Assembly<2> assembly = squareWall(20);
    auto program = underForce<2>(assembly, 0.65, freeBlocksOf(assembly) - 1, {1, 0.2});
    program.strength.assign(program.contacts.size(), {200, 100, 4e4});
    EXPECT_LE(expectSameAsWhole(program), program.bodies / 3);
    // Points far from the load that are crushed by the weight above them are seen.
    program.strength.assign(program.contacts.size(), {200, 100, 4e2});
    EXPECT_FALSE(byPart(program));
    EXPECT_EQ(solveLimitAnalysis(program, {.tolerance = tolerance}).status, CollapseStatus::unstable);
}

TEST(ReachedPart, GrowsUntilItHoldsTheMechanism)
{
    // The last stone of the top course comes off alone, one farther in takes all up to the end along.
    const Assembly<2> assembly = squareWall(20);
    const int last = freeBlocksOf(assembly) - 1;
    const int few = expectSameAsWhole(underForce<2>(assembly, 0.65, last, {1, 0.2}));
    const int more = expectSameAsWhole(underForce<2>(assembly, 0.65, last - 9, {1, 0.2}));
    EXPECT_LT(few, more);
}

TEST(ReachedPart, DeadLoadIsCarriedOnceForAllLiveLoads)
{
    const Assembly<2> assembly = viaduct(20);
    CarriedDeadLoad<3, 2> carried;
    SymbolicAnalysis symbolic;
    const auto factorisations = [&](int block)
    {
        const auto program = underForce<2>(assembly, 0.7, block, {0, -1});
        const auto part = analyseReachedPart(program, {.tolerance = tolerance}, carried, symbolic);
        EXPECT_TRUE(part);
        return part ? part->factorisations : 0;
    };
    const int first = factorisations(10 * voussoirsOfSpan + 8);
    const Eigen::VectorXd forces = carried.contactForce;
    const int second = factorisations(10 * voussoirsOfSpan + 8);
    EXPECT_LT(second, first);
    EXPECT_EQ(carried.contactForce, forces);
    // Other forces carry another dead load.
    auto heavier = underForce<2>(assembly, 0.7, 10 * voussoirsOfSpan + 8, {0, -1});
    heavier.load *= 2;
    const auto part = analyseReachedPart(heavier, {.tolerance = tolerance}, carried, symbolic);
    ASSERT_TRUE(part);
    EXPECT_LE(part->certificate.worst(), tolerance);
    EXPECT_NE(carried.contactForce, forces);
}

TEST(ReachedPart, NothingWhereTheWholeIsToBeSolved)
{
    const Assembly<2> assembly = squareWall(20);
    const int last = freeBlocksOf(assembly) - 1;
    auto program = underForce<2>(assembly, 0.65, last, {1, 0});
    for (Eigen::Index row = 0; row < program.liveLoad.size(); row += 3)
    {
        program.liveLoad[row] = 1000; // everywhere
    }
    EXPECT_FALSE(byPart(program));
    program.liveLoad.setZero();
    EXPECT_FALSE(byPart(program));
    // Pressed upon it carries any load.
    EXPECT_FALSE(byPart(underForce<2>(assembly, 0.65, last, {0, -1})));
    // Small.
    EXPECT_FALSE(byPart(underForce<2>(squareWall(8), 0.65, 70, {1, 0})));
    // The dead load is not carried: without friction an arch falls.
    EXPECT_FALSE(byPart(underForce<2>(viaduct(12), 0.01, 100, {0, -1})));
}

TEST(ReachedPart, RandomWallsAndForces)
{
    std::mt19937 random(20261125);
    const auto even = [&random](double from, double to)
    { return from + (to - from) * std::ldexp(static_cast<double>(random()), -32); };
    int answered = 0;
    constexpr int walls = 200;
    for (int wall = 0; wall < walls; ++wall)
    {
        const auto size = static_cast<int>(even(15, 26));
        const Assembly<2> assembly = squareWall(size);
        const auto block = static_cast<int>(even(0.7, 1) * freeBlocksOf(assembly));
        const double angle = even(0, 1) * std::numbers::pi;
        const auto program = underForce<2>(assembly, even(0.2, 1), block, {std::cos(angle), std::sin(angle)});
        const std::optional<LimitAnalysis> part = byPart(program);
        if (!part)
        {
            continue;
        }
        ++answered;
        const LimitAnalysis whole = solveLimitAnalysis(program, {.tolerance = tolerance});
        EXPECT_EQ(whole.status, CollapseStatus::optimal) << wall;
        EXPECT_NEAR(part->alpha, whole.alpha, 1e-7 * whole.alpha) << wall;
        EXPECT_LE(part->certificate.worst(), tolerance) << wall;
    }
    EXPECT_GE(answered, walls / 4);
    RecordProperty("answered", answered);
}

} // namespace
