// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Readers of solids: the same cubes in every format, and what is refused, where.
#include "import/Solids.h"

#include "ImportTesting.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

using namespace drystone;
using test::fileOf;
using testing::AllOf;
using testing::HasSubstr;

namespace
{

const Polyhedron cube = makeBox({0, 0, 0}, {1, 1, 1});

double volumeOf(const Solid& solid)
{
    return volumeProperties({solid.vertices, solid.faces}).volume;
}

TEST(Obj, EachObjectIsASolidAndItsMaterialTheZone)
{
    const std::string text =
        "# two cubes\nmtllib x.mtl\nv 9 9 9\no base.001\nusemtl stone\n"
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nvn 0 0 1\n"
        "f -8//1 -5//1 -6 -7\nf 6/1/1 7/2/1 \\\n8 9 # top\nf 2 3 7 6\nf 3 4 8 7\r\nf 4 5 9 8\nf 5 2 6 9\n"
        "o top\nusemtl brick\nf 2 3 4\n";
    const Solids solids = readObj(fileOf(text));
    ASSERT_EQ(solids.solids.size(), 2u);
    EXPECT_EQ(solids.solids[0].name, "base.001");
    EXPECT_THAT(solids.solids[0].zones, testing::ElementsAre("stone"));
    EXPECT_EQ(solids.solids[0].vertices.size(), 8u);
    EXPECT_DOUBLE_EQ(volumeOf(solids.solids[0]), 1);
    EXPECT_THAT(solids.solids[1].zones, testing::ElementsAre("brick"));
    EXPECT_EQ(solids.solids[1].vertices.size(), 3u);
    EXPECT_EQ(solids.division, Division::asWritten);
}

TEST(Obj, WithoutMaterialsTheZoneIsTheNameWithoutItsNumber)
{
    const Solids solids = readObj(fileOf("v 0 0 0\nv 1 0 0\nv 0 1 0\ng Mesh_12\nf 1 2 3\ng 7\nf 1 2 3\n"));
    ASSERT_EQ(solids.solids.size(), 2u);
    EXPECT_THAT(solids.solids[0].zones, testing::ElementsAre("Mesh"));
    EXPECT_THAT(solids.solids[1].zones, testing::ElementsAre(""));
    EXPECT_EQ(readObj(fileOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).division, Division::byConnectivity);
}

TEST(Obj, FaultsAreNamedWithTheirLine)
{
    const auto report = [](const std::string& text) { return reportOf([&] { readObj(fileOf(text)); }); };
    EXPECT_THAT(report("v 0 0 0\nv 1 o 0\n"), AllOf(HasSubstr("'o' is no number"), HasSubstr("line 2")));
    EXPECT_THAT(report("v 0 0,5 0\n"), AllOf(HasSubstr("'0,5' is no number"), HasSubstr("decimal points")));
    EXPECT_THAT(report("v 0 0\n"), AllOf(HasSubstr("this one has 2"), HasSubstr("line 1")));
    EXPECT_THAT(report("v 0 0 0\nf 1 2 3\n"),
                AllOf(HasSubstr("vertex 2, but 1 vertices"), HasSubstr("line 2")));
    EXPECT_THAT(report("v 0 0 0\nf 1 0 1\n"), HasSubstr("vertex 0"));
    EXPECT_THAT(report("v 0 0 0\nf 1 -2 1\n"), HasSubstr("vertex -2"));
    EXPECT_THAT(report("v 0 0 0\nf 1 1\n"), HasSubstr("at least 3"));
    EXPECT_THAT(report("v 0 0 1e999\n"), HasSubstr("too large"));
    EXPECT_THAT(report("v 0 0 1" + std::string(400, '0') + "e-5\n"), HasSubstr("too large"));
    EXPECT_EQ(report("v 0 0 1.0E-400\nv 1 0 -1e-999\nv 0 1 0." + std::string(400, '0') + "1\nf 1 2 3\n"),
              "no error");
    EXPECT_THAT(report("v 0 0 nan\n"), HasSubstr("not a finite"));
    EXPECT_THAT(report("hello\n"), HasSubstr("There is no face"));
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    EXPECT_THAT(report(triangle + "o next\nv 0 0 1\nv 1 0 1\nv 0 0 0."),
                AllOf(HasSubstr("ends with 3 vertices that no face follows"), HasSubstr("line 8")));
    EXPECT_EQ(report(triangle + "v 0 0 1\nl 1 4\n"), "no error");
}

std::string plyHeader(std::string_view format, std::string_view type)
{
    return fmt::format(
        "ply\nformat {} 1.0\ncomment made by hand\nelement vertex 8\nproperty {} x\nproperty {} y\n"
        "property uchar red\nproperty {} z\nelement face 6\nproperty list uchar int vertex_indices\n"
        "end_header\n",
        format, type, type, type);
}

template<class Number>
void append(std::string& bytes, Number number, std::endian order)
{
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    if (order != std::endian::native)
    {
        std::reverse(raw, raw + sizeof number);
    }
    bytes.append(raw, sizeof number);
}

std::string binaryPly(std::endian order)
{
    std::string bytes =
        plyHeader(order == std::endian::little ? "binary_little_endian" : "binary_big_endian", "float");
    for (const Vector<3>& vertex : cube.vertices)
    {
        append(bytes, static_cast<float>(vertex.x()), order);
        append(bytes, static_cast<float>(vertex.y()), order);
        bytes += '\7';
        append(bytes, static_cast<float>(vertex.z()), order);
    }
    for (const std::vector<int>& face : cube.faces)
    {
        bytes += static_cast<char>(face.size());
        for (const int vertex : face)
        {
            append(bytes, vertex, order);
        }
    }
    return bytes;
}

std::string asciiPly()
{
    std::string text = plyHeader("ascii", "double");
    for (const Vector<3>& vertex : cube.vertices)
    {
        text += fmt::format("{} {} 255 {}\n", vertex.x(), vertex.y(), vertex.z());
    }
    for (const std::vector<int>& face : cube.faces)
    {
        text += fmt::format("{} {}\n", face.size(), fmt::join(face, " "));
    }
    return text;
}

TEST(Ply, TheThreeFormsSayTheSame)
{
    for (const std::string& bytes : {asciiPly(), binaryPly(std::endian::little), binaryPly(std::endian::big)})
    {
        const Solids solids = readPly(fileOf(bytes));
        ASSERT_EQ(solids.solids.size(), 1u);
        EXPECT_EQ(solids.solids[0].vertices, cube.vertices);
        EXPECT_EQ(solids.solids[0].faces, cube.faces);
        EXPECT_EQ(solids.division, Division::byConnectivity);
    }
    EXPECT_NEAR(readPly(fileOf(binaryPly(std::endian::big))).rounding, 1.2e-7, 1e-8);
}

// Normals in single precision made coordinates in double precision rounded ones.
TEST(Ply, NormalsSayNothingOfHowCoordinatesAreRounded)
{
    const std::string header = "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
                               "property float nx\nelement face 1\nproperty list uchar int vertex_indices\n"
                               "end_header\n";
    EXPECT_EQ(readPly(fileOf("ply\nformat ascii 1.0\n" + header
                             + "0 0 0 0.577350\n0.1234567890123 1 0 0.577350\n0 0.5 1 0.577350\n3 0 1 2\n"))
                  .rounding,
              0);
    std::string bytes = "ply\nformat binary_little_endian 1.0\n" + header;
    for (const double x : {0., 1., 2.})
    {
        append(bytes, x, std::endian::little);
        append(bytes, x * x, std::endian::little);
        append(bytes, 0., std::endian::little);
        append(bytes, 0.57735F, std::endian::little);
    }
    bytes += '\3';
    for (const int vertex : {0, 1, 2})
    {
        append(bytes, vertex, std::endian::little);
    }
    EXPECT_EQ(readPly(fileOf(bytes)).rounding, 0);
}

TEST(Ply, CutOffAnywhereItIsRefused)
{
    for (const std::string& bytes : {asciiPly(), binaryPly(std::endian::little)})
    {
        for (std::size_t size = 0; size + 2 < bytes.size(); ++size)
        {
            EXPECT_NE(reportOf([&] { readPly(fileOf(bytes.substr(0, size))); }), "no error") << size;
        }
    }
}

TEST(Ply, FaultsAreNamed)
{
    const auto report = [](const std::string& text) { return reportOf([&] { readPly(fileOf(text)); }); };
    EXPECT_THAT(report("ply\nformat latin 1.0\n"),
                AllOf(HasSubstr("Unknown format latin"), HasSubstr("line 2")));
    EXPECT_THAT(report("ply\nformat ascii 1.0\nproperty float x\n"), HasSubstr("belongs to no element"));
    EXPECT_THAT(report("ply\nformat ascii 1.0\nelement vertex 1\nproperty long x\n"),
                HasSubstr("Unknown type long"));
    EXPECT_THAT(
        report("ply\nformat ascii 1.0\nelement vertex 2000000000\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n"),
        HasSubstr("ends in the middle"));
    std::string text = asciiPly();
    EXPECT_THAT(report(std::string(text).replace(text.find("indices"), 7, "numbers")), HasSubstr("no list"));
    text[text.rfind('7')] = '8';
    EXPECT_THAT(report(text), HasSubstr("has vertex 8"));
}

TEST(Ply, WhatTheHeaderDoesNotCountIsNotLeftOut)
{
    const auto report = [](const std::string& text) { return reportOf([&] { readPly(fileOf(text)); }); };
    for (std::string bytes : {asciiPly(), binaryPly(std::endian::little), binaryPly(std::endian::big)})
    {
        EXPECT_EQ(report(bytes + "\n \r\n"), "no error");
        bytes.replace(bytes.find("face 6"), 6, "face 4"); // of blocks in one file these may be whole ones
        EXPECT_THAT(report(bytes), HasSubstr("behind the last element that the header counts"));
    }
    EXPECT_THAT(report(asciiPly() + "4 0 1 2 3\n"), AllOf(HasSubstr("4 stands behind"), HasSubstr("line")));
}

std::string binaryStl(const std::vector<Polyhedron>& shapes)
{
    std::string bytes(80, ' ');
    std::string data;
    std::uint32_t count = 0;
    for (const Polyhedron& shape : shapes)
    {
        for (const std::vector<int>& face : test::triangulated(shape).faces)
        {
            ++count;
            data.append(12, '\0');
            for (const int vertex : face)
            {
                for (int axis = 0; axis < 3; ++axis)
                {
                    append(data, static_cast<float>(shape.vertices[vertex][axis]), std::endian::little);
                }
            }
            data.append(2, '\0');
        }
    }
    append(bytes, count, std::endian::little);
    return bytes + data;
}

TEST(Stl, BothFormsSayTheSame)
{
    const Solids binary = readStl(fileOf(binaryStl({cube})));
    std::string text = "solid a cube 7\n";
    for (const std::vector<int>& face : test::triangulated(cube).faces)
    {
        text += "facet normal 0 0 1\nouter loop\n";
        for (const int vertex : face)
        {
            const Vector<3>& place = cube.vertices[vertex];
            text += fmt::format("vertex {:e} {:e} {:e}\n", place.x(), place.y(), place.z());
        }
        text += "endloop\nendfacet\n";
    }
    const Solids ascii = readStl(fileOf(text + "endsolid a cube 7\n"));
    ASSERT_EQ(ascii.solids.size(), 1u);
    EXPECT_THAT(ascii.solids[0].zones, testing::ElementsAre("a cube"));
    EXPECT_EQ(ascii.solids[0].vertices, binary.solids[0].vertices);
    EXPECT_EQ(ascii.solids[0].faces, binary.solids[0].faces);
    std::string capitals = text + "endsolid a cube 7\n";
    std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
    EXPECT_EQ(readStl(fileOf(capitals)).solids[0].vertices, binary.solids[0].vertices);
    EXPECT_THAT(reportOf([&] { readStl(fileOf(text)); }), HasSubstr("`endsolid` is expected"));
    EXPECT_THAT(reportOf([&] { readStl(fileOf("solid x\nfacet\nouter loop\nvertex 1 2 z\n")); }),
                AllOf(HasSubstr("'z' is no number"), HasSubstr("line 4")));
    EXPECT_THAT(reportOf([&] { readStl(fileOf("solid x\nendsolid x\n")); }), HasSubstr("no triangle"));
    EXPECT_THAT(reportOf([&] { readStl(fileOf(binaryStl({cube}).substr(0, 300))); }),
                HasSubstr("complete copy"));
    // A count that was not raised when a second solid was added.
    std::string two = binaryStl({cube, cube});
    two.replace(80, 4, binaryStl({cube}), 80, 4);
    EXPECT_THAT(reportOf([&] { readStl(fileOf(two)); }),
                AllOf(HasSubstr("12 triangles"), HasSubstr("for 24")));
}

/// A mesh as COMPAS writes it. \param wrapping `data` or `value`
std::string meshOf(const Polyhedron& shape, std::string_view dtype, std::string_view wrapping)
{
    std::string vertices;
    for (std::size_t i = 0; i < shape.vertices.size(); ++i)
    {
        const Vector<3>& vertex = shape.vertices[i];
        // 0 is the default, and left out.
        vertices += fmt::format("{}\"{}\": {{", i > 0 ? ", " : "", i);
        const char* separator = "";
        for (int axis = 0; axis < 3; ++axis)
        {
            if (vertex[axis] != 0)
            {
                vertices += fmt::format("{}\"{}\": {}", separator, "xyz"[axis], vertex[axis]);
                separator = ", ";
            }
        }
        vertices += "}";
    }
    std::string faces;
    for (std::size_t i = 0; i < shape.faces.size(); ++i)
    {
        faces += fmt::format("{}\"{}\": [{}]", i > 0 ? ", " : "", i, fmt::join(shape.faces[i], ", "));
    }
    return fmt::format(
        "{{\"dtype\": \"{}\", \"{}\": {{\"dva\": {{\"x\": 0.0, \"y\": 0.0, \"z\": 0.0}}, \"vertex\": {{{}}}, "
        "\"face\": {{{}}}}}}}",
        dtype, wrapping, vertices, faces);
}

const Polyhedron above = makeBox({0, 0, 1}, {1, 1, 2});

std::vector<std::string> compasSchemas()
{
    const std::string points = "[[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]";
    const auto block = [](const Polyhedron& shape, std::string_view wrapping)
    { return meshOf(shape, "compas_assembly.datastructures/Block", wrapping); };
    const std::string today = fmt::format(
        R"({{"dtype": "compas_assembly.datastructures/Assembly", "data": {{"attributes": {{}}, "graph": {{"dtype":
        "compas.datastructures/Graph", "data": {{"node": {{"3": {{"block": {}, "is_support": true}}, "5": {{"block": {}}}}},
        "edge": {{"5": {{"3": {{"interfaces": [{{"dtype": "Interface", "data": {{"points": {}}}}}]}}}}, "3": {{}}}}}}}}}}}})",
        block(cube, "data"), block(above, "data"), points);
    const std::string network = fmt::format(
        R"({{"attributes": {{}}, "node": {{"3": {{"block": {}, "is_support": true}}, "5": {{"block": {}}}}},
        "edge": {{"5": {{"3": {{"interface": {{"dtype": "Interface", "value": {{"points": {}}}}}}}}}, "3": {{}}}}}})",
        block(cube, "value"), block(above, "value"), points);
    const auto bare = [&](const Polyhedron& shape)
    {
        const std::string whole = block(shape, "value");
        const std::size_t start = whole.find("\"value\": ") + 9;
        return whole.substr(start, whole.size() - start - 1);
    };
    const std::string beside = fmt::format(
        R"({{"assembly": {{"vertex": {{"3": {{"is_support": true}}, "5": {{"is_support": false}}}},
        "edge": {{"5": {{"3": {{"interface_points": {}}}}}}}}}, "blocks": {{"5": {}, "3": {}}}}})",
        points, bare(above), bare(cube));
    return {today, network, beside};
}

