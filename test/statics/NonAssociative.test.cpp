// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analysis with Coulomb's law: every collapse is checked as a pair of forces and mechanism, and the
/// six walls are compared with the lowest multipliers known.
#include "statics/NonAssociative.h"
#include "Structures.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace drystone;

namespace
{

/// What the lowest collapse found is made of, by the program and not by the search.
void expectCoulomb(const PlaneConeProgram& program, const LimitAnalysis& result)
{
    // The mechanism comes with its largest entry 1: the live load's work scales it back.
    const Eigen::VectorXd mechanism = result.mechanism / program.liveLoad.dot(result.mechanism);
    const CoulombResiduals residuals =
        coulombResiduals(program, result.alpha, result.contactForce, mechanism);
    EXPECT_LE(residuals.balance, 1e-8);
    EXPECT_LE(residuals.yield, 1e-6);
    EXPECT_LE(residuals.flow, 1e-6);
    EXPECT_LE(residuals.mismatch, 1e-6);
}

} // namespace

TEST(NonAssociative, MeetsTheLowestKnownMultipliersOfTheSixWallsByDefault)
{
    // None higher than what earlier searches found from many starts; of wall 6 a lower one came with them.
    const double met[] = {0.638982, 0.557416, 0.355817, 0.263736, 0.207973, 0.295762};
    const std::vector<Wall> walls = paperWalls();
    for (std::size_t i = 0; i < walls.size(); ++i)
    {
        const WeighedStructure structure = standing(walls[i].bond);
        const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
        const LimitAnalysis result = solveNonAssociative(program);
        ASSERT_EQ(result.status, CollapseStatus::optimal) << "wall " << i + 1;
        expectCoulomb(program, result);
        EXPECT_LE(result.alpha, met[i] + 5e-7) << "wall " << i + 1;
        EXPECT_GE(result.alpha, 0.98 * met[i]) << "wall " << i + 1;
        ASSERT_TRUE(result.coulomb.has_value());
        EXPECT_NEAR(result.coulomb->associative, walls[i].alpha, 1e-6);
        EXPECT_LE(result.coulomb->highest, result.coulomb->associative + 1e-9);
        EXPECT_EQ(result.coulomb->lowest, result.alpha);
        EXPECT_EQ(result.coulomb->starts, 1);
        EXPECT_EQ(result.coulomb->converged, 1);
    }
}

TEST(NonAssociative, MoreStartsLeadToCollapsesAndToNoneHigherThanTheFirst)
{
    const std::vector<Wall> walls = paperWalls();
    for (std::size_t i = 0; i < walls.size(); ++i)
    {
        const WeighedStructure structure = standing(walls[i].bond);
        const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
        const LimitAnalysis one = solveNonAssociative(program);
        const LimitAnalysis twelve = solveNonAssociative(program, {.starts = 12});
        ASSERT_EQ(twelve.status, CollapseStatus::optimal) << "wall " << i + 1;
        expectCoulomb(program, twelve);
        EXPECT_LE(twelve.alpha, one.alpha) << "wall " << i + 1;
        EXPECT_GE(twelve.coulomb->converged, 6) << "wall " << i + 1;
    }
}

/// A wall of five courses whose lowest right stone alone is drawn out. The stones beside it can carry all
/// that is above, so that it slides with its own weight: at mu, the least of all pairs (a mixed-integer
/// program over the states of the points finds none below). Where it carries the wall it is at ten times
/// that.
TEST(NonAssociative, AStoneIsDrawnOutOfASmallWallAtItsOwnFriction)
{
    constexpr double friction = 0.23;
    RunningBond bond;
    bond.unit = {0.424, 0.1666};
    bond.length = 2;
    bond.courses = 5;
    const WeighedStructure structure = standing(bond);
    LoadVectors loads = structure.weightLoads();
    constexpr int stone = 2;
    const Eigen::Vector3d drawn = loads.live.segment<3>(3 * stone);
    loads.live.setZero();
    loads.live.segment<3>(3 * stone) = drawn;
    const PlaneConeProgram program = structure.program(friction, loads);
    const LimitAnalysis result = solveNonAssociative(program);
    ASSERT_EQ(result.status, CollapseStatus::optimal);
    expectCoulomb(program, result);
    EXPECT_NEAR(result.alpha, friction, 1e-6);
    EXPECT_GT(result.coulomb->associative, 5 * friction);
}

TEST(NonAssociative, IsTheSameOnASecondRun)
{
    const WeighedStructure structure = standing(paperWalls()[4].bond);
    const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
    const NonAssociativeSettings settings{.starts = 2};
    const LimitAnalysis one = solveNonAssociative(program, settings);
    const LimitAnalysis two = solveNonAssociative(program, settings);
    EXPECT_EQ(one.alpha, two.alpha);
    EXPECT_EQ(one.contactForce, two.contactForce);
}

