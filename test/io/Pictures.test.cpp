// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures: well-formed, complete, and an error for what cannot be drawn. With
/// DRYSTONE_KEEP_PICTURES=<folder> in the environment the pictures are kept there for inspection.
#include "Scene.h"
#include "contact/Facing.h"
#include "core/Error.h"
#include "io/Canvas.h"
#include "io/Mechanism.h"
#include "io/MechanismPicture.h"
#include "io/PicturePage.h"
#include "io/Plot.h"
#include "io/SvgText.h"
#include "io/plane/ThrustLine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <cmath>
#include <cstdlib>
#include <limits>

namespace drystone
{

namespace
{

using test::content;
using test::ScratchFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// The root element when the text is well-formed XML (read by expat), or nothing.
vtkSmartPointer<vtkXMLDataElement> parsed(const std::string& text)
{
    return vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromString(text.c_str()));
}

std::size_t count(const std::string& text, const std::string& what)
{
    std::size_t result = 0;
    for (auto at = text.find(what); at != text.npos; at = text.find(what, at + what.size()))
    {
        ++result;
    }
    return result;
}

void keep(const std::string& name, const std::string& text)
{
    if (const char* folder = std::getenv("DRYSTONE_KEEP_PICTURES"))
    {
        std::ofstream(std::filesystem::path(folder) / name) << text;
    }
}

TEST(Canvas, TextsFitTheirRoom)
{
    EXPECT_EQ(fittedText("short", 14, 100).size, 14);
    EXPECT_EQ(fittedText("", 14, 100).content, "");
    const std::string label(20, 'x');
    const FittedText smaller = fittedText(label, 14, 120);
    EXPECT_EQ(smaller.content, label);
    EXPECT_LT(smaller.size, 14);
    EXPECT_LE(textWidth(smaller.content, smaller.size), 120 * (1 + 1e-9));
    std::string text;
    for (int i = 0; i < 100; ++i)
    {
        text += "\xc3\xbc";
    }
    for (double room = 40; room < 60; ++room)
    {
        const FittedText cut = fittedText(text, 14, room);
        EXPECT_LE(textWidth(cut.content, cut.size), room);
        EXPECT_EQ(cut.content.size() % 2, 1U); // whole characters and the three points
        EXPECT_TRUE(cut.content.ends_with("..."));
    }
}

TEST(Svg, IsWellFormedWhateverTheTextSays)
{
    Canvas drawing(100, 50);
    drawing.text({10, 10}, "a < b && \"c\" > d\x01", {});
    drawing.text({10, 30}, "10⁻³ µm", {});
    ASSERT_TRUE(parsed(svgText(drawing)));
    EXPECT_THAT(svgText(drawing), HasSubstr("a &lt; b &amp;&amp; &quot;c&quot; &gt; d</text>"));
    testing::internal::CaptureStderr();
    EXPECT_FALSE(parsed("<svg><g></svg>")); // the check can fail
    testing::internal::GetCapturedStderr();
}

TEST(Svg, RefusesCoordinatesThatAreNotFinite)
{
    Canvas drawing(100, 50);
    EXPECT_THROW(drawing.line({0, 0}, {std::numeric_limits<double>::quiet_NaN(), 1}, {}), FatalError);
    EXPECT_THROW(drawing.circle({0, 0}, std::numeric_limits<double>::infinity(), {}), FatalError);
}

TEST(MechanismPicture, ShowsEveryFreeBlockTheBuiltOutlineAndTheGround)
{
    const Assembly<2> wall = test::wall(5, 6);
    const auto placements = mechanismPlacements(wall, test::turningRates(wall, 2), 0.5 * meanBlockSize(wall));
    const std::string svg = mechanismSvg(
        wall, placements, {"masonryPanels/wall1", "alpha = 0.642859, 33 blocks, 174 contact points"});
    keep("wall.svg", svg);
    ASSERT_TRUE(parsed(svg));
    std::size_t freeBlocks = 0;
    for (const Block<2>& block : wall.blocks)
    {
        freeBlocks += block.support < 0 ? 1 : 0;
    }
    EXPECT_EQ(count(svg, "<polygon"), wall.blocks.size());
    EXPECT_EQ(count(svg, "url(#fixed)"), wall.blocks.size() - freeBlocks);
    EXPECT_THAT(svg, HasSubstr("alpha = 0.642859"));
    // The outline as built consists of the four sides, in pieces of one block each, and none of the joints
    // within: 6 blocks below (two are halves), 5 above, 6 on either side; and one stroke in the legend.
    EXPECT_EQ(count(svg, "stroke-dasharray=\"5 4\""), 6u + 5u + 2 * 6u + 1u);
}

TEST(MechanismPicture, HasAScaleBarTheLoadAndItsMotion)
{
    EXPECT_DOUBLE_EQ(roundLength(0.99), 0.5);
    EXPECT_DOUBLE_EQ(roundLength(1), 1);
    EXPECT_DOUBLE_EQ(roundLength(4.9), 2);
    EXPECT_DOUBLE_EQ(roundLength(0.05), 0.05);
    const Assembly<2> wall = test::wall(5, 6);
    MechanismPicture picture;
    picture.load = {{0, -3, 0}, "live load 24.6 kN"};
    picture.motion = "moved by up to 0.1 m in this picture";
    const std::string svg = mechanismSvg(wall, std::vector<Placement<2>>(wall.blocks.size()), picture);
    keep("notes.svg", svg);
    ASSERT_TRUE(parsed(svg));
    EXPECT_THAT(svg, HasSubstr(">0.2 m</text>"));
    EXPECT_THAT(svg, HasSubstr("live load 24.6 kN"));
    EXPECT_THAT(svg, HasSubstr("moved by up to 0.1 m"));
    // The arrow points downwards: its shaft is a line of one x, from above.
    double x1 = 0;
    double y1 = 0;
    double x2 = 1;
    double y2 = 0;
    for (std::size_t at = svg.find("<line"); at != std::string::npos; at = svg.find("<line", at + 1))
    {
        const std::string element = svg.substr(at, svg.find("/>", at) - at);
        if (element.find("#b3261e") != std::string::npos)
        {
            ASSERT_EQ(std::sscanf(element.c_str(), "<line x1=\"%lf\" y1=\"%lf\" x2=\"%lf\" y2=\"%lf\"", &x1,
                                  &y1, &x2, &y2),
                      4);
        }
    }
    EXPECT_EQ(x1, x2);
    EXPECT_GT(y2, y1);
}

/// The shafts of load arrows: from x, y of the tail to that of the tip, the legend's last.
std::vector<Vector<4>> loadShafts(const std::string& svg)
{
    std::vector<Vector<4>> shafts;
    for (std::size_t at = svg.find("<line"); at != std::string::npos; at = svg.find("<line", at + 1))
    {
        const std::string element = svg.substr(at, svg.find("/>", at) - at);
        Vector<4> line;
        if (element.find("#b3261e") != std::string::npos
            && std::sscanf(element.c_str(), "<line x1=\"%lf\" y1=\"%lf\" x2=\"%lf\" y2=\"%lf\"", &line[0],
                           &line[1], &line[2], &line[3])
                   == 4)
        {
            shafts.push_back(line);
        }
    }
    return shafts;
}

TEST(MechanismPicture, DrawsALoadAtItsPlaceOnTheMovedBlock)
{
    // A block of 1 m that moves by 0.5 m to the right: a load on the middle of its top goes with it.
    Assembly<2> assembly;
    assembly.blocks.push_back({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1, -1});
    assembly.blocks.push_back({{{4, 0}, {5, 0}, {5, 1}, {4, 1}}, 1, -1});
    MechanismPicture picture;
    picture.load = {{0, -1, 0}, "live load"};
    picture.loadPlaces = {{{0.5, 1, 0}, 0, 1}, {{4.5, 1, 0}, 1, 0.5}};
    const auto tips = [&](const std::vector<Placement<2>>& placements)
    {
        const std::string svg = mechanismSvg(assembly, placements, picture);
        EXPECT_TRUE(parsed(svg));
        return loadShafts(svg);
    };
    const auto built = tips({{{0, 0}, 0}, {{0, 0}, 0}});
    const auto moved = tips({{{0.5, 0}, 0}, {{0, 0}, 0}});
    ASSERT_EQ(built.size(), 3u); // and that of the legend
    ASSERT_EQ(moved.size(), 3u);
    const double metre = (built[1][0] - built[0][0]) / 4;
    EXPECT_GT(metre, 10);
    EXPECT_NEAR(moved[1][0] - moved[0][0], 3.5 * metre,
                0.2 * metre); // the page may be as wide as before or not
    EXPECT_GT(built[0][3] - built[0][1], 1.4 * (built[1][3] - built[1][1])); // half the axle, a shorter arrow
    EXPECT_EQ(built[0][0], built[0][2]);
}

/// Expects `arrows` arrows of the load in the drawing area, whole.
void expectWholeArrows(const std::string& svg, std::size_t arrows)
{
    Vector<2> corner;
    Vector<2> room;
    const std::size_t clip = svg.find("<clipPath id=\"view\">");
    ASSERT_NE(clip, std::string::npos);
    ASSERT_EQ(std::sscanf(svg.c_str() + clip,
                          "<clipPath id=\"view\"><rect x=\"%lf\" y=\"%lf\" width=\"%lf\" height=\"%lf\"",
                          &corner[0], &corner[1], &room[0], &room[1]),
              4);
    const std::vector<Vector<4>> shafts = loadShafts(svg);
    ASSERT_EQ(shafts.size(), arrows + 1);
    for (std::size_t i = 0; i < arrows; ++i)
    {
        for (const Vector<2>& end : {Vector<2>(shafts[i].head<2>()), Vector<2>(shafts[i].tail<2>())})
        {
            EXPECT_TRUE((end.array() >= corner.array()).all()) << end.transpose();
            EXPECT_TRUE((end.array() <= (corner + room).array()).all()) << end.transpose();
        }
    }
}

TEST(MechanismPicture, HasRoomForArrowsOfLoadsOnItsEdges)
{
    // Many small blocks, so that the arrows reach far beyond the usual margin, with loads on the outermost.
    Assembly<2> plane;
    Assembly<3> space;
    for (const double x : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0})
    {
        plane.blocks.push_back({{{x, 0}, {x + 1, 0}, {x + 1, 0.5}, {x, 0.5}}, 1, -1});
        space.blocks.push_back({makeBox({x, 0, 0}, {x + 1, 1, 0.5}), -1});
    }
    const std::vector<Placement<2>> rest(plane.blocks.size());
    const std::vector<Placement<3>> restInSpace(space.blocks.size());
    MechanismPicture picture;
    for (const Vector<3>& direction :
         {Vector<3>(0, -1, 0), Vector<3>(0, 1, 0), Vector<3>(1, 0, 0), Vector<3>(-1, 0, 0)})
    {
        picture.load = {direction, "live load"};
        picture.loadPlaces = {{{0, 0, 0}, 0, 1}, {{14, 0.5, 0}, 13, 0.5}, {{6.5, 0.5, 0}, 6, 1}};
        expectWholeArrows(mechanismSvg(plane, rest, picture), 3);
    }
    for (const Vector<3>& direction : {Vector<3>(0, 0, -1), Vector<3>(0, 0, 1), Vector<3>(1, 0, 0),
                                       Vector<3>(-1, 0, 0), Vector<3>(0, 1, 0)})
    {
        picture.load = {direction, "live load"};
        picture.loadPlaces = {{{0, 0, 0}, 0, 1}, {{14, 1, 0.5}, 13, 0.5}, {{6.5, 1, 0.5}, 6, 1}};
        expectWholeArrows(mechanismSvg(space, restInSpace, picture), 3);
    }
}