TEST(CompasJson, ANodeNamesTheZonesOfItsBlock)
{
    const auto zonesOf = [](std::string_view attributes)
    {
        return readCompasJson(fileOf(fmt::format(R"({{"node": {{"0": {{"block": {}{}}}}}, "edge": {{}}}})",
                                                 meshOf(cube, "Mesh", "data"), attributes)))
            .solids[0]
            .zones;
    };
    EXPECT_THAT(zonesOf(R"(, "is_support": true, "zones": ["ground", "tuff"])"),
                testing::ElementsAre("is_support", "ground", "tuff"));
    EXPECT_THAT(zonesOf(R"(, "zones": [])"), testing::IsEmpty());
    EXPECT_THAT(zonesOf(R"(, "is_support": 1)"), testing::ElementsAre("is_support"));
    EXPECT_THAT(zonesOf(R"(, "is_support": 0)"), testing::IsEmpty());
    EXPECT_THAT(zonesOf(R"(, "is_support": null)"), testing::IsEmpty());
    const std::string byDefault = fmt::format(
        R"({{"default_node_attributes": {{"is_support": true}}, "node": {{"0": {{"block": {0}}}, "1": {{"block": {0},
        "is_support": false}}}}, "edge": {{}}}})",
        meshOf(cube, "Mesh", "data"));
    const Solids solids = readCompasJson(fileOf(byDefault));
    EXPECT_THAT(solids.solids[0].zones, testing::ElementsAre("is_support"));
    EXPECT_THAT(solids.solids[1].zones, testing::IsEmpty());
    for (const std::string_view wrong : {"\"yes\"", "2", "[]"})
    {
        EXPECT_THAT(reportOf([&] { zonesOf(fmt::format(R"(, "is_support": {})", wrong)); }),
                    AllOf(HasSubstr("true or false is expected"), HasSubstr("is_support")));
    }
    // What other programs keep under this name.
    EXPECT_THAT(zonesOf(R"(, "zones": {"a": 1})"), testing::IsEmpty());
    EXPECT_THAT(zonesOf(R"(, "zones": "tuff")"), testing::IsEmpty());
    EXPECT_THAT(zonesOf(R"(, "zones": [3, null, "tuff"])"), testing::ElementsAre("tuff"));
}

