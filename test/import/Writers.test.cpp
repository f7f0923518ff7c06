// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Writers: what they write says of each block what the assembly says, as built and moved, of the plane and
/// of space. Texts that Drystone reads are read by its readers, others by what their formats define.
#include "import/export/Writers.h"
#include "../MadeStructure.h"

#include "ImportTesting.h"
#include "contact/ContactPoint.h"
#include "core/Json.h"
#include "dictionary/Dictionary.h"
#include "import/Drawing.h"
#include "import/SolidBlocks.h"
#include "import/export/Unwritten.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <sstream>

using namespace drystone;
using test::fileOf;

namespace
{

template<int Dim>
Assembly<Dim> structure(const std::string& texture, const std::string& supports)
{
    return madeStructure<Dim>(Dictionary::readString(
        fmt::format("dimensions {}; texture {{ {} }} supports {{ {} }}", Dim, texture, supports), "test"));
}

const std::string ground = "ground { type ground; }";

/// Of space: bricks; boxes of few digits, which look rounded; turned faces; a block that is not convex.
std::vector<Assembly<3>> assembliesOfSpace()
{
    const std::string concave =
        "type extrusion; of { type polygons; blocks ( ((0 0) (0.3 0) (0.3 0.1) (0.1 0.1) (0.1 0.3) (0 0.3)) "
        "((0.1 0.1) (0.3 0.1) (0.3 0.3) (0.1 0.3)) ); } thickness 0.7;";
    const std::string walls =
        "type walls; unit (0.25 0.125 0.065); bond running; courses 4; walls { a { from (0 0); direction (1 "
        "0); length 4; thickness left; } b { from (0 0); direction (0 1); length 3; thickness right; } }";
    const std::string boxes =
        "type boxes; blocks (((0 0 0) (0.123456 0.5 0.5)) ((0.123457 0 0) (0.3 0.5 0.5)));"; // a gap of 1e-6
                                                                                             // m
    const std::string dome = "type dome; radius 1; thickness 0.1; around 8; rows 6; cap 10;";
    std::vector<Assembly<3>> assemblies;
    for (const std::string& texture : {concave, walls, boxes, dome})
    {
        assemblies.push_back(structure<3>(texture, ground));
    }
    return assemblies;
}

/// Moves and turns of a size that changes all digits.
Placement<3> placementOf(std::size_t block)
{
    const double t = 1 + static_cast<double>(block);
    return {{0.1 * std::sin(t), 0.2 * std::cos(3 * t), 0.01 * t},
            {0.3 * std::cos(t), std::sin(2 * t), 0.4 * std::sin(5 * t)}};
}

std::vector<Placement<3>> placementsOf(const Assembly<3>& assembly)
{
    std::vector<Placement<3>> placements;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        placements.push_back(placementOf(i));
    }
    return placements;
}

std::vector<Placement<2>> placementsOf(const Assembly<2>& assembly)
{
    std::vector<Placement<2>> placements;
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    {
        const Placement<3> placement = placementOf(i);
        placements.push_back({placement.translation.head<2>(), placement.rotation.x()});
    }
    return placements;
}

const std::string circularArch = "type arch; profile circular; radius 1; thickness 0.15; voussoirs 9; depth "
                                 "1.5; angle 180;";
const std::string bond =
    "type runningBond; unit (0.4 0.175); thickness 0.5; length 3; courses 4; firstCourse half;";

/// Places in an order of their own.
std::vector<std::array<double, 3>> sorted(const std::vector<Vector<3>>& places)
{
    std::vector<std::array<double, 3>> corners;
    for (const Vector<3>& vertex : places)
    {
        corners.push_back({vertex.x(), vertex.y(), vertex.z()});
    }
    std::sort(corners.begin(), corners.end());
    return corners;
}

/// Where blocks are with placements that the test works out by itself: Rodrigues' formula about the centroid.
Vector<3> turned(const Vector<3>& place, const Vector<3>& centre, const Placement<3>& placement)
{
    const double angle = placement.rotation.norm();
    const Vector<3> axis = placement.rotation / angle;
    const Vector<3> arm = place - centre;
    const Vector<3> cross(axis.y() * arm.z() - axis.z() * arm.y(), axis.z() * arm.x() - axis.x() * arm.z(),
                          axis.x() * arm.y() - axis.y() * arm.x());
    return centre + placement.translation + std::cos(angle) * arm + std::sin(angle) * cross
           + (1 - std::cos(angle)) * axis.dot(arm) * axis;
}