TEST(NonAssociative, ReportsHowFarItHasComeWithoutChangingTheResult)
{
    const WeighedStructure structure = standing(paperWalls()[4].bond);
    const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
    std::vector<CollapseProgress> reported;
    NonAssociativeSettings settings{.starts = 3};
    const LimitAnalysis silent = solveNonAssociative(program, settings);
    settings.observe = [&reported](const CollapseProgress& progress) { reported.push_back(progress); };
    const LimitAnalysis observed = solveNonAssociative(program, settings);
    EXPECT_EQ(observed.alpha, silent.alpha);
    EXPECT_EQ(observed.mechanism, silent.mechanism);
    ASSERT_FALSE(reported.empty());
    EXPECT_EQ(reported.front().path, 1);
    EXPECT_TRUE(std::isinf(reported.front().lowest));
    EXPECT_EQ(reported.back().path, 3);
    EXPECT_GE(reported.back().lowest, observed.alpha);
    EXPECT_LT(reported.back().lowest, observed.coulomb->associative);
    for (std::size_t i = 1; i < reported.size(); ++i)
    {
        EXPECT_TRUE(reported[i].path > reported[i - 1].path || reported[i].pieces > reported[i - 1].pieces);
    }
}

TEST(NonAssociative, WithoutTimeIsTheBoundOfTheAssociativeLaw)
{
    const WeighedStructure structure = standing(paperWalls()[4].bond);
    const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
    const LimitAnalysis associative = solveLimitAnalysis(program);
    const LimitAnalysis result = solveNonAssociative(program, {.maximumTime = 1e-9});
    EXPECT_EQ(result.status, CollapseStatus::upperBound);
    EXPECT_EQ(result.alpha, associative.alpha);
    EXPECT_EQ(result.contactForce, associative.contactForce);
    EXPECT_EQ(result.mechanism, associative.mechanism);
    EXPECT_EQ(result.certificate.worst(), associative.certificate.worst());
    EXPECT_EQ(result.coulomb->starts, 0);
    EXPECT_TRUE(std::isinf(result.coulomb->lowest));
    EXPECT_TRUE(std::isfinite(result.coulomb->safe));
    ASSERT_TRUE(isCutShort(result));
    EXPECT_GE(*result.coulomb->cutShortAfter, 1e-9);
}

TEST(NonAssociative, BeforeItsTimeIsUsedUpIsTheSameAsWithoutLimit)
{
    const WeighedStructure structure = standing(paperWalls()[4].bond);
    const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
    const LimitAnalysis any = solveNonAssociative(program, {.starts = 3});
    const LimitAnalysis limited =
        solveNonAssociative(program, {.starts = 3, .maximumTime = 1e9, .isOver = [] { return false; }});
    EXPECT_FALSE(isCutShort(any));
    EXPECT_FALSE(isCutShort(limited));
    EXPECT_EQ(limited.status, any.status);
    EXPECT_EQ(limited.alpha, any.alpha);
    EXPECT_EQ(limited.contactForce, any.contactForce);
    EXPECT_EQ(limited.mechanism, any.mechanism);
    EXPECT_EQ(limited.certificate.worst(), any.certificate.worst());
    EXPECT_EQ(limited.iterations, any.iterations);
    EXPECT_EQ(limited.factorisations, any.factorisations);
    EXPECT_EQ(limited.coulomb->highest, any.coulomb->highest);
    EXPECT_EQ(limited.coulomb->starts, 3);
}

TEST(NonAssociative, APathThatIsEndedLeavesThePairOfBefore)
{
    const WeighedStructure structure = standing(paperWalls()[4].bond);
    const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
    const LimitAnalysis one = solveNonAssociative(program, {.starts = 1});
    CollapseProgress last;
    NonAssociativeSettings settings{.starts = 3};
    settings.observe = [&last](const CollapseProgress& progress) { last = progress; };
    settings.isOver = [&last] { return last.path == 2 && last.pieces >= 3; };
    const LimitAnalysis result = solveNonAssociative(program, settings);
    EXPECT_EQ(last.path, 2);
    EXPECT_EQ(last.pieces, 3);
    EXPECT_TRUE(isCutShort(result));
    EXPECT_EQ(result.status, CollapseStatus::optimal);
    EXPECT_EQ(result.alpha, one.alpha);
    EXPECT_EQ(result.contactForce, one.contactForce);
    EXPECT_EQ(result.mechanism, one.mechanism);
    EXPECT_EQ(result.coulomb->starts, 2);
    EXPECT_EQ(result.coulomb->converged, 1);
}