TEST(MechanismPicture, DrawsASupportThatSinksWhereItIs)
{
    Assembly<2> assembly;
    assembly.supports.push_back({"pad", "blocks"});
    assembly.blocks.push_back({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1, -1});
    assembly.blocks.push_back({{{0, -0.5}, {1, -0.5}, {1, 0}, {0, 0}}, 1, 0});
    const Vector<2> down(0, -0.2);
    const std::string svg = mechanismSvg(assembly, {{down, 0}, {down, 0}}, {});
    keep("sinking.svg", svg);
    ASSERT_TRUE(parsed(svg));
    // Lowest and highest y of the polygons with a style, downwards.
    const auto rangeOf = [&](const std::string& style)
    {
        const std::size_t end = svg.find(style);
        const std::size_t begin = svg.rfind("points=\"", end);
        std::istringstream points(svg.substr(begin + 8, end - begin));
        Vector<2> range(HUGE_VAL, -HUGE_VAL);
        double x = 0, y = 0;
        for (char comma = 0; points >> x >> comma >> y;)
        {
            range = {std::min(range[0], y), std::max(range[1], y)};
        }
        return range;
    };
    const Vector<2> pad = rangeOf("url(#fixed)");
    const Vector<2> block = rangeOf("stroke=\"#3b2a22\"");
    EXPECT_GT(block[1] - block[0], 50);
    EXPECT_NEAR(pad[0], block[1], 0.011); // the block still stands on it
    const Vector<2> built = rangeOf("stroke-dasharray=\"5 4\"");
    EXPECT_NEAR(built[0], pad[0] - 0.2 * (block[1] - block[0]), 0.03);
}

