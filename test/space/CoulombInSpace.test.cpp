// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
// Limit analysis with Coulomb's law in space: closed forms, and the lowest multipliers known.
#include "../MadeStructure.h"
#include "SpaceStructures.h"
#include "dictionary/Dictionary.h"
#include "statics/NonAssociative.h"

#include <gtest/gtest.h>

#include <numbers>

namespace drystone
{
namespace
{

void expectCoulomb(const SpaceConeProgram& program, const LimitAnalysis& result)
{
    ASSERT_EQ(result.status, CollapseStatus::optimal);
    const Eigen::VectorXd mechanism = result.mechanism / program.liveLoad.dot(result.mechanism);
    EXPECT_LE(coulombResiduals(program, result.alpha, result.contactForce, mechanism).worst(), 1e-6);
    EXPECT_LE(result.alpha, result.coulomb->associative * (1 + 1e-9));
}

/// Paths, refinement, steps from rest: each ends where it is requested to, and what was met before is left.
void expectToEndAnywhere(const SpaceConeProgram& program)
{
    const LimitAnalysis whole = solveNonAssociative(program);
    double before = std::numeric_limits<double>::infinity();
    int work = 0;
    bool isCut = true;
    for (int asks = 0; isCut; asks += 1 + asks / 8)
    {
        SCOPED_TRACE(testing::Message() << asks << " asks");
        int asked = 0;
        const LimitAnalysis result =
            solveNonAssociative(program, {.isOver = [&] { return asked++ >= asks; }});
        isCut = isCutShort(result);
        EXPECT_LE(asked, asks + 1); // what is over stays so
        EXPECT_LE(result.alpha, before);
        before = result.alpha;
        if (result.status == CollapseStatus::optimal)
        {
            expectCoulomb(program, result);
        }
        else
        {
            EXPECT_EQ(result.status, CollapseStatus::upperBound);
            EXPECT_GE(result.factorisations, work);
            work = result.factorisations;
        }
    }
    EXPECT_EQ(before, whole.alpha);
}

SpaceConeProgram reference(const std::string& name, double mu, const Vector<3>& direction,
                           const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity())
{
    const Dictionary dictionary =
        Dictionary::readFile(std::string(DRYSTONE_SOURCE_DIR) + "/test/space/references/" + name);
    const Assembly<3> assembly =
        test::transformed(madeStructure<3>(dictionary.subDict("blockTextureDict")), turn, 1, {0, 0, 0});
    return test::programOf(assembly, findContactPoints(assembly), mu,
                           test::pushed(assembly, turn * direction));
}

} // namespace

// It was 0.203187 as built and 0.176471 turned by 130 degrees: which way a path goes was decided by tangents,
// the order of corners, norms by components and rounding.
TEST(CoulombInSpace, AWallThatIsTurnedOrMirroredCollapsesAtTheSameMultiplier)
{
    const LimitAnalysis asBuilt = solveNonAssociative(reference("wallL316", 0.65, {0, -1, 0}));
    const Eigen::Matrix3d mirrored = Eigen::Vector3d(-1, 1, 1).asDiagonal();
    const auto upright = [](double degrees) {
        return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Eigen::Vector3d::UnitZ())
            .toRotationMatrix();
    };
    for (const Eigen::Matrix3d& turn : {upright(17), upright(45), upright(73), upright(130), mirrored,
                                        Eigen::Matrix3d(upright(17) * mirrored)})
    {
        const SpaceConeProgram program = reference("wallL316", 0.65, {0, -1, 0}, turn);
        const LimitAnalysis turned = solveNonAssociative(program);
        expectCoulomb(program, turned);
        EXPECT_NEAR(turned.alpha, asBuilt.alpha, 1e-9);
        EXPECT_EQ(turned.coulomb->starts, asBuilt.coulomb->starts);
        EXPECT_EQ(turned.coulomb->converged, asBuilt.coulomb->converged);
    }
}

// What the forces of the associative collapse allow costs one program, but was tried after all paths: with
// the time over before, there was a bound alone.
TEST(CoulombInSpace, BoxesThatSlideAreAnsweredWhenTheTimeIsOverAtOnce)
{
    const Assembly<3> assembly =
        test::onGround({makeBox({0, 0, 0}, {0.4, 0.7, 0.3}), makeBox({0.4, 0, 0}, {0.8, 0.7, 0.3})});
    const SpaceConeProgram program =
        test::programOf(assembly, findContactPoints(assembly), 0.5, test::pushed(assembly, {1, 0, 0}));
    const LimitAnalysis result = solveNonAssociative(program, {.isOver = [] { return true; }});
    EXPECT_TRUE(isCutShort(result));
    expectCoulomb(program, result);
    EXPECT_NEAR(result.alpha, 0.5, 1e-6);
}