TEST(ObjText, ComesBackToTheLastBit)
{
    for (const Assembly<3>& assembly : assembliesOfSpace())
    {
        for (const bool isMoved : {false, true})
        {
            const std::vector<ExportedSolid> solids =
                exportedSolids(assembly, isMoved ? placementsOf(assembly) : std::vector<Placement<3>>());
            const ImportedFile file = fileOf(objText(solids, {}));
            const Assembly<3> back = solidBlocks(readObj(file), {}, file);
            ASSERT_EQ(back.blocks.size(), solids.size());
            EXPECT_FALSE(back.jointTolerance);
            for (std::size_t i = 0; i < solids.size(); ++i)
            {
                EXPECT_EQ(back.blocks[i].shape, solids[i].shape) << i;
            }
        }
    }
}

TEST(ObjText, BlocksOfThePlaneBecomeSolidsOfTheirThickness)
{
    const Assembly<2> assembly = structure<2>(circularArch, ground);
    const ImportedFile file = fileOf(objText(exportedSolids(assembly, placementsOf(assembly)), {}));
    const Assembly<3> back = solidBlocks(readObj(file), {}, file);
    ASSERT_EQ(back.blocks.size(), assembly.blocks.size());
    const std::vector<Placement<2>> placements = placementsOf(assembly);
    for (std::size_t i = 0; i < back.blocks.size(); ++i)
    {
        const Polygon outline = placedOutline(assembly.blocks[i], placements[i]);
        std::vector<std::array<double, 3>> expected;
        for (const Vector<2>& corner : outline)
        {
            expected.push_back({corner.x(), 0, corner.y()});
            expected.push_back({corner.x(), 1.5, corner.y()});
        }
        std::sort(expected.begin(), expected.end());
        EXPECT_EQ(sorted(back.blocks[i].shape.vertices), expected) << i;
    }
    ASSERT_EQ(back.zones.size(), 2u); // the layer of the free blocks, and the support
    EXPECT_EQ(back.zones[0].name, "blocks");
    EXPECT_EQ(back.zones[1].name, "ground");
}

TEST(ObjText, DecimalsOnRequestAreStatedByTheReader)
{
    const Assembly<3> assembly =
        structure<3>("type dome; radius 1; thickness 0.1; around 8; rows 6; cap 10;", ground);
    const std::string text = objText(exportedSolids(assembly), {3});
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("-0.000")));
    EXPECT_DOUBLE_EQ(readObj(fileOf(text)).rounding, 1e-3);
}

TEST(ExportedSolids, DecimalsThatFlattenABlockAreNoticed)
{
    Assembly<3> assembly;
    assembly.blocks = {{makeBox({0, 0, 0}, {4, 4, 4}), -1}, {makeBox({4, 0, 0}, {8, 4, 0.2}), -1}};
    EXPECT_EQ(flattenedBlock(exportedSolids(assembly), 0), 1);
    EXPECT_EQ(flattenedBlock(exportedSolids(assembly), 1), -1);
}

TEST(ExportedSolids, AreWhereThePlacementsPutThem)
{
    const Assembly<3> assembly = assembliesOfSpace().front();
    const std::vector<Placement<3>> placements = placementsOf(assembly);
    const std::vector<ExportedSolid> solids = exportedSolids(assembly, placements);
    for (std::size_t i = 0; i < solids.size(); ++i)
    {
        const Polyhedron& shape = assembly.blocks[i].shape;
        const Vector<3> centre = volumeProperties(shape).centroid;
        for (std::size_t k = 0; k < shape.vertices.size(); ++k)
        {
            EXPECT_LE((solids[i].shape.vertices[k] - turned(shape.vertices[k], centre, placements[i])).norm(),
                      1e-14);
        }
    }
}

