// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The tables of function objects against observations with known values.
#include "functionObjects/FunctionObject.h"
#include "core/Error.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include <unistd.h>

using namespace drystone;
using testing::ElementsAre;

namespace
{

/// A block of unit size on a fixed one, seen at one instant.
struct Scene
{
    Assembly<2> assembly;
    std::vector<Placement<2>> placements{2};
    std::vector<BlockVelocity<2>> velocities{2};
    std::vector<ContactPoint<2>> points{2};
    std::vector<Vector<2>> forces{{30, 6}, {10, -5}};
    std::vector<double> friction{0.5, 0.5};

    Scene()
    {
        assembly.blocks = {{{{0, -1}, {1, -1}, {1, 0}, {0, 0}}, 1, 0},
                           {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1, -1}};
        assembly.supports = {{"ground", "ground"}};
        placements[1] = {{0.01, -0.02}, 0.03};
        velocities[1] = {{0.1, 0.2}, -0.3};
        for (int i = 0; i < 2; ++i)
        {
            // contact points name the lower index first: `block` is the fixed one, its inward normal points
            // down
            points[static_cast<std::size_t>(i)].block = 0;
            points[static_cast<std::size_t>(i)].neighbour = 1;
            points[static_cast<std::size_t>(i)].position = {1.0 * i, 0};
            points[static_cast<std::size_t>(i)].normal = {0, -1};
        }
    }

    StepObservation<2> at(double time) const
    {
        StepObservation<2> step;
        step.time = time;
        step.timeStep = 0.25;
        step.assembly = &assembly;
        step.placements = placements;
        step.velocities = velocities;
        step.contactPoints = points;
        step.contactForces = forces;
        step.frictionCoefficients = friction;
        step.energy = {10, 4, 5, 1, 1, 0.5, 0.25};
        step.residuals = {1, 1e-9, 2e-9, 3e-9, 12, 13, 2, 1};
        return step;
    }
};

class FunctionObjects : public testing::Test
{
protected:
    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / fmt::format("drystone_functions_{}", getpid());
    Scene scene;

    void TearDown() override { std::filesystem::remove_all(folder); }

    std::vector<std::string> lines(const std::string& file) const
    {
        std::ifstream stream(folder / file);
        std::vector<std::string> result;
        for (std::string line; std::getline(stream, line);)
        {
            result.push_back(line);
        }
        return result;
    }
};

} // namespace

TEST_F(FunctionObjects, EnergyWritesTheLedgerAndWhatItLeavesUnexplained)
{
    EnergyFunction<2> energy({folder});
    EXPECT_FALSE(std::filesystem::exists(folder));
    energy.write(scene.at(0.25));
    energy.write(scene.at(0.5));
    EXPECT_THAT(
        lines("energy.dat"),
        ElementsAre("# Time[s]  kinetic[J]  potential[J]  externalWork[J]  frictionLoss[J]  impactLoss[J]  "
                    "algorithmicLoss[J]  imbalance[J]  elastic[J]  dampingLoss[J]",
                    "0.25  4  5  1  1  0.5  0.25  -0.25  0  0", "0.5  4  5  1  1  0.5  0.25  -0.25  0  0"));
}

TEST_F(FunctionObjects, RowsAreOnTheDiskWhileTheRunGoesOn)
{
    EnergyFunction<2> energy({folder});
    energy.write(scene.at(0.25));
    EXPECT_EQ(lines("energy.dat").size(), 2u);
}

TEST_F(FunctionObjects, BlockMotionWritesOneTableABlock)
{
    BlockMotionFunction<2> motion({folder}, {1, 0});
    motion.write(scene.at(0.25));
    EXPECT_THAT(lines("block1.dat"),
                ElementsAre("# Time[s]  ux[m]  uy[m]  rz[rad]  vx[m/s]  vy[m/s]  wz[rad/s]",
                            "0.25  0.01  -0.02  0.03  0.1  0.2  -0.3"));
    EXPECT_THAT(lines("block0.dat"), ElementsAre(testing::_, "0.25  0  0  0  0  0  0"));
}

