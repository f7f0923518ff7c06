// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Capacity curves against closed forms.
#include "statics/Pushover.h"
#include "Structures.h"

#include "assembly/AssemblyFile.h"
#include "statics/SolveCase.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace drystone;

namespace
{

WeighedStructure monolith()
{
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {rectangle(0, 0, 0.5, 2), rectangle(-1, -1, 3, 0, 0)};
    return WeighedStructure(std::move(assembly));
}

Pushover push(const WeighedStructure& structure, double mu, const PushoverSettings& settings,
              const LoadVectors& loads, const InteriorPointSettings& solver = {})
{
    return solvePushover<2>({structure.assembly, mu, loads}, settings, solver,
                            [](const CapacityPoint&, const std::vector<Placement<2>>&) {});
}
Pushover push(const WeighedStructure& structure, double mu, const PushoverSettings& settings)
{
    return push(structure, mu, settings, structure.weightLoads());
}

} // namespace

TEST(Pushover, OfAMonolithFollowsTheMomentOfItsWeight)
{
    // The centroid is b - d from the toe and sqrt(R2 - (b - d)2) above it: alpha is the quotient, so that the
    // overturning moment alpha W y = W (b - d) is a straight line to zero at d = b.
    const double b = 0.25;
    const double h = 1;
    const Pushover pushover = push(monolith(), 0.65, {.step = 0.01});
    EXPECT_EQ(pushover.end, PushoverEnd::overturned);
    ASSERT_GT(pushover.curve.size(), 20U);
    for (const CapacityPoint& point : pushover.curve)
    {
        const double x = b - point.displacement;
        const double height = std::sqrt(b * b + h * h - x * x);
        EXPECT_NEAR(point.alpha * height, x, 1e-4 * b) << point.displacement;
        EXPECT_LE(point.worst, 1e-9);
    }
    EXPECT_NEAR(pushover.curve.back().displacement, b, 1e-4 * b);
    EXPECT_EQ(pushover.curve.back().alpha, 0);
}

TEST(Pushover, AForceStaysAtItsPointOfABlockThatTurns)
{
    // As much as the weight, at the middle of the top. About the toe, turned by t, the centroid is at
    // (x y) = (b cos t - h sin t, b sin t + h cos t) and the force at x - h sin t:
    // alpha W y = W x + W (x - h sin t), zero at tan t = 2b/3h.
    const double b = 0.25;
    const double h = 1;
    const WeighedStructure structure = monolith();
    LoadVectors loads = structure.weightLoads();
    const Load roof = pointLoad(structure.assembly, 0, {b, 2 * h}, {0, -loads.dead.norm()});
    loads.dead += roof.rows;
    loads.firstMomentsOfDead = roof.firstMoments;
    const Pushover pushover = push(structure, 2, {.step = 0.01}, loads);
    EXPECT_EQ(pushover.end, PushoverEnd::overturned);
    const double toCorner = std::hypot(b, h);
    for (const CapacityPoint& point : pushover.curve)
    {
        const double x = b - point.displacement;
        const double turn = std::atan2(b, h) - std::asin(x / toCorner);
        EXPECT_NEAR(point.alpha * std::sqrt(toCorner * toCorner - x * x), 2 * x - h * std::sin(turn), 1e-4)
            << point.displacement;
    }
    const double last = std::atan(2 * b / (3 * h));
    EXPECT_NEAR(pushover.curve.back().displacement, b - b * std::cos(last) + h * std::sin(last), 1e-4);
}

TEST(Pushover, TellsThePathOfTheCornerThatMovesMost)
{
    // About the toe, turned by t, the centroid has moved horizontally by r (cos a - cos(a + t)), a the angle
    // under which it is seen from there, and the top by t times its distance.
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {rectangle(0, 0, 0.5, 2), rectangle(-1, -1, 3, 0, 0)};
    assembly.blocks.front().outline = {{0, 0}, {0.5, 0}, {0, 2}};
    const Pushover pushover = push(WeighedStructure(std::move(assembly)), 2, {.step = 0.01});
    EXPECT_EQ(pushover.end, PushoverEnd::overturned);
    const double radius = std::hypot(1.0 / 3, 2.0 / 3);
    const double angle = std::atan2(2, 1);
    for (const CapacityPoint& point : pushover.curve)
    {
        const double turn = std::acos(std::cos(angle) - point.displacement / radius) - angle;
        EXPECT_NEAR(point.largest, turn * std::hypot(0.5, 2), 1e-4) << point.displacement;
    }
}

TEST(Pushover, OfAMonolithThatSlidesNeverEnds)
{
    const Pushover pushover = push(monolith(), 0.1, {.step = 0.01, .maximumSteps = 20});
    EXPECT_EQ(pushover.end, PushoverEnd::stepsUsedUp);
    EXPECT_NEAR(pushover.curve.front().alpha, 0.1, 1e-8);
}

TEST(Pushover, OfAWallStartsAtItsCollapseMultiplierAndEndsAtZero)
{
    const WeighedStructure structure = standing(paperWalls()[0].bond);
    for (const double length : {0.01, 0.03})
    {
        const Pushover pushover = push(structure, 0.65, {.step = length});
        // Blocks lose their hold and fall before the wall overturns as a whole, or it overturns.
        EXPECT_TRUE(pushover.end == PushoverEnd::overturned || pushover.end == PushoverEnd::falling);
        EXPECT_NEAR(pushover.curve.front().alpha, 0.642859, 1e-6);
        EXPECT_EQ(pushover.curve.back().alpha, 0);
        for (const CapacityPoint& point : pushover.curve)
        {
            EXPECT_LE(point.alpha, 0.6429);
            EXPECT_LE(point.worst, 1e-6);
        }
    }
}