TEST(CompasJsonText, ComesBackToTheLastBitWithSupportsAndJoints)
{
    for (const Assembly<3>& assembly : assembliesOfSpace())
    {
        const std::vector<ExportedSolid> solids = exportedSolids(assembly);
        std::vector<StatedJoint<3>> joints;
        int last = -1;
        for (const ContactPoint<3>& point : findContactPoints(assembly))
        {
            if (point.joint != last)
            {
                joints.push_back({point.block, point.neighbour, point.normal, {}});
                last = point.joint;
            }
            joints.back().points.push_back(point.position);
        }
        const ImportedFile file = fileOf(compasJsonText(solids, joints, {}));
        SolidSettings settings;
        settings.interfaces = Interfaces::contacts;
        const Assembly<3> back = solidBlocks(readCompasJson(file), settings, file);
        ASSERT_EQ(back.blocks.size(), solids.size());
        for (std::size_t i = 0; i < solids.size(); ++i)
        {
            EXPECT_EQ(back.blocks[i].shape, solids[i].shape) << i;
        }
        ASSERT_EQ(back.zones.size(), 2u);
        EXPECT_EQ(back.zones[0].name, "is_support");
        EXPECT_EQ(back.zones[1].name, "ground");
        for (const Zone& zone : back.zones)
        {
            EXPECT_EQ(zone.blocks, std::vector<int>{static_cast<int>(solids.size()) - 1});
        }
        ASSERT_EQ(back.statedJoints.size(), joints.size());
        std::stable_sort(joints.begin(), joints.end(),
                         [](const auto& a, const auto& b)
                         { return std::pair(a.block, a.neighbour) < std::pair(b.block, b.neighbour); });
        for (std::size_t i = 0; i < joints.size(); ++i)
        {
            EXPECT_LE((back.statedJoints[i].normal - joints[i].normal).norm(), 1e-12) << i;
            EXPECT_EQ(sorted(back.statedJoints[i].points), sorted(joints[i].points)) << i; // either way round
        }
    }
}

/// The vector of three numbers after a name.
Vector<3> vectorAfter(const std::string& text, const std::string& name)
{
    std::size_t at = text.find('[', text.find(name));
    Vector<3> vector;
    for (int axis = 0; axis < 3; ++axis)
    {
        vector[axis] = std::strtod(text.c_str() + at + 1, nullptr);
        at = text.find(',', at + 1);
    }
    return vector;
}

// compas_cra and compas_rbe press the first block of an edge against the z axis of a frame, and the second
// along it; so all 597 interfaces that COMPAS publishes have it. The other way compression was tension there.
TEST(CompasJsonText, FramesOfInterfacesPointFromTheFirstBlockToTheSecond)
{
    const Assembly<3> assembly =
        structure<3>("type boxes; blocks (((0 0 0) (1 1 1)) ((0.2 0 1) (1.2 1 2)));", ground);
    std::vector<StatedJoint<3>> joints;
    for (const ContactPoint<3>& point : findContactPoints(assembly))
    {
        if (joints.empty() || joints.back().neighbour != point.neighbour)
        {
            joints.push_back({point.block, point.neighbour, point.normal, {}});
        }
        joints.back().points.push_back(point.position);
    }
    const std::vector<ExportedSolid> solids = exportedSolids(assembly);
    ASSERT_EQ(joints.size(), 2u);
    for (const StatedJoint<3>& joint : joints)
    {
        const std::string text = compasJsonText(solids, {joint}, {});
        const auto centreOf = [&](int block)
        { return volumeProperties(solids[static_cast<std::size_t>(block)].shape).centroid; };
        const Vector<3> zAxis = vectorAfter(text, "xaxis").cross(vectorAfter(text, "yaxis"));
        EXPECT_NEAR(std::abs(zAxis.z()), 1, 1e-12);
        EXPECT_GT(zAxis.dot(centreOf(joint.neighbour) - centreOf(joint.block)), 0)
            << joint.block << " " << joint.neighbour;
    }
}

/// Three blocks on a ground: the lowest one is also of `wet`, the next is of `shaft` and `wet`.
Assembly<3> column()
{
    Assembly<3> assembly =
        structure<3>("type boxes; blocks (((0 0 0) (1 1 1)) ((0 0 1) (1 1 2)) ((0 0 2) (1 1 3)));", ground);
    assembly.zones = {{"shaft", {1, 2}}, {"wet", {1, 3}}};
    return assembly;
}

TEST(CompasJsonText, ZonesComeBackAllOfThem)
{
    const ImportedFile file = fileOf(compasJsonText(exportedSolids(column()), {}, {}));
    std::map<std::string, std::vector<int>> zones;
    for (const Zone& zone : solidBlocks(readCompasJson(file), {}, file).zones)
    {
        zones[zone.name] = zone.blocks;
    }
    const std::map<std::string, std::vector<int>> expected{
        {"is_support", {3}}, {"ground", {3}}, {"shaft", {1, 2}}, {"wet", {1, 3}}};
    EXPECT_EQ(zones, expected);
}

