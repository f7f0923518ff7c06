// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The six walls of the paper on a ground that accelerates steadily: they stand below their collapse
/// multiplier and move above it, and what must hold while they fall holds.
#include "../MadeStructure.h"
#include "../SquareWall.h"
#include "Scenes.h"

#include "contact/Penetration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

namespace drystone
{
namespace
{

constexpr std::array<double, 6> multipliers{0.642859, 0.579999, 0.403694, 0.331948, 0.239643, 0.347825};

/// A wall of tutorials/limitAnalysis/masonryPanels, 1 to 6, at `share` of its multiplier: the blocks are
/// pushed to the right, or to the left where share is negative.
DynamicCase<2> wall(int number, double share, const scenes::Settings& settings)
{
    const std::string file = std::string(DRYSTONE_TUTORIALS) + "/limitAnalysis/masonryPanels/wall"
                             + std::to_string(number) + "/system/blockTextureDict";
    DynamicCase<2> scene = scenes::sceneOf(madeStructure(Dictionary::readFile(file)), settings);
    scenes::shake(scene, std::make_shared<ConstantAcceleration>(
                             -share * multipliers[static_cast<std::size_t>(number - 1)] * g));
    return scene;
}

double largestDisplacement(const Motion<2>& motion)
{
    double largest = 0;
    for (const Placement<2>& placement : motion.state.placements)
    {
        largest = std::max(largest, placement.translation.norm());
    }
    return largest;
}

class PaperWall : public testing::TestWithParam<int>
{
};

TEST_P(PaperWall, StandsStillAtOneThousandthBelowItsMultiplier)
{
    const DynamicCase<2> scene =
        wall(GetParam(), 0.999, {.mu = 0.65, .flowRule = FlowRule::associative, .tolerance = 1e-12});
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < 500; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, wallStep)) << "step " << step;
    }
    EXPECT_LT(largestDisplacement(motion), 1e-9);
}

// What a loose solver leaves of a displacement must not become momentum.
TEST_P(PaperWall, StandsStillBelowItsMultiplierAtAnyTolerance)
{
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10})
    {
        DynamicCase<2> scene =
            wall(GetParam(), 0.998, {.mu = 0.65, .flowRule = FlowRule::associative, .tolerance = tolerance});
        scene.schemes.smallDisplacements = true;
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        for (int step = 0; step < 50; ++step)
        {
            ASSERT_TRUE(advance(scene, motion, wallStep)) << "tolerance " << tolerance << " step " << step;
        }
        EXPECT_EQ(largestDisplacement(motion), 0) << "tolerance " << tolerance;
    }
}

TEST_P(PaperWall, MovesAtOneThousandthAbove)
{
    const DynamicCase<2> scene =
        wall(GetParam(), 1.001, {.mu = 0.65, .flowRule = FlowRule::associative, .tolerance = 1e-12});
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    while (motion.state.time < 0.2 - 0.5 * wallStep)
    {
        // At the onset a step of full length may not reach 1e-12; contactDynamics then halves it, too.
        double length = wallStep;
        while (!advance(scene, motion, length))
        {
            length /= 2;
            ASSERT_GT(length, wallStep / 1000) << "at " << motion.state.time << " s";
        }
    }
    EXPECT_GT(largestDisplacement(motion), 1e-6);
}

// Just above, the associative motion is next to nothing and Coulomb's a thousand times that: a fixed point
// that is drawn to the former does not converge.
TEST_P(PaperWall, MovesByCoulombsLawJustAbove)
{
    for (const double share : {1.0000017, 1.0005})
    {
        DynamicCase<2> scene =
            wall(GetParam(), share, {.mu = 0.65, .flowRule = FlowRule::nonAssociative, .tolerance = 1e-12});
        scene.schemes.smallDisplacements = true;
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        for (int step = 0; step < 3; ++step)
        {
            ASSERT_TRUE(advance(scene, motion, wallStep)) << "share " << share << " step " << step;
        }
        // Wall 1 moves least, by 7e-8 to 12e-8 m: a step ends when Coulomb's law is met to a part of what it
        // changes. By the associative law it moves by 5e-10 m.
        EXPECT_GT(largestDisplacement(motion), 3e-8) << "share " << share;
    }
}