// Law 6: without dilatancy the prism is not wedged.
TEST(CoulombInSpace, APrismInAGrooveSlidesAtMuOverCosine)
{
    test::Chance chance(17);
    for (int i = 0; i < test::instances; ++i)
    {
        SCOPED_TRACE(testing::Message() << "instance " << i);
        const double slope = i == 0 ? std::numbers::pi / 4 : i == 1 ? std::numbers::pi / 6 : chance(0.2, 1.2);
        const double mu = i == 0 ? 0.3 : i == 1 ? 0.5 : chance(0.05, 0.9 / std::tan(slope));
        const double h = std::tan(slope);
        const auto along = [](const std::vector<Vector<2>>& outline, double from, double to)
        {
            std::vector<Vector<3>> start;
            std::vector<Vector<3>> end;
            for (const Vector<2>& corner : outline)
            {
                start.emplace_back(from, corner.x(), corner.y());
                end.emplace_back(to, corner.x(), corner.y());
            }
            return makePrism(start, end);
        };
        Assembly<3> assembly;
        assembly.blocks = {{along({{0, 0}, {1, h}, {-1, h}}, -10, 10), -1},
                           {along({{0, 0}, {2, 0}, {2, 2 * h}}, -20, 20), 0},
                           {along({{0, 0}, {-2, 2 * h}, {-2, 0}}, -20, 20), 0}};
        assembly.supports = {{"groove", "blocks"}};
        const SpaceConeProgram program =
            test::programOf(assembly, findContactPoints(assembly), mu, test::pushed(assembly, {1, 0, 0}));
        const LimitAnalysis result = solveNonAssociative(program);
        expectCoulomb(program, result);
        EXPECT_NEAR(result.alpha, mu / std::cos(slope), 1e-6);
    }
}

// No path from the forces for the dead load ends in a collapse; motion from rest begins well below the
// associative multiplier.
TEST(CoulombInSpace, BoxesThatNoPathAnswersAreAnsweredByStepsFromRest)
{
    struct Case
    {
        std::string blocks;
        std::vector<double> densities; ///< [kg/m3]
        Vector<3> gravity;
        double mu;
        Vector<3> inertia; ///< direction of inertial forces, and of a force on a block [N]
        Vector<3> force;
        int block;
        Vector<3> at;
        double associative;
        double coulomb;
    };
    const std::vector<Case> cases{
        {"((0.13 0.05 0) (0.48 0.53 0.22)) ((0.48 -0.05 0) (0.87 0.27 0.22)) ((0.87 -0.07 0) (1.5 0.4 0.22))",
         {1865, 2339, 1846},
         {0.27, 0.93, -9.81},
         0.69,
         {-1.01, 0.78, 0.41},
         {56.4, 99.2, 41.1},
         2,
         {1.144, 0.077, 0.09},
         0.235742876,
         0.134228},
        {"((0.11 0.06 0) (0.82 0.51 0.31)) ((0.82 -0.02 0) (1.52 0.46 0.31)) ((1.52 0.07 0) (2.16 0.56 "
         "0.31)) "
         "((0.01 0.06 0.31) (0.79 0.5 0.7)) ((0.79 -0.09 0.31) (1.52 0.4 0.7)) ((1.52 0.04 0.31) (1.85 0.38 "
         "0.7))",
         {1088, 2400, 1840, 1739, 1308, 1213},
         {-0.75, 0.56, -9.81},
         0.55,
         {0, 0, 0},
         {-544.4, -343.9, -32.9},
         5,
         {1.727, 0.251, 0.51},
         3.07846104,
         2.643}};
    for (const Case& boxes : cases)
    {
        const Assembly<3> assembly = madeStructure<3>(
            Dictionary::readString("dimensions 3; texture { type boxes; blocks (" + boxes.blocks
                                   + "); } supports { ground { type ground; margin 10; } }"));
        std::vector<double> masses = boxes.densities;
        for (std::size_t block = 0; block < masses.size(); ++block)
        {
            masses[block] *= volumeProperties(assembly.blocks[block].shape).volume;
        }
        masses.push_back(1); // the ground
        LoadVectors loads{gravityLoad(assembly, masses, boxes.gravity),
                          inertialLoad(assembly, masses, boxes.gravity, boxes.inertia)};
        const auto row = 6 * boxes.block;
        const Vector<3> centroid =
            volumeProperties(assembly.blocks[static_cast<std::size_t>(boxes.block)].shape).centroid;
        loads.live.segment<3>(row) += boxes.force;
        loads.live.segment<3>(row + 3) += (boxes.at - centroid).cross(boxes.force);
        const std::vector<ContactPoint<3>> points = findContactPoints(assembly);
        SpaceConeProgram program = test::programOf(assembly, points, boxes.mu, loads);
        for (std::size_t point = 0; point < points.size(); ++point)
        {
            const int ground = static_cast<int>(assembly.blocks.size()) - 1;
            const auto pair = std::minmax(points[point].block, points[point].neighbour);
            program.friction[point] = pair == std::minmax(2, ground) ? 0.15 : boxes.mu;
        }
        const LimitAnalysis result = solveNonAssociative(program, {}, {});
        expectCoulomb(program, result);
        EXPECT_NEAR(result.coulomb->associative, boxes.associative, 1e-6 * boxes.associative);
        EXPECT_LE(result.alpha, boxes.coulomb * (1 + 1e-5));
        expectToEndAnywhere(program);
    }
}

