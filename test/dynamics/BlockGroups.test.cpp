// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks that are taken as one body: sums and motions of groups, and columns whose drums provably move as
/// one.
#include "dynamics/BlockGroups.h"

#include "Scenes.h"
#include "SpaceScenes.h"

#include "dynamics/EffectCalls.h"
#include "dynamics/GroupChoice.h"
#include "dynamics/TurnedGroups.h"
#include "dynamics/VerifiedStep.h"
#include "timeSeries/GroundAcceleration.h"

#include <gtest/gtest.h>

using namespace drystone;

namespace
{

template<int Dim>
Block<Dim> drum(double at, double width, double bottom)
{
    if constexpr (Dim == 2)
    {
        return scenes::rectangle(at - width / 2, bottom, width, 0.5);
    }
    else
    {
        return spaceScenes::boxBlock({at - width / 2, -width / 2, bottom},
                                     {at + width / 2, width / 2, bottom + 0.5});
    }
}

/// The ground moves along x by half a sine of a share of g.
template<int Dim>
void push(DynamicCase<Dim>& scene, double share, double duration)
{
    scene.schemes.effects.selection = EffectSelection::automatic;
    scene.effectNames.simulated = {"friction", "groundMotion"};
    GroundMotion::Component component;
    component.acceleration = std::make_shared<SinePulse>(PulseShape{share * g, duration, 0.02}, 1);
    setGroundMotion<Dim>(scene.effects, {{component}});
}

/// Drums of 0.5 m on top of each other, in space square. \param widths of the columns, which stand 3 m apart
template<int Dim>
DynamicCase<Dim> columns(int drums, const std::vector<double>& widths, FlowRule flowRule)
{
    Assembly<Dim> assembly;
    if constexpr (Dim == 2)
    {
        assembly = scenes::ground(-5, 15);
    }
    else
    {
        assembly.supports.push_back({"ground", "ground"});
        assembly.blocks.push_back(spaceScenes::boxBlock({-5, -5, -1}, {15, 5, 0}, 0));
    }
    for (std::size_t column = 0; column < widths.size(); ++column)
    {
        for (int above = 0; above < drums; ++above)
        {
            assembly.blocks.push_back(
                drum<Dim>(3 * static_cast<double>(column), widths[column], 0.5 * above));
        }
    }
    if constexpr (Dim == 2)
    {
        return scenes::sceneOf(std::move(assembly), {.mu = 0.7, .flowRule = flowRule, .tolerance = 1e-10});
    }
    else
    {
        return spaceScenes::sceneOf(std::move(assembly), 1, 0.7, {0, 0, -g}, flowRule);
    }
}

struct Course
{
    int steps = 0;
    int moving = 0; ///< with some block awake
    int asOne = 0;  ///< with the whole column one body
    int fewer = 0;  ///< with fewer bodies than blocks, but more than one
    int apart = 0;  ///< with more bodies than one
    double top = 0; ///< the farthest that the top has been [m]
};

/// Each step is taken with everything on, too.
template<int Dim>
Course verify(const DynamicCase<Dim>& scene, double timeStep, int steps)
{
    Course course;
    Motion<Dim> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < steps; ++step)
    {
        const Motion<Dim> before = motion;
        EXPECT_TRUE(advance(scene, motion, timeStep)) << step;
        verifyStep(scene, before, timeStep, motion);
        const long bodies = simulatedBodies(motion);
        course.moving += awakeBlocks(motion) > 0;
        course.asOne += bodies == 1;
        course.apart += bodies > 1;
        course.fewer += bodies > 1 && bodies < awakeBlocks(motion);
        course.top = std::max(course.top, motion.state.placements.back().translation.norm());
        ++course.steps;
        if (motion.bodies.empty() || bodies == 0)
        {
            continue;
        }
        // The forces are those of all blocks: they change the momentum of each.
        EXPECT_LE(motion.residuals.primalResidual, scene.solution.tolerance) << step;
    }
    EXPECT_EQ(motion.effectUse.verified, steps);
    EXPECT_LE(motion.effectUse.largestDifference, scene.schemes.contactTolerance * scene.blockSize)
        << motion.effectUse.timeOfLargestDifference;
    EXPECT_LT(scenes::relativeImbalance(motion.energy), 1e-7);
    return course;
}

