// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The parts of a report: HTML, tables of input, histories, the data of the viewer.
#include "core/WholeFile.h"
#include "effects/ContactProperties.h"
#include "effects/EffectList.h"
#include "functionObjects/Histories.h"
#include "report/HtmlPage.h"
#include "report/InputTable.h"
#include "report/ViewerData.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unistd.h>

namespace drystone
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

TEST(HtmlPage, EscapesTextAndKeepsMarkup)
{
    HtmlPage page("<wall>");
    page.paragraph("1 < 2");
    page.table({"key", "value"}, {{"a", "<b>"}});
    page.picture("<?xml version=\"1.0\"?>\n<svg/>", "A & B");
    const std::string text = page.text();
    EXPECT_THAT(text, HasSubstr("<title>&lt;wall&gt;</title>"));
    EXPECT_THAT(text, HasSubstr("<p>1 &lt; 2</p>"));
    EXPECT_THAT(text, HasSubstr("<td>&lt;b&gt;</td>"));
    EXPECT_THAT(text, HasSubstr("<figure>\n<svg/>\n<figcaption>A &amp; B</figcaption>"));
    EXPECT_THAT(text, testing::Not(HasSubstr("<?xml")));
}

TEST(HtmlPage, NamesOfOneDrawingAreNotThoseOfAnother)
{
    HtmlPage page("wall");
    for (int i = 0; i < 2; ++i)
    {
        page.picture("<svg><clipPath id=\"view\"/><g clip-path=\"url(#view)\"/></svg>", "");
    }
    EXPECT_THAT(page.text(),
                HasSubstr("<clipPath id=\"picture1-view\"/><g clip-path=\"url(#picture1-view)\"/>"));
    EXPECT_THAT(page.text(),
                HasSubstr("<clipPath id=\"picture2-view\"/><g clip-path=\"url(#picture2-view)\"/>"));
}

TEST(HtmlPage, HoldsAnImageAsText)
{
    HtmlPage page("wall");
    page.image("foobar", "A & B");
    EXPECT_THAT(page.text(), HasSubstr("alt=\"A &amp; B\""));
    EXPECT_THAT(page.text(), HasSubstr("src=\"data:image/png;base64,Zm9vYmFy\""));
}

TEST(InputTable, GivesEachValueItsUnitAndItsMeaning)
{
    const Dictionary dictionary =
        Dictionary::readString("FoamFile { version 2.0; }\nfriction { type Coulomb; mu 0.65; } "
                               "crushing { strength 1e6; } unheardOf (1 2);");
    const auto rows = inputRows(dictionary, describeOptions<CaseEffects<2>>());
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows[0][0], "friction/type");
    EXPECT_THAT(rows[1], ElementsAre("friction/mu", "0.65", "-", "friction coefficient"));
    EXPECT_THAT(rows[2], ElementsAre("crushing/strength", "1e6", "Pa", "of a joint over its area"));
    EXPECT_THAT(rows[3], ElementsAre("unheardOf", "(1 2)", "", ""));
}

class Histories : public testing::Test
{
protected:
    void TearDown() override { std::filesystem::remove(file); }
    NumberTable tableOf(const std::string& text)
    {
        writeWholeFile(file, text);
        return readNumberTable(file);
    }
    std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("drystone-histories-" + std::to_string(::getpid()));
};

TEST_F(Histories, ReadsATableUpToARowThatIsCutOff)
{
    const NumberTable table = tableOf("# Time[s] ux[m] vx[m/s]\n0 1 2\n0.1 nan inf\n0.2 3\n");
    EXPECT_THAT(table.names, ElementsAre("Time", "ux", "vx"));
    EXPECT_THAT(table.units, ElementsAre("s", "m", "m/s"));
    ASSERT_EQ(table.columns[0].size(), 2U);
    EXPECT_TRUE(std::isnan(table.columns[1][1]));
    EXPECT_TRUE(tableOf("no table\n1 2\n").names.empty());
    EXPECT_TRUE(readNumberTable("/nowhere/at/all").names.empty());
}

// One such time ended the whole report.
TEST_F(Histories, RowsWithoutATimeAreLeftOutAndNamed)
{
    const NumberTable table = tableOf("# Time[s] ux[m]\n0 1\nnan 2\n0.2 3\ninf 4\n");
    EXPECT_THAT(table.columns[0], ElementsAre(0, 0.2));
    EXPECT_EQ(table.damagedLine, 3);
    EXPECT_EQ(historyPlots(table, "").size(), 1U);
    EXPECT_EQ(tableOf("# Time[s] ux[m]\nnan 1\n").damagedLine, 2);
    NumberTable other{{"Time", "ux"}, {"s", "m"}, {{0, std::nan("")}, {1, 2}}};
    EXPECT_TRUE(historyPlots(other, "").empty());
    EXPECT_EQ(tableOf("# alpha[-] b[-]\ninf 1\n").damagedLine, 0);
}