TEST(NonAssociative, WhereverItIsEndedIsTheLowestPairSoFar)
{
    const WeighedStructure structure = standing(paperWalls()[0].bond);
    const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
    const double associative = solveLimitAnalysis(program).alpha;
    double before = associative;
    bool isCut = true;
    int pairs = 0;
    for (int asks = 0; isCut; asks += 1 + asks / 50)
    {
        SCOPED_TRACE(asks);
        int asked = 0;
        const LimitAnalysis result =
            solveNonAssociative(program, {.starts = 3, .isOver = [&] { return asked++ >= asks; }});
        isCut = isCutShort(result);
        EXPECT_LE(asked, asks + 1); // what is over stays so
        EXPECT_LE(result.alpha, before);
        if (result.status == CollapseStatus::optimal)
        {
            expectCoulomb(program, result);
            pairs += isCut;
        }
        else
        {
            EXPECT_EQ(result.status, CollapseStatus::upperBound);
            EXPECT_EQ(result.alpha, associative);
        }
        before = result.alpha;
    }
    EXPECT_GT(pairs, 0);
    EXPECT_LE(before, 0.638982 + 5e-7);
}

TEST(NonAssociative, OfAMonolithIsThatOfTheAssociativeLaw)
{
    // Statically determinate: normal forces follow from equilibrium.
    for (const double mu : {0.1, 0.65})
    {
        Assembly<2> assembly;
        assembly.supports = {{"ground", "ground"}};
        assembly.blocks = {rectangle(0, 0, 0.5, 2), rectangle(-1, -1, 2, 0, 0)};
        const WeighedStructure structure(std::move(assembly));
        const PlaneConeProgram program = structure.program(mu, structure.weightLoads());
        const LimitAnalysis result = solveNonAssociative(program);
        EXPECT_EQ(result.status, CollapseStatus::optimal);
        EXPECT_NEAR(result.alpha, std::min(mu, 0.25), 1e-8);
        expectCoulomb(program, result);
    }
}

TEST(NonAssociative, AtALooseToleranceOfTheSolverHasNoAnswerOrARightOne)
{
    // Mechanisms are so inexact then that no point may be left that carries anything.
    const WeighedStructure structure = standing(paperWalls()[0].bond);
    const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
    for (const double tolerance : {1e-3, 1e-4})
    {
        const LimitAnalysis result = solveNonAssociative(program, {.starts = 1}, {.tolerance = tolerance});
        if (result.status == CollapseStatus::optimal)
        {
            expectCoulomb(program, result);
        }
        else
        {
            EXPECT_EQ(result.status, CollapseStatus::notConverged);
        }
    }
}

TEST(NonAssociative, KnowsCohesionAndTension)
{
    // A block 1 x 1 of 1000 N: shear mu W + C, overturning about an end with T at the other.
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {rectangle(0, 0, 1, 1), rectangle(-1, -1, 2, 0, 0)};
    const WeighedStructure block(std::move(assembly));
    PlaneConeProgram program = block.program(0.3, block.weightLoads());
    program.strength.assign(2, {.cohesion = 50});
    LimitAnalysis result = solveNonAssociative(program);
    expectCoulomb(program, result);
    EXPECT_NEAR(result.alpha, 0.3 + 2 * 50.0 / 1000, 1e-7);
    program = block.program(2, block.weightLoads());
    program.strength.assign(2, {.cohesion = 100, .tension = 20});
    result = solveNonAssociative(program);
    expectCoulomb(program, result);
    EXPECT_NEAR(result.alpha, 1 + 2 * 20.0 / 1000, 1e-7);

    // A wall with weak mortar: a pair, and no higher than the associative one.
    const WeighedStructure wall = standing(paperWalls()[2].bond);
    program = wall.program(0.65, wall.weightLoads());
    program.strength.assign(program.friction.size(), {.cohesion = 5, .tension = 3});
    result = solveNonAssociative(program);
    ASSERT_EQ(result.status, CollapseStatus::optimal);
    expectCoulomb(program, result);
    EXPECT_LE(result.alpha, result.coulomb->associative * (1 + 1e-9));
    EXPECT_GT(result.alpha, 0.36);
}

TEST(NonAssociative, LeavesUnstableWhatIsUnstable)
{
    const WeighedStructure structure = standing(paperWalls()[0].bond);
    LoadVectors loads = structure.weightLoads();
    loads.dead += 0.7 * loads.live;
    const LimitAnalysis result = solveNonAssociative(structure.program(0.65, loads));
    EXPECT_EQ(result.status, CollapseStatus::unstable);
    EXPECT_LE(result.certificate.worst(), 1e-9);
}

