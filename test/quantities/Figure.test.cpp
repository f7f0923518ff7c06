// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Figures of a run by name: of tables, of collapse, of a motion.
#include "quantities/Figure.h"
#include "core/Error.h"
#include "quantities/Criterion.h"
#include "quantities/LimitAnalysisFigures.h"
#include "quantities/MotionFigures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace drystone;
using testing::HasSubstr;

namespace
{

Figure figureOf(const std::string& text)
{
    return figureTypes().select(Dictionary::readString(text, "dict"));
}

/// A block of 0.5 x 2 m on the ground, in space 1 m wide: 0.5 x 1 x 2 m.
template<int Dim>
Assembly<Dim> blockOnGround()
{
    Assembly<Dim> assembly;
    assembly.supports.push_back({"ground", "ground"});
    if constexpr (Dim == 2)
    {
        assembly.blocks.push_back({{{-5, -1}, {5, -1}, {5, 0}, {-5, 0}}, 1, 0});
        assembly.blocks.push_back({{{0, 0}, {0.5, 0}, {0.5, 2}, {0, 2}}, 1, -1});
    }
    else
    {
        assembly.blocks.resize(2);
        assembly.blocks[0].shape = makeBox({-5, -5, -1}, {5, 5, 0});
        assembly.blocks[0].support = 0;
        assembly.blocks[1].shape = makeBox({0, 0, 0}, {0.5, 1, 2});
    }
    return assembly;
}

/// The value after the block has been at some placements.
template<int Dim>
double valueAfter(const std::string& text, const std::vector<Placement<Dim>>& placements)
{
    DynamicCase<Dim> scene;
    scene.assembly = blockOnGround<Dim>();
    scene.blocks = blockMasses(scene.assembly);
    scene.free = freeIndices(scene.assembly);
    Motion<Dim> motion;
    motion.state = stateAtRest(scene.assembly);
    const auto watch = std::get<WatchMaker<Dim>>(figureOf(text).watch)(scene, motion);
    watch->observe(motion, 0);
    for (const Placement<Dim>& placement : placements)
    {
        motion.state.placements[1] = placement;
        watch->observe(motion, 0.01);
    }
    return watch->value();
}

} // namespace

TEST(Taken, IsOneNumberOfSeveral)
{
    const std::vector<double> values{1, -4, 3};
    EXPECT_EQ(taken(values, Take::first), 1);
    EXPECT_EQ(taken(values, Take::last), 3);
    EXPECT_EQ(taken(values, Take::minimum), -4);
    EXPECT_EQ(taken(values, Take::maximum), 3);
    EXPECT_EQ(taken(values, Take::largest), 4);
    EXPECT_EQ(taken(values, Take::mean), 0);
    EXPECT_TRUE(std::isnan(taken({}, Take::last)));
    EXPECT_TRUE(std::isnan(taken({1, std::nan("")}, Take::maximum)));
}

TEST(Figure, OfAMotionIsTheLargestUnlessAnotherIsTaken)
{
    const std::vector<Placement<2>> way{{{0.3, 0.4}, -0.2}, {{0.1, -0.2}, 0.1}};
    EXPECT_DOUBLE_EQ(valueAfter<2>("type displacement;", way), 0.5);
    EXPECT_DOUBLE_EQ(valueAfter<2>("type displacement; block 1; direction (-2 0 0); take last;", way), -0.1);
    EXPECT_DOUBLE_EQ(valueAfter<2>("type rotation; block 1;", way), 0.2);
    EXPECT_DOUBLE_EQ(valueAfter<2>("type rotation; take last;", way), 0.1);
    EXPECT_DOUBLE_EQ(valueAfter<2>("type drop;", way), 0.2);
    EXPECT_TRUE(std::isnan(valueAfter<2>("type returnTime; block 1;", {way.front()}))); // it leans still
}

TEST(Figure, RefusesBlocksThatAreNotThereOrNeverMove)
{
    EXPECT_THROW(valueAfter<2>("type displacement; block 2;", {}), FatalIOError);
    EXPECT_THROW(valueAfter<2>("type rotation; block 0;", {}), FatalIOError);
    EXPECT_THROW(figureOf("type displacement; direction (1 0 0);"), FatalIOError);
    EXPECT_THROW(valueAfter<2>("type displacement; block 1; direction (0 0 1);", {}), FatalIOError);
    EXPECT_THROW(valueAfter<2>("type displacement; block 1; direction (1 0 1);", {}), FatalIOError);
    EXPECT_THROW(figureOf("type energy; part heat;"), FatalIOError);
}

