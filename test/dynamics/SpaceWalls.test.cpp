// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The six walls of the paper extruded to a thickness: by Coulomb's law they fall in space as in the plane,
/// whichever way they stand.
#include "../MadeStructure.h"
#include "Scenes.h"
#include "SpaceScenes.h"

#include "../space/SpaceStructures.h"
#include "../statics/LocalLoads.h"

#include "texture/space/Extrusion.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>

namespace drystone
{
namespace
{

constexpr std::array<double, 6> multipliers{0.642859, 0.579999, 0.403694, 0.331948, 0.239643, 0.347825};

Assembly<2> paperWall(int number)
{
    return madeStructure(Dictionary::readFile(std::string(DRYSTONE_TUTORIALS)
                                              + "/limitAnalysis/masonryPanels/wall" + std::to_string(number)
                                              + "/system/blockTextureDict"));
}

/// Pushed by 1.1 times its multiplier.
double acceleration(int number)
{
    return -1.1 * multipliers[static_cast<std::size_t>(number - 1)] * g;
}

DynamicCase<2> inPlane(int number)
{
    DynamicCase<2> scene = scenes::sceneOf(
        paperWall(number), {.mu = 0.65, .flowRule = FlowRule::nonAssociative, .tolerance = 1e-9});
    scenes::shake(scene, std::make_shared<ConstantAcceleration>(acceleration(number)));
    return scene;
}

/// 0.12 m thick, in its own plane y = 0.
Assembly<3> extrudedWall(int number)
{
    const Assembly<2> wall = paperWall(number);
    Assembly<3> assembly;
    assembly.supports = wall.supports;
    for (const Block<2>& block : wall.blocks)
    {
        assembly.blocks.push_back({extruded(block.outline, 0, 0.12), block.support});
    }
    return assembly;
}

/// By Coulomb's law, on ground that accelerates so much horizontally [m/s2].
DynamicCase<3> pushed(Assembly<3> assembly, const Vector<3>& ground)
{
    DynamicCase<3> scene = spaceScenes::sceneOf(std::move(assembly), 1, 0.65, {0, 0, -g});
    scene.solution.tolerance = 1e-9;
    std::vector<GroundMotion::Component> components(2);
    components[0].acceleration = std::make_shared<ConstantAcceleration>(ground.x());
    components[1].acceleration = std::make_shared<ConstantAcceleration>(ground.y());
    components[1].direction = Vector<3>::UnitY();
    setGroundMotion<3>(scene.effects, {components});
    return scene;
}

/// Turned about the vertical.
DynamicCase<3> inSpace(int number, double angle)
{
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vector<3>::UnitZ()).toRotationMatrix();
    return pushed(test::transformed(extrudedWall(number), turn, 1, Vector<3>::Zero()),
                  acceleration(number) * turn.col(0));
}

template<int Dim>
struct Fall
{
    std::vector<Vector<Dim>> way; ///< of each block [m]
    double moved = 0;             ///< by the farthest block [m]
    double sideways = 0;          ///< out of the wall's own plane, likewise
    long factorisations = 0;
};

template<int Dim>
Fall<Dim> fall(const DynamicCase<Dim>& scene, int steps, double angle)
{
    Fall<Dim> result;
    Motion<Dim> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < steps; ++step)
    {
        if (!advance(scene, motion, wallStep))
        {
            ADD_FAILURE() << "step " << step;
            break;
        }
        result.factorisations += motion.residuals.factorisations;
    }
    for (const Placement<Dim>& placement : motion.state.placements)
    {
        result.way.push_back(placement.translation);
        result.moved = std::max(result.moved, placement.translation.norm());
        if constexpr (Dim == 3)
        {
            const Vector<3> across(-std::sin(angle), std::cos(angle), 0);
            result.sideways = std::max(result.sideways, std::abs(placement.translation.dot(across)));
        }
    }
    return result;
}

class ExtrudedWall : public testing::TestWithParam<int>
{
};

