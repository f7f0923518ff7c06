// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/LimitAnalysisTables.h"

#include "io/JointForces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <vector>

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

/// Points of a joint, at places, with the normal along x.
template<int Dim>
std::vector<ContactPoint<Dim>> jointAt(const std::vector<Vector<Dim>>& places)
{
    std::vector<ContactPoint<Dim>> points;
    for (const Vector<Dim>& place : places)
    {
        ContactPoint<Dim> point;
        point.block = 3;
        point.neighbour = 7;
        point.joint = 0;
        point.position = place;
        point.normal = Vector<Dim>::Unit(0);
        points.push_back(point);
    }
    return points;
}

/// The numbers of the only row.
std::vector<double> rowOf(const std::string& text)
{
    std::istringstream table(text);
    std::string line;
    std::getline(table, line);
    std::vector<double> numbers;
    for (double number = 0; table >> number;)
    {
        numbers.push_back(number);
    }
    return numbers;
}

// A block that is glued to a wall by its side: what rounding leaves of the normal force is no lever of the
// moment.
TEST(LimitAnalysisTables, BendingWithoutNormalForceHasNoCentreOfPressure)
{
    const std::vector<ContactPoint<2>> points = jointAt<2>({{1, 2}, {1, 3}});
    for (const double rounding : {0.0, 1e-7, -1e-7})
    {
        const std::vector<Vector<2>> forces{{-1000, 50}, {1000 + rounding, 30}};
        const std::vector<double> row = rowOf(thrustText(points, forces));
        ASSERT_EQ(row.size(), 8U);
        EXPECT_NEAR(row[0], 1, 1e-9);
        EXPECT_NEAR(row[1], 2.5, 1e-9) << rounding;
        EXPECT_NEAR(row[3], 80, 1e-9);
        EXPECT_NEAR(std::abs(row[4]), 1000, 1e-5);
        EXPECT_EQ(row[5], 0) << rounding;
        EXPECT_TRUE(jointForces(points, forces).empty()) << rounding;
    }
}

TEST(LimitAnalysisTables, JointsInSpaceThatPullOrShearAloneAreListed)
{
    const std::vector<ContactPoint<3>> points = jointAt<3>({{1, 0, 0}, {1, 1, 0}, {1, 1, 2}, {1, 0, 2}});
    const std::vector<double> pulled =
        rowOf(thrustText(points, {{-10, 0, 0}, {-10, 0, 0}, {-30, 0, 0}, {-30, 0, 0}}));
    ASSERT_EQ(pulled.size(), 11U);
    EXPECT_NEAR(pulled[1], 0.5, 1e-9);
    EXPECT_NEAR(pulled[2], 1.5, 1e-9);
    EXPECT_NEAR(pulled[3], -80, 1e-9);
    EXPECT_NEAR(pulled[6], -80, 1e-9);
    EXPECT_EQ(pulled[9], 3);
    EXPECT_EQ(pulled[10], 7);
    for (const double rounding : {0.0, 1e-9, -1e-9})
    {
        const std::vector<Vector<3>> forces{{-10, 3, 4}, {-10, 3, 4}, {10 + rounding, 3, 4}, {10, 3, 4}};
        const std::vector<double> sheared = rowOf(thrustText(points, forces));
        ASSERT_EQ(sheared.size(), 11U) << rounding;
        EXPECT_NEAR(sheared[1], 0.5, 1e-9) << rounding;
        EXPECT_NEAR(sheared[2], 1, 1e-9) << rounding;
        EXPECT_NEAR(sheared[7], 20, 1e-8);
        EXPECT_TRUE(jointForces(points, forces).empty()) << rounding;
    }
}

} // namespace
} // namespace drystone