TEST(CompasJson, SchemasOfTodayAndOfOldSayTheSame)
{
    for (const std::string& text : compasSchemas())
    {
        const Solids solids = readCompasJson(fileOf(text));
        ASSERT_EQ(solids.solids.size(), 2u);
        EXPECT_THAT(solids.solids[0].zones, testing::ElementsAre("is_support"));
        EXPECT_THAT(solids.solids[1].zones, testing::IsEmpty());
        EXPECT_EQ(solids.solids[0].vertices, cube.vertices);
        EXPECT_EQ(solids.solids[1].faces, above.faces);
        ASSERT_EQ(solids.interfaces.size(), 1u);
        EXPECT_EQ(solids.interfaces[0].solid, 1);
        EXPECT_EQ(solids.interfaces[0].neighbour, 0);
        EXPECT_EQ(solids.interfaces[0].points.size(), 4u);
    }
    const std::string list =
        fmt::format("[{}, {}]", meshOf(cube, "Mesh", "value"), meshOf(above, "Mesh", "data"));
    EXPECT_EQ(readCompasJson(fileOf(list)).solids.size(), 2u);
    EXPECT_EQ(readCompasJson(fileOf(meshOf(cube, "Mesh", "data"))).solids.size(), 1u);
}

TEST(CompasJson, FaultsAreNamedWithTheirPath)
{
    const auto report = [](std::string text, const std::string& old, const std::string& with)
    {
        const std::size_t at = text.find(old);
        EXPECT_NE(at, std::string::npos) << old;
        text.replace(at, old.size(), with);
        return reportOf([&] { readCompasJson(fileOf(text)); });
    };
    const std::string today = compasSchemas().front();
    EXPECT_THAT(
        report(today, "\"x\": 1", "\"x\": \"1\""),
        AllOf(HasSubstr("A number is expected"), HasSubstr("data/graph/data/node/3/block/data/vertex/1/x")));
    EXPECT_THAT(report(today, "\"x\": 1", "\"x\": null"), HasSubstr("A number is expected"));
    const std::string face = fmt::format("\"0\": [{}", fmt::join(cube.faces[0], ", "));
    EXPECT_THAT(report(today, face, "\"0\": [0, 1, 9"), AllOf(HasSubstr("vertex 9"), HasSubstr("face/0")));
    EXPECT_THAT(report(today, face, "\"0\": [0, 1, 2.4"), HasSubstr("vertex 2.4"));
    EXPECT_THAT(report(today, "\"3\": {\"interfaces\"", "\"4\": {\"interfaces\""),
                HasSubstr("between 5 and 4"));
    EXPECT_THAT(report(today, "[1, 0, 1]", "[1, 0]"), HasSubstr("list of 3 numbers"));
    EXPECT_THAT(report(today, "\"node\"", "\"nodes\""), HasSubstr("no object with the nodes"));
    EXPECT_THAT(report(today, "}", ""), HasSubstr("no COMPAS JSON"));
    EXPECT_THAT(reportOf([] { readCompasJson(fileOf(std::string(1000000, '['))); }),
                HasSubstr("nested deeper"));
    EXPECT_THAT(reportOf([] { readCompasJson(fileOf("[]")); }), HasSubstr("no block"));
}

TEST(DigitCount, SaysToWhatCoordinatesAreRounded)
{
    const auto unit = [](const std::vector<std::string>& numbers)
    {
        DigitCount digits;
        for (const std::string& number : numbers)
        {
            digits.add(number);
        }
        return digits.unit();
    };
    EXPECT_DOUBLE_EQ(unit({"0.000", "1.025", "-12.500"}), 1e-3);
    EXPECT_EQ(unit({"0", "1.025", "0.5"}), 0);
    EXPECT_EQ(unit({"0", "0.1", "0.30000000000000004"}), 0);
    EXPECT_DOUBLE_EQ(unit({"0.707107", "1.5", "12.3457"}), 1e-4);
    EXPECT_EQ(unit({"8.881784197001252e-16", "5"}), 0);
    EXPECT_EQ(unit({}), 0);
}

} // namespace