TEST_P(ExtrudedWall, FallsByCoulombsLawAsInThePlaneWithFewFactorisations)
{
    constexpr int steps = 60;
    const Fall<2> plane = fall(inPlane(GetParam()), steps, 0);
    for (const double angle : {0.0, 0.6})
    {
        const Fall<3> space = fall(inSpace(GetParam(), angle), steps, angle);
        // Forces follow overlaps of a part of 1e-10 of a block: of six walls one differs by 0.2%.
        EXPECT_NEAR(space.moved, plane.moved, 3e-3 * plane.moved) << "turned by " << angle;
        EXPECT_LT(space.sideways, 1e-6 * space.moved) << "turned by " << angle;
        EXPECT_LE(space.factorisations, 12 * steps) << "turned by " << angle; // some 200 a step by programs
    }
}

// With theta below 1 forces were those of any solver, near the last ones: they kept the pressure of head
// joints that a step began with, and wall 4 fell by half the way.
TEST(FallingWall, FallsByCoulombsLawAsFarWithAnyTheta)
{
    constexpr int steps = 60;
    constexpr double ofFirstOrder = 2.0 / steps; // with theta 1; of half a t^2 it is one step
    for (const int wall : {3, 4})
    {
        const double moved = fall(inPlane(wall), steps, 0).moved;
        for (const double theta : {0.5, 0.7})
        {
            DynamicCase<2> plane = inPlane(wall);
            plane.schemes.timeIntegration.theta = theta;
            EXPECT_NEAR(fall(plane, steps, 0).moved, moved, ofFirstOrder * moved)
                << "wall " << wall << ", theta " << theta;
        }
    }
    constexpr double angle = 0.6;
    DynamicCase<3> space = inSpace(3, angle);
    const double moved = fall(space, steps, angle).moved;
    space.schemes.timeIntegration.theta = 0.7;
    EXPECT_NEAR(fall(space, steps, angle).moved, moved, ofFirstOrder * moved);
}

// A motion makes rounding grow: here to 2e-7 of the way at most, by the associative law, whose joints open as
// they slide, to 3e-3 in the same 0.1 s. Forces that are not unique, were they chosen by the order of blocks,
// would part the ways at the first step.
TEST_P(ExtrudedWall, FallsByCoulombsLawAlikeInAMirrorAndWithItsBlocksInAnyOrder)
{
    constexpr int steps = 50;
    constexpr double allowed = 1e-6; // of the farthest way
    const Assembly<3> wall = extrudedWall(GetParam());
    const Vector<3> ground(acceleration(GetParam()), 0, 0);
    const Fall<3> built = fall(pushed(wall, ground), steps, 0);
    EXPECT_GT(built.moved, 1e-3);

    const Eigen::Matrix3d mirror = Vector<3>(-1, 1, 1).asDiagonal();
    const Fall<3> mirrored =
        fall(pushed(test::transformed(wall, mirror, 1, Vector<3>::Zero()), mirror * ground), steps, 0);
    std::vector<std::size_t> order(wall.blocks.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::mt19937 random(static_cast<unsigned>(GetParam()));
    std::shuffle(order.begin(), order.end(), random);
    Assembly<3> reordered;
    reordered.supports = wall.supports;
    for (const std::size_t block : order)
    {
        reordered.blocks.push_back(wall.blocks[block]);
    }
    const Fall<3> inOrder = fall(pushed(std::move(reordered), ground), steps, 0);
    double offInMirror = 0;
    double offInOrder = 0;
    for (std::size_t block = 0; block < order.size(); ++block)
    {
        offInMirror = std::max(offInMirror, (mirror * mirrored.way[block] - built.way[block]).norm());
        offInOrder = std::max(offInOrder, (inOrder.way[block] - built.way[order[block]]).norm());
    }
    EXPECT_LT(offInMirror, allowed * built.moved);
    EXPECT_LT(offInOrder, allowed * built.moved);
}

INSTANTIATE_TEST_SUITE_P(OfThePaper, ExtrudedWall, testing::Range(1, 7));

// Newton's method has 140 factorisations a step, and the augmented Lagrangian 24 of most programs, all in
// vain: they are tried in each 32nd step, whichever way a run has come there.
TEST(HouseInSpace, DoesNotTryInEachStepByCoulombsLawWhatWasInVainInTheLast)
{
    constexpr double length = 0.005;
    constexpr int fewest = 40; // of the tries; a program has up to 24, alternating directions three
    DynamicCase<3> scene = spaceScenes::sceneOf(cornerOfHouse(), 1, 0.6, {0, 0, -g});
    scene.solution.tolerance = 1e-9;
    GroundMotion::Component component;
    component.acceleration = std::make_shared<ConstantAcceleration>(3);
    setGroundMotion<3>(scene.effects, {{component}});
    Motion<3> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < 34; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, length));
        EXPECT_GT(motion.residuals.flowError, 0);
        const int tries = motion.residuals.factorisations - 20 * motion.residuals.programs;
        if (step % 32 == 0)
        {
            EXPECT_GT(tries, fewest) << step;
        }
        else
        {
            EXPECT_LE(tries, fewest) << step;
        }
    }
}

