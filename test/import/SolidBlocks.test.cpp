// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// From the solids of a file to blocks: welded, parted, turned, merged and made plane.
#include "import/SolidBlocks.h"
#include "../MadeStructure.h"

#include "ImportTesting.h"
#include "contact/ContactPoint.h"
#include "contact/JointClosure.h"
#include "dictionary/Dictionary.h"
#include "geometry/space/PolyhedronFault.h"
#include "import/space/Mesh.h"
#include "import/space/PlaneFaces.h"
#include "import/space/Weld.h"
#include "texture/space/Rubble.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace drystone;
using testing::HasSubstr;

namespace
{

const ImportedFile file{"sample", ""};

Solids solidsOf(const std::vector<Polyhedron>& shapes, Division division = Division::asWritten)
{
    Solids solids;
    solids.division = division;
    for (const Polyhedron& shape : shapes)
    {
        Solid solid;
        solid.vertices = shape.vertices;
        solid.faces = shape.faces;
        solids.solids.push_back(std::move(solid));
    }
    return solids;
}

/// All triangles of all shapes with vertices of their own, in random order: what STL has.
Solids soupOf(const std::vector<Polyhedron>& shapes, unsigned seed)
{
    std::mt19937 random(seed);
    std::vector<std::array<Vector<3>, 3>> triangles;
    for (const Polyhedron& shape : shapes)
    {
        for (const std::vector<int>& face : test::triangulated(shape).faces)
        {
            triangles.push_back({shape.vertices[face[0]], shape.vertices[face[1]], shape.vertices[face[2]]});
        }
    }
    std::shuffle(triangles.begin(), triangles.end(), random);
    Polyhedron soup;
    for (const auto& corners : triangles)
    {
        std::vector<int> face;
        for (const Vector<3>& corner : corners)
        {
            face.push_back(static_cast<int>(soup.vertices.size()));
            soup.vertices.push_back(corner);
        }
        soup.faces.push_back(face);
    }
    return solidsOf({soup}, Division::byConnectivity);
}

Assembly<3> structure(const std::string& texture)
{
    return madeStructure<3>(Dictionary::readString("dimensions 3; texture { " + texture + " }", "test"));
}

std::vector<Polyhedron> shapesOf(const Assembly<3>& assembly)
{
    std::vector<Polyhedron> shapes;
    for (const Block<3>& block : assembly.blocks)
    {
        shapes.push_back(block.shape);
    }
    return shapes;
}

std::vector<double> sortedVolumes(const std::vector<Polyhedron>& shapes)
{
    std::vector<double> volumes;
    for (const Polyhedron& shape : shapes)
    {
        volumes.push_back(volumeProperties(shape).volume);
    }
    std::sort(volumes.begin(), volumes.end());
    return volumes;
}

/// One object of several blocks, as it is exported when they were joined before.
Polyhedron oneObjectOf(const std::vector<Polyhedron>& shapes)
{
    Polyhedron joined;
    for (const Polyhedron& shape : shapes)
    {
        for (std::vector<int> face : shape.faces)
        {
            for (int& vertex : face)
            {
                vertex += static_cast<int>(joined.vertices.size());
            }
            joined.faces.push_back(std::move(face));
        }
        joined.vertices.insert(joined.vertices.end(), shape.vertices.begin(), shape.vertices.end());
    }
    return joined;
}

const std::string dome = "type dome; radius 1; thickness 0.1; around 8; rows 6; cap 10;";
const std::string corner =
    "type walls; unit (0.25 0.125 0.065); bond running; courses 4; walls { a { from (0 0); "
    "direction (1 0); length 4; thickness left; } b { from (0 0); direction (0 1); length 3; "
    "thickness right; } }";

TEST(SolidBlocks, ThatAreSoundStayAsTheyAreToTheLastBit)
{
    for (const std::string& texture : {dome, corner,
                                       std::string("type barrelVault; radius 1; thickness 0.1; voussoirs 13; "
                                                   "length 1; slices 2; staggered yes; angle 180;")})
    {
        const std::vector<Polyhedron> shapes = shapesOf(structure(texture));
        const Assembly<3> assembly = solidBlocks(solidsOf(shapes), {}, file);
        EXPECT_EQ(shapesOf(assembly), shapes);
        EXPECT_FALSE(assembly.jointTolerance);
    }
}

TEST(SolidBlocks, TrianglesAreMergedToTheFacesThatTheyWereCutFrom)
{
    for (const std::string& texture : {dome, corner})
    {
        const std::vector<Polyhedron> shapes = shapesOf(structure(texture));
        std::vector<Polyhedron> cut;
        for (const Polyhedron& shape : shapes)
        {
            cut.push_back(test::triangulated(shape));
        }
        const std::vector<Polyhedron> merged = shapesOf(solidBlocks(solidsOf(cut), {}, file));
        ASSERT_EQ(merged.size(), shapes.size());
        for (std::size_t i = 0; i < shapes.size(); ++i)
        {
            EXPECT_EQ(merged[i].faces.size(), shapes[i].faces.size()) << i;
            EXPECT_EQ(merged[i].vertices, shapes[i].vertices) << i;
        }
    }
}

TEST(SolidBlocks, TouchingSolidsOfASoupOfTrianglesAreParted)
{
    for (const std::string& texture : {dome, corner,
                                       std::string("type boxes; blocks (((0 0 0) (1 1 1)) ((1 0 0) (2 1 1)) "
                                                   "((1 1 0) (2 2 1)) ((0 0 1) (1 1 2)));")})
    {
        const std::vector<Polyhedron> shapes = shapesOf(structure(texture));
        for (const unsigned seed : {1U, 2U, 3U})
        {
            Solids soup = soupOf(shapes, seed);
            for (const bool isTurnedInside : {false, true})
            {
                const std::vector<Polyhedron> parts = shapesOf(solidBlocks(soup, {}, file));
                ASSERT_EQ(parts.size(), shapes.size()) << texture << seed << isTurnedInside;
                const std::vector<double> expected = sortedVolumes(shapes);
                const std::vector<double> volumes = sortedVolumes(parts);
                for (std::size_t i = 0; i < expected.size(); ++i)
                {
                    EXPECT_NEAR(volumes[i], expected[i], 1e-14);
                }
                for (std::vector<int>& face : soup.solids[0].faces)
                {
                    std::reverse(face.begin(), face.end());
                }
            }
        }
    }
}

TEST(SolidBlocks, BlocksThatWereJoinedToOneObjectAreParted)
{
    const Polyhedron joined = oneObjectOf(
        {makeBox({0, 0, 0}, {1, 1, 1}), makeBox({0, 0, 1}, {1, 1, 2}), makeBox({1, 0, 0}, {2, 1, 1})});
    const Polyhedron other = makeBox({5, 0, 0}, {6, 1, 1});
    const Assembly<3> assembly = solidBlocks(solidsOf({joined, other}), {}, file);
    ASSERT_EQ(assembly.blocks.size(), 4u);
    for (const Block<3>& block : assembly.blocks)
    {
        EXPECT_EQ(block.shape.faces.size(), 6u);
        EXPECT_NEAR(volumeProperties(block.shape).volume, 1, 1e-15);
    }
}

TEST(SolidBlocks, FacesInAnyOrderAreTurnedOutwards)
{
    std::mt19937 random(7);
    for (int instance = 0; instance < 50; ++instance)
    {
        Polyhedron shape = makeBox({0, 0, 0}, {1, 2, 3});
        int turned = 0;
        for (std::vector<int>& face : shape.faces)
        {
            if (random() % 2 == 0)
            {
                std::reverse(face.begin(), face.end());
                ++turned;
            }
        }
        EXPECT_EQ(turnOutwards(shape), turned);
        EXPECT_FALSE(findFault(shape));
        EXPECT_NEAR(volumeProperties(shape).volume, 6, 1e-14);
    }
}

TEST(SolidBlocks, FacesThatStandTwiceAreLeftOutOnce)
{
    const std::vector<Polyhedron> shapes = {makeBox({0, 0, 0}, {1, 1, 1}), makeBox({1, 0, 0}, {2, 1, 1})};
    Polyhedron repeated = test::triangulated(shapes[0]);
    std::vector<int> second = repeated.faces[1];
    std::rotate(second.begin(), second.begin() + 1, second.end());
    repeated.faces.push_back(second);
    testing::internal::CaptureStdout();
    const std::vector<Polyhedron> read = shapesOf(solidBlocks(solidsOf({repeated, shapes[1]}), {}, file));
    EXPECT_THAT(testing::internal::GetCapturedStdout(), HasSubstr("faces that stand in the file twice: 1;"));
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].vertices, shapes[0].vertices);
    EXPECT_EQ(read[0].faces.size(), 6u);
    EXPECT_EQ(read[1], shapes[1]);

    // All of a block, as where a file was put together from two that both have it.
    const Assembly<3> fromSoup = solidBlocks(soupOf({shapes[0], shapes[1], shapes[1]}, 1), {}, file);
    EXPECT_THAT(sortedVolumes(shapesOf(fromSoup)),
                testing::ElementsAre(testing::DoubleNear(1, 1e-12), testing::DoubleNear(1, 1e-12)));
}