// In the first of these rows, as in some small walls that slide as a whole, every path ends without a
// collapse.
// A box of weight W between two walls is drawn upwards 0.09 m off its centre: N = 0.09 P/0.3 on either
// wall and P = W/(1 - 0.6 mu). By the associative law it wedges; that was said of Coulomb's, too.
TEST(CoulombInSpace, ABoxIsDrawnOutOfASlotInWhichItWedgesByTheAssociativeLaw)
{
    Assembly<3> assembly;
    assembly.blocks = {{makeBox({0, 0, 0}, {0.4, 0.5, 0.5}), 0},
                       {makeBox({0.6, 0, 0}, {1, 0.5, 0.5}), 0},
                       {makeBox({0.4, 0, 0.2}, {0.6, 0.5, 0.9}), -1}};
    assembly.supports = {{"walls", "blocks"}};
    LoadVectors loads = test::pushed(assembly, {0, 0, 1});
    const double weight = -loads.dead[2];
    loads.live << 0, 0, weight, 0, -0.09 * weight, 0;
    for (const double mu : {0.1, 0.2, 0.3, 0.4, 0.6})
    {
        SCOPED_TRACE(mu);
        const SpaceConeProgram program = test::programOf(assembly, findContactPoints(assembly), mu, loads);
        const LimitAnalysis result = solveNonAssociative(program);
        EXPECT_TRUE(std::isinf(result.coulomb->associative));
        ASSERT_EQ(result.status, CollapseStatus::optimal);
        const Eigen::VectorXd mechanism = result.mechanism / program.liveLoad.dot(result.mechanism);
        EXPECT_LE(coulombResiduals(program, result.alpha, result.contactForce, mechanism).worst(), 1e-6);
        // It may slide out askew, with less friction.
        EXPECT_LE(result.alpha, 1.01 / (1 - 0.6 * mu));
        EXPECT_GE(result.alpha, 1);
    }
    // A load that needs no friction is feasible by any law.
    loads.live *= -1;
    assembly.blocks.push_back({makeBox({0.4, 0, 0}, {0.6, 0.5, 0.2}), 0});
    const SpaceConeProgram pressed = test::programOf(assembly, findContactPoints(assembly), 0.3, loads);
    EXPECT_EQ(solveNonAssociative(pressed).status, CollapseStatus::unbounded);
}

TEST(CoulombInSpace, BoxesInARowSlideAtMu)
{
    test::Chance chance(18);
    for (int i = 0; i < test::instances; ++i)
    {
        SCOPED_TRACE(testing::Message() << "instance " << i);
        const double mu = i == 0 ? 0.5 : chance(0.2, 0.6);
        const double height = i == 0 ? 0.3 : chance(0.1, 0.3);
        Assembly<3> assembly;
        assembly.supports = {{"ground", "ground"}};
        assembly.blocks = {{makeBox({-9, -9, -1}, {9, 9, 0}), 0}};
        double left = 0.034;
        for (int box = 0; box < 2 + i % 2; ++box)
        {
            const double right = left + (i == 0 ? 0.37 - 0.001 * box : chance(0.35, 0.5));
            assembly.blocks.push_back({makeBox({left, 0, 0}, {right, 0.7, height}), -1});
            left = right;
        }
        const SpaceConeProgram program =
            test::programOf(assembly, findContactPoints(assembly), mu, test::pushed(assembly, {1, 0, 0}));
        const LimitAnalysis result = solveNonAssociative(program);
        expectCoulomb(program, result);
        EXPECT_NEAR(result.alpha, mu, 1e-6);
        EXPECT_GE(result.coulomb->converged, 1);
    }
}