/// Columns pushed for a share of g and a time [s]. \param steps of 0.002 s
template<int Dim>
Course pushed(int drums, const std::vector<double>& widths, FlowRule flowRule, double share, double duration,
              int steps)
{
    DynamicCase<Dim> scene = columns<Dim>(drums, widths, flowRule);
    push(scene, share, duration);
    return verify(scene, 0.002, steps);
}

} // namespace

TEST(BlockGroups, SumsAndMotionsOfGroupsDoTheSameWork)
{
    const DynamicCase<3> scene = columns<3>(5, {0.8}, FlowRule::associative);
    Motion<3> motion = startMotion(scene, stateAtRest(scene.assembly));
    Step<3> step(scene, motion, 0.01, {});
    findContacts(step);
    assemble(step);
    const BlockGroups<3> groups = blockGroups(step, {7, 7, -1, 3, 3});
    ASSERT_EQ(groups.count(), 2);
    EXPECT_EQ(groups.group, (std::vector<int>{0, 0, -1, 1, 1}));
    const Eigen::VectorXd rows = Eigen::VectorXd::LinSpaced(30, -1, 2).array().sin();
    const Eigen::VectorXd ofGroups = Eigen::VectorXd::LinSpaced(12, 1, -3).array().cos() * 0.3;
    const Eigen::VectorXd linear = linearDisplacement(groups, ofGroups);
    EXPECT_NEAR(linear.dot(rows), ofGroups.dot(rowsOfGroups(groups, rows)), 1e-14);

    // A turn by an angle of any size leaves the distances as they are, and the columns of points within have
    // no work.
    const Eigen::VectorXd y = displacementOfBlocks(groups, ofGroups);
    EXPECT_NEAR(
        (y.segment<3>(18) + Vector<3>(0, 0, 0.5 * 3) - y.segment<3>(24) - Vector<3>(0, 0, 0.5 * 4)).norm(),
        0.5, 1e-14);
    EXPECT_TRUE(y.segment<6>(12).isZero(0));
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(3 * step.program.points());
    for (const std::size_t point : groups.inner)
    {
        forces.segment<3>(3 * static_cast<Eigen::Index>(point)) = Vector<3>(3, 1, -2);
    }
    EXPECT_FALSE(groups.inner.empty());
    EXPECT_LT(rowsOfGroups(groups, applyEquilibrium(step.program, forces)).lpNorm<Eigen::Infinity>(), 1e-14);

    // The kinetic energy is that of the blocks.
    const StepProgram<3> program = programOfGroups(groups, programOfBlocks(groups, step.program));
    EXPECT_NEAR(ofGroups.dot(applyInertia(program, ofGroups)), linear.dot(applyInertia(step.program, linear)),
                1e-12 * linear.dot(applyInertia(step.program, linear)));
    EXPECT_EQ(program.points(), static_cast<int>(groups.outer.size()));

    // Forces on blocks give the groups displacements, by finite turns, with the momenta of all blocks.
    step.program.load = applyInertia(step.program, linear) / 10;
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(program.gap.size());
    const Eigen::VectorXd moved =
        balancedDisplacement(groups, step.program, program, none, Eigen::VectorXd(ofGroups / 10));
    const Eigen::VectorXd momenta =
        rowsOfGroups(groups, applyInertia(step.program, displacementOfBlocks(groups, moved)));
    const Eigen::VectorXd expected = rowsOfGroups(groups, step.program.load);
    EXPECT_LT((momenta - expected).lpNorm<Eigen::Infinity>(), 1e-8 * expected.lpNorm<Eigen::Infinity>());
    EXPECT_GT((moved - ofGroups / 10).lpNorm<Eigen::Infinity>(),
              1e-4); // they are not those of the linear part
}