TEST(MechanismPicture, OfALargeWallIsAreasWithoutJointsBelowAMegabyte)
{
    const Assembly<2> wall = test::wall(160, 160);
    std::vector<Placement<2>> placements(wall.blocks.size());
    for (std::size_t i = 0; i < placements.size(); ++i)
    {
        placements[i].translation.x() = wall.blocks[i].support < 0 ? 1e-3 * static_cast<double>(i % 1000) : 0;
    }
    const std::string svg = mechanismSvg(wall, placements, {});
    ASSERT_TRUE(parsed(svg));
    EXPECT_LT(svg.size(), 1000000U);
    EXPECT_EQ(count(svg, "stroke=\"#3b2a22\""), 1U); // of the legend
    EXPECT_EQ(count(svg, "z"), 25680U + count(svg, "font-size"));
}

TEST(Svg, ManyPolygonsAreOneElementWithTheirCorners)
{
    Canvas drawing(100, 50);
    drawing.polygons({{{10, 20}, {14, 20}, {14, 18.26}, {10, 18.26}}, {{-1, 0}, {0.04, 0}, {0.04, -0.06}}},
                     {});
    EXPECT_THAT(svgText(drawing), HasSubstr("d=\"M10 20l4 0 0-1.7-4 0zM-1 0l1 0 0-0.1z\""));
    drawing.lines({{{1, 2}, {3, 1}}}, {});
    EXPECT_THAT(svgText(drawing), HasSubstr("d=\"M1 2l2-1\""));
    EXPECT_THROW(drawing.lines({{{1, 2}, {std::numeric_limits<double>::quiet_NaN(), 1}}}, {}), FatalError);
}