TEST_P(PaperWall, FallsWithoutBlocksEnteringEachOtherAndItsEnergyIsAccountedFor)
{
    const DynamicCase<2> scene =
        wall(GetParam(), 1.1, {.mu = 0.65, .flowRule = FlowRule::associative, .tolerance = 1e-9});
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    double factorisations = 0;
    for (int step = 0; step < 500; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, wallStep)) << "step " << step;
        // 1.4e-10 in the first steps, in which blocks move by 1e-5 m.
        EXPECT_LT(scenes::relativeImbalance(motion.energy), 3e-10) << "step " << step;
        factorisations += motion.residuals.factorisations;
        if (step % 20 == 19)
        {
            EXPECT_LT(penetration(scene.assembly, motion.state.placements).depth, 1e-6 * scene.blockSize)
                << "step " << step;
        }
    }
    EXPECT_GT(largestDisplacement(motion), 0.02);
    EXPECT_LE(factorisations / 500, 30);
}

/// Factorisations of a collapse by Coulomb's law in 100 steps.
double factorisationsOf(int number, double restitution)
{
    const DynamicCase<2> scene = wall(
        number, 1.1,
        {.mu = 0.65, .flowRule = FlowRule::nonAssociative, .restitution = restitution, .tolerance = 1e-9});
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    double factorisations = 0;
    for (int step = 0; step < 100; ++step)
    {
        EXPECT_TRUE(advance(scene, motion, wallStep)) << "step " << step;
        factorisations += motion.residuals.factorisations;
    }
    return factorisations;
}

// As joints turn, points close by 1e-6 m/s in every step: too slowly to rebound, so that they need no impact
// of their own. Each of these took several programs: 200 times the factorisations on wall 1, 115 on wall 3.
TEST(Restitution, CostsAWallThatFallsWithoutBlowsNothing)
{
    for (const int number : {1, 3, 4})
    {
        EXPECT_EQ(factorisationsOf(number, 0.3), factorisationsOf(number, 0)) << "wall " << number;
    }
}

/// Collapses wall 1 for some steps, with its energy in balance. \param programs of each step, filled in
void collapse(const scenes::Settings& settings, int steps, std::vector<int>& programs)
{
    const DynamicCase<2> scene = wall(1, 1.1, settings);
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < steps; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, wallStep)) << "step " << step;
        EXPECT_LT(scenes::relativeImbalance(motion.energy), 1e-6) << "step " << step;
        programs.push_back(motion.residuals.programs);
    }
}

// An impact that stops all points to its tolerance is not repeated for what the tolerance leaves (that took
// up to ten impacts a step, 34 programs and 600 factorisations on average).
TEST(FallingWall, NoPointIsHitTwiceForWhatAnImpactLeaves)
{
    constexpr int steps = 100;
    std::vector<int> programs;
    ASSERT_NO_FATAL_FAILURE(
        collapse({.mu = 0.65, .flowRule = FlowRule::associative, .restitution = 0.3, .tolerance = 1e-6},
                 steps, programs));
    EXPECT_LT(std::accumulate(programs.begin(), programs.end(), 0), 10 * steps);
}

// In steady motion Newton's method finds Coulomb's law from the forces of the last step, without any program.
TEST(FallingWall, CoulombsLawIsMostlyFoundFromTheLastStep)
{
    std::vector<int> programs;
    ASSERT_NO_FATAL_FAILURE(
        collapse({.mu = 0.65, .flowRule = FlowRule::nonAssociative, .tolerance = 1e-6}, 100, programs));
    EXPECT_GT(std::count(programs.begin(), programs.end(), 0), 80);
}

// One point of hundreds that would neither slide nor stick left such steps without an end.
TEST(FallingWall, CoulombsLawIsMetOrMissedByLittleInEveryStep)
{
    const DynamicCase<2> scene =
        wall(4, 1.1, {.mu = 0.65, .flowRule = FlowRule::nonAssociative, .tolerance = 1e-9});
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    Eigen::VectorXd velocity = motion.state.velocity;
    for (int step = 0; step < 125; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, wallStep)) << "step " << step;
        const double change = (motion.state.velocity - velocity).lpNorm<Eigen::Infinity>();
        EXPECT_LE(motion.residuals.flowError, 0.05 * wallStep * change) << "step " << step;
        velocity = motion.state.velocity;
    }
}