// In space a turn is known by its angle, from 0 to pi.
TEST(Criterion, InSpaceALimitOfRotationBeyondHalfATurnIsRefused)
{
    const auto limit = [](const char* text)
    { return criterionTypes().select(Dictionary::readString(text, "dict")); };
    EXPECT_DOUBLE_EQ(limit("type rotation; limit 4;")(blockOnGround<2>()).limit, 4);
    EXPECT_DOUBLE_EQ(limit("type rotation; limit 3;")(blockOnGround<3>()).limit, 3);
    EXPECT_THROW(limit("type rotation; limit 4;")(blockOnGround<3>()), FatalIOError);
}

TEST(Figure, OfTheTableOfLimitAnalysisIsKnownWithoutTheTable)
{
    const Figure figure = figureOf("type table; table \"postProcessing/limitAnalysis/0/limitAnalysis.dat\"; "
                                   "column iterations; take first;");
    EXPECT_EQ(figure.ofCollapse, "iterations");
    EXPECT_EQ(figureOf("type multiplier;").ofCollapse, "alpha");
    EXPECT_FALSE(
        figureOf("type table; table \"postProcessing/energy/0/energy.dat\"; column kinetic;").ofCollapse);
    EXPECT_THROW(figureOf("type table; table \"../other.dat\"; column a;"), FatalIOError);
}

TEST(Figure, OfAMotionInSpaceIsWrittenTheSameWay)
{
    // Half a turn about an axis of length 1, then a quarter of a turn about z and a fall by 0.2 m.
    const double quarter = std::numbers::pi / 2;
    const std::vector<Placement<3>> way{{{0.3, 0.4, 1.2}, {2 * quarter, 0, 0}},
                                        {{0.1, -0.2, -0.2}, {0, 0, quarter}}};
    EXPECT_DOUBLE_EQ(valueAfter<3>("type displacement;", way), 1.3);
    EXPECT_DOUBLE_EQ(valueAfter<3>("type displacement; block 1; direction (0 0 3); take last;", way), -0.2);
    EXPECT_DOUBLE_EQ(valueAfter<3>("type rotation; block 1;", way), 2 * quarter);
    EXPECT_DOUBLE_EQ(valueAfter<3>("type rotation; take last;", way), quarter);
    EXPECT_DOUBLE_EQ(valueAfter<3>("type drop;", way), 0.2);
    // The corner (0.25 0.5 1) from the centre, turned by a quarter about z, has moved by (-0.75 -0.25 0).
    EXPECT_DOUBLE_EQ(valueAfter<3>("type motion; take last;", {{{0, 0, 0}, {0, 0, quarter}}}),
                     std::hypot(0.75, 0.25));
    EXPECT_THROW(valueAfter<3>("type returnTime; block 1;", way), FatalIOError);
    EXPECT_THROW(valueAfter<3>("type displacement; block 1; direction (0 0 0);", way), FatalIOError);
    EXPECT_THROW(valueAfter<2>("type displacement; block 1; direction (0 0 1);", {}), FatalIOError);
}

TEST(Figure, WithATableNeedsNoType)
{
    Dictionary dictionary =
        Dictionary::readString("results { a { table t; column c; } b { type multiplier; } }");
    sayTable(dictionary, "results");
    EXPECT_EQ(dictionary.subDict("results").subDict("a").get<std::string>("type"), "table");
    EXPECT_EQ(dictionary.subDict("results").subDict("b").get<std::string>("type"), "multiplier");
}

TEST(LimitAnalysisFigures, AreTheColumnsOfTheTable)
{
    LimitAnalysis result;
    result.status = CollapseStatus::optimal;
    result.alpha = 0.642859123456789;
    const auto figures = limitAnalysisFigures(LimitAnalysisCase<2>(), result, 0.5);
    EXPECT_EQ(figures.front().heading, "alpha[-]");
    EXPECT_EQ(figures.front().text, "0.642859123457");
    EXPECT_EQ(figures.back().text, "0.5");
    EXPECT_EQ(limitAnalysisHeadings().size(), figures.size());
    result.status = CollapseStatus::unstable;
    EXPECT_EQ(limitAnalysisFigures(LimitAnalysisCase<2>(), result, 0).front().text, "nan");
}
