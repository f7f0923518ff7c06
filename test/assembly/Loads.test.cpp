// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Load vectors against hand calculations.
#include "../Polygons.h"
#include "../ReportOf.h"

#include "assembly/Materials.h"
#include "assembly/TurnedLoad.h"
#include "core/Error.h"
#include "core/WholeFile.h"
#include "geometry/Rotation.h"

#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace drystone;

namespace
{

using test::rectangle;

/// A fixed block first, so that block and free indices differ.
Assembly<2> twoOnGround()
{
    return {{{rectangle(-9, -1, 9, 0), 1, 0}, {rectangle(0, 0, 1, 2)}, {rectangle(1, 0, 3, 1)}},
            {{"ground", "ground"}}};
}

using Blocks = std::vector<int>;

Blocks blocksAt(const Vector<2>& point, double tolerance)
{
    return findLoadedBlocks(twoOnGround(), point, tolerance).blocks;
}

/// A line along which 10 N/m act downwards; nothing where a piece has no block.
std::optional<Eigen::VectorXd> lineLoad(const Vector<2>& from, const Vector<2>& to)
{
    const Assembly<2> assembly = twoOnGround();
    SumOfLoads<2> load(assembly);
    for (const LinePiece<2>& piece : piecesOfLine(assembly, from, to, 1e-3))
    {
        if (piece.on.blocks.empty())
        {
            return std::nullopt;
        }
        load.add(pointLoad(assembly, piece.on.blocks.front(), piece.middle, {0, -10 * piece.length}));
    }
    return load.sum().rows;
}

TEST(Loads, GravityActsOnFreeBlocksAtTheirCentroids)
{
    const Eigen::VectorXd load = gravityLoad(twoOnGround(), {7, 2, 3}, {0, -10});
    const Eigen::VectorXd expected = (Eigen::VectorXd(6) << 0, -20, 0, 0, -30, 0).finished();
    EXPECT_EQ(load, expected);
}

TEST(Loads, InertialLoadIsTheOwnWeightWhateverTheLengthOfTheDirection)
{
    for (const double length : {1e-300, 1e-3, 1.0, 1e3, 1e300})
    {
        const Eigen::VectorXd load = inertialLoad(twoOnGround(), {7, 2, 3}, {0, -10}, {length, 0});
        EXPECT_NEAR(load(0), 20, 1e-13);
        EXPECT_NEAR(load(3), 30, 1e-13);
        EXPECT_EQ(load(1), 0);
    }
}

TEST(Loads, WithoutGravityAreQuestioned)
{
    const std::filesystem::path directory = std::filesystem::path(testing::TempDir()) / "loadsWithoutGravity";
    std::filesystem::create_directories(directory / "constant");
    const Assembly<2> assembly = twoOnGround();
    const std::vector<double> masses{7, 2, 3};
    const auto warnings = [&](const Vector<2>& gravity, LiveLoad live)
    {
        writeWholeFile(
            directory / "constant/loads",
            "dead { type gravity; }\ncases { own { type inertial; direction (1 0); } push { type force; "
            "at (0.5 1); value (1 0); } }\nlive { type combined; terms ((1 own) (1 push)); }\n");
        testing::internal::CaptureStderr();
        readLoads<2>(directory, {assembly, masses, gravity}, live);
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_EQ(warnings({0, -10}, LiveLoad::required), "");
    const std::string ofMotion = warnings({0, 0}, LiveLoad::optional);
    EXPECT_THAT(ofMotion, testing::HasSubstr("zero, and so is this load"));
    EXPECT_THAT(ofMotion, testing::HasSubstr("at line 2"));
    EXPECT_THAT(ofMotion, testing::Not(testing::HasSubstr("dead load")));
    const std::string ofRest = warnings({0, 0}, LiveLoad::required);
    EXPECT_THAT(ofRest, testing::HasSubstr("The dead load is zero on every block"));
    EXPECT_THAT(ofRest, testing::HasSubstr("loads/dead at line 1"));
    std::filesystem::remove_all(directory);
}

TEST(Loads, GravityToTheSideIsQuestioned)
{
    const std::filesystem::path directory = std::filesystem::path(testing::TempDir()) / "gravityToTheSide";
    std::filesystem::create_directories(directory / "constant");
    const auto warnings = [&](const std::string& value)
    {
        writeWholeFile(directory / "constant/g", "value " + value + ";\n");
        testing::internal::CaptureStderr();
        readGravity<2>(directory);
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_EQ(warnings("(0 -9.81)"), "");
    EXPECT_EQ(warnings("(-6.9 -7)"), "") << "a table that is tilted by less than 45 degrees";
    const std::string without = warnings("(-9.81 0)"); // (0 -9.81 0), the first component left out
    EXPECT_THAT(without, testing::HasSubstr("Gravity (-9.81 0) [m/s2] points to the side more than down"));
    EXPECT_THAT(without, testing::HasSubstr("g/value at line 1"));
    std::filesystem::remove_all(directory);
}

TEST(Loads, AForceHasItsMomentAboutTheCentroid)
{
    const Assembly<2> assembly = twoOnGround();
    EXPECT_EQ(blocksAt({2.5, 1}, 1e-6), Blocks{2});
    const Eigen::VectorXd load = pointLoad(assembly, 2, {2.5, 1}, {3, -4}).rows;
    // Arm (0.5 0.5) from the centroid (2 0.5): moment 0.5 (-4) - 0.5 3.
    const Eigen::VectorXd expected = (Eigen::VectorXd(6) << 0, 0, 0, 3, -4, -3.5).finished();
    EXPECT_EQ(load, expected);
}

/// A force at the corner of a box that turns and moves: its moment about the mass centre and its work.
template<int Dim>
void expectForceStaysAtItsPoint(const Assembly<Dim>& assembly, const Vector<Dim>& corner,
                                const Placement<Dim>& placement)
{
    const Vector<Dim> force = Vector<Dim>::LinSpaced(Dim, 3, -4);
    const Load load = pointLoad(assembly, 0, corner, force);
    const Vector<Dim> arm = corner - blockMass(assembly.blocks[0]).centroid;
    const Vector<Dim> now = turned(placement.rotation, arm);
    const Eigen::VectorXd rows = turnedLoad<Dim>(load, {0}, {placement});
    EXPECT_EQ(rows.head<Dim>(), force);
    EXPECT_LT((rows.tail<rotationCount<Dim>>() - momentOf(now, force)).norm(), 1e-14);
    EXPECT_NEAR(workOfTurning<Dim>(load, 0, placement), force.dot(now - arm), 1e-14);
    EXPECT_EQ(turnedLoad<Dim>(load, {0}, {Placement<Dim>()}), load.rows);
}

TEST(Loads, ForcesStayAtTheirPointsOfBlocksThatTurn)
{
    Assembly<2> rectangleAlone;
    rectangleAlone.blocks.push_back({rectangle(0, 0, 1, 2)});
    expectForceStaysAtItsPoint<2>(rectangleAlone, {1, 2}, {{0.3, 0.1}, 0.7});
    Assembly<3> box;
    box.blocks.resize(1);
    box.blocks[0].shape = makeBox({0, 0, 0}, {1, 0.5, 2});
    expectForceStaysAtItsPoint<3>(box, {1, 0.5, 2}, {{0.3, 0.1, 0}, {0.4, -0.7, 0.2}});
}

TEST(Loads, APointOnNoFreeBlockLoadsNone)
{
    EXPECT_EQ(blocksAt({5, -0.5}, 0.01), Blocks{});   // the ground is fixed
    EXPECT_EQ(blocksAt({2, -0.005}, 0.01), Blocks{}); // and takes what lies in it, also near a free block
    EXPECT_EQ(blocksAt({2, 0}, 0.01), Blocks{2});
    EXPECT_EQ(blocksAt({2, 1.1}, 0.01), Blocks{});
    EXPECT_EQ(blocksAt({2, 1.005}, 0.01), Blocks{2});
    EXPECT_EQ(findLoadedBlocks(twoOnGround(), {2, 1.005}, 0.01).distance, 1.005 - 1);
    EXPECT_EQ(blocksAt({0.5, 1.5}, 0.01), Blocks{1});
    EXPECT_EQ(blocksAt({1, 0.5}, 0.01), (Blocks{1, 2})); // on the edge of both
}

TEST(Loads, OfALineAreSharedByTheBlocksThatItCrosses)
{
    // Along y = 0.5 from x = 0.5 to 2: half a metre on the first free block, one on the second.
    const auto load = lineLoad({0.5, 0.5}, {2, 0.5});
    ASSERT_TRUE(load);
    const Eigen::VectorXd expected = (Eigen::VectorXd(6) << 0, -5, -5 * 0.25, 0, -10, 10 * 0.5).finished();
    EXPECT_LT((*load - expected).lpNorm<Eigen::Infinity>(), 1e-12);
    // Backwards the same, and over the top of a block too; not where there is none.
    EXPECT_LT((*lineLoad({2, 0.5}, {0.5, 0.5}) - expected).lpNorm<Eigen::Infinity>(), 1e-12);
    EXPECT_NEAR((*lineLoad({0, 2}, {1, 2}))[1], -10, 1e-12);
    EXPECT_FALSE(lineLoad({0, 2}, {1.5, 2}));
    EXPECT_FALSE(lineLoad({-5, -0.5}, {-4, -0.5}));
}

TEST(Loads, ThatCancelButForRoundingAddUpToNothing)
{
    const Assembly<2> assembly = twoOnGround();
    SumOfLoads<2> sum(assembly);
    for (const Vector<2>& force : {Vector<2>(0.1, 0.7), Vector<2>(0.2, 0.1), Vector<2>(-0.3, -0.8)})
    {
        sum.add(pointLoad(assembly, 1, {0.1, 0.5}, force));
    }
    sum.add(pointLoad(assembly, 2, {2, 0.5}, {1e-9, 0})); // small, and all there is on its block
    const Eigen::VectorXd expected = (Eigen::VectorXd(6) << 0, 0, 0, 1e-9, 0, 0).finished();
    EXPECT_EQ(sum.sum().rows, expected);
}

/// The refusal of constant/loads.
template<int Dim>
std::string refusalOf(const std::string& loads, const Assembly<Dim>& assembly,
                      bool isWithCombinations = false)
{
    const std::filesystem::path directory = std::filesystem::path(testing::TempDir()) / "loadsRefused";
    std::filesystem::create_directories(directory / "constant");
    writeWholeFile(directory / "constant/loads", loads);
    const std::vector<double> masses(assembly.blocks.size(), 1);
    const LoadContext<Dim> context{assembly, masses, -10 * Vector<Dim>::Unit(Dim - 1)};
    const std::string report = reportOf(
        [&]
        {
            isWithCombinations ? void(readLoadCombinations<Dim>(directory, context))
                               : void(readLoads<Dim>(directory, context, LiveLoad::required));
        });
    std::filesystem::remove_all(directory);
    return report;
}

TEST(Loads, ThatCanOnlyBeTheLiveLoadAreRefusedInSumsAndCases)
{
    const std::string movement = "type supportMovement; support ground; direction (0 -1 0);";
    const std::string moving = "type moving; from (0 1 0); to (1 1 0); value (0 -1 0);";
    const auto sum = [](const std::string& part)
    { return "dead { type gravity; }\nlive { type sum; loads {\n down { " + part + " } } }\n"; };
    const auto cases = [](const std::string& part)
    {
        return "dead { type gravity; }\ncases {\n down { " + part
               + " } }\nlive { type combined; terms ((1 down)); }\n";
    };
    const auto combinations = [](const std::string& part)
    {
        return "combinations { one { dead { type gravity; }\n live { type sum; loads {\n down { " + part
               + " } } } } }\n";
    };
    for (const std::string& loads : {sum(movement), cases(movement)})
    {
        const std::string report = refusalOf<2>(loads, twoOnGround());
        EXPECT_THAT(report, testing::HasSubstr("supportMovement can only be the live load, by itself"));
        EXPECT_THAT(report, testing::HasSubstr("down/type at line 3"));
        EXPECT_THAT(report, testing::Not(testing::HasSubstr("Unknown load type")));
    }
    EXPECT_THAT(refusalOf<2>(combinations(movement), twoOnGround(), true),
                testing::AllOf(testing::HasSubstr("supportMovement can only be the live load, by itself"),
                               testing::HasSubstr("down/type at line 3")));
    for (const std::string& loads : {sum(moving), cases(moving)})
    {
        EXPECT_THAT(refusalOf<2>(loads, twoOnGround()),
                    testing::AllOf(testing::HasSubstr("A moving load can only be the live load, by itself"),
                                   testing::HasSubstr("down/type at line 3")));
    }
    Assembly<3> box;
    box.blocks.resize(1);
    box.blocks[0].shape = makeBox({0, 0, 0}, {1, 0.5, 2});
    EXPECT_THAT(refusalOf<3>(sum(movement), box),
                testing::HasSubstr("supportMovement can only be the live load, by itself"));
    // Others stay as they are.
    EXPECT_THAT(refusalOf<2>(sum("type gravty;"), twoOnGround()),
                testing::HasSubstr("Unknown load type gravty. Did you mean gravity?"));
    EXPECT_EQ(refusalOf<2>(sum("type inertial; direction (1 0 0);"), twoOnGround()), "no error");
}

} // namespace