INSTANTIATE_TEST_SUITE_P(OfThePaper, PaperWall, testing::Range(1, 7));

/// Some steps of a wall that stands under an earthquake were not solved to 1e-12 by the active set.
TEST(WallUnderARecord, IsSolvedToTheLastDigitsInEveryStep)
{
    const std::filesystem::path record =
        std::filesystem::path(DRYSTONE_SOURCE_DIR) / ".." / "shared" / "records" / "elCentro.AT2";
    if (!std::filesystem::exists(record))
    {
        GTEST_SKIP() << "there is no " << record;
    }
    RecordMotion groundRecord;
    groundRecord.file = record.string();
    groundRecord.peakAcceleration = 0.2 * g;
    DynamicCase<2> scene = wall(6, 0, {.mu = 0.65, .flowRule = FlowRule::associative, .tolerance = 1e-12});
    setGroundMotion<2>(scene.effects, {{{recordedAcceleration(groundRecord, ""), Eigen::Vector3d::UnitX()}}});
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < 120; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, wallStep)) << "at " << motion.state.time << " s";
    }
}

/// The assembly in a mirror, its blocks and corners in the order that keeps outlines counter-clockwise.
Assembly<2> mirrored(Assembly<2> assembly)
{
    for (Block<2>& block : assembly.blocks)
    {
        std::reverse(block.outline.begin(), block.outline.end());
        for (Vector<2>& corner : block.outline)
        {
            corner.x() = -corner.x();
        }
    }
    return assembly;
}

// Rigid forces are not unique and Coulomb's law makes the motion depend on them: with any of them a wall and
// its mirror image differed by 12% after 0.05 s. The least forces are the same in both, as long as no overlap
// is taken for rounding: that left 1e-6.
TEST(WallByCoulombsLaw, FallsLikeItsMirrorImageWithFewFactorisations)
{
    DynamicCase<2> scene = wall(3, 0, {.mu = 0.65, .flowRule = FlowRule::nonAssociative, .tolerance = 1e-9});
    scenes::shake(scene, std::make_shared<ConstantAcceleration>(-0.55 * g));
    DynamicCase<2> image = scene;
    setStructure(image, mirrored(scene.assembly), std::vector<double>(scene.assembly.blocks.size(), 1800));
    scenes::shake(image, std::make_shared<ConstantAcceleration>(0.55 * g));
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    Motion<2> ofImage = startMotion(image, stateAtRest(image.assembly));
    std::vector<int> factorisations;
    for (int step = 0; step < 25; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, wallStep)) << "step " << step;
        ASSERT_TRUE(advance(image, ofImage, wallStep)) << "step " << step;
        factorisations.push_back(motion.residuals.factorisations);
        for (const ContactPoint<2>& point : motion.points)
        {
            EXPECT_GT(point.gap, -1e-9 * scene.blockSize) << "step " << step;
        }
    }
    double difference = 0;
    for (std::size_t block = 0; block < motion.state.placements.size(); ++block)
    {
        const Vector<2>& there = motion.state.placements[block].translation;
        const Vector<2>& imaged = ofImage.state.placements[block].translation;
        difference = std::max(difference, (there - Vector<2>(-imaged.x(), imaged.y())).norm());
    }
    EXPECT_LT(difference, 1e-10 * largestDisplacement(motion));
    std::nth_element(factorisations.begin(), factorisations.begin() + 12, factorisations.end());
    EXPECT_LE(factorisations[12], 2);
}

// Nor do they depend on the order of the blocks.
TEST(WallByCoulombsLaw, FallsAlikeWithItsBlocksInAnotherOrder)
{
    DynamicCase<2> scene =
        wall(3, 1.1, {.mu = 0.65, .flowRule = FlowRule::nonAssociative, .tolerance = 1e-9});
    DynamicCase<2> other = scene;
    Assembly<2> reversed = scene.assembly;
    std::reverse(reversed.blocks.begin(), reversed.blocks.end());
    setStructure(other, reversed, std::vector<double>(reversed.blocks.size(), 1800));
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    Motion<2> ofOther = startMotion(other, stateAtRest(other.assembly));
    for (int step = 0; step < 50; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, wallStep)) << "step " << step;
        ASSERT_TRUE(advance(other, ofOther, wallStep)) << "step " << step;
    }
    double difference = 0;
    const std::size_t blocks = motion.state.placements.size();
    for (std::size_t block = 0; block < blocks; ++block)
    {
        difference = std::max(difference, (motion.state.placements[block].translation
                                           - ofOther.state.placements[blocks - 1 - block].translation)
                                              .norm());
    }
    EXPECT_GT(largestDisplacement(motion), 1e-3);
    EXPECT_LT(difference, 1e-7 * largestDisplacement(motion));
}