TEST(ObjText, HasTheFirstZoneOfABlockAndTheOthersAreSaidToBeLost)
{
    const ImportedFile file = fileOf(objText(exportedSolids(column()), {}));
    std::map<std::string, std::vector<int>> zones;
    for (const Zone& zone : solidBlocks(readObj(file), {}, file).zones)
    {
        zones[zone.name] = zone.blocks;
    }
    const std::map<std::string, std::vector<int>> expected{
        {"blocks", {0}}, {"shaft", {1, 2}}, {"ground", {3}}};
    EXPECT_EQ(zones, expected);
    EXPECT_THAT(
        unwritten(column(), "obj", {}),
        testing::ElementsAre("2 blocks have more than one group, as block 1 (shaft wet): obj has one name "
                             "for a block, and the file has the first, shaft. compasJson has all of them."));
}

TEST(Unwritten, NothingIsLostOfWhatAFormatHas)
{
    WrittenProperties all{WrittenZones::all, WrittenJoints::all};
    Assembly<3> assembly = column();
    assembly.statedJoints = {{0, 1, {0, 0, -1}, {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}}}};
    EXPECT_THAT(unwritten(assembly, "compasJson", all), testing::IsEmpty());
    assembly.zones = {{"shaft", {1, 2}}, {"dry", {0}}}; // one each
    EXPECT_THAT(unwritten(assembly, "obj", {}),
                testing::ElementsAre(testing::HasSubstr("states its 1 joints")));
    assembly.statedJoints.clear();
    EXPECT_THAT(unwritten(assembly, "obj", {}), testing::IsEmpty());
    assembly.jointTolerance = 1e-3;
    EXPECT_THAT(unwritten(assembly, "compasJson", all),
                testing::ElementsAre(testing::HasSubstr("`jointTolerance 0.001;`")));
}

TEST(Unwritten, ADrawingHasNoThickness)
{
    WrittenProperties drawing;
    drawing.thickness = WrittenThickness::none;
    Assembly<2> assembly = structure<2>(bond, ground);
    EXPECT_THAT(unwritten(assembly, "dxf", drawing),
                testing::ElementsAre(testing::HasSubstr("`thickness 0.5;`")));
    EXPECT_THAT(unwritten(assembly, "obj", {}), testing::IsEmpty());
    assembly.blocks[0].thickness = 1;
    EXPECT_THAT(unwritten(assembly, "dxf", drawing),
                testing::ElementsAre(testing::HasSubstr("from 0.5 to 1 m, is lost")));
    for (Block<2>& block : assembly.blocks)
    {
        block.thickness = 1; // what an imported drawing has unless it is stated
    }
    EXPECT_THAT(unwritten(assembly, "dxf", drawing), testing::IsEmpty());
}

TEST(DxfText, DrawingsOfThePlaneComeBackToTheLastBit)
{
    for (const std::string& texture : {circularArch, bond})
    {
        const Assembly<2> assembly = structure<2>(texture, ground);
        for (const bool isMoved : {false, true})
        {
            const std::vector<Placement<2>> placements =
                isMoved ? placementsOf(assembly) : std::vector<Placement<2>>();
            const ImportedFile file = fileOf(dxfText(assembly, placements, {}));
            const Assembly<2> back = drawnBlocks(readDxf(file, {}), {}, file);
            ASSERT_EQ(back.blocks.size(), assembly.blocks.size());
            for (std::size_t i = 0; i < back.blocks.size(); ++i)
            {
                EXPECT_EQ(back.blocks[i].outline, isMoved ? placedOutline(assembly.blocks[i], placements[i])
                                                          : assembly.blocks[i].outline)
                    << i;
            }
            ASSERT_EQ(back.zones.size(), 2u);
            EXPECT_EQ(back.zones[1].name, "ground");
        }
    }
}

/// Volume enclosed by triangles that are turned outwards.
double volumeWithin(const std::vector<std::array<Vector<3>, 3>>& triangles)
{
    double six = 0;
    for (const auto& [a, b, c] : triangles)
    {
        six += a.dot(b.cross(c));
    }
    return six / 6;
}

double volumeOf(const Polyhedron& shape)
{
    return volumeProperties(shape).volume;
}

