// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
// Joints in space that crush or hold together: closed forms of the rectangular stress block, walls of the
// plane, and the approach of points to it from above.
#include "SpaceStructures.h"
#include "contact/PointAreas.h"
#include "contact/space/PatchCells.h"
#include "statics/CrushingHinges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace drystone
{
namespace
{

using test::Chance;
using test::exact;
using test::instances;
using test::onGround;
using test::pushed;
using test::Stresses;

std::vector<Strength> strengths(const Stresses& stresses, const std::vector<double>& areas)
{
    std::vector<Strength> result;
    for (const double area : areas)
    {
        result.push_back({stresses.cohesion * area, stresses.tension * area, stresses.crushing * area});
    }
    return result;
}

/// With points where hinges are.
LimitAnalysis withHinges(const Assembly<3>& assembly, double mu, const LoadVectors& loads,
                         const Stresses& stresses)
{
    JointPoints<3> joints;
    joints.patches = patchCells(findContactPoints(assembly));
    joints.points = pointsOf(joints.patches);
    joints.friction.assign(joints.points.size(), mu);
    joints.strength = strengths(stresses, areasOf(joints.patches));
    for (int round = 0; round < 30; ++round)
    {
        SpaceConeProgram program = test::programOf(assembly, joints.points, mu, loads);
        program.strength = joints.strength;
        const LimitAnalysis result = solveLimitAnalysis(program);
        if (result.status != CollapseStatus::optimal
            || !addCrushingHinges(joints, {result.contactForce}, 1e-8))
        {
            return result;
        }
    }
    return {};
}

/// With a grid of points.
double withGrid(const Assembly<3>& assembly, double mu, const LoadVectors& loads, const Stresses& stresses,
                int perSide)
{
    std::vector<PatchCells> patches = patchCells(findContactPoints(assembly));
    for (PatchCells& patch : patches)
    {
        cutIntoGrid(patch, perSide);
    }
    SpaceConeProgram program = test::programOf(assembly, pointsOf(patches), mu, loads);
    program.strength = strengths(stresses, areasOf(patches));
    const LimitAnalysis result = solveLimitAnalysis(program);
    return result.status == CollapseStatus::optimal ? result.alpha : std::numeric_limits<double>::quiet_NaN();
}

Vector<3> directionAt(double angle)
{
    return {std::cos(angle), std::sin(angle), 0};
}

TEST(CrushingInSpace, ABoxTurnsAboutTheMiddleOfItsRectangularStressBlock)
{
    Chance chance(31);
    for (int i = 0; i < instances; ++i)
    {
        const double a = chance(0.1, 1);
        const double b = chance(0.1, 1);
        const double h = chance(0.5, 2);
        const double weight = 8 * a * b * h;
        const Stresses stresses{0, i % 2 == 0 ? 0 : chance(0, h),
                                weight / (4 * a * b) * std::exp(chance(0.1, 7))};
        // P acts in the middle of a zone of the depth u along x.
        const double tension = stresses.tension * 4 * a * b;
        const double resultant = weight + tension;
        const double depth = 2 * a * resultant / (stresses.crushing * 4 * a * b + tension);
        const double expected = resultant * (a - depth / 2) / (weight * h);
        const double mu = 100;
        const Assembly<3> assembly = onGround({makeBox({-a, -b, 0}, {a, b, 2 * h})});
        Stresses withCohesion = stresses;
        withCohesion.cohesion = mu * stresses.tension;
        const LimitAnalysis result = withHinges(assembly, mu, pushed(assembly, {1, 0, 0}), withCohesion);
        ASSERT_EQ(result.status, CollapseStatus::optimal) << "instance " << i;
        EXPECT_NEAR(result.alpha, expected, exact) << "instance " << i;
    }
}

TEST(CrushingInSpace, ABoxPushedAskewCrushesATriangleAtItsCorner)
{
    Chance chance(32);
    int triangles = 0;
    for (int i = 0; i < instances; ++i)
    {
        const double a = chance(0.1, 1);
        const double b = chance(0.1, 1);
        const double h = chance(0.5, 2);
        const double angle = i == 0 ? std::numbers::pi / 4 : std::atan2(b, a) + chance(-0.2, 0.2);
        const double pressure = 2 * h; // of the weight over the base
        const double crushing = pressure * std::exp(chance(1.5, 7));
        // A triangle with the legs p and q along the sides, p q/2 = W/s, has its centroid at (a - p/3, b -
        // q/3), which is t (cos, sin): 9 (a - t cos)(b - t sin) = 2 W/s.
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        const double zone = 4 * a * b * pressure / crushing;
        const double half = (a * s + b * c) / 2;
        const double t = (half - std::sqrt(half * half - s * c * (a * b - 2 * zone / 9))) / (s * c);
        if (!(3 * (a - t * c) < 2 * a && 3 * (b - t * s) < 2 * b))
        {
            continue; // a trapezoid
        }
        ++triangles;
        const Assembly<3> assembly = onGround({makeBox({-a, -b, 0}, {a, b, 2 * h})});
        const LimitAnalysis result =
            withHinges(assembly, 100, pushed(assembly, directionAt(angle)), {0, 0, crushing});
        ASSERT_EQ(result.status, CollapseStatus::optimal) << "instance " << i;
        EXPECT_NEAR(result.alpha, t / h, exact) << "instance " << i;
    }
    EXPECT_GE(triangles, 60);
}

TEST(CrushingInSpace, GridsOfPointsApproachTheStressBlockFromAbove)
{
    Chance chance(33);
    for (int i = 0; i < instances; ++i)
    {
        // The last ones concave.
        const int sides = 3 + i % 5;
        std::vector<Vector<2>> outline;
        for (int k = 0; k < sides; ++k)
        {
            const double angle = 2 * std::numbers::pi * (k + chance(-0.2, 0.2)) / sides;
            outline.emplace_back(chance(0.3, 0.5) * std::cos(angle), 0.4 * std::sin(angle));
        }
        if (i % 5 == 4)
        {
            outline = {{0, 0},  {0.8, 0}, {0.8, chance(0.1, 0.4)}, {0.3, 0.4}, {chance(0.1, 0.3), 0.9},
                       {0, 0.9}};
        }
        const Assembly<3> assembly = onGround({test::prism(outline, 0, 1)});
        const LoadVectors loads = pushed(assembly, directionAt(chance(0, 6)));
        const Stresses stresses{0, 0, std::exp(chance(0.7, 4))};
        const LimitAnalysis result = withHinges(assembly, 1, loads, stresses);
        const double coarse = withGrid(assembly, 1, loads, stresses, 3);
        const double fine = withGrid(assembly, 1, loads, stresses, 5);
        const double finer = withGrid(assembly, 1, loads, stresses, 9);
        ASSERT_EQ(result.status, CollapseStatus::optimal) << "instance " << i;
        EXPECT_GE(coarse, fine - exact) << "instance " << i;
        EXPECT_GE(fine, finer - exact) << "instance " << i;
        EXPECT_GE(finer, result.alpha - exact) << "instance " << i;
        // s d2/(8 P) of the arm, d the size of a cell of some 0.1 m, over the height of the centroid.
        EXPECT_LE(finer, result.alpha + stresses.crushing * 0.15 * 0.15 / 8 / 0.5) << "instance " << i;
    }
}

TEST(CrushingInSpace, AnExtrudedWallEqualsThePlaneWallWhateverItsThickness)
{
    Chance chance(34);
    for (int i = 0; i < 20; ++i)
    {
        RunningBond bond;
        bond.unit = {chance(0.2, 0.6), chance(0.1, 0.3)};
        bond.length = 2 + i % 2;
        bond.courses = 2 + i % 4;
        const Assembly<2> wall = test::wallOnGround(bond);
        const double mu = chance(0.3, 0.9);
        const double thickness = chance(0.1, 1);
        const double crushing = bond.courses * bond.unit.y() * std::exp(chance(1, 4));
        const std::vector<double> masses = test::unitMasses(wall);
        JointPoints<2> joints;
        joints.points = findContactPoints(wall);
        joints.friction.assign(joints.points.size(), mu);
        for (const double area : pointAreas(wall, joints.points))
        {
            joints.strength.push_back({.crushing = crushing * area});
        }
        LimitAnalysis plane;
        for (bool isAdded = true; isAdded;)
        {
            PlaneConeProgram program = limitAnalysisProgram(
                static_cast<int>(wall.blocks.size()) - 1,
                equilibriumColumns(wall, blockMasses(wall), joints.points),
                std::vector<double>(joints.points.size(), mu),
                {gravityLoad(wall, masses, {0, -1}), inertialLoad(wall, masses, {0, -1}, {1, 0})});
            program.strength = joints.strength;
            plane = solveLimitAnalysis(program);
            ASSERT_EQ(plane.status, CollapseStatus::optimal) << "instance " << i;
            isAdded = addCrushingHinges(joints, {plane.contactForce}, 1e-8);
        }
        const Assembly<3> extruded = test::extruded(wall, thickness);
        const LimitAnalysis space = withHinges(extruded, mu, pushed(extruded, {1, 0, 0}), {0, 0, crushing});
        ASSERT_EQ(space.status, CollapseStatus::optimal) << "instance " << i;
        EXPECT_NEAR(space.alpha, plane.alpha, exact) << "instance " << i;
    }
}

// Twisting a joint that has cohesion: the corners carry it farther from the axis than the face does.
TEST(StrengthInSpace, TorsionOfACohesionIsTooLargeAtTheCornersAndConvergesWithTheGrid)
{
    // c times the integral of r over a square of the side 2 a is c (2 a)3 (sqrt 2 + log(1 + sqrt 2))/6.
    const double a = 0.5;
    const Assembly<3> assembly = onGround({makeBox({-a, -a, 0}, {a, a, 0.1})});
    LoadVectors loads = pushed(assembly, {1, 0, 0});
    loads.live.setZero();
    loads.live[5] = 1;
    const double cohesion = 1;
    const double expected =
        cohesion * std::pow(2 * a, 3) * (std::sqrt(2.0) + std::log(1 + std::sqrt(2.0))) / 6;
    double before = 0;
    for (const int perSide : {2, 3, 5, 9, 17})
    {
        const double error = withGrid(assembly, 0, loads, {cohesion, 0}, perSide) - expected;
        if (perSide == 2)
        {
            // All at the corners: c A r
            EXPECT_NEAR(error, cohesion * 4 * a * a * a * std::sqrt(2.0) - expected, exact);
        }
        else
        {
            EXPECT_GT(error, 0);
            EXPECT_LT(error, before / 2.5); // less than 4 for the kink of r in the middle
        }
        before = error;
    }
    EXPECT_LT(before, 0.003 * expected);
}

} // namespace
} // namespace drystone
