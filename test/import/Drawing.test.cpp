// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Readers of drawings: closed outlines with their layers, and what is left out or refused.
#include "import/Drawing.h"

#include "ImportTesting.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

using namespace drystone;
using test::fileOf;
using testing::AllOf;
using testing::HasSubstr;

namespace
{

/// Groups `code value` to lines.
std::string groups(std::initializer_list<std::pair<int, std::string>> list)
{
    std::string text;
    for (const auto& [code, value] : list)
    {
        text += fmt::format("{:3}\r\n{}\r\n", code, value);
    }
    return text;
}

std::string section(const std::string& name, const std::string& content)
{
    return groups({{0, "SECTION"}, {2, name}}) + content + groups({{0, "ENDSEC"}});
}

const std::string square = groups({{0, "LWPOLYLINE"},
                                   {8, "stone"},
                                   {90, "4"},
                                   {70, "1"},
                                   {10, "0"},
                                   {20, "0"},
                                   {10, "2"},
                                   {20, "0"},
                                   {10, "2"},
                                   {20, "1"},
                                   {10, "0"},
                                   {20, "1"}});
const std::string end = groups({{0, "EOF"}});

/// A block of one closed triangle on layer 0. \param baseX of its base point (baseX 0)
std::string triangleBlock(const std::string& name, const std::string& baseX,
                          const std::array<std::array<const char*, 2>, 3>& corners)
{
    std::string polyline = groups({{0, "LWPOLYLINE"}, {8, "0"}, {70, "1"}});
    for (const auto& [x, y] : corners)
    {
        polyline += groups({{10, x}, {20, y}});
    }
    return groups({{0, "BLOCK"}, {2, name}, {10, baseX}, {20, "0"}}) + polyline + groups({{0, "ENDBLK"}});
}

Drawing read(const std::string& text, int chords = 36)
{
    return readDxf(fileOf(text), {chords});
}

std::string report(const std::string& text)
{
    return reportOf([&] { read(text); });
}

TEST(Dxf, ClosedPolylinesAreOutlinesOfTheirLayers)
{
    const std::string old = groups({{0, "POLYLINE"},
                                    {8, "brick"},
                                    {66, "1"},
                                    {70, "1"},
                                    {10, "0"},
                                    {20, "0"},
                                    {0, "VERTEX"},
                                    {10, "0"},
                                    {20, "5"},
                                    {0, "VERTEX"},
                                    {10, "1"},
                                    {20, "5"},
                                    {0, "VERTEX"},
                                    {10, "0"},
                                    {20, "6"},
                                    {0, "SEQEND"},
                                    {8, "brick"}});
    const std::string open =
        groups({{0, "LWPOLYLINE"}, {8, "axis"}, {70, "0"}, {10, "0"}, {20, "0"}, {10, "2"}, {20, "0"}});
    const std::string text = groups({{0, "TEXT"}, {1, "facade"}});
    const Drawing drawing =
        read(groups({{999, "drawn by hand"}})
             + section("HEADER", groups({{9, "$ACADVER"}, {1, "AC1015"}, {9, "$INSUNITS"}, {70, "4"}}))
             + section("ENTITIES", square + old + open + text) + end);
    ASSERT_EQ(drawing.outlines.size(), 2u);
    EXPECT_EQ(drawing.outlines[0].corners, (Polygon{{0, 0}, {2, 0}, {2, 1}, {0, 1}}));
    EXPECT_EQ(drawing.outlines[0].layer, "stone");
    EXPECT_EQ(drawing.outlines[1].corners, (Polygon{{0, 5}, {1, 5}, {0, 6}}));
    EXPECT_EQ(drawing.outlines[1].layer, "brick");
    EXPECT_EQ(drawing.unit, 0.001);
    EXPECT_THAT(drawing.ignored, testing::UnorderedElementsAre("1 entities TEXT", "1 open polylines"));
    const Assembly<2> assembly = drawnBlocks(drawing, {}, fileOf(""));
    EXPECT_NEAR(areaProperties(assembly.blocks[0].outline).area, 2e-6, 1e-20);
    ASSERT_EQ(assembly.zones.size(), 2u);
    EXPECT_EQ(assembly.zones[1].name, "brick");
}

TEST(Dxf, BulgesAreChordsOnTheArc)
{
    // A half circle about (1 0) from (2 0) to (0 0), closed by a straight line.
    const std::string arc = groups(
        {{0, "LWPOLYLINE"}, {8, "0"}, {70, "1"}, {10, "2"}, {20, "0"}, {42, "1"}, {10, "0"}, {20, "0"}});
    const Drawing drawing = read(section("ENTITIES", arc) + end, 36);
    ASSERT_EQ(drawing.outlines.size(), 1u);
    const Polygon& corners = drawing.outlines[0].corners;
    ASSERT_EQ(corners.size(), 19u);
    for (const Vector<2>& corner : corners)
    {
        EXPECT_NEAR((corner - Vector<2>(1, 0)).norm(), 1, 1e-14);
        EXPECT_GE(corner.y(), -1e-15);
    }
    // The other way round the same corners result, so that neighbours meet.
    const std::string back = groups(
        {{0, "LWPOLYLINE"}, {8, "0"}, {70, "1"}, {10, "0"}, {20, "0"}, {42, "-1"}, {10, "2"}, {20, "0"}});
    const Polygon reversed = read(section("ENTITIES", back) + end, 36).outlines[0].corners;
    for (std::size_t i = 0; i <= 18; ++i)
    {
        EXPECT_LE((reversed[i] - corners[18 - i]).norm(), 1e-14) << i;
    }
}

TEST(Dxf, BlocksAreInsertedMovedTurnedScaledAndRepeated)
{
    const std::string block = triangleBlock("brick", "1", {{{"1", "0"}, {"2", "0"}, {"2", "1"}}});
    const std::string outer =
        groups({{0, "BLOCK"}, {2, "pair"}, {10, "0"}, {20, "0"}})
        + groups({{0, "INSERT"}, {2, "brick"}, {8, "0"}, {10, "0"}, {20, "0"}, {70, "2"}, {44, "3"}})
        + groups({{0, "ENDBLK"}});
    const std::string insert = groups(
        {{0, "INSERT"}, {2, "pair"}, {8, "wall"}, {10, "10"}, {20, "20"}, {41, "2"}, {42, "2"}, {50, "90"}});
    const Drawing drawing = read(section("BLOCKS", block + outer) + section("ENTITIES", insert) + end);
    ASSERT_EQ(drawing.outlines.size(), 2u);
    EXPECT_EQ(drawing.outlines[0].layer, "wall");
    const Polygon expected{{10, 26}, {10, 28}, {8, 28}};
    for (std::size_t i = 0; i < 3; ++i)
    {
        EXPECT_LE((drawing.outlines[1].corners[i] - expected[i]).norm(), 1e-14);
    }
}

TEST(Dxf, AnInsertExtrudedBackwardsIsAMirrorImage)
{
    // A triangle at (-3 0) of coordinates whose x counts the other way.
    const std::string block = triangleBlock("Stone", "0", {{{"0", "0"}, {"1", "0"}, {"0", "1"}}});
    const std::string insert =
        groups({{0, "INSERT"}, {2, "STONE"}, {8, "0"}, {10, "-3"}, {20, "0"}, {210, "0"}, {230, "-1"}});
    const std::string tilted = groups({{0, "INSERT"}, {2, "stone"}, {220, "-1"}, {230, "0"}});
    const Drawing drawing = read(section("BLOCKS", block) + section("ENTITIES", insert + tilted) + end);
    ASSERT_EQ(drawing.outlines.size(), 2u);
    EXPECT_EQ(drawing.outlines[0].corners, (Polygon{{3, 0}, {2, 0}, {3, 1}}));
    ASSERT_EQ(drawing.ignored.size(), 1u);
    EXPECT_THAT(drawing.ignored[0], HasSubstr("1 directions of extrusion other than z"));
}

TEST(Dxf, TheFrameOfASplineAndMeshesAreNotDrawn)
{
    const auto vertex = [](const char* x, const char* y, const char* flags) {
        return groups({{0, "VERTEX"}, {8, "0"}, {10, x}, {20, y}, {70, flags}});
    };
    const std::string corners = vertex("1", "0", "8") + vertex("0", "0", "16") + vertex("2", "1", "8")
                                + vertex("5", "5", "16") + vertex("1", "2", "8");
    const std::string ends = groups({{0, "SEQEND"}});
    const std::string spline = groups({{0, "POLYLINE"}, {66, "1"}, {10, "0"}, {20, "0"}, {70, "5"}});
    const std::string mesh = groups({{0, "POLYLINE"}, {66, "1"}, {70, "17"}});
    const Drawing drawing = read(section("ENTITIES", spline + corners + ends + mesh + corners + ends) + end);
    ASSERT_EQ(drawing.outlines.size(), 1u);
    EXPECT_EQ(drawing.outlines[0].corners, (Polygon{{1, 0}, {2, 1}, {1, 2}}));
    EXPECT_THAT(drawing.ignored, testing::ElementsAre("1 entities POLYLINE that are meshes"));
}

// A layer that is off hides what is on it, one that is frozen also the blocks that are inserted on it.
TEST(Dxf, InsertsOnFrozenLayersAreLeftOutWithAllThatTheyInsert)
{
    const std::string blocks =
        section("BLOCKS", groups({{0, "BLOCK"}, {2, "b"}}) + square // on `stone`
                              + groups({{0, "ENDBLK"}, {0, "BLOCK"}, {2, "outer"}})
                              + groups({{0, "INSERT"}, {8, "0"}, {2, "b"}}) + groups({{0, "ENDBLK"}}));
    const auto ofInsert = [&](const std::string& flags, const std::string& colour, const std::string& block)
    {
        const std::string tables =
            groups({{0, "TABLE"}, {2, "LAYER"}, {0, "LAYER"}, {2, "Old"}, {70, flags}, {62, colour}})
            + groups({{0, "ENDTAB"}});
        const std::string insert = groups({{0, "INSERT"}, {8, "old"}, {2, block}});
        return read(section("TABLES", tables) + blocks + section("ENTITIES", insert) + end);
    };
    const Drawing frozen = ofInsert("1", "7", "b");
    EXPECT_TRUE(frozen.outlines.empty());
    EXPECT_THAT(frozen.ignored, testing::ElementsAre("1 inserts on layers that are frozen"));
    EXPECT_TRUE(ofInsert("1", "7", "outer").outlines.empty());
    EXPECT_EQ(ofInsert("0", "-7", "b").outlines.size(), 1u);
    EXPECT_EQ(ofInsert("4", "7", "outer").outlines.size(), 1u) << "only locked";
}

TEST(Dxf, EntitiesOfManyNamesAreAllCounted)
{
    std::string entities;
    for (int i = 0; i < 300; ++i)
    {
        entities += groups({{0, fmt::format("THING{}", i % 150)}});
    }
    const Drawing drawing = read(section("ENTITIES", square + entities) + end);
    EXPECT_THAT(drawing.ignored, testing::Contains("2 entities THING0"));
    EXPECT_THAT(drawing.ignored, testing::Contains("100 entities of other names"));
}

TEST(Dxf, HiddenLayersAreLeftOut)
{
    const std::string tables = groups(
        {{0, "TABLE"}, {2, "LAYER"}, {0, "LAYER"}, {2, "Stone"}, {70, "0"}, {62, "-7"}, {0, "ENDTAB"}});
    const Drawing drawing = read(section("TABLES", tables) + section("ENTITIES", square) + end);
    EXPECT_TRUE(drawing.outlines.empty());
    EXPECT_THAT(drawing.ignored, testing::ElementsAre("1 outlines on layers that are off or frozen"));
    EXPECT_THAT(reportOf([&] { drawnBlocks(drawing, {}, fileOf("")); }), HasSubstr("no closed outline"));
}

TEST(Dxf, WhatIsMarkedInvisibleIsLeftOutAndCounted)
{
    const auto marked = [](const char* mark, int code = 60)
    {
        return groups({{0, "LWPOLYLINE"},
                       {code, mark},
                       {70, "1"},
                       {10, "0"},
                       {20, "0"},
                       {10, "2"},
                       {20, "0"},
                       {10, "2"},
                       {20, "1"}});
    };
    const std::string block = groups({{0, "BLOCK"}, {2, "brick"}}) + square + groups({{0, "ENDBLK"}});
    const std::string insert = groups({{0, "INSERT"}, {2, "brick"}, {60, "1"}});
    const std::string title = groups({{0, "INSERT"}, {2, "brick"}, {67, "1"}});
    constexpr int onPaper = 67;
    const std::string all = marked("1") + marked("0") + marked("1", onPaper) + insert + title;
    const Drawing drawing = read(section("BLOCKS", block) + section("ENTITIES", all) + end);
    EXPECT_EQ(drawing.outlines.size(), 1u);
    EXPECT_THAT(drawing.ignored,
                testing::ElementsAre("2 entities of paper space", "2 entities that are marked invisible"));
}

TEST(Dxf, HostileFilesEndInAMessage)
{
    EXPECT_THAT(report("AutoCAD Binary DXF\r\n"), HasSubstr("text form"));
    EXPECT_THAT(report("AC1027\0\0\0"), HasSubstr("This is a DWG file"));
    EXPECT_THAT(report("hello\n"), AllOf(HasSubstr("no integer"), HasSubstr("line 1")));
    EXPECT_THAT(report(section("ENTITIES", square)), HasSubstr("without `EOF`"));
    EXPECT_THAT(report(groups({{0, "SECTION"}, {2, "ENTITIES"}}) + square + end),
                HasSubstr("before `ENDSEC`"));
    std::string wrong = section("ENTITIES", square) + end;
    wrong[wrong.rfind(" 20\r\n1") + 5] = 'x';
    EXPECT_THAT(report(wrong), AllOf(HasSubstr("'x' is no number"), HasSubstr("at line")));
    // A polyline that announces more corners than there is memory for.
    std::string many = section("ENTITIES", square) + end;
    many.replace(many.find(" 90\r\n4") + 5, 1, "2147483647");
    EXPECT_EQ(read(many).outlines.size(), 1u);
    // Blocks within blocks, 10^16 of them in all.
    std::string nested = groups({{0, "BLOCK"}, {2, "b0"}}) + square + groups({{0, "ENDBLK"}});
    for (int level = 1; level <= 16; ++level)
    {
        nested += groups({{0, "BLOCK"}, {2, fmt::format("b{}", level)}});
        for (int i = 0; i < 10; ++i)
        {
            nested += groups({{0, "INSERT"}, {2, fmt::format("b{}", level - 1)}, {10, "0"}, {20, "0"}});
        }
        nested += groups({{0, "ENDBLK"}});
    }
    const std::string all = groups({{0, "INSERT"}, {2, "b15"}, {10, "0"}, {20, "0"}});
    EXPECT_THAT(report(section("BLOCKS", nested) + section("ENTITIES", all) + end),
                HasSubstr("more than 1000000"));
    // As many that are left out, each of which took its time.
    std::string hidden = groups({{0, "BLOCK"}, {2, "h"}});
    for (int i = 0; i < 2000; ++i)
    {
        hidden += groups({{0, "INSERT"}, {60, "1"}, {2, "h"}});
    }
    hidden += groups({{0, "ENDBLK"}});
    const std::string array = groups({{0, "INSERT"}, {2, "h"}, {70, "1000"}, {71, "999"}});
    EXPECT_THAT(report(section("BLOCKS", hidden) + section("ENTITIES", array) + end),
                HasSubstr("More than 1000000"));
    const std::string self = groups({{0, "BLOCK"}, {2, "a"}, {0, "INSERT"}, {2, "a"}, {0, "ENDBLK"}});
    EXPECT_THAT(
        report(section("BLOCKS", self) + section("ENTITIES", groups({{0, "INSERT"}, {2, "a"}})) + end),
        HasSubstr("more than 16 levels"));
    EXPECT_THAT(report(section("ENTITIES", groups({{0, "INSERT"}, {2, "none"}})) + end),
                HasSubstr("no block none"));
}

Drawing readVector(const std::string& content, const std::string& attributes = "")
{
    return readSvg(fileOf(
        fmt::format("<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" {}>\n{}\n</svg>\n",
                    attributes, content)));
}

TEST(Svg, PathsPolygonsAndRectanglesAreOutlines)
{
    const Drawing drawing =
        readVector("<g id=\"wall\"><g id=\"inner\"><path d=\"M0,0l1.5-2h2e0V0z m10 0 h1 v1 z\"/></g></g>"
                   "<polygon points=\"0,0 1,0 1,1\"/><rect x=\"1\" y=\"2\" width=\"3\" height=\"4\"/><circle "
                   "r=\"1\"/><path d=\"M0 0L1 1\"/>",
                   "width=\"100mm\" viewBox=\"0 0 50 50\"");
    ASSERT_EQ(drawing.outlines.size(), 4u);
    EXPECT_EQ(drawing.outlines[0].corners, (Polygon{{0, 0}, {1.5, 2}, {3.5, 2}, {3.5, 0}}));
    EXPECT_EQ(drawing.outlines[0].layer, "wall");
    EXPECT_EQ(drawing.outlines[1].corners, (Polygon{{10, 0}, {11, 0}, {11, -1}}));
    EXPECT_EQ(drawing.outlines[2].layer, "");
    EXPECT_EQ(drawing.outlines[3].corners, (Polygon{{1, -2}, {4, -2}, {4, -6}, {1, -6}}));
    EXPECT_DOUBLE_EQ(drawing.unit.value_or(0), 0.002);
    EXPECT_THAT(drawing.ignored,
                testing::UnorderedElementsAre("1 elements circle", "1 elements path that is open"));
}

TEST(Svg, PolylinesWhoseEndsMeetAreOutlines)
{
    const Drawing drawing =
        readVector("<polyline points=\"0,0 2,0 2,1 0,1 0,0\"/><polyline points=\"0,0 2,0 2,1\"/><polyline/>");
    ASSERT_EQ(drawing.outlines.size(), 1u);
    EXPECT_EQ(drawing.outlines[0].corners, (Polygon{{0, 0}, {2, 0}, {2, -1}, {0, -1}, {0, 0}}));
    EXPECT_THAT(drawing.ignored, testing::ElementsAre("2 elements polyline that is open"));
}

// A unit of the file is a pixel of CSS, 1/96 in, whatever the unit of the drawing.
TEST(Svg, LengthsOfRectanglesMayHaveUnits)
{
    const Polygon corners = readVector("<rect x=\"1in\" y=\" 2 px \" width=\"25.4mm\" height=\"72pt\"/>")
                                .outlines.front()
                                .corners;
    EXPECT_LE((corners[0] - Vector<2>(96, -2)).norm(), 1e-12);
    EXPECT_LE((corners[2] - Vector<2>(192, -98)).norm(), 1e-12);
    EXPECT_THAT(reportOf([] { readVector("<rect width=\"50%\" height=\"1em\"/>"); }),
                AllOf(HasSubstr("50%"), HasSubstr("line 3")));
    EXPECT_THAT(reportOf([] { readVector("<rect width=\"60em\" height=\"1\"/>"); }), HasSubstr("'60em'"));
    EXPECT_FALSE(readVector("<rect width=\"2\" height=\"1\"/>", "width=\"60em\" viewBox=\"0 0 1 1\"").unit);
    EXPECT_FALSE(readVector("<rect width=\"2\" height=\"1\"/>", "width=\"60vmin\" viewBox=\"0 0 1 1\"").unit);
}

TEST(Svg, ElementsOfManyNamesAreAllCounted)
{
    std::string elements;
    for (int i = 0; i < 300; ++i)
    {
        elements += fmt::format("<thing{}/>", i % 150);
    }
    const Drawing drawing = readVector(elements);
    EXPECT_THAT(drawing.ignored, testing::Contains("2 elements thing0"));
    EXPECT_THAT(drawing.ignored, testing::Contains("100 elements of other names"));
}

TEST(Svg, HalfACornerIsRefused)
{
    EXPECT_THAT(reportOf([] { readVector("<polygon points=\"0,0 1,0 1,1 0\"/>"); }),
                HasSubstr("A number is expected at the end: a coordinate is missing."));
}

TEST(Svg, TransformsAreApplied)
{
    const auto corner = [](const std::string& transform)
    {
        return readVector(fmt::format("<g transform=\"{}\"><polygon points=\"1 0 2 0 2 1\"/></g>", transform))
            .outlines.front()
            .corners.front();
    };
    EXPECT_EQ(corner("translate(2, 3)"), Vector<2>(3, -3));
    EXPECT_EQ(corner("scale(2)translate(1)"), Vector<2>(4, 0));
    EXPECT_LE((corner("rotate(90)") - Vector<2>(0, -1)).norm(), 1e-15);
    EXPECT_LE((corner("rotate(90, 1, 1)") - Vector<2>(2, -1)).norm(), 1e-15);
    EXPECT_EQ(corner("matrix(1 2 3 4 5 6)"), Vector<2>(6, -8));
    EXPECT_LE((corner("skewY(45)") - Vector<2>(1, -1)).norm(), 1e-15);
}

TEST(Svg, HiddenShapesAreLeftOutAndCounted)
{
    const std::string rect = "<rect width=\"1\" height=\"1\" ";
    const auto outlines = [&](const std::string& content)
    {
        const Drawing drawing = readVector(content);
        const std::size_t hidden = 5 - drawing.outlines.size();
        EXPECT_THAT(drawing.ignored, testing::ElementsAre(fmt::format(
                                         "{} shapes that are hidden (display, visibility)", hidden)));
        return drawing.outlines.size();
    };
    const std::string four = "/>" + rect + "/>" + rect + "/>" + rect + "/>" + rect + "/>";
    EXPECT_EQ(outlines(rect + "display=\"none\"" + four), 4u);
    EXPECT_EQ(outlines(rect + "style=\"fill: #ccc; display : none !important\"" + four), 4u);
    EXPECT_EQ(outlines(rect + "visibility=\"hidden\"" + four), 4u);
    EXPECT_EQ(outlines(rect + "visibility=\"collapse\"" + four), 4u);
    EXPECT_EQ(
        outlines("<g style=\"display:none\"><g>" + rect + "display=\"inline\"/></g></g>" + four.substr(2)),
        4u);
    EXPECT_EQ(outlines("<g visibility=\"hidden\">" + rect + "/>" + rect + "visibility=\"visible\"/></g>"
                       + rect + "/>" + rect + "/>" + rect + "/>"),
              4u);
    EXPECT_TRUE(
        readVector(rect + "style=\"display:inline;visibility:visible\" display=\"none\"/>").ignored.empty())
        << "style comes before the attribute";
    EXPECT_THAT(readVector("<style>.a { display: none }</style>" + rect + "class=\"a\"/>").ignored,
                testing::ElementsAre(HasSubstr("style, whose `display` and `visibility` are not read")));
}

TEST(Svg, TheUnitIsThatOfTheShapeOfTheDrawing)
{
    const auto unit = [](const std::string& attributes)
    { return readVector("<rect width=\"2\" height=\"1\"/>", attributes).unit.value_or(0); };
    const std::string wide = "width=\"2000mm\" height=\"1000mm\" viewBox=\"0 -1000 1000 1000\" ";
    EXPECT_DOUBLE_EQ(unit(wide), 0.001);
    EXPECT_DOUBLE_EQ(unit(wide + "preserveAspectRatio=\"xMinYMax meet\""), 0.001);
    EXPECT_DOUBLE_EQ(unit(wide + "preserveAspectRatio=\"xMidYMid slice\""), 0.002);
    EXPECT_DOUBLE_EQ(unit("width=\"1m\" height=\"50cm\" viewBox=\"0 0 100 25\""), 0.01);
    EXPECT_DOUBLE_EQ(unit("width=\"1m\" height=\"100%\" viewBox=\"0 0 100 25\""), 0.01);
    EXPECT_DOUBLE_EQ(unit("width=\"1in\" height=\"48\" viewBox=\"0 0 10 10\""), 0.00127);
    EXPECT_DOUBLE_EQ(unit("width=\"72pt\" height=\"96px\" viewBox=\"0 0 10 10\""), 0.00254);
    EXPECT_EQ(unit("width=\"500\" height=\"96mm\" viewBox=\"0 0 10 10\""), 0);
    const Drawing stretched =
        readVector("<rect width=\"2\" height=\"1\"/>", wide + "preserveAspectRatio=\"none\"");
    EXPECT_DOUBLE_EQ(stretched.unit.value_or(0), 0.002);
    EXPECT_EQ(stretched.outlines.front().corners, (Polygon{{0, 0}, {2, 0}, {2, -0.5}, {0, -0.5}}));
}

TEST(Svg, RoundCornersAreRefusedAsCurvesAre)
{
    const auto reportOfRect = [](const std::string& radii)
    { return reportOf([&] { readVector("<rect width=\"2\" height=\"1\" " + radii + "/>"); }); };
    for (const char* round : {"rx=\"0.2\"", "ry=\"0.2\"", "rx=\"2mm\" ry=\"0.1\"", "rx=\"auto\" ry=\"5%\""})
    {
        EXPECT_THAT(reportOfRect(round), AllOf(HasSubstr("round corners"), HasSubstr("line 3"))) << round;
    }
    for (const char* sharp : {"rx=\"0\"", "ry=\"0\" rx=\"0.2\"", "rx=\"auto\"", "rx=\"\""})
    {
        EXPECT_EQ(reportOfRect(sharp), "no error") << sharp;
    }
}

TEST(Svg, FaultsAreNamedWithTheirLine)
{
    const auto reportOfSvg = [](const std::string& content)
    { return reportOf([&] { readVector(content); }); };
    EXPECT_THAT(reportOfSvg("<path d=\"M0 0 C1 1 2 2 3 3z\"/>"),
                AllOf(HasSubstr("command `C`"), HasSubstr("line 3")));
    EXPECT_THAT(reportOfSvg("\n<path d=\"M0 0 L1\"/>"),
                AllOf(HasSubstr("number is expected"), HasSubstr("line 4")));
    EXPECT_THAT(reportOfSvg("<path d=\"1 2\"/>"), HasSubstr("begins with a command"));
    EXPECT_THAT(reportOfSvg("<g transform=\"turn(3)\"/>"), HasSubstr("transform `turn`"));
    EXPECT_THAT(reportOfSvg("<g transform=\"rotate\"/>"), HasSubstr("no `(`"));
    EXPECT_THAT(reportOfSvg("<g>"), HasSubstr("This is no SVG"));
    EXPECT_THAT(reportOf([] { readSvg(fileOf("<html/>")); }), HasSubstr("no element `svg`"));
    std::string deep;
    for (int i = 0; i < 100000; ++i)
    {
        deep += "<g>";
    }
    for (int i = 0; i < 100000; ++i)
    {
        deep += "</g>";
    }
    EXPECT_THAT(reportOfSvg(deep), HasSubstr("nested deeper"));
}

TEST(Svg, ATransformInAStyleIsNotPassedOver)
{
    const std::string rect = "<rect width=\"1\" height=\"1\" ";
    const std::string moved = "style=\"fill: red; transform: translate(1px, 0)\"";
    EXPECT_THAT(reportOf([&] { readVector(rect + moved + "/>"); }), HasSubstr("`transform=\"...\"`"));
    EXPECT_THAT(reportOf([&] { readVector("<g " + moved + ">" + rect + "/></g>"); }),
                HasSubstr("`transform=\"...\"`"));
    EXPECT_EQ(readVector(rect + "style=\"transform: none\"/>").outlines.size(), 1u);
    EXPECT_EQ(
        readVector(rect + "style=\"transform: scale(2); display: none\"/>" + rect + "/>").outlines.size(),
        1u);
    EXPECT_THAT(readVector("<style>.a { transform: scale(2) }</style>" + rect + "class=\"a\"/>").ignored,
                testing::ElementsAre(HasSubstr("style, whose `transform` is not read")));
}

TEST(Drawing, OutlinesThatAreNoBlocksAreNamedWithTheirLine)
{
    Drawing drawing;
    drawing.outlines = {{{{0, 0}, {1, 0}, {1, 1}}, "a", 3}, {{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, "b", 9}};
    EXPECT_THAT(reportOf([&] { drawnBlocks(drawing, {}, fileOf("")); }),
                AllOf(HasSubstr("The outline of block 1"), HasSubstr("line 9")));
    DrawingSettings settings;
    settings.layers = {"a"};
    EXPECT_EQ(drawnBlocks(drawing, settings, fileOf("")).blocks.size(), 1u);
    settings.scale = 1e9;
    EXPECT_THAT(reportOf([&] { drawnBlocks(drawing, settings, fileOf("")); }), HasSubstr("smaller scale"));
}

TEST(Drawing, ALayerWithoutOutlinesIsRefusedBesideOthers)
{
    Drawing drawing;
    drawing.outlines = {{{{0, 0}, {1, 0}, {1, 1}}, "stone", 3}, {{{2, 0}, {3, 0}, {3, 1}}, "brick", 9}};
    DrawingSettings settings;
    settings.layers = {"stone", "brik"};
    EXPECT_THAT(reportOf([&] { drawnBlocks(drawing, settings, fileOf("")); }),
                AllOf(HasSubstr("brik. Did you mean brick?"), HasSubstr("brick stone")));
    settings.layers = {"stone", "brick"};
    EXPECT_EQ(drawnBlocks(drawing, settings, fileOf("")).blocks.size(), 2u);
}

TEST(Drawing, WithoutOutlinesSaysWhatThereIs)
{
    Drawing drawing;
    drawing.ignored = {"4 entities LINE", "1 open polylines"};
    EXPECT_THAT(reportOf([&] { drawnBlocks(drawing, {}, fileOf("")); }),
                AllOf(HasSubstr("no closed outline"), HasSubstr("4 entities LINE, 1 open polylines")));
}

// Four corners of a stone that nobody closed: without it the wall stands on less, and no word said where.
TEST(Drawing, OpenLinesOnLayersOfBlocksAreWarnedOf)
{
    const auto polyline = [](const std::string& layer, const std::string& closed, int corners)
    {
        std::string text = groups({{0, "LWPOLYLINE"}, {8, layer}, {70, closed}});
        for (int i = 0; i < corners; ++i)
        {
            text += groups({{10, i == 1 || i == 2 ? "1" : "0"}, {20, i > 1 ? "1" : "0"}});
        }
        return text;
    };
    const auto said = [&](const std::string& line)
    {
        const ImportedFile file = fileOf(section("ENTITIES", polyline("stone", "1", 4) + line) + end);
        testing::internal::CaptureStderr();
        drawnBlocks(readDxf(file, {}), {}, file);
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_THAT(said(polyline("stone", "0", 4)), AllOf(HasSubstr("1 lines of three and more corners"),
                                                       HasSubstr("on layer stone"), HasSubstr("line 2")));
    EXPECT_EQ(said(polyline("stone", "0", 2)), ""); // an axis
    EXPECT_EQ(said(polyline("dimensions", "0", 4)), "");
    const ImportedFile vector =
        fileOf("<svg><g id=\"stone\"><rect width=\"1\" height=\"1\"/>\n<path d=\"M0 5h1v1h-1\"/></g></svg>");
    testing::internal::CaptureStderr();
    drawnBlocks(readSvg(vector), {}, vector);
    EXPECT_THAT(testing::internal::GetCapturedStderr(), AllOf(HasSubstr("not closed"), HasSubstr("line 2")));
}

TEST(Drawing, AnOffsetIsInMetres)
{
    Drawing drawing;
    drawing.outlines = {{{{0, -200}, {100, -200}, {0, 0}}, "", 0}};
    DrawingSettings settings;
    settings.scale = 0.01;
    settings.offset = {1, 2};
    EXPECT_TRUE(drawnBlocks(drawing, settings, fileOf("")).blocks[0].outline[1].isApprox(Vector<2>(2, 0)));
}

// An array of inserts without a distance between them drew 9,086 outlines in one place, each pair of which
// was examined for joints.
TEST(Drawing, OutlinesThatAreDrawnMoreThanOnceAreOneBlock)
{
    Drawing drawing;
    drawing.outlines = {{{{0, 0}, {1, 0}, {1, 1}}, "a", 3},
                        {{{1, 1}, {0, 0}, {1, 0}}, "b", 9},
                        {{{0, 0}, {1, 1}, {1, 0}}, "a", 12},
                        {{{1, 0}, {2, 0}, {2, 1}}, "b", 15}};
    testing::internal::CaptureStdout();
    const Assembly<2> assembly = drawnBlocks(drawing, {}, fileOf(""));
    EXPECT_THAT(testing::internal::GetCapturedStdout(),
                HasSubstr("left out 2 outlines that are drawn more than once, the first in line 9"));
    EXPECT_EQ(assembly.blocks.size(), 2u);
    ASSERT_EQ(assembly.zones.size(), 2u);
    EXPECT_THAT(assembly.zones[0].blocks, testing::ElementsAre(0));
    EXPECT_THAT(assembly.zones[1].blocks, testing::ElementsAre(1));
}

TEST(Drawing, CornersThatAreWrittenTwiceAreOneAndOrientationDoesNotMatter)
{
    Drawing drawing;
    drawing.outlines = {{{{0, 0}, {0, 1}, {1, 1}, {1, 1}, {1, 0}, {0, 0}}, "Layer 1", 0}};
    const Assembly<2> assembly = drawnBlocks(drawing, {}, fileOf(""));
    EXPECT_EQ(assembly.blocks[0].outline.size(), 4u);
    EXPECT_DOUBLE_EQ(areaProperties(assembly.blocks[0].outline).area, 1);
    EXPECT_EQ(assembly.zones[0].name, "Layer_1");
}

// Of a wall at an angle, in inches, half of the joints were none: metres have other last digits.
TEST(Drawing, DigitsOfTheFileSayHowNearFacesAreJoints)
{
    Drawing drawing;
    drawing.outlines = {{{{0, 0}, {38.3, 11.7}, {35.1, 22.4}, {-3.2, 10.7}}, "", 0}};
    drawing.rounding = 0.1;
    const auto tolerance = [&](double unit)
    {
        drawing.unit = unit;
        return drawnBlocks(drawing, {}, fileOf("")).jointTolerance.value_or(0);
    };
    EXPECT_EQ(tolerance(1), 0) << "found from the coordinates, as before";
    const double coarsest = 1e-3 * meanBlockSize(drawnBlocks(drawing, {}, fileOf("")));
    EXPECT_DOUBLE_EQ(tolerance(0.0254), 0.0254 * coarsest);
    drawing.rounding = 0.001;
    EXPECT_DOUBLE_EQ(tolerance(0.0254), 1.5 * 0.0254 * 0.001);
    DrawingSettings settings;
    settings.tolerance = 1e-5;
    EXPECT_EQ(drawnBlocks(drawing, settings, fileOf("")).jointTolerance, 1e-5);
    drawing.outlines = {{{{0, 0}, {38.3, 0}, {38.3, 11.7}, {0, 11.7}}, "", 0}};
    EXPECT_EQ(tolerance(0.0254), 0) << "edges along the axes stay on common lines";
}

TEST(Drawing, DigitsAreScaledAsTheOutlinesAre)
{
    const std::string insert = groups({{0, "INSERT"}, {2, "b"}, {41, "3"}, {42, "-3"}, {50, "90"}});
    const std::string triangle =
        triangleBlock("b", "0.0", {{{"0.0", "0.0"}, {"1.5", "0.5"}, {"0.0", "2.5"}}});
    EXPECT_NEAR(read(section("BLOCKS", triangle) + section("ENTITIES", insert) + end).rounding, 0.3, 1e-15);
    EXPECT_NEAR(
        readVector("<g transform=\"scale(4)\"><polygon points=\"0.0 0.0 1.5 0.5 0.0 2.5\"/></g>").rounding,
        0.4, 1e-15);
}

} // namespace
