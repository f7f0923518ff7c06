// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/LimitAnalysisTables.h"

#include <gtest/gtest.h>

#include <sstream>

namespace drystone
{
namespace
{

// A joint of 1 m with a hinge point near its end, as crushing adds one: moments are about its middle, which
// is not the mean of its points.
TEST(LimitAnalysisTables, MomentsAreAboutTheMiddleOfTheJoint)
{
    std::vector<ContactPoint<2>> points;
    std::vector<Vector<2>> forces;
    for (const auto& [x, normalForce] : {std::pair(2.0, 10.0), {2.1, 30.0}, {3.0, 60.0}})
    {
        ContactPoint<2> point;
        point.block = 0;
        point.neighbour = 1;
        point.joint = 0;
        point.position = {x, 5};
        point.normal = {0, 1};
        points.push_back(point);
        forces.push_back({normalForce, 1});
    }
    std::istringstream table(thrustText(points, forces));
    std::string titles;
    std::getline(table, titles);
    double x = 0, y = 0, normalForce = 0, shearForce = 0, moment = 0, eccentricity = 0;
    table >> x >> y >> normalForce >> shearForce >> moment >> eccentricity;
    EXPECT_NEAR(x, 2.63, 1e-8);
    EXPECT_NEAR(y, 5, 1e-8);
    EXPECT_NEAR(normalForce, 100, 1e-7);
    EXPECT_NEAR(shearForce, 3, 1e-8);
    EXPECT_NEAR(moment, -10 * 0.5 - 30 * 0.4 + 60 * 0.5, 1e-7);
    EXPECT_NEAR(eccentricity, 0.13, 1e-8);
}

} // namespace
} // namespace drystone