// All slide on the ground at mu. The shears that the solver finds are off that by 1e-5 of their directions.
TEST(CoulombInSpace, BoxesInThreeLayersSlideAtMu)
{
    Assembly<3> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {{makeBox({-2, -2, -0.5}, {5, 5, 0}), 0}};
    for (const auto& [from, to] : {std::pair{Vector<3>(0, 0, 0), Vector<3>(0.4, 0.2, 0.2)},
                                   {Vector<3>(0.4, 0, 0), Vector<3>(0.8, 0.2, 0.2)},
                                   {Vector<3>(0, 0.2, 0), Vector<3>(0.4, 0.4, 0.2)},
                                   {Vector<3>(0.4, 0.2, 0), Vector<3>(0.8, 0.4, 0.2)},
                                   {Vector<3>(0.2, 0, 0.2), Vector<3>(0.6, 0.2, 0.4)},
                                   {Vector<3>(0.2, 0.2, 0.2), Vector<3>(0.6, 0.4, 0.4)},
                                   {Vector<3>(0.1, 0.1, 0.4), Vector<3>(0.5, 0.3, 0.6)}})
    {
        assembly.blocks.push_back({makeBox(from, to), -1});
    }
    for (const Vector<3>& direction :
         {Vector<3>(1, 0, 0), Vector<3>(0, 1, 0), Vector<3>(1, 1, 0).normalized()})
    {
        SCOPED_TRACE(direction.transpose());
        const SpaceConeProgram program =
            test::programOf(assembly, findContactPoints(assembly), 0.3, test::pushed(assembly, direction));
        const LimitAnalysis result = solveNonAssociative(program);
        expectCoulomb(program, result);
        EXPECT_NEAR(result.alpha, 0.3, 1e-6);
        expectToEndAnywhere(program);
    }
}

// A box between two walls lifted by its own weight: nothing presses at its least multiplier, which is 1.
TEST(CoulombInSpace, ABoxIsLiftedOutOfASlotByItsWeight)
{
    Assembly<3> assembly;
    assembly.blocks = {{makeBox({0, 0, 0}, {0.4, 0.5, 0.5}), 0},
                       {makeBox({0.6, 0, 0}, {1, 0.5, 0.5}), 0},
                       {makeBox({0.4, 0, 0}, {0.6, 0.5, 0.2}), 0},
                       {makeBox({0.4, 0, 0.2}, {0.6, 0.5, 0.9}), -1}};
    assembly.supports = {{"walls", "blocks"}};
    const SpaceConeProgram program =
        test::programOf(assembly, findContactPoints(assembly), 0.3, test::pushed(assembly, {0, 0, 1}));
    const LimitAnalysis result = solveNonAssociative(program);
    ASSERT_EQ(result.status, CollapseStatus::optimal);
    EXPECT_NEAR(result.alpha, 1, 1e-6);
}

TEST(CoulombInSpace, TheLWallIsNoHigherThanTheLowestKnown)
{
    const SpaceConeProgram program = reference("wallL316", 0.65, {0, -1, 0});
    const LimitAnalysis result = solveNonAssociative(program);
    expectCoulomb(program, result);
    EXPECT_NEAR(result.coulomb->associative, 0.207494721, 1e-6);
    EXPECT_LE(result.alpha, 0.203232297 + 5e-10);
}

TEST(CoulombInSpace, HousesDomesTowersAndBondsAreAnswered)
{
    struct Case
    {
        const char* name;
        double mu;
        Vector<3> direction;
    };
    for (const Case& structure :
         {Case{"houseWithDoor", 0.65, {1, 0, 0}}, Case{"domeWithOculus", 0.7, {1, 0, 0}},
          Case{"tower", 0.6, {1, 0, 0}}, Case{"englishBond", 0.6, {0, 1, 0}},
          Case{"flemishBond", 0.6, {0, 1, 0}}, Case{"wallL428", 0.65, {0, -1, 0}}})
    {
        SCOPED_TRACE(structure.name);
        const SpaceConeProgram program = reference(structure.name, structure.mu, structure.direction);
        expectCoulomb(program, solveNonAssociative(program));
    }
}