TEST(MechanismPicture, OfAStructureAtRestHasNoLegendOfMotion)
{
    const Assembly<2> wall = test::wall(5, 6);
    const std::string svg = mechanismSvg(wall, std::vector<Placement<2>>(wall.blocks.size()), {});
    ASSERT_TRUE(parsed(svg));
    EXPECT_THAT(svg, Not(HasSubstr("moves most")));
}

TEST(MechanismPicture, OfNothingIsStillAPicture)
{
    ASSERT_TRUE(parsed(mechanismSvg(Assembly<2>{}, {}, {.title = "empty"})));
}

TEST(MechanismPicture, DrawsAnArchWithItsThrust)
{
    // Voussoirs between radii 0.925 and 1.075, each hinging a little further.
    Assembly<2> arch;
    arch.supports.push_back({"springers", "blocks"});
    std::vector<Placement<2>> placements;
    std::vector<JointForce<2>> thrust;
    constexpr int voussoirs = 27;
    const double pi = std::acos(-1.0);
    const auto at = [&](double radius, double part)
    { return Vector<2>(-radius * std::cos(pi * part), radius * std::sin(pi * part)); };
    for (int i = -1; i <= voussoirs; ++i)
    {
        const double from = static_cast<double>(i) / voussoirs;
        const double to = static_cast<double>(i + 1) / voussoirs;
        const bool isFree = i >= 0 && i < voussoirs;
        arch.blocks.push_back(
            {{at(0.925, from), at(0.925, to), at(1.075, to), at(1.075, from)}, 1, isFree ? -1 : 0});
        std::swap(arch.blocks.back().outline[1], arch.blocks.back().outline[3]); // counter-clockwise
        placements.push_back(
            {isFree ? Vector<2>(0.05 * std::sin(pi * from), -0.05 * std::sin(pi * from)) : Vector<2>(0, 0),
             0});
        if (i >= 0)
        {
            thrust.push_back({at(0.98 + 0.05 * std::cos(4 * pi * from), from),
                              Vector<2>(0.3, 0.5 - from).normalized() * (0.5 + std::abs(0.5 - from)), i,
                              i + 1});
        }
    }
    MechanismPicture picture{.title = "arch", .subtitle = "P/W = 0.22696"};
    picture.thrust = thrust;
    const std::string svg = mechanismSvg(arch, placements, picture);
    keep("arch.svg", svg);
    ASSERT_TRUE(parsed(svg));
    // A line through each voussoir, an arrow of two parts at each springer, two lines in the legend.
    EXPECT_EQ(count(svg, "#1b4f8f"), voussoirs + 2 * 2 + 2);
    EXPECT_THAT(svg, HasSubstr("line of thrust"));
}