TEST(DxfText, SolidsAreFacesThatEncloseThemByLayer)
{
    for (const Assembly<3>& assembly : assembliesOfSpace())
    {
        const std::vector<ExportedSolid> solids = exportedSolids(assembly, placementsOf(assembly));
        std::istringstream text(dxfText(solids, {}));
        std::map<std::string, std::vector<std::array<Vector<3>, 3>>> faces;
        std::string code;
        std::string value;
        std::string entity;
        std::string layer;
        std::array<Vector<3>, 4> corners;
        int numbers = 0;
        while (std::getline(text, code) && std::getline(text, value))
        {
            const int number = std::stoi(code);
            if (number == 0)
            {
                entity = value;
                numbers = 0;
            }
            else if (number == 8)
            {
                layer = value;
            }
            else if (entity == "3DFACE" && number >= 10 && number < 40)
            {
                corners[static_cast<std::size_t>(number % 10)][number / 10 - 1] = std::stod(value);
                if (++numbers == 12)
                {
                    EXPECT_EQ(corners[2], corners[3]); // a triangle
                    faces[layer].push_back({corners[0], corners[1], corners[2]});
                }
            }
        }
        EXPECT_EQ(entity, "EOF");
        ASSERT_EQ(faces.size(), 2u);
        double free = 0;
        for (const ExportedSolid& solid : solids)
        {
            free += solid.isFixed ? 0 : volumeOf(solid.shape);
        }
        EXPECT_NEAR(volumeWithin(faces["blocks"]), free, 1e-13);
        EXPECT_NEAR(volumeWithin(faces["ground"]), volumeOf(solids.back().shape), 1e-12);
    }
}

std::string bytesOf(std::string_view base64)
{
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    for (std::size_t i = 0; i + 3 < base64.size(); i += 4)
    {
        std::uint32_t group = 0;
        int letterCount = 0;
        for (std::size_t k = 0; k < 4; ++k)
        {
            const std::size_t value = letters.find(base64[i + k]);
            letterCount += value == std::string_view::npos ? 0 : 1;
            group = group << 6U | (value == std::string_view::npos ? 0U : static_cast<std::uint32_t>(value));
        }
        for (int k = 0; k + 1 < letterCount; ++k)
        {
            bytes += static_cast<char>(group >> (16U - 8U * static_cast<unsigned>(k)) & 255U);
        }
    }
    return bytes;
}

TEST(GltfText, HasTheTrianglesOfEachBlockWithYUpwards)
{
    for (const Assembly<3>& assembly : assembliesOfSpace())
    {
        const std::vector<ExportedSolid> solids = exportedSolids(assembly, placementsOf(assembly));
        const JsonValue gltf = parseJson(gltfText(solids));
        const auto list = [&](std::string_view name) -> const JsonValue::List&
        { return *gltf.find(name)->asList(); };
        const auto number = [](const JsonValue& value, std::string_view name)
        { return static_cast<std::size_t>(*value.find(name)->asNumber()); };
        const std::string& uri = *list("buffers")[0].find("uri")->asText();
        const std::string bytes = bytesOf(std::string_view(uri).substr(uri.find(',') + 1));
        ASSERT_EQ(bytes.size(), number(list("buffers")[0], "byteLength"));
        ASSERT_EQ(list("nodes").size(), solids.size());
        const auto vectors = [&](std::size_t accessorIndex)
        {
            const JsonValue& accessor = list("accessors")[accessorIndex];
            const JsonValue& view = list("bufferViews")[number(accessor, "bufferView")];
            EXPECT_EQ(number(view, "byteLength"), 12 * number(accessor, "count"));
            std::vector<Vector<3>> result(number(accessor, "count"));
            for (std::size_t i = 0; i < 3 * result.size(); ++i)
            {
                std::uint32_t bits = 0;
                for (std::size_t k = 0; k < 4; ++k)
                {
                    const auto byte =
                        static_cast<unsigned char>(bytes.at(number(view, "byteOffset") + 4 * i + k));
                    bits |= static_cast<std::uint32_t>(byte) << 8U * k;
                }
                result[i / 3][static_cast<int>(i % 3)] = std::bit_cast<float>(bits);
            }
            return result;
        };
        for (std::size_t i = 0; i < solids.size(); ++i)
        {
            const JsonValue& mesh = list("meshes")[number(list("nodes")[i], "mesh")];
            const JsonValue& primitive = (*mesh.find("primitives")->asList())[0];
            EXPECT_EQ(number(primitive, "material"), solids[i].isFixed ? 1U : 0U);
            const JsonValue& attributes = *primitive.find("attributes");
            const std::vector<Vector<3>> places = vectors(number(attributes, "POSITION"));
            const std::vector<Vector<3>> normals = vectors(number(attributes, "NORMAL"));
            ASSERT_EQ(normals.size(), places.size());
            std::vector<std::array<Vector<3>, 3>> triangles;
            Vector<3> lower = Vector<3>::Constant(1e300);
            for (std::size_t k = 0; k + 2 < places.size(); k += 3)
            {
                triangles.push_back({places[k], places[k + 1], places[k + 2]});
                const Vector<3> area = (places[k + 1] - places[k]).cross(places[k + 2] - places[k]);
                EXPECT_NEAR(area.normalized().dot(normals[k]), 1, 1e-4);
            }
            for (const Vector<3>& vertex : solids[i].shape.vertices)
            {
                lower = lower.cwiseMin(Vector<3>(vertex.x(), vertex.z(), -vertex.y()));
            }
            const double scale = 1 + volumeOf(solids[i].shape);
            EXPECT_NEAR(volumeWithin(triangles), volumeOf(solids[i].shape), 1e-5 * scale) << i;
            const JsonValue& accessor = list("accessors")[number(attributes, "POSITION")];
            for (std::size_t axis = 0; axis < 3; ++axis)
            {
                EXPECT_NEAR(*(*accessor.find("min")->asList())[axis].asNumber(),
                            lower[static_cast<int>(axis)], 1e-6 * scale);
            }
        }
    }
}