TEST(SolidBlocks, AFaceWithAHoleStaysInParts)
{
    // A box with a shaft through it: its top is a ring of 8 triangles, which has no single outline.
    Polyhedron frame;
    for (const double z : {0.0, 1.0})
    {
        for (const auto& [x, y] : {std::pair(0, 0), {3, 0}, {3, 3}, {0, 3}, {1, 1}, {2, 1}, {2, 2}, {1, 2}})
        {
            frame.vertices.emplace_back(x, y, z);
        }
    }
    for (int i = 0; i < 4; ++i)
    {
        const int j = (i + 1) % 4;
        frame.faces.push_back({i, j, j + 8, i + 8});           // outside
        frame.faces.push_back({i + 4, i + 12, j + 12, j + 4}); // the shaft
        frame.faces.push_back({i + 8, j + 8, j + 12, i + 12}); // top
        frame.faces.push_back({i, i + 4, j + 4, j});           // bottom
    }
    ASSERT_FALSE(findFault(frame));
    const Polyhedron result =
        solidBlocks(solidsOf({test::triangulated(frame)}), {}, file).blocks.front().shape;
    EXPECT_FALSE(findFault(result));
    EXPECT_NEAR(volumeProperties(result).volume, 8, 1e-14);
    EXPECT_LE(result.faces.size(), 12u); // 8 sides, and each ring in at least two parts
}