TEST(Pushover, StepsAsLongAsBlocksAreQuestioned)
{
    const auto directory = std::filesystem::path(testing::TempDir()) / "longSteps";
    std::filesystem::create_directories(directory / "constant/assembly");
    std::filesystem::create_directories(directory / "system");
    const auto write = [&](const std::string& file, const std::string& text)
    { std::ofstream(directory / file) << text; };
    write("constant/assembly/blocks", assemblyText(monolith().assembly));
    write("constant/g", "value (0 -9.81 0);");
    write("constant/materialProperties", "density 2000;");
    write("constant/contactProperties", "friction { type Coulomb; mu 0.65; }");
    write("constant/loads", "dead { type gravity; } live { type inertial; direction (1 0 0); }");
    for (const double step : {0.01, 10.0})
    {
        write("system/solution", fmt::format("limitAnalysis\n{{\n    pushover {{ step {}; }}\n}}\n", step));
        testing::internal::CaptureStderr();
        readLimitAnalysisCase<2>(directory);
        const std::string said = testing::internal::GetCapturedStderr();
        EXPECT_EQ(said.find("A step of 10 m is long for blocks of 1 m") != std::string::npos, step > 1)
            << said;
        EXPECT_EQ(said.find("pushover/step at line 3") != std::string::npos, step > 1) << said;
    }
    std::filesystem::remove_all(directory);
}

TEST(Pushover, StepsWhoseMiddleIsNotSolvedAreCounted)
{
    const WeighedStructure structure = standing(paperWalls()[0].bond);
    const PushoverSettings settings{.step = 0.03};
    const Pushover pushover = push(structure, 0.65, settings);
    EXPECT_EQ(pushover.stepsToFirstOrder, 0);
    // With the iterations of the first position alone; positions themselves have more in a second attempt.
    const Pushover hurried = push(structure, 0.65, settings, structure.weightLoads(),
                                  {.maximumIterations = pushover.curve.front().iterations});
    EXPECT_GT(hurried.curve.size(), 10U);
    EXPECT_GT(hurried.stepsToFirstOrder, 0);
}

TEST(Pushover, OfWhatTheLiveLoadHoldsUpHasNoPosition)
{
    // A block that leans beyond its base: it stands for alpha from 0.5 to mu = 0.9 only, and not by itself.
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {{{{0, 0}, {1, 0}, {3, 2}, {2, 2}}, 1}, rectangle(-5, -1, 5, 0, 0)};
    const WeighedStructure structure(std::move(assembly));
    for (const double sense : {1.0, -1.0})
    {
        LoadVectors loads = structure.weightLoads();
        loads.live *= sense;
        const Pushover pushover = push(structure, 0.9, {.step = 0.02}, loads);
        EXPECT_EQ(pushover.end, PushoverEnd::unstable) << sense;
        EXPECT_TRUE(pushover.curve.empty()) << sense;
    }
}

TEST(Pushover, OfWhatNoLiveLoadMovesIsWithoutLimit)
{
    // Pressed onto the ground, blocks that are not yet at what is two courses farther carry any load.
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {rectangle(0, 0, 0.3, 0.5), rectangle(0, 0.5, 0.3, 1), rectangle(-5, -1, 5, 0, 0)};
    const WeighedStructure structure(std::move(assembly));
    LoadVectors loads = structure.weightLoads();
    loads.live = loads.dead;
    loads.firstMomentsOfLive = loads.firstMomentsOfDead;
    for (const double step : {0.1, 1e-4})
    {
        const Pushover pushover = push(structure, 0.7, {.step = step}, loads);
        EXPECT_EQ(pushover.end, PushoverEnd::unbounded) << step;
        EXPECT_TRUE(pushover.curve.empty()) << step;
    }
}

TEST(Pushover, OfAPortalWhoseLintelEndsWithItsColumns)
{
    // Columns that turn by psi below their critical angle carry the lintel on corners that meet its own:
    // alpha = tan psi, also where they lean by more than 15 degrees.
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {rectangle(0, 0, 0.5, 1), rectangle(1.5, 0, 2, 1), rectangle(0, 1, 2, 1.2),
                       rectangle(-5, -1, 5, 0, 0)};
    const WeighedStructure structure(std::move(assembly));
    const double mean = 0.9 / 1.4; // of what the lintel moves by: columns 0.5 and 0.5, lintel 0.4
    for (const double step : {0.01, 0.002})
    {
        const Pushover pushover = push(structure, 0.9, {.step = step});
        EXPECT_EQ(pushover.end, PushoverEnd::overturned);
        for (const CapacityPoint& point : pushover.curve)
        {
            const double psi = std::asin((0.5 - point.displacement / mean) / std::sqrt(1.25));
            EXPECT_NEAR(point.alpha, std::tan(psi), 1e-4) << step << ' ' << point.displacement;
        }
        EXPECT_NEAR(pushover.curve.back().displacement, 0.5 * mean, 1e-4) << step;
    }
}