TEST(BlockGroups, AColumnThatRocksIsOneBodyAndMovesAsWithEverythingOn)
{
    const Course course = pushed<2>(8, {0.8}, FlowRule::associative, 0.35, 0.5, 500);
    EXPECT_GT(course.top, 0.02);
    EXPECT_GT(course.moving, 0.8 * course.steps);
    // However fast it turns: within a step points then leave the straight lines of the program by far more
    // than the gaps that bodies may keep.
    EXPECT_GT(course.asOne, 0.95 * course.moving);
}

TEST(BlockGroups, AColumnOfSpaceThatRocksIsOneBodyAndMovesAsWithEverythingOn)
{
    const Course course = pushed<3>(6, {0.8}, FlowRule::associative, 0.45, 0.5, 300);
    EXPECT_GT(course.top, 0.02);
    EXPECT_GT(course.moving, 0.75 * course.steps);
    EXPECT_GT(course.asOne, 0.95 * course.moving);
}

TEST(BlockGroups, ColumnsThatRockApartAreABodyEach)
{
    const Course course = pushed<2>(6, {0.8, 0.6, 0.7}, FlowRule::associative, 0.4, 0.5, 300);
    EXPECT_GT(course.top, 0.02);
    EXPECT_GT(course.fewer, 0.1 * course.steps);
}

// A push that slides and opens joints between drums: bodies are parted there. The column then falls by
// metres, and the error that each step is allowed at its joints is several times as much at its top, with
// everything on, too.
TEST(BlockGroups, DrumsThatPartAreBodiesOfTheirOwn)
{
    const Course course = pushed<2>(8, {0.8}, FlowRule::associative, 5, 0.1, 300);
    EXPECT_GT(course.top, 1);
    EXPECT_GT(course.fewer, 10);
    EXPECT_GT(course.apart, 0.5 * course.moving);
    EXPECT_GT(course.asOne, 0.1 * course.moving);
}

TEST(BlockGroups, AColumnThatRocksIsOneBodyByCoulombsLawToo)
{
    const Course course = pushed<2>(8, {0.8}, FlowRule::nonAssociative, 0.35, 0.5, 500);
    EXPECT_GT(course.top, 0.02);
    EXPECT_GT(course.moving, 0.8 * course.steps);
    EXPECT_GT(course.asOne, 0.95 * course.moving);
}

TEST(BlockGroups, DrumsThatSlideByCoulombsLawAreBodiesOfTheirOwn)
{
    const Course course = pushed<2>(2, {3}, FlowRule::nonAssociative, 1.2, 0.1, 60);
    EXPECT_GT(course.top, 0.001);
    EXPECT_GT(course.moving, 20);
    EXPECT_EQ(course.apart, course.moving);
}

TEST(BlockGroups, AStepSaysWhereEachEffectActs)
{
    DynamicCase<2> scene = columns<2>(1, {0.8}, FlowRule::nonAssociative);
    push(scene, 1.2, 0.1); // slides
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    EXPECT_EQ(namesOfEffects(scene),
              (std::vector<std::string>{"friction", "groundMotion", "largeDisplacements"}));
    ASSERT_TRUE(advance(scene, motion, 0.01));
    EXPECT_EQ(motion.effectCalls, (std::vector<double>{0, 0, 0})); // before the pulse
    for (int step = 0; step < 5; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, 0.01));
    }
    ASSERT_EQ(motion.effectCalls.size(), 3u);
    EXPECT_GT(motion.effectCalls[0], 0);
    EXPECT_EQ(motion.effectCalls[1], 1);
    EXPECT_EQ(motion.effectCalls[2], 1);
}