TEST(WallByCoulombsLaw, ConvergesAtFirstOrderInTheStep)
{
    const auto displacementBy = [](int steps)
    {
        const DynamicCase<2> scene =
            wall(3, 1.1, {.mu = 0.65, .flowRule = FlowRule::nonAssociative, .tolerance = 1e-9});
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        for (int step = 0; step < steps; ++step)
        {
            EXPECT_TRUE(advance(scene, motion, 0.1 / steps)) << "step " << step << " of " << steps;
        }
        return largestDisplacement(motion);
    };
    const double coarse = displacementBy(50);
    const double halved = displacementBy(100);
    const double quartered = displacementBy(200);
    EXPECT_NEAR((coarse - halved) / (halved - quartered), 2, 0.2);
}

// Joints closed but for rounding. Where forces press, the inertia had no digit left next to them in the Schur
// system before the interior point had ended: it lost the balance, began again from openings as small as the
// rounding, and took 42 factorisations, or more than 60 and was not solved.
TEST_P(PaperWall, TakesItsFirstStepWithFewFactorisations)
{
    for (const FlowRule flowRule : {FlowRule::associative, FlowRule::nonAssociative})
    {
        const DynamicCase<2> scene =
            wall(GetParam(), 1.1, {.mu = 0.65, .flowRule = flowRule, .tolerance = 1e-9});
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        ASSERT_TRUE(advance(scene, motion, wallStep));
        const bool isLong = GetParam() == 6 && flowRule == FlowRule::nonAssociative;
        EXPECT_LE(motion.residuals.factorisations, isLong ? 500 : 36);
    }
}

// Where there are thousands of points the interior point has to end at complementarities at which a
// compliance, which keeps the balance of small walls, bends its path: then it came to a standstill.
TEST(FallingStone, OnALargeWallTakesFewFactorisations)
{
    constexpr int units = 40;
    Assembly<2> assembly = squareWall(units);
    const double middle = 0.5 * 0.4 * units;
    assembly.blocks.push_back(scenes::rectangle(middle, 0.175 * units, 0.3, 0.2));
    assembly.blocks.push_back(scenes::rectangle(middle + 0.17, 0.175 * units + 0.2, 0.3, 0.2));
    const DynamicCase<2> scene = scenes::sceneOf(std::move(assembly), {.mu = 0.65,
                                                                       .flowRule = FlowRule::associative,
                                                                       .tolerance = 1e-9,
                                                                       .gravity = {0, -9.81},
                                                                       .density = 2000});
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < 4; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, 0.01)) << step;
        EXPECT_LE(motion.residuals.factorisations, 150) << step;
    }
}

// Points that have been far open, or have slid far, have lost digits: the path ended on a piece that was not
// that of its solution, and the step took programs instead (wall 3 1,141 factorisations, wall 5 1,481).
TEST(WallByCoulombsLaw, IsFollowedThroughAFastCollapseWithFewFactorisations)
{
    int factorisations = 0;
    for (const int number : {3, 5})
    {
        const DynamicCase<2> scene =
            wall(number, 2, {.mu = 0.65, .flowRule = FlowRule::nonAssociative, .tolerance = 1e-9});
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        for (int step = 0; step < 300; ++step)
        {
            ASSERT_TRUE(advance(scene, motion, wallStep)) << "wall " << number << " step " << step;
            factorisations += motion.residuals.factorisations;
        }
    }
    EXPECT_LE(factorisations, 2000);
}