// Seven digits of the buffer were of the whole: a brick in coordinates of a map had no height.
TEST(GltfText, FarFromTheOriginBlocksKeepTheirShape)
{
    const Vector<3> place(512345.25, 4649876.5, 123.75);
    std::vector<ExportedSolid> solids;
    for (const double z : {0.0, 0.065})
    {
        solids.push_back(
            {makeBox(place + Vector<3>(0, 0, z), place + Vector<3>(0.25, 0.125, z + 0.065)), "brick"});
    }
    const SolidFrame frame{0, Eigen::Matrix3Xd::Constant(3, 2, 0.01), Eigen::Matrix3Xd::Zero(3, 2)};
    for (const std::vector<SolidFrame>& frames : {std::vector<SolidFrame>{}, {frame}})
    {
        const JsonValue gltf = parseJson(gltfText(solids, frames));
        const auto list = [](const JsonValue& value, std::string_view name) -> const JsonValue::List&
        { return *value.find(name)->asList(); };
        const auto numberIn = [&](const JsonValue& value, std::string_view name, std::size_t axis)
        { return *list(value, name)[axis].asNumber(); };
        const JsonValue::List& nodes = list(gltf, "nodes");
        ASSERT_EQ(nodes.size(), 3u);
        EXPECT_EQ(numberIn(list(gltf, "scenes")[0], "nodes", 0), 2);
        ASSERT_EQ(list(nodes[2], "children").size(), 2u);
        for (std::size_t block = 0; block < 2; ++block)
        {
            const Vector<3> lowest(place.x(), place.z() + 0.065 * static_cast<double>(block),
                                   -place.y() - 0.125);
            const Vector<3> size(0.25, 0.065, 0.125);
            const JsonValue& accessor = list(gltf, "accessors")[2 * block];
            for (int axis = 0; axis < 3; ++axis)
            {
                const auto at = static_cast<std::size_t>(axis);
                const double lower = numberIn(accessor, "min", at);
                EXPECT_NEAR(numberIn(accessor, "max", at) - lower, size[axis], 1e-7);
                const double ofNode = frames.empty() ? 0 : numberIn(nodes[block], "translation", at);
                EXPECT_NEAR(numberIn(nodes[2], "translation", at) + ofNode + lower, lowest[axis], 1e-6);
            }
        }
    }
}

TEST(GltfText, NamesOfLayersAreThoseOfTheDictionary)
{
    const std::string name = "left\\new";
    const JsonValue gltf = parseJson(gltfText({{makeBox({0, 0, 0}, {1, 1, 1}), name}}));
    EXPECT_EQ(*(*gltf.find("nodes")->asList())[0].find("extras")->find("layer")->asText(), name);
}

