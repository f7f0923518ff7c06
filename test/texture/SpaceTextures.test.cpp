// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Textures of space: numbers of blocks, contacts and points of structures that two other codes computed too,
/// volumes in closed form, and the faults of their dictionaries.
#include "../MadeStructure.h"
#include "../ReportOf.h"
#include "contact/ContactPoint.h"
#include "texture/Texture.h"
#include "texture/space/Extrusion.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace drystone;
using testing::HasSubstr;

namespace
{

const std::string onSlab = " supports { ground { type ground; } }";

Assembly<3> spaceStructure(const std::string& texture, const std::string& supports = onSlab)
{
    return madeStructure<3>(Dictionary::readString("dimensions 3; texture { " + texture + " }" + supports,
                                                   "system/blockTextureDict"));
}

std::string spaceReport(const std::string& texture)
{
    return reportOf([&] { spaceStructure(texture); });
}

/// Free blocks, joints and contact points, as `33 / 83 / 332`.
std::string counts(const Assembly<3>& assembly)
{
    const auto free = std::count_if(assembly.blocks.begin(), assembly.blocks.end(),
                                    [](const Block<3>& block) { return block.support < 0; });
    const auto points = findContactPoints(assembly);
    return fmt::format("{} / {} / {}", free, points.empty() ? 0 : points.back().joint + 1, points.size());
}

double freeVolume(const Assembly<3>& assembly)
{
    double volume = 0;
    for (const Block<3>& block : assembly.blocks)
    {
        const double one = volumeProperties(block.shape).volume;
        EXPECT_GT(one, 0);
        volume += block.support < 0 ? one : 0;
    }
    return volume;
}

std::string bondedWall(const std::string& type, int length, int courses, const std::string& more = {})
{
    return fmt::format("type walls; unit (0.24 0.12 0.08); bond {}; courses {}; walls {{ wall {{ from (0 0); "
                       "length {}; }} }} {}",
                       type, courses, length, more);
}

const std::string stone = "type walls; unit (0.4 0.2 0.2); bond running; ";

/// A front along x and returns along y, at its left end and perhaps its right one.
std::string frontWithReturns(int front, int returns, int courses, const std::string& right = {})
{
    return stone
           + fmt::format(
               "courses {}; walls {{ front {{ from (0 0); length {}; }} left {{ from (0 0); direction (0 1); "
               "length {}; thickness right; }} ",
               courses, front, returns)
           + (right.empty()
                  ? ""
                  : fmt::format("right {{ from ({} 0); direction (0 1); length {}; thickness left; }} ",
                                0.4 * front, returns))
           + "}";
}

const std::string house =
    stone
    + "courses 6; walls { front { from (0 0); length 4; } back { from (0 1.2); length 4; thickness "
      "right; } left { from (0 0); direction (0 1); length 3; thickness right; } "
      "right { from (1.6 0); direction (0 1); length 3; thickness left; } } ";

/// The ground in square cells of 0.2 m, those within 0.4 m of the corner along the diagonal as a support of
/// their own.
std::string cells()
{
    std::string boxes[2];
    for (int i = 0; i < 6; ++i)
    {
        for (int j = 0; j < 4; ++j)
        {
            boxes[i + j < 2 ? 0 : 1] += fmt::format("(({:.1f} {:.1f} -0.2) ({:.1f} {:.1f} 0)) ", 0.2 * i,
                                                    0.2 * j, 0.2 * (i + 1), 0.2 * (j + 1));
        }
    }
    return fmt::format(
        " supports {{ corner {{ type boxes; blocks ( {}); }} rest {{ type boxes; blocks ( {}); }} }}",
        boxes[0], boxes[1]);
}

struct Reference
{
    std::string name;
    std::string texture;
    std::string counts;
    std::string supports = onSlab;
};

TEST(SpaceTextures, HaveTheBlocksContactsAndPointsOfTheReferences)
{
    const std::string barrel = "type barrelVault; radius 1; thickness 0.15; voussoirs 27; length 1;";
    const std::vector<Reference> references{
        {"wall 1 extruded", "type extrusion; of { type runningBond; unit (0.4 0.175); length 5; courses 6; }",
         "33 / 83 / 332"},
        {"wall 1 extruded, thickness .3",
         "type extrusion; of { type runningBond; unit (0.4 0.175); length 5; courses 6; } thickness 0.3;",
         "33 / 83 / 332"},
        {"running", bondedWall("running", 4, 6), "27 / 65 / 260"},
        {"header", bondedWall("header", 4, 6), "51 / 133 / 532"},
        {"english", bondedWall("english", 4, 6), "51 / 182 / 728"},
        {"flemish", bondedWall("flemish", 4, 6), "69 / 260 / 1040"},
        {"L 3 1 6", frontWithReturns(3, 1, 6), "24 / 57 / 228"},
        {"U 3 1 6", frontWithReturns(3, 1, 6, "right"), "27 / 66 / 264"},
        {"L 4 2 8", frontWithReturns(4, 2, 8), "48 / 123 / 492"},
        {"U 4 2 8", frontWithReturns(4, 2, 8, "right"), "60 / 158 / 632"},
        {"L 3 2 6 on cells of 0.2 m", frontWithReturns(3, 2, 6), "30 / 78 / 312", cells()},
        {"slab on three pads", "type boxes; blocks ( ((0 0 0) (2 0.2 1)) );", "1 / 3 / 12",
         "supports { left { type boxes; blocks (((0 0 -0.2) (0.2 0.2 0))); } middle { type boxes; blocks "
         "(((0.9 0 -0.2) "
         "(1.1 0.2 0))); } right { type boxes; blocks (((1.8 0 -0.2) (2 0.2 0))); } }"},
        {"house", house, "72 / 204 / 816"},
        {"house with a door", house + "openings ( { wall front; from (1 0); to (2 4); lintel 0.5; } );",
         "70 / 187 / 748"},
        {"T 4 2 6",
         stone
             + "courses 6; walls { front { from (0 0); length 4; } cross { from (0.7 0); direction (0 1); "
               "length 2; "
               "thickness right; } }",
         "42 / 110 / 440"},
        {"two leaves", bondedWall("running", 4, 9, "leaves 2;"), "80 / 238 / 952"},
        {"two leaves with headers", bondedWall("running", 4, 9, "leaves 2; headersEvery 3;"),
         "78 / 226 / 904"},
        {"dome with a cap", "type dome; radius 1; thickness 0.1; around 8; rows 8; cap 10;",
         "65 / 136 / 544"},
        {"dome with an oculus", "type dome; radius 1; thickness 0.1; around 8; rows 8; oculus 20;",
         "64 / 128 / 512"},
        {"barrel, 1 slice", barrel, "27 / 28 / 112"},
        {"barrel, 4 slices", barrel + " slices 4;", "108 / 193 / 772"},
        {"barrel, staggered", barrel + " slices 4; staggered yes;", "121 / 310 / 1240"},
        {"pointed arch",
         "type extrusion; of { type arch; profile pointed; radius 1; offset 0.3; thickness 0.12; voussoirs "
         "16; }",
         "16 / 17 / 68"},
        {"groin vault", "type crossVault; radius 1; thickness 0.2; voussoirs 8; reach 1.4;", "32 / 52 / 208"},
        {"column", "type column; sides 8; radius 0.3; drums 5; drumHeight 0.4;", "5 / 5 / 40"},
        {"portal",
         "type column; sides 8; radius 0.3; drums 4; drumHeight 0.5; at ((-1.2 0) (1.2 0)); architrave { "
         "width 0.6; "
         "height 0.5; overhang 0.4; }",
         "9 / 10 / 80"},
        {"tower", "type tower; around 8; courses 6; innerRadius 0.8; outerRadius 1; courseHeight 0.25;",
         "48 / 136 / 704"},
    };
    for (const Reference& reference : references)
    {
        EXPECT_EQ(counts(spaceStructure(reference.texture, reference.supports)), reference.counts)
            << reference.name;
    }
}

TEST(SpaceTextures, AnExtrudedWallHasTheJointsOfThePlaneWallWithTwiceThePoints)
{
    const std::string wall =
        "type runningBond; unit (0.4 0.175); length 7; courses 21; openings ( { from (1.5 4); to (2.5 "
        "9); } { from (4.5 12); to (5.5 17); } );";
    const Assembly<2> plane = madeStructure(
        Dictionary::readString("texture { " + wall + " } supports { ground { type ground; } }"));
    const Assembly<3> space = spaceStructure("type extrusion; of { " + wall + " }");
    EXPECT_EQ(findContactPoints(space).size(), 2 * findContactPoints(plane).size());
    EXPECT_EQ(space.blocks.size(), plane.blocks.size());
}

TEST(SpaceTextures, FillTheVolumeThatTheyShould)
{
    EXPECT_NEAR(freeVolume(spaceStructure(bondedWall("english", 6, 10))), 6 * 0.24 * 0.24 * 0.8, 1e-12);
    EXPECT_NEAR(freeVolume(spaceStructure(bondedWall("flemish", 5, 7))), 14 * 0.12 * 0.24 * 0.56, 1e-12);
    EXPECT_NEAR(freeVolume(spaceStructure(bondedWall("header", 3, 5))), 3 * 0.24 * 0.24 * 0.4, 1e-12);
    EXPECT_NEAR(freeVolume(spaceStructure(bondedWall("stack", 3, 5))), 3 * 0.24 * 0.12 * 0.4, 1e-12);
    EXPECT_NEAR(freeVolume(spaceStructure(house)), (1.6 * 1.2 - 1.2 * 0.8) * 1.2, 1e-12);
    EXPECT_NEAR(
        freeVolume(spaceStructure(house + "openings ( { wall left; from (1 2); to (2 4); lintel 0.25; } );")),
        (1.6 * 1.2 - 1.2 * 0.8) * 1.2 - 0.4 * 0.2 * 0.4, 1e-12);
    // 27 trapezoids: R t n sin(pi/n) per metre.
    EXPECT_NEAR(freeVolume(spaceStructure(
                    "type barrelVault; radius 1; thickness 0.15; voussoirs 27; length 2; slices 3; "
                    "staggered yes;")),
                2 * 0.15 * 27 * std::sin(std::numbers::pi / 27), 1e-12);
    // Rings between regular octagons: 4 sin(45 deg)(ro^2 - ri^2) times the height, whatever the bond.
    for (const std::string type : {"turned", "toothed", "stacked"})
    {
        EXPECT_NEAR(freeVolume(spaceStructure(
                        "type tower; around 8; courses 6; innerRadius 0.8; outerRadius 1; courseHeight "
                        "0.25; bond "
                        + type + ";")),
                    4 * std::sqrt(0.5) * 0.36 * 1.5, 1e-12);
    }
    EXPECT_NEAR(freeVolume(spaceStructure("type rubble; size (2 0.5 1); stones 200;")), 1, 1e-12);
}

TEST(SpaceTextures, ADomeOnADrumStandsOnIt)
{
    const std::string dome = "type dome; radius 1; thickness 0.1; around 8; rows 4; cap 10; ";
    EXPECT_EQ(counts(spaceStructure(dome)), "33 / 72 / 288");
    const Assembly<3> drum = spaceStructure(dome + "drum { height 0.5; courses 2; thickness 0.2; }");
    // Two courses of 8: 16 heads, 8 on the ground, 16 between them, 16 under the dome; with the 64
    // of the dome but its 8 on the ground.
    EXPECT_EQ(counts(drum).substr(0, 8), "49 / 120");
    // Aligned joints of course 0 are those of the dome, course 1 goes round the corners.
    EXPECT_EQ(drum.blocks[8].shape.vertices.size(), 12U);
}

TEST(SpaceTextures, ABarrelOfASmallAngleHasAbutmentsAndOneOfAHalfCircleStandsOnTheGround)
{
    const std::string segment =
        "type barrelVault; radius 1; thickness 0.15; voussoirs 9; length 1; slices 2; angle 120;";
    const Assembly<3> vault = spaceStructure(segment, "");
    EXPECT_EQ(vault.supports.size(), 2U);
    EXPECT_EQ(vault.blocks.size(), 18U + 2);
    EXPECT_EQ(counts(vault).substr(0, 7), "18 / 29"); // 8 x 2 between rows, 9 within, 2 x 2 springings
    EXPECT_EQ(
        spaceStructure("type barrelVault; radius 1; thickness 0.15; voussoirs 9; length 1;").supports.size(),
        1U);
}

TEST(SpaceTextures, StepsOfAStairAreEnclosedByTheWallAndLieOnEachOther)
{
    const Assembly<3> stair = spaceStructure("type stair; steps 5;", "");
    // Each step: 2 stones beside it; the lowest on the foot of the wall, the top under its crown, others on
    // the steps and stones next to them.
    const auto points = findContactPoints(stair);
    for (int step = 0; step < 5; ++step)
    {
        double area = 0;
        for (const ContactPoint<3>& point : points)
        {
            area += point.block == step || point.neighbour == step ? 1 : 0;
        }
        EXPECT_GE(area, 4 * 4) << step;
    }
    EXPECT_EQ(stair.supports.size(), 1U);
}

TEST(SpaceTextures, RubbleDependsOnItsSeedAloneAndFitsTogether)
{
    const std::string rubble = "type rubble; size (2 0.5 1); stones 120; seed ";
    const Assembly<3> one = spaceStructure(rubble + "3;");
    EXPECT_EQ(one.blocks[7].shape, spaceStructure(rubble + "3;").blocks[7].shape);
    EXPECT_NE(one.blocks[7].shape, spaceStructure(rubble + "4;").blocks[7].shape);
    // Euler: every stone is a convex polyhedron; every face inside belongs to two of them.
    std::size_t faces = 0;
    for (std::size_t i = 0; i + 1 < one.blocks.size(); ++i)
    {
        faces += one.blocks[i].shape.faces.size();
    }
    const auto points = findContactPoints(one);
    EXPECT_GT(2 * (points.back().joint + 1), static_cast<int>(faces) - 400); // the rest lie on the box
    EXPECT_LT(points.back().joint + 1, static_cast<int>(faces));
}

/// Area of all patches, from the points of each joint in their order round it.
double jointArea(const std::vector<ContactPoint<3>>& points)
{
    Vector<3> twice = Vector<3>::Zero();
    double area = 0;
    for (std::size_t i = 0, first = 0; i < points.size(); ++i)
    {
        if (points[i].joint != points[first].joint)
        {
            first = i;
            area += twice.norm() / 2;
            twice.setZero();
        }
        else if (i > first + 1)
        {
            twice += (points[i - 1].position - points[first].position)
                         .cross(points[i].position - points[first].position);
        }
    }
    return area + twice.norm() / 2;
}

TEST(SpaceTextures, RubbleWithoutShortEdgesStillFitsTogether)
{
    for (const int seed : {1, 2, 3, 4, 5})
    {
        for (const double leastEdge : {0.0, 0.1, 0.25})
        {
            const std::string text = fmt::format(
                "type rubble; size (1 0.5 1); stones 100; seed {}; leastEdge {};", seed, leastEdge);
            const Assembly<3> rubble = spaceStructure(text, "");
            ASSERT_EQ(rubble.blocks.size(), 100U);
            EXPECT_NEAR(freeVolume(rubble), 0.5, 1e-12) << text;
            double surface = 0;
            int edges = 0;
            int shortEdges = 0;
            for (const Block<3>& block : rubble.blocks)
            {
                for (const std::vector<int>& face : block.shape.faces)
                {
                    surface += areaVector(block.shape, face).norm();
                    for (std::size_t k = 0; k < face.size(); ++k)
                    {
                        const double length = (block.shape.vertices[face[(k + 1) % face.size()]]
                                               - block.shape.vertices[face[k]])
                                                  .norm();
                        ++edges;
                        shortEdges += length < 0.05 * std::cbrt(0.5 / 100) ? 1 : 0;
                    }
                }
            }
            // Those that stay are the few without which a stone would be no solid.
            if (leastEdge > 0)
            {
                EXPECT_LT(shortEdges, 0.02 * edges) << text;
            }
            else
            {
                EXPECT_GT(shortEdges, 0.03 * edges) << text;
            }
            // Every face but those on the box (1 x 0.5 x 1) lies on one of another stone.
            EXPECT_NEAR(jointArea(findContactPoints(rubble)), (surface - 4) / 2, 1e-6) << text;
        }
    }
}

TEST(SpaceTextures, ATaperedColumnIsAFrustum)
{
    const Assembly<3> column = spaceStructure(
        "type column; sides 4; radius 0.5; drums 3; drumHeight 0.5; taper 0.4;"); // a square: area 2 r^2
    const double a = 0.5;
    const double b = 0.3;
    EXPECT_NEAR(freeVolume(column), 1.5 * 2 * (a * a + a * b + b * b) / 3, 1e-12);
}

TEST(SpaceTextures, FaultsAreNamed)
{
    EXPECT_THAT(spaceReport("type boxes; blocks ( ((0 0 0) (1 1 1)) ((0 0 1) (1 1 0.5)) );"),
                HasSubstr("Box 1 has no volume"));
    EXPECT_THAT(spaceReport("type wals;"), HasSubstr("Did you mean walls?"));
    EXPECT_THAT(spaceReport("type runningBond;"), HasSubstr("extrusion"));
    EXPECT_THAT(
        spaceReport("type walls; unit (0.25 0.1 0.06); bond english; courses 2; walls { a { from (0 0); "
                    "length 4; } }"),
        HasSubstr("twice as long as it is wide"));
    EXPECT_THAT(
        spaceReport("type walls; unit (0.25 0.125 0.06); bond flemish; courses 2; walls { a { from (0 0); "
                    "length 3.5; } }"),
        HasSubstr("whole number"));
    EXPECT_THAT(spaceReport(bondedWall("stack", 4, 6, "leaves 2;")), HasSubstr("Only a running bond"));
    EXPECT_THAT(spaceReport(house + "openings ( { wall frnt; from (1 0); to (2 4); } );"),
                HasSubstr("no wall of this name. There are: front back left right."));
    EXPECT_THAT(spaceReport(house + "openings ( { wall front; from (1 0); to (2 6); lintel 0.5; } );"),
                HasSubstr("no course above it"));
    EXPECT_THAT(spaceReport(house + "openings ( { wall front; from (1 0.5); to (2 4); } );"),
                HasSubstr("whole courses"));
    EXPECT_THAT(spaceReport(house + "openings ( { wall front; from (3 0); to (5 4); } );"),
                HasSubstr("outside wall front"));
    EXPECT_THAT(
        spaceReport(stone
                    + "courses 2; walls { a { from (0 0); length 4; } b { from (0.5 0); direction (1 1); "
                      "length 2; } }"),
        HasSubstr("not at right angles"));
    // A brick in mm: the sizes of the walls show it.
    EXPECT_THAT(
        spaceReport("type walls; unit (400 200 200); bond running; courses 2; walls { a { from (0 0); "
                    "length 4; } b { from (0 1.2); length 3; thickness right; } }"),
        HasSubstr("b (1200 m long, 200 m thick)"));
    EXPECT_THAT(
        spaceReport(stone
                    + "courses 2; walls { a { from (0 0); length 4; } b { from (0.5 0.1); direction (0 "
                      "1); length 2; } }"),
        HasSubstr("ends within the thickness of wall a"));
    EXPECT_THAT(spaceReport("type dome; radius 1; thickness 0.1; around 8; rows 8;"),
                HasSubstr("either cap or oculus"));
    EXPECT_THAT(spaceReport("type crossVault; radius 1; thickness 0.2; voussoirs 7; reach 1.4;"),
                HasSubstr("even"));
    EXPECT_THAT(spaceReport("type crossVault; radius 1; thickness 0.2; voussoirs 8; reach 1;"),
                HasSubstr("reach farther"));
    EXPECT_THAT(
        spaceReport("type tower; around 8; courses 6; innerRadius 1; outerRadius 1; courseHeight 0.25;"),
        HasSubstr("above the inner one"));
    EXPECT_THAT(
        spaceReport("type column; radius 0.3; drums 5; drumHeight 0.4; architrave { width 1; height 1; }"),
        HasSubstr("two columns at least"));
    EXPECT_THAT(spaceReport("type boxes; blocks ( ((0 0 -0.5) (1 1 1)) );"), HasSubstr("below z = 0"));
    EXPECT_THAT(spaceReport("type barrelVault; radius 1; thickness 2; voussoirs 9; length 1;"),
                HasSubstr("below twice the radius"));
}

TEST(SpaceTextures, DimensionsSelectThePlaneOrSpace)
{
    const auto dimensions = [](const std::string& text)
    { return dimensionsOf(Dictionary::readString(text, "dict")); };
    EXPECT_EQ(dimensions("a 1;"), 2);
    EXPECT_EQ(dimensions("dimensions 3;"), 3);
    EXPECT_THROW(dimensions("dimensions 4;"), FatalIOError);
    EXPECT_THROW(madeStructure<3>(Dictionary::readString(
                     "dimensions 2; texture { type boxes; blocks (((0 0 0) (1 1 1))); }")),
                 FatalIOError);
}

TEST(SpaceTextures, TurnedMovedAndScaledStructuresKeepTheirJoints)
{
    std::mt19937 random(41);
    std::normal_distribution<double> normal;
    for (const std::string& texture :
         {house, bondedWall("flemish", 4, 6),
          std::string("type dome; radius 1; thickness 0.1; around 9; rows 5; oculus 15;"),
          std::string("type crossVault; radius 1; thickness 0.2; voussoirs 8; reach 1.4;"),
          std::string("type tower; around 7; courses 5; innerRadius 0.8; outerRadius 1; courseHeight 0.25; "
                      "bond toothed;"),
          std::string(
              "type barrelVault; radius 1; thickness 0.15; voussoirs 9; length 2; slices 4; staggered yes;"),
          std::string("type rubble; size (1 0.5 1); stones 60; seed 5;")})
    {
        const Assembly<3> built = spaceStructure(texture);
        for (int trial = 0; trial < 20; ++trial)
        {
            const Eigen::Matrix3d rotation =
                Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                    .normalized()
                    .toRotationMatrix();
            const double scale = std::pow(10.0, trial % 7 - 3);
            const Vector<3> shift = scale * Vector<3>(1000, -300, 50);
            Assembly<3> moved = built;
            for (Block<3>& block : moved.blocks)
            {
                for (Vector<3>& vertex : block.shape.vertices)
                {
                    vertex = (scale * (rotation * vertex) + shift).eval();
                }
            }
            EXPECT_EQ(counts(moved), counts(built)) << texture << " trial " << trial;
        }
    }
}

} // namespace