TEST_F(Histories, DrawsColumnsOfOneUnitTogetherAndThoseThatAreZeroNot)
{
    const auto plots = historyPlots(
        tableOf("# Time[s] ux[m] uy[m] vx[m/s] wz[rad/s]\n0 0 0 1 0\n1 2 3 1 0\n2 4 3 1 0\n"), "block");
    ASSERT_EQ(plots.size(), 2U);
    EXPECT_EQ(plots[0].second.y.label, "displacement [m]");
    ASSERT_EQ(plots[0].second.curves.size(), 2U);
    EXPECT_THAT(plots[0].second.curves[1].y, ElementsAre(0, 3, 3));
    ASSERT_EQ(plots[1].second.curves.size(), 1U);
    EXPECT_TRUE(historyPlots(tableOf("# alpha[-] x[m]\n1 2\n2 3\n"), "").empty()); // not over time
}

// Each fifth of 10,000 rows was drawn, and the force of an impact was in none.
TEST_F(Histories, DrawsWhatLastsASingleStepOfMany)
{
    constexpr std::size_t rows = 10000;
    NumberTable table{
        {"Time", "force"}, {"s", "N"}, {std::vector<double>(rows), std::vector<double>(rows, 1)}};
    for (std::size_t row = 0; row < rows; ++row)
    {
        table.columns[0][row] = 0.001 * static_cast<double>(row);
    }
    table.columns[1][5003] = 70;
    table.columns[1][7001] = -70;
    const auto plots = historyPlots(table, "");
    ASSERT_EQ(plots.size(), 1U);
    const PlotCurve& curve = plots[0].second.curves[0];
    EXPECT_LE(curve.y.size(), 2002U);
    EXPECT_TRUE(std::is_sorted(curve.x.begin(), curve.x.end()));
    EXPECT_EQ(curve.x.front(), table.columns[0].front());
    EXPECT_EQ(curve.x.back(), table.columns[0].back());
    EXPECT_DOUBLE_EQ(
        curve.x[static_cast<std::size_t>(std::max_element(curve.y.begin(), curve.y.end()) - curve.y.begin())],
        5.003);
    EXPECT_DOUBLE_EQ(
        curve.x[static_cast<std::size_t>(std::min_element(curve.y.begin(), curve.y.end()) - curve.y.begin())],
        7.001);
}

TEST(ViewerData, HoldsBlocksAndFrames)
{
    Assembly<2> plane;
    plane.blocks = {{{{0, 0}, {2, 0}, {2, 1}}, 0.5, -1}, {{{-1, -1}, {3, -1}, {3, 0}, {-1, 0}}, 1, 0}};
    BlockFrame frame{0.25, Eigen::Matrix3Xd::Zero(3, 2), Eigen::Matrix3Xd::Zero(3, 2)};
    frame.displacement(1, 0) = 0.125;
    frame.rotation.col(1).setConstant(std::numeric_limits<double>::quiet_NaN());
    const std::string json = viewerJson(plane, {frame}, {"time", " s", 3});
    EXPECT_THAT(
        json, testing::StartsWith(R"({"dimensions":2,"timeName":"time","timeUnit":" s","magnification":3,)"));
    // Prisms of the thickness about z = 0: corners behind, then in front, faces with those of both.
    EXPECT_THAT(json, HasSubstr(R"("vertices":[-2,-0.5,-0.5,2,-0.5,-0.5,2,0.5,-0.5,-2,0.5,-0.5,)"));
    EXPECT_THAT(json, HasSubstr(R"("faces":[[2,1,0],[3,4,5],[0,1,4,3],[1,2,5,4],[2,0,3,5]])"));
    EXPECT_THAT(json, HasSubstr(R"("fixed":false},)"));
    EXPECT_THAT(
        json,
        HasSubstr(R"({"time":0.25,"displacement":[0,0.125,0,0,0,0],"rotation":[0,0,0,null,null,null]})"));

    Assembly<3> space;
    space.blocks = {{makeBox({0, 0, 0}, {1, 2, 4}), -1}};
    EXPECT_THAT(viewerJson(space, {}, {}), HasSubstr(R"("centre":[0,0,0])"));
}

// With coordinates of a map six digits are metres: all blocks were points and lines.
TEST(ViewerData, IsTheSameWhereverTheStructureStands)
{
    const auto wallAt = [](const Vector<3>& place)
    {
        Assembly<3> wall;
        wall.blocks = {{makeBox(place - Vector<3>(8, 8, 1), place + Vector<3>(8, 8, 0)), 0},
                       {makeBox(place, place + Vector<3>(1, 2, 0.5)), -1},
                       {makeBox(place + Vector<3>(0, 0, 0.5), place + Vector<3>(1, 2, 1)), -1}};
        return viewerJson(wall, {}, {});
    };
    EXPECT_EQ(wallAt({393216, 524288, 128}), wallAt(Vector<3>::Zero()));
    EXPECT_THAT(wallAt(Vector<3>::Zero()), HasSubstr(R"("centre":[0,0,0.25])"));
}

} // namespace
} // namespace drystone