TEST(ThrustLine, RunsThroughAColumnAndGathersWithinAWall)
{
    // Ground 0, column 1 2 3: a chain of centres without a gap, from the ground up; the top block has one
    // joint only.
    const std::vector<JointForce<2>> column{
        {{0.1, 0}, {0, 30}, 1, 0}, {{0.2, 1}, {0, 20}, 2, 1}, {{0.3, 2}, {0, 10}, 3, 2}};
    const auto chain = thrustSegments(column, {false, true, true, true});
    ASSERT_EQ(chain.size(), 3U);
    EXPECT_EQ(chain[0].from, Vector<2>(0.1, 0));
    EXPECT_EQ(chain[0].to, Vector<2>(0.2, 1));
    EXPECT_EQ(chain[0].force, 30);
    EXPECT_EQ(chain[1].to, Vector<2>(0.3, 2));
    EXPECT_EQ(chain[2].from, chain[2].to);

    // One block on two, equally loaded from above by one joint: its lines meet at the weighted mean.
    const std::vector<JointForce<2>> wall{
        {{0, 0}, {0, 1}, 2, 0}, {{1, 0}, {0, 1}, 2, 1}, {{0.5, 1}, {0, -2}, 2, 3}};
    const auto star = thrustSegments(wall, {false, false, true, false});
    ASSERT_EQ(star.size(), 3U);
    for (const ThrustSegment& segment : star)
    {
        EXPECT_EQ(segment.to, Vector<2>(0.5, 0.5));
    }
    EXPECT_TRUE(thrustSegments({}, {true}).empty());
}