/// The numbers in a text, with all else between them.
std::vector<double> numbersIn(std::string text)
{
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == ',' || c == '[' || c == ']' || c == '('; }, ' ');
    std::istringstream words(text);
    std::vector<double> numbers;
    for (double number = 0; words >> number;)
    {
        numbers.push_back(number);
    }
    return numbers;
}

TEST(Lmgc90Text, HasEachBlockWithItsMaterialAndWhetherItIsFixed)
{
    for (const Assembly<3>& assembly : assembliesOfSpace())
    {
        std::vector<double> densities(assembly.blocks.size(), 2000);
        densities.front() = 1800;
        const std::vector<ExportedSolid> solids = exportedSolids(assembly, placementsOf(assembly), densities);
        const std::string text = lmgc90Text(solids, 0.65);
        EXPECT_THAT(text, testing::HasSubstr("fric=0.65"));
        EXPECT_THAT(text, testing::HasSubstr("materialType='RIGID', density=1800)"));
        std::size_t at = 0;
        for (std::size_t i = 0; i < solids.size(); ++i)
        {
            at = text.find("\nblock([", at);
            ASSERT_NE(at, std::string::npos) << i;
            const std::size_t vertices = text.find('\n', at + 1);
            const std::size_t between = text.find("], [\n", vertices);
            const std::size_t end = text.find("], stone", between);
            const std::vector<double> places = numbersIn(text.substr(vertices, between - vertices));
            const std::vector<double> indices = numbersIn(text.substr(between + 4, end - between - 4));
            ASSERT_EQ(places.size(), 3 * solids[i].shape.vertices.size());
            std::vector<std::array<Vector<3>, 3>> triangles;
            for (std::size_t k = 0; k + 2 < indices.size(); k += 3)
            {
                std::array<Vector<3>, 3> corners;
                for (std::size_t c = 0; c < 3; ++c)
                {
                    const std::size_t vertex = 3 * (static_cast<std::size_t>(indices[k + c]) - 1); // from 1
                    corners[c] = {places.at(vertex), places.at(vertex + 1), places.at(vertex + 2)};
                }
                triangles.push_back(corners);
            }
            EXPECT_NEAR(volumeWithin(triangles), volumeOf(solids[i].shape), 1e-12) << i;
            const std::string material = i == 0 ? "stone0" : "stone1";
            EXPECT_EQ(text.substr(end + 3, 13 + (solids[i].isFixed ? 0 : 1)),
                      fmt::format("{}, {})", material, solids[i].isFixed ? "True" : "False"));
            at = end;
        }
    }
}

TEST(ThreeDecText, HasConvexBlocksWithFacesClockwiseFromOutside)
{
    std::size_t leftOut = 0;
    for (const Assembly<3>& assembly : assembliesOfSpace())
    {
        const std::vector<ExportedSolid> solids = exportedSolids(assembly, placementsOf(assembly));
        const std::vector<int> concave = concaveBlocks(solids);
        leftOut += concave.size();
        std::istringstream text(threeDecText(solids));
        std::vector<double> volumes;
        for (std::string line; std::getline(text, line);)
        {
            const bool isBlock = line.starts_with("block create polyhedron");
            if (isBlock)
            {
                volumes.push_back(0);
            }
            const std::size_t face = line.find("    face ");
            if (face == std::string::npos)
            {
                continue;
            }
            const bool isContinued = line.ends_with(" &");
            const std::vector<double> places =
                numbersIn(line.substr(9, line.size() - 9 - (isContinued ? 2 : 0)));
            const auto corner = [&](std::size_t k)
            { return Vector<3>(places.at(3 * k), places.at(3 * k + 1), places.at(3 * k + 2)); };
            for (std::size_t k = 1; 3 * (k + 1) < places.size(); ++k)
            {
                volumes.back() -= volumeWithin({{corner(0), corner(k), corner(k + 1)}}); // clockwise
            }
        }
        std::vector<double> expected;
        for (std::size_t i = 0; i < solids.size(); ++i)
        {
            if (std::find(concave.begin(), concave.end(), static_cast<int>(i)) == concave.end())
            {
                expected.push_back(volumeOf(solids[i].shape));
            }
        }
        EXPECT_THAT(volumes, testing::Pointwise(testing::DoubleNear(1e-12), expected));
    }
    EXPECT_EQ(leftOut, 1u);
}

} // namespace