TEST_F(FunctionObjects, ContactForcesAddUpToTheReactionOnTheStructure)
{
    ContactForcesFunction<2> contacts({folder}, ContactPointTable::all);
    contacts.write(scene.at(0.25));
    // On the fixed block the normal is -y, so its tangent is -x: forces (-6, -30) and (5, -10); on the
    // structure the opposite, (6, 30) at x = 0 and (-5, 10) at x = 1.
    EXPECT_THAT(lines("contactForces.dat"),
                ElementsAre("# Time[s]  points[-]  open[-]  sticking[-]  sliding[-]  largestNormalForce[N]  "
                            "largestShearForce[N]  ground.x[N]  ground.y[N]  ground.moment[Nm]",
                            "0.25  2  0  1  1  30  6  1  40  10"));
    EXPECT_THAT(
        lines("points.dat"),
        ElementsAre("# Time[s]  block[-]  neighbour[-]  x[m]  y[m]  gap[m]  normalForce[N]  shearForce[N]  "
                    "state[-]",
                    "0.25  0  1  0  0  0  30  6  1", "0.25  0  1  1  0  0  10  -5  2"));
}

TEST_F(FunctionObjects, ReactionsDoNotDependOnWhichBlockOfAPairIsNamedFirst)
{
    for (ContactPoint<2>& point : scene.points)
    {
        std::swap(point.block, point.neighbour);
        point.normal = -point.normal;
    }
    ContactForcesFunction<2> contacts({folder}, ContactPointTable::none);
    contacts.write(scene.at(0.25));
    EXPECT_EQ(lines("contactForces.dat").at(1), "0.25  2  0  1  1  30  6  1  40  10");
    EXPECT_FALSE(std::filesystem::exists(folder / "points.dat"));
}

TEST_F(FunctionObjects, ResidualsWriteWhatTheStepCost)
{
    ResidualsFunction<2> residuals({folder});
    residuals.write(scene.at(0.25));
    EXPECT_THAT(
        lines("residuals.dat"),
        ElementsAre("# Time[s]  timeStep[s]  initialResidual[-]  primalResidual[-]  dualResidual[-]  gap[-]  "
                    "iterations[-]  factorisations[-]  programs[-]  retries[-]  flowError[m]",
                    "0.25  0.25  1  1e-09  2e-09  3e-09  12  13  2  1  0"));
}

TEST_F(FunctionObjects, StageTimesWriteAColumnAStageAndWarnOfAStateThatHasNone)
{
    StageTimesFunction<2> stageTimes({folder});
    StepObservation<2> step = scene.at(0.25);
    testing::internal::CaptureStderr();
    stageTimes.write(step);
    stageTimes.write(step);
    const std::string warning = testing::internal::GetCapturedStderr();
    EXPECT_NE(warning.find("does not keep the times of the stages"), std::string::npos) << warning;
    EXPECT_EQ(warning.find("does not keep", warning.find("does not keep") + 1), std::string::npos) << warning;
    EXPECT_FALSE(std::filesystem::exists(folder));
    step.stageTimes = StageTimes{{0.5, 0.25, 0, 2, 0, 0, 0.125, 1, 3}, {}};
    stageTimes.write(step);
    EXPECT_THAT(lines("stageTimes.dat"),
                ElementsAre("# Time[s]  findContacts[s]  assemble[s]  contribute[s]  solve[s]  collide[s]  "
                            "review[s]  move[s]  account[s]  rest[s]",
                            "0.25  0.5  0.25  0  2  0  0  0.125  1  3"));
}

TEST_F(FunctionObjects, ARestartLeavesTheEarlierTablesAlone)
{
    EnergyFunction<2> first({postProcessingFolder(folder, "energy", "0")});
    first.write(scene.at(0.25));
    EnergyFunction<2> second({postProcessingFolder(folder, "energy", "0.25")});
    second.write(scene.at(0.5));
    EXPECT_EQ(lines("postProcessing/energy/0/energy.dat").size(), 2u);
    EXPECT_EQ(lines("postProcessing/energy/0.25/energy.dat").size(), 2u);
}

TEST_F(FunctionObjects, ATableThatCannotBeWrittenIsNamed)
{
    std::ofstream(folder) << "a file where a folder is needed";
    EnergyFunction<2> energy({folder});
    EXPECT_THROW(energy.write(scene.at(0.25)), FatalError);
}

TEST_F(FunctionObjects, ARowOfAnotherWidthIsRefused)
{
    ColumnFile file(folder / "two.dat", {"Time[s]", "value[-]"});
    EXPECT_THROW(file.write(std::array{1.0}), std::logic_error);
    file.write(std::array{1.0, 1.0 / 3});
    EXPECT_THAT(lines("two.dat"), ElementsAre("# Time[s]  value[-]", "1  0.333333333333"));
}

TEST(ColumnFile, ReportsAFullDisk)
{
    if (!std::filesystem::exists("/dev/full"))
    {
        GTEST_SKIP() << "this system has no /dev/full";
    }
    EXPECT_THROW(ColumnFile("/dev/full", {"Time[s]"}), FatalError);
}
