// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A legend of values instead of their combinations.
#include "io/PlotKey.h"

#include <gtest/gtest.h>

using namespace drystone;

namespace
{

struct Crowd
{
    std::vector<PlotCurve> curves;
    std::vector<std::vector<std::string>> words;
};

Crowd crowd(int solvers, int rules, int thetas, int tolerances)
{
    Crowd made;
    for (int i = 0; i < solvers * rules * thetas * tolerances; ++i)
    {
        made.curves.push_back(
            {"curve " + std::to_string(i), {1, 2}, {3, 4}, CurveLine::solid, CurveMarker::automatic, ""});
        made.words.push_back({"theta " + std::to_string(i % thetas),
                              "rule " + std::to_string(i / thetas % rules),
                              "solver " + std::to_string(i / thetas / rules % solvers),
                              "tolerance " + std::to_string(i / thetas / rules / solvers)});
    }
    return made;
}

TEST(PlotKey, TwentyFourCurvesHaveNineNames)
{
    Crowd made = crowd(3, 2, 2, 2);
    ASSERT_TRUE(lookBySettings(made.curves, made.words));
    ASSERT_EQ(made.curves.size(), 24u + 3 + 2 + 4);
    for (std::size_t i = 0; i < 24; ++i)
    {
        EXPECT_TRUE(made.curves[i].name.empty());
        for (std::size_t k = 0; k < i; ++k) // no two look the same
        {
            EXPECT_FALSE(made.curves[i].colour == made.curves[k].colour
                         && made.curves[i].line == made.curves[k].line
                         && made.curves[i].marker == made.curves[k].marker);
        }
    }
    EXPECT_EQ(made.curves[24].name, "solver 0");
    EXPECT_EQ(made.curves[24].colour, made.curves[0].colour);
    EXPECT_EQ(made.curves[27].name, "tolerance 0");
    EXPECT_EQ(made.curves[29].name, "theta 0, rule 0");
    EXPECT_EQ(made.curves[29].line, CurveLine::none);
    Plot plot;
    plot.curves = made.curves;
    EXPECT_NE(plotSvg(plot).find("theta 1, rule 1"), std::string::npos);
}

TEST(PlotKey, WhatHasTooManyValuesStaysAsItIs)
{
    Crowd made = crowd(8, 1, 1, 2);
    EXPECT_FALSE(lookBySettings(made.curves, made.words));
    made = crowd(3, 3, 2, 2);
    EXPECT_FALSE(lookBySettings(made.curves, made.words));
    EXPECT_EQ(made.curves.front().name, "curve 0");
    std::vector<PlotCurve> single(1);
    EXPECT_FALSE(lookBySettings(single, {{"theta 1"}}));
}

} // namespace