// Programs that begin with the forces of the last step took 8 a step, and left the house a pressure between
// its blocks that held it back.
TEST(HouseInSpace, FallsByForcesNearTheLeastInFewPrograms)
{
    constexpr int steps = 12;
    DynamicCase<3> scene = spaceScenes::sceneOf(
        madeStructure<3>(Dictionary::readString(
            "dimensions 3;\n"
            "texture { type walls; unit (0.4 0.2 0.2); bond running; courses 6; walls {\n"
            "front { from (0 0); length 4; }\n"
            "back { from (0 1.2); length 4; thickness right; }\n"
            "left { from (0 0); direction (0 1); length 3; thickness right; }\n"
            "right { from (1.6 0); direction (0 1); length 3; thickness left; } }\n"
            "openings ( { wall front; from (1 0); to (2 4); lintel 0.5; } ); }\n"
            "supports { ground { type ground; } }\n")),
        1, 0.65, {6, 0, -g});
    scene.solution.tolerance = 1e-9;
    Motion<3> motion = startMotion(scene, stateAtRest(scene.assembly));
    int programs = 0;
    double moved = 0;
    for (int step = 0; step < steps; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, 0.002));
        programs += motion.residuals.programs;
        EXPECT_LE(motion.residuals.flowError, 0.15 * 6 * 0.002 * 0.002) << step; // of what gravity changes
    }
    for (const Placement<3>& placement : motion.state.placements)
    {
        moved = std::max(moved, placement.translation.norm());
    }
    EXPECT_GT(moved, 0.9e-3);
    EXPECT_LE(programs, 3 * steps);
}

// Paths from the forces of a program did not leave their start, three ways one after the other, and took what
// the programs need by which such a house is solved: 1,376 factorisations of a step of twice the blocks,
// which ended the run.
TEST(HouseInSpace, LeavesWorkForProgramsWherePathsDoNotLeaveTheirStart)
{
    DynamicCase<3> scene = spaceScenes::sceneOf(
        madeStructure<3>(Dictionary::readString(
            "dimensions 3;\n"
            "texture { type walls; unit (0.4 0.2 0.2); bond english; courses 10; walls {\n"
            "front { from (0 0); length 10; }\n"
            "left { from (0 0); direction (0 1); length 6; thickness right; } } }\n"
            "supports { ground { type ground; } }\n")),
        1, 0.5, {0, 0, -g});
    scene.solution.tolerance = 1e-9;
    scene.solution.maximumFactorisations = 2000;
    GroundMotion::Component component;
    component.acceleration = std::make_shared<ConstantAcceleration>(4);
    setGroundMotion<3>(scene.effects, {{component}});
    Motion<3> motion = startMotion(scene, stateAtRest(scene.assembly));
    ASSERT_TRUE(advance(scene, motion, 0.005));
    EXPECT_EQ(motion.work.attempts, 1);
    EXPECT_LE(motion.residuals.factorisations, 600);
    EXPECT_LE(motion.residuals.primalResidual, scene.solution.tolerance);
}

} // namespace
} // namespace drystone
