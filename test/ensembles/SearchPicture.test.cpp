// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the picture of a search shows.
#include "ensembles/SearchPicture.h"

#include <gtest/gtest.h>

using namespace drystone;

namespace
{

ParameterSearchSettings settingsOf(SearchGoal goal)
{
    ParameterSearchSettings settings;
    settings.variables.resize(1);
    settings.variables.front().first = "angle";
    settings.objective.goal = goal;
    settings.objective.value = "alpha";
    return settings;
}

Evaluation at(double variable, double objective, double violation = 0)
{
    Evaluation point;
    point.variables = {variable};
    point.objective = objective;
    point.violation = violation;
    return point;
}

const PlotCurve* curveOf(const Plot& plot, const std::string& name)
{
    for (const PlotCurve& curve : plot.curves)
    {
        if (curve.name == name)
        {
            return &curve;
        }
    }
    return nullptr;
}

TEST(SearchPicture, TheBestPointIsMarked)
{
    const std::vector<Evaluation> points{at(1, 0.5), at(2, 0.3), at(3, 0.4, 0.1)};
    const Plot plot = searchPicture(settingsOf(SearchGoal::minimise), points, points[1]);
    ASSERT_NE(curveOf(plot, "best"), nullptr);
    EXPECT_EQ(curveOf(plot, "best")->x, std::vector<double>{2});
    EXPECT_EQ(curveOf(plot, "best")->y, std::vector<double>{0.3});
    EXPECT_EQ(curveOf(plot, "evaluations")->x, std::vector<double>{1});
    EXPECT_EQ(curveOf(plot, "violate a constraint")->x, std::vector<double>{3});
    EXPECT_EQ(curveOf(plot, "beyond the axis"), nullptr);
    EXPECT_FALSE(plot.y.upper);
}

TEST(SearchPicture, APlateauFarAwayDoesNotFlattenTheRest)
{
    std::vector<Evaluation> points;
    for (int i = 0; i < 10; ++i)
    {
        points.push_back(at(i, 0.3 + 0.01 * i));
        points.push_back(at(10 + i, 1000)); // where a result has no number
    }
    Plot plot = searchPicture(settingsOf(SearchGoal::minimise), points, points[0]);
    ASSERT_TRUE(plot.y.upper);
    EXPECT_LT(*plot.y.upper, 0.5);
    ASSERT_NE(curveOf(plot, "beyond the axis"), nullptr);
    EXPECT_GE(curveOf(plot, "beyond the axis")->x.size(), 10u);
    EXPECT_EQ(curveOf(plot, "beyond the axis")->y.back(), *plot.y.upper);
    // Of a largest value the other way round.
    for (Evaluation& point : points)
    {
        point.objective *= -1;
    }
    plot = searchPicture(settingsOf(SearchGoal::maximise), points, points[0]);
    EXPECT_FALSE(plot.y.upper);
    ASSERT_TRUE(plot.y.lower);
    EXPECT_GT(*plot.y.lower, -0.5);
}

} // namespace