TEST(SolidBlocks, RoundedCoordinatesAreMadePlaneAndJointsAreFound)
{
    const Assembly<3> exact = structure(dome);
    const std::size_t joints = static_cast<std::size_t>(findContactPoints(exact).back().joint);
    for (const double unit : {1e-3, 1e-4, 1e-6})
    {
        std::vector<Polyhedron> shapes = shapesOf(exact);
        for (Polyhedron& shape : shapes)
        {
            for (Vector<3>& vertex : shape.vertices)
            {
                vertex = (vertex / unit).array().round() * unit;
            }
        }
        Solids solids = solidsOf(shapes);
        solids.rounding = unit;
        Assembly<3> assembly = solidBlocks(std::move(solids), {}, file);
        ASSERT_TRUE(assembly.jointTolerance);
        EXPECT_NEAR(*assembly.jointTolerance, 1.75 * unit, 1e-12);
        for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
        {
            const Polyhedron& shape = assembly.blocks[i].shape;
            EXPECT_LE(unevenness(shape), 1e-6 * unit) << i;
            for (std::size_t k = 0; k < shape.vertices.size(); ++k)
            {
                EXPECT_LE((shape.vertices[k] - exact.blocks[i].shape.vertices[k]).norm(), 4 * unit);
            }
        }
        closeJoints(assembly);
        EXPECT_EQ(static_cast<std::size_t>(findContactPoints(assembly).back().joint), joints) << unit;
    }
}