// Where blocks slide freely the factors of a step are nearly singular, and what the LU without exchange of
// rows left of an equation was larger than the equation: of 500 steps of wall 2 a hundred needed programs.
TEST(WallByCoulombsLaw, IsFollowedThroughItsCollapseWithoutPrograms)
{
    const DynamicCase<2> scene =
        wall(2, 1.1, {.mu = 0.65, .flowRule = FlowRule::nonAssociative, .tolerance = 1e-9});
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    int programs = 0;
    int factorisations = 0;
    for (int step = 0; step < 500; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, wallStep)) << "step " << step;
        programs += motion.residuals.programs;
        factorisations += motion.residuals.factorisations;
    }
    EXPECT_LE(programs, 15);
    EXPECT_LE(factorisations, 1500);
}

// In rubble no way of few stages arrives in some steps, and then in none of those that follow: 27,000
// factorisations in 50 steps, most of them for nothing, and 40 of the steps by programs, until points were
// stiffened gradually.
TEST(RubbleByCoulombsLaw, IsFollowedAlsoWhereStagesDoNotArrive)
{
    DynamicCase<2> scene = scenes::sceneOf(
        madeStructure(Dictionary::readString("texture { type rubble; size (5 3); thickness 0.5; stones 100; "
                                             "seed 7; } supports { ground { type ground; } }")),
        {.mu = 0.7, .flowRule = FlowRule::nonAssociative, .tolerance = 1e-9, .density = 2000});
    scenes::shake(scene, std::make_shared<ConstantAcceleration>(-3));
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    int factorisations = 0;
    int byPrograms = 0;
    for (int step = 0; step < 50; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, wallStep)) << "step " << step;
        factorisations += motion.residuals.factorisations;
        byPrograms += motion.residuals.programs > 1;
    }
    EXPECT_LE(factorisations, 3000);
    EXPECT_LE(byPrograms, 2);
}

// Impacts one after the other, more than a step may take: the run ended there, as that of a colonnade of 31
// blocks did with restitution or theta 0.5.
TEST(FallingWall, FallsOnWithoutReboundsWhereImpactsAreMoreThanAStepMayTake)
{
    DynamicCase<2> scene =
        wall(1, 1.1, {.mu = 0.65, .flowRule = FlowRule::associative, .restitution = 0.3, .tolerance = 1e-9});
    scene.solution.maximumFactorisations = 300; // one impact of this wall takes some 70
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    TimeControls controls;
    controls.deltaT = wallStep;
    controls.endTime = 200 * wallStep;
    Time time(controls, {0, wallStep});
    int withoutRebounds = 0;
    int steps = 0;
    while (time.loop())
    {
        ASSERT_TRUE(advance(scene, motion, time)) << "at " << motion.state.time << " s";
        withoutRebounds += motion.residuals.isWithoutRebounds;
        ++steps;
    }
    EXPECT_GT(withoutRebounds, 0);
    EXPECT_LT(withoutRebounds, steps); // the next steps have rebounds again
    EXPECT_LE(motion.created, 1e-6 * motion.largestKinetic);
}

/// Blocks that fly 7 m in a step of theirs, where the gaps of 40,000 points are anything but linear: 25 steps
/// took more than two minutes, most of them in attempts that came to nothing.
TEST(WallUnderAnAbsurdAcceleration, IsSolvedOrGivenUpWithinTheWorkAllowed)
{
    DynamicCase<2> scene = wall(6, 1e6 / (multipliers[5] * g),
                                {.mu = 0.65, .flowRule = FlowRule::associative, .tolerance = 1e-9});
    scene.solution.maximumFactorisations = 1000; // a fifth of the default, so that it is soon shown
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    TimeControls controls;
    controls.deltaT = wallStep;
    controls.endTime = 25 * wallStep;
    Time time(controls, {0, wallStep});
    bool isSolved = true;
    double before = 0;
    while (isSolved && time.loop())
    {
        before = motion.state.time;
        isSolved = advance(scene, motion, time);
        // The program that crosses the border is brought to its end.
        EXPECT_LE(motion.work.done, 3 * motion.work.most) << "at " << before << " s";
    }
    EXPECT_FALSE(isSolved);
    EXPECT_TRUE(motion.work.isUsedUp());
    EXPECT_EQ(motion.state.time, before);
    EXPECT_EQ(time.value(), before);
}

} // namespace
} // namespace drystone