TEST(MechanismPicture, IsWrittenWholeOrRefused)
{
    const ScratchFolder folder;
    const Assembly<2> wall = test::wall(2, 2);
    std::vector<Placement<2>> placements(wall.blocks.size());
    writeMechanismPicture(folder / "deep/mechanism", wall, placements, {.title = "wall"},
                          {PictureFormat::svg});
    EXPECT_TRUE(parsed(content(folder / "deep/mechanism.svg")));
    placements.back().rotation = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(
        writeMechanismPicture(folder / "bad", wall, placements, {.title = "wall"}, {PictureFormat::svg}),
        FatalError);
    EXPECT_FALSE(std::filesystem::exists(folder / "bad.svg"));
    placements.pop_back();
    EXPECT_THROW(mechanismSvg(wall, placements, {}), FatalError);
}

TEST(Plot, TicksOfALinearAxisAreRoundNumbers)
{
    EXPECT_THAT(axisTicks(0, 1, AxisScale::linear),
                ElementsAre(0, 0.2, 0.4, testing::DoubleNear(0.6, 1e-15), 0.8, 1));
    EXPECT_THAT(axisTicks(-3.3, 7.1, AxisScale::linear), ElementsAre(-2, 0, 2, 4, 6));
}

TEST(Plot, TicksOfALogarithmicAxisArePowersOfTen)
{
    const auto is = [](double value) { return testing::DoubleNear(value, 1e-12 * value); };
    EXPECT_THAT(axisTicks(2e-3, 30, AxisScale::logarithmic), ElementsAre(is(1e-2), is(1e-1), is(1), is(10)));
    EXPECT_THAT(axisTicks(3, 60, AxisScale::logarithmic), ElementsAre(is(5), is(10), is(20), is(50)));
    EXPECT_THAT(axisTicks(1e-12, 1e6, AxisScale::logarithmic),
                ElementsAre(is(1e-12), is(1e-10), is(1e-8), is(1e-6), is(1e-4), is(1e-2), is(1), is(1e2),
                            is(1e4), is(1e6)));
}

Plot accuracyPlot()
{
    Plot plot;
    plot.title = "What accuracy costs: free rocking, block 0.5 x 2 m";
    plot.subtitle = "median error of the first period over 20 phases; one core";
    plot.x = {"CPU time [s]", AxisScale::logarithmic, {}, {}};
    plot.y = {"relative error of the period [-]", AxisScale::logarithmic, {}, {}};
    for (const auto& [name, order, factor] :
         {std::tuple{"theta = 1", 1, 2.0}, std::tuple{"theta = 0.5", 2, 5.0},
          std::tuple{"theta = 1, Coulomb", 1, 3.0}})
    {
        PlotCurve curve;
        curve.name = name;
        for (int i = 0; i < 7; ++i)
        {
            const double dt = 0.02 * std::pow(0.5, i);
            curve.x.push_back(0.002 * factor / dt);
            curve.y.push_back(factor * std::pow(dt, order));
        }
        plot.curves.push_back(curve);
    }
    plot.curves[2].line = CurveLine::dashed;
    plot.references.push_back({"0.5 %", ReferenceDirection::horizontal, 0.005});
    return plot;
}

TEST(Plot, DrawsLogarithmicCurvesWithALegend)
{
    const std::string svg = plotSvg(accuracyPlot());
    keep("accuracy.svg", svg);
    ASSERT_TRUE(parsed(svg));
    EXPECT_EQ(count(svg, "<polyline"), 3u);
    EXPECT_THAT(svg, HasSubstr("CPU time [s]</text>"));
    EXPECT_THAT(svg, HasSubstr("theta = 0.5</text>"));
    EXPECT_THAT(svg, HasSubstr("10⁻⁴</text>"));
}