TEST(NonAssociative, ALoadThatNeedsNoFrictionFromSomeMultiplierOnHasProvablyNoCollapse)
{
    // A block that friction alone holds, as 0.3 of its weight draws it away from a wall that the live load
    // presses it against: without friction it stands from 0.3 on.
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {rectangle(0, 0, 1, 1), rectangle(1, 0, 1, 1, 0), rectangle(-1, -1, 3, 0, 0)};
    const WeighedStructure structure(std::move(assembly));
    LoadVectors loads = structure.weightLoads();
    loads.dead -= 0.3 * loads.live;
    const LimitAnalysis result = solveNonAssociative(structure.program(0.65, loads));
    EXPECT_EQ(result.status, CollapseStatus::unbounded);
    ASSERT_TRUE(result.coulomb.has_value());
    EXPECT_TRUE(std::isinf(result.coulomb->safe));
    EXPECT_EQ(result.coulomb->starts, 0) << "proved without a search";
    EXPECT_EQ(result.coulomb->converged, 0);
    EXPECT_TRUE(std::isinf(result.coulomb->lowest));
    EXPECT_LE(result.certificate.worst(), 1e-9);
    // A live load that draws it away from there makes it slide.
    loads.dead += 0.6 * loads.live;
    loads.live *= -1;
    const LimitAnalysis drawn = solveNonAssociative(structure.program(0.65, loads));
    EXPECT_EQ(drawn.status, CollapseStatus::optimal);
    EXPECT_NEAR(drawn.alpha, 0.3 + 0.65, 1e-6);
}

namespace
{

/// A block of unit size on a slope of 1 in 2, which friction alone holds, under a live load of its own weight
/// along a direction.
PlaneConeProgram blockOnSlope(const Vector<2>& direction)
{
    Assembly<2> assembly;
    assembly.supports = {{"slope", "blocks"}};
    assembly.blocks = {{{{0, 0}, {2, 1}, {1, 3}, {-1, 2}}, 1, -1}, {{{-2, -1}, {4, -1}, {4, 2}}, 1, 0}};
    const WeighedStructure structure(std::move(assembly));
    LoadVectors loads = structure.weightLoads();
    loads.live = inertialLoad(structure.assembly, structure.weights, {0, -1}, direction);
    return structure.program(0.8, loads);
}

} // namespace

TEST(NonAssociative, ALoadThatNeedsNoFrictionItselfHasProvablyNoCollapse)
{
    // Square to the slope: no mechanism that opens no joint backwards lets it do work.
    const LimitAnalysis result = solveNonAssociative(blockOnSlope({1, -2}));
    EXPECT_EQ(result.status, CollapseStatus::unbounded);
    ASSERT_TRUE(result.coulomb.has_value());
    EXPECT_TRUE(std::isinf(result.coulomb->safe));
    EXPECT_GT(result.coulomb->safe, 0);
    EXPECT_EQ(result.coulomb->starts, 0) << "proved without a search";
    EXPECT_TRUE(hasAnswer(result));
}

TEST(NonAssociative, ALoadOfWhichAnyMultipleIsCarriedByFrictionHasNoCollapse)
{
    // Within the friction cone, down the slope: the one joint has one force only, which never slides.
    const PlaneConeProgram program = blockOnSlope({0, -1});
    const LimitAnalysis result = solveNonAssociative(program);
    EXPECT_EQ(result.status, CollapseStatus::unbounded);
    ASSERT_TRUE(result.coulomb.has_value());
    EXPECT_FALSE(result.coulomb->safe > 0);
    EXPECT_EQ(result.coulomb->converged, 0);
    EXPECT_GT(result.coulomb->starts, 0);
    EXPECT_LE(result.certificate.worst(), 1e-9);
    EXPECT_TRUE(hasAnswer(result));
    // Before the search has ended that is not said.
    const LimitAnalysis cut = solveNonAssociative(program, {.maximumTime = 1e-9});
    EXPECT_EQ(cut.status, CollapseStatus::upperBound);
    EXPECT_TRUE(std::isinf(cut.alpha));
    EXPECT_FALSE(hasAnswer(cut));
}

TEST(NonAssociative, ResidualsSeeWhatIsNotCoulombs)
{
    const WeighedStructure structure = standing(paperWalls()[2].bond);
    const PlaneConeProgram program = structure.program(0.65, structure.weightLoads());
    // The associative pair of the wall dilates where it slides.
    const ConeSolution associative = solveInteriorPoint(program);
    EXPECT_GT(
        coulombResiduals(program, associative.multiplier, associative.contactForce, associative.displacement)
            .flow,
        1e-2);
    const LimitAnalysis result = solveNonAssociative(program, {.starts = 1});
    const Eigen::VectorXd mechanism = result.mechanism / program.liveLoad.dot(result.mechanism);
    Eigen::VectorXd force = result.contactForce;
    force[1] += 0.1 * force.lpNorm<Eigen::Infinity>();
    EXPECT_GT(coulombResiduals(program, result.alpha, force, mechanism).worst(), 1e-3);
    EXPECT_GT(coulombResiduals(program, 1.01 * result.alpha, result.contactForce, mechanism).worst(), 1e-4);
}