TEST(SolidBlocks, ScaleAndUpAxis)
{
    SolidSettings settings;
    settings.scale = 0.001;
    settings.up = UpAxis::y;
    const Assembly<3> assembly =
        solidBlocks(solidsOf({makeBox({0, 0, 0}, {1000, 2000, 3000})}), settings, file);
    const VolumeProperties volume = volumeProperties(assembly.blocks.front().shape);
    EXPECT_NEAR(volume.volume, 6, 1e-12);
    EXPECT_LE((volume.centroid - Vector<3>(0.5, -1.5, 1)).norm(), 1e-12);
    settings.offset = {10, 20, 30};
    const Assembly<3> moved = solidBlocks(solidsOf({makeBox({0, 0, 0}, {1000, 2000, 3000})}), settings, file);
    EXPECT_LE((volumeProperties(moved.blocks.front().shape).centroid - Vector<3>(10.5, 18.5, 31)).norm(),
              1e-12);
}

TEST(SolidBlocks, FaultsNameTheBlock)
{
    const auto report = [](const Solids& solids) { return reportOf([&] { solidBlocks(solids, {}, file); }); };
    Polyhedron open = makeBox({0, 0, 0}, {1, 1, 1});
    open.faces.pop_back();
    Solids solids = solidsOf({makeBox({0, 0, 0}, {1, 1, 1}), open});
    solids.solids[1].name = "keystone";
    solids.solids[1].line = 17;
    EXPECT_THAT(report(solids),
                testing::AllOf(HasSubstr("Block 1, keystone is no solid: it is not closed"),
                               HasSubstr("The corners of face 0 have their middle at (0.5 0.5 0) m"),
                               HasSubstr("file: sample at line 17")));
    Polyhedron uneven = makeBox({0, 0, 0}, {1, 1, 1});
    uneven.vertices[6].z() += 0.02;
    EXPECT_THAT(report(solidsOf({uneven})), HasSubstr("state a tolerance of 0.005 m"));
    EXPECT_THAT(report(solidsOf({makeBox({0, 0, 0}, {1, 1, 2e6})})), HasSubstr("coordinates are at most"));
    EXPECT_THAT(report(solidsOf({makeBox({512345.25, 4649876.5, 123}, {512346.25, 4649877.5, 124})})),
                HasSubstr("`offset (-512345 -4649877 -123);`"));
    EXPECT_THAT(report(solidsOf({Polyhedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}})),
                HasSubstr("is no solid"));
}

TEST(SolidBlocks, InterfacesBecomeJointsWithNormalsIntoTheLowerBlock)
{
    Solids solids = solidsOf({makeBox({0, 0, 1}, {1, 1, 2}), makeBox({0, 0, 0}, {1, 1, 1})});
    SolidSettings settings;
    settings.interfaces = Interfaces::contacts;
    EXPECT_THAT(reportOf([&] { solidBlocks(solids, settings, file); }), HasSubstr("no interfaces"));
    for (const bool isReversed : {false, true})
    {
        std::vector<Vector<3>> points{{0, 0, 1}, {1, 0, 1}, {1, 0.5, 1}};
        if (isReversed)
        {
            std::reverse(points.begin(), points.end());
        }
        solids.interfaces = {{1, 0, points}};
        const Assembly<3> assembly = solidBlocks(solids, settings, file);
        ASSERT_EQ(assembly.statedJoints.size(), 1u);
        EXPECT_EQ(assembly.statedJoints[0].block, 0);
        EXPECT_EQ(assembly.statedJoints[0].neighbour, 1);
        EXPECT_EQ(assembly.statedJoints[0].normal, Vector<3>(0, 0, 1));
    }
    solids.interfaces = {{1, 0, {{0, 0, 1}, {1, 0, 1}, {2, 0, 1}}}};
    EXPECT_THAT(reportOf([&] { solidBlocks(solids, settings, file); }), HasSubstr("has no area"));
    solids.interfaces = {{1, 0, {{0, 0, 1}, {1, 0, 1}, {1, 1, 2}}}};
    EXPECT_THAT(reportOf([&] { solidBlocks(solids, settings, file); }),
                HasSubstr("lies along no face of either"));
}