TEST(Plot, EndsAtItsFrame)
{
    Plot plot;
    plot.y.upper = 1;
    plot.y.lower = 0;
    plot.curves = {{"rises", {0, 1, 2}, {0.5, 1, 5}, CurveLine::solid, CurveMarker::circle, ""}};
    const Canvas drawing = drawnPlot(plot);
    const CanvasClip* clip = nullptr;
    const CanvasRectangle* frame = nullptr;
    std::size_t markers = 0;
    bool isInside = false;
    for (const CanvasShape& shape : drawing.shapes)
    {
        if (const auto* rectangle = std::get_if<CanvasRectangle>(&shape);
            rectangle && rectangle->style.fill == "none")
        {
            frame = rectangle;
        }
        if (const auto* begins = std::get_if<CanvasClip>(&shape))
        {
            clip = begins;
            isInside = true;
        }
        isInside = isInside && !std::holds_alternative<CanvasClipEnd>(shape);
        const auto* path = std::get_if<CanvasPath>(&shape);
        if (path && path->kind == CanvasPath::Kind::polyline)
        {
            EXPECT_TRUE(isInside);
        }
        markers += std::holds_alternative<CanvasCircle>(shape) ? 1 : 0;
    }
    ASSERT_NE(frame, nullptr);
    ASSERT_NE(clip, nullptr);
    EXPECT_GE(clip->corner.y(), frame->corner.y() - 1);
    EXPECT_LE(clip->height, frame->height + 2);
    EXPECT_EQ(markers, 2u + 1u); // the third is beyond; one in the legend
}

TEST(Plot, DrawsManyPointsWithoutMarkers)
{
    Plot plot;
    plot.title = "Wall 6 at 1.1 alpha";
    plot.x = {"time [s]", AxisScale::linear, {}, {}};
    plot.y = {"displacement of block 145 [mm]", AxisScale::linear, {}, {}};
    PlotCurve curve{"ux", {}, {}, CurveLine::solid, CurveMarker::automatic, ""};
    for (int i = 0; i <= 500; ++i)
    {
        curve.x.push_back(0.002 * i);
        curve.y.push_back(60 * std::sin(0.01 * i) - 20);
    }
    plot.curves = {curve};
    const std::string svg = plotSvg(plot);
    keep("time.svg", svg);
    ASSERT_TRUE(parsed(svg));
    EXPECT_EQ(count(svg, "<circle"), 0u);
}

TEST(Plot, OfNothingOrOfASinglePointIsStillAPlot)
{
    EXPECT_TRUE(parsed(plotSvg({})));
    Plot plot;
    plot.x.scale = AxisScale::logarithmic;
    plot.curves.push_back({"one", {3}, {5}, CurveLine::solid, CurveMarker::automatic, ""});
    EXPECT_TRUE(parsed(plotSvg(plot)));
    plot.curves[0].y = {0};
    EXPECT_TRUE(parsed(plotSvg(plot)));
}

TEST(Plot, RefusesWhatItCannotShowAndNamesIt)
{
    Plot plot;
    plot.x = {"dt [s]", AxisScale::logarithmic, {}, {}};
    plot.curves.push_back({"theta = 1", {1, 0}, {1, 2}, CurveLine::solid, CurveMarker::automatic, ""});
    const std::string report = reportOf([&] { plotSvg(plot); });
    EXPECT_THAT(report, HasSubstr("Point 1 of the curve 'theta = 1'"));
    EXPECT_THAT(report, HasSubstr("dt [s]"));
    plot.curves[0].x = {1};
    EXPECT_THROW(plotSvg(plot), FatalError);
    plot.curves[0].x = {1, std::numeric_limits<double>::quiet_NaN()};
    EXPECT_THROW(plotSvg(plot), FatalError);
    plot.curves.clear();
    plot.x.lower = 5;
    plot.x.upper = 5;
    EXPECT_THROW(plotSvg(plot), FatalError);
}

} // namespace

} // namespace drystone