// A house of hundreds of blocks: a path has several pieces for each of its points, and takes minutes.
TEST(CoulombInSpace, AHouseOfHundredsOfBlocksIsAnsweredWithoutPaths)
{
    const Assembly<3> assembly = madeStructure<3>(Dictionary::readString(R"(
        dimensions 3;
        texture
        {
            type walls;
            unit (0.4 0.2 0.2);
            bond running;
            courses 14;
            walls
            {
                front { from (0 0); length 12; }
                back { from (0 3.6); length 12; thickness right; }
                left { from (0 0); direction (0 1); length 9; thickness right; }
                right { from (4.8 0); direction (0 1); length 9; thickness left; }
            }
            openings
            (
                { wall front; from (2 0); to (4 8); lintel 0.5; }
                { wall front; from (7 4); to (9 9); lintel 1; }
                { wall right; from (3 4); to (5 9); lintel 1; }
            );
        }
        supports { ground { type ground; } }
    )"));
    const auto points = findContactPoints(assembly);
    ASSERT_GT(points.size(), 4000u);
    const SpaceConeProgram program =
        test::programOf(assembly, points, 0.65, test::pushed(assembly, {1, 0, 0}));
    // To the first collapse; others are looked for until none is lower, half a minute longer.
    bool hasFollowedPath = false;
    bool isMet = false;
    const NonAssociativeSettings settings{.observe =
                                              [&](const CollapseProgress& progress)
                                          {
                                              hasFollowedPath = hasFollowedPath || progress.isPath;
                                              isMet = isMet || std::isfinite(progress.lowest);
                                          },
                                          .isOver = [&] { return isMet; }};
    const LimitAnalysis result = solveNonAssociative(program, settings);
    expectCoulomb(program, result);
    EXPECT_FALSE(hasFollowedPath);
    EXPECT_EQ(result.coulomb->starts, 2);
    EXPECT_EQ(result.coulomb->converged, 1);
    EXPECT_LT(result.alpha, 0.95 * result.coulomb->associative); // 0.272, of which friction is a part
}

// A box with cohesion over its base: C + mu W, whichever way it is pushed.
TEST(CoulombInSpace, ABoxWithCohesionSlidesAtItsClosedForm)
{
    for (const double angle : {0.0, 0.5, 0.785})
    {
        const Assembly<3> assembly = test::onGround({makeBox({0, 0, 0}, {1, 1, 0.2})});
        SpaceConeProgram program =
            test::programOf(assembly, findContactPoints(assembly), 0.3,
                            test::pushed(assembly, {std::cos(angle), std::sin(angle), 0}));
        program.strength.assign(program.friction.size(), {.cohesion = 0.005}); // of a weight of 0.2
        const LimitAnalysis result = solveNonAssociative(program);
        expectCoulomb(program, result);
        EXPECT_NEAR(result.alpha, 0.3 + 0.02 / 0.2, 1e-6) << angle;
    }
}

/// The stone in the middle of three courses, pushed alone along the wall. 600 starts by paths from forces
/// that carry the dead load end at 1.336 at the lowest; the mechanism of such forces' pressures leads lower.
TEST(CoulombInSpace, AStoneInAWallIsPushedOutAtNoMoreThanTheLowestKnown)
{
    std::vector<Polyhedron> stones;
    const auto add = [&stones](int course, double from, double to) {
        stones.push_back(makeBox({from, 0, 0.065 * course}, {to, 0.125, 0.065 * (course + 1)}));
    };
    for (const int course : {0, 2})
    {
        add(course, 0, 0.25);
        add(course, 0.25, 0.5);
    }
    add(1, 0, 0.125);
    add(1, 0.125, 0.375);
    add(1, 0.375, 0.5);
    constexpr int pushedStone = 5;
    const Assembly<3> assembly = test::onGround(stones);
    LoadVectors loads = test::pushed(assembly, {0.996905, 0, -0.0786135});
    const Eigen::Matrix<double, 6, 1> pushed = loads.live.segment<6>(6 * pushedStone);
    loads.live.setZero();
    loads.live.segment<6>(6 * pushedStone) = pushed;
    const SpaceConeProgram program = test::programOf(assembly, findContactPoints(assembly), 0.497, loads);
    const LimitAnalysis result = solveNonAssociative(program);
    expectCoulomb(program, result);
    EXPECT_LE(result.alpha, 1.2975);
}

TEST(CoulombInSpace, Wall1ExtrudedIsNoHigherThanInThePlane)
{
    const SpaceConeProgram program = reference("extrudedWall1", 0.65, {1, 0, 0});
    const LimitAnalysis result = solveNonAssociative(program, {.starts = 2});
    expectCoulomb(program, result);
    EXPECT_LE(result.alpha, 0.638982 + 5e-7);
}

} // namespace drystone