// A skewback: its sloping face begins at an edge of its bed joint, and is but 11 degrees from that.
TEST(SolidBlocks, TheFaceThatAnInterfaceLiesOnDecidesItsNormal)
{
    Polyhedron skewback;
    skewback.vertices = {{0, 0, 1}, {1, 0, 1}, {1, 0, 1.2}, {0, 1, 1}, {1, 1, 1}, {1, 1, 1.2}};
    skewback.faces = {{0, 2, 5, 3}, {0, 3, 4, 1}, {0, 1, 2}, {3, 5, 4}, {1, 4, 5, 2}};
    for (int turn = 0; turn < 4; ++turn)
    {
        Solids solids = solidsOf({skewback, makeBox({0, 0, 0}, {1, 1, 1})});
        solids.interfaces = {{0, 1, {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}};
        const Assembly<3> assembly = solidBlocks(solids, {}, file);
        ASSERT_EQ(assembly.statedJoints.size(), 1u);
        EXPECT_EQ(assembly.statedJoints[0].normal, Vector<3>(0, 0, 1)) << turn;
        for (std::vector<int>& face : skewback.faces)
        {
            std::rotate(face.begin(), face.begin() + 1, face.end());
        }
    }
}

// A face that two stones share, cut into other triangles by each, is off its plane by rounding.
TEST(SolidBlocks, StonesInSinglePrecisionArePartedWhereTheirFacesAreCutOtherwise)
{
    Rubble rubble;
    rubble.size = {1, 0.4, 1};
    rubble.stones = 30;
    rubble.seed = 3;
    std::vector<Polyhedron> stones;
    for (const Block<3>& stone : makeAssembly(rubble).blocks)
    {
        stones.push_back(stone.shape);
        for (Vector<3>& vertex : stones.back().vertices)
        {
            vertex = vertex.cast<float>().cast<double>();
        }
    }
    Solids soup = soupOf(stones, 1);
    soup.rounding = 1e-7;
    EXPECT_EQ(solidBlocks(soup, {}, file).blocks.size(), stones.size());
}

// Interfaces name solids by their numbers in the file, which are not those of blocks once one is parted.
TEST(SolidBlocks, InterfacesOfAPartedObjectAreThoseOfItsNearestPart)
{
    const auto square = [](double x) {
        return std::vector<Vector<3>>{{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}};
    };
    Solids solids = solidsOf({oneObjectOf({makeBox({0, 0, 0}, {1, 1, 1}), makeBox({3, 0, 0}, {4, 1, 1})}),
                              makeBox({0, 0, -1}, {8, 1, 0}), makeBox({6, 0, 0}, {7, 1, 1})});
    solids.interfaces = {{0, 1, square(0)}, {0, 1, square(3)}, {1, 2, square(6)}};
    SolidSettings settings;
    settings.interfaces = Interfaces::contacts;
    const Assembly<3> assembly = solidBlocks(solids, settings, file);
    ASSERT_EQ(assembly.blocks.size(), 4u);
    std::vector<std::array<int, 2>> pairs;
    for (const StatedJoint<3>& joint : assembly.statedJoints)
    {
        pairs.push_back({joint.block, joint.neighbour});
        EXPECT_EQ(joint.normal, Vector<3>(0, 0, joint.block == 2 ? -1 : 1));
    }
    EXPECT_EQ(pairs, (std::vector<std::array<int, 2>>{{0, 2}, {1, 2}, {2, 3}}));
}

TEST(Weld, PointsWithinTheToleranceAreOneNode)
{
    EXPECT_EQ(weld({{0, 0, 0}, {1, 0, 0}, {-1e-4, 0, 0}, {0, 0, -0.0}}, 1e-3),
              (std::vector<int>{0, 1, 0, 0}));
    EXPECT_EQ(weld({{0, 0, 0}, {0, 0, 1e-300}, {-0.0, 0, 0}}, 0), (std::vector<int>{0, 1, 0}));
    // Two points of one owner never become one.
    EXPECT_EQ(weld({{0, 0, 0}, {1e-4, 0, 0}, {2e-4, 0, 0}}, 1e-3, {0, 0, 1}), (std::vector<int>{0, 1, 0}));
}

} // namespace
