// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
// Closed forms of structures in space, each with random instances: what any correct program must obey.
#include "SpaceStructures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace drystone
{
namespace
{

using test::Chance;
using test::collapse;
using test::exact;
using test::instances;
using test::multiplier;
using test::onGround;
using test::pushed;

/// Some boxes on each other, each shifted and turned a little.
std::vector<Polyhedron> randomStack(Chance& chance, int count)
{
    std::vector<Polyhedron> stack;
    double z = 0;
    for (int i = 0; i < count; ++i)
    {
        const double a = chance(0.2, 0.4);
        const double b = chance(0.2, 0.4);
        const double h = chance(0.1, 0.5);
        const double angle = chance(-0.3, 0.3);
        const Vector<2> centre(chance(-0.03, 0.03), chance(-0.03, 0.03));
        std::vector<Vector<2>> outline;
        for (const Vector<2>& corner :
             {Vector<2>(-a, -b), Vector<2>(a, -b), Vector<2>(a, b), Vector<2>(-a, b)})
        {
            outline.push_back(centre + Eigen::Rotation2Dd(angle) * corner);
        }
        stack.push_back(test::prism(outline, z, z + h));
        z += h;
    }
    return stack;
}

Vector<3> randomDirection(Chance& chance)
{
    const double angle = chance(0, 2 * std::numbers::pi);
    return {std::cos(angle), std::sin(angle), 0};
}

// Law 1.
TEST(LawsOfSpace, PointsInsideAContactPolygonAddNothing)
{
    Chance chance(1);
    for (int i = 0; i < instances; ++i)
    {
        const Assembly<3> assembly = onGround(randomStack(chance, 3));
        const double mu = chance(0.2, 1);
        const Vector<3> direction = randomDirection(chance);
        const LoadVectors loads = pushed(assembly, direction);
        const std::vector<ContactPoint<3>> corners = findContactPoints(assembly);
        const LimitAnalysis few = collapse(assembly, corners, mu, loads);
        ASSERT_EQ(few.status, CollapseStatus::optimal) << "instance " << i;
        for (const int perSide : {5, 9})
        {
            const LimitAnalysis many = collapse(assembly, divideJoints(corners, perSide), mu, loads);
            ASSERT_EQ(many.status, CollapseStatus::optimal) << "instance " << i << ", " << perSide;
            EXPECT_NEAR(few.alpha, many.alpha, exact) << "instance " << i << ", " << perSide;
        }
    }
}

TEST(LawsOfSpace, AnLShapedFaceEqualsItsHullAndAFaceInTrianglesTheFace)
{
    Chance chance(2);
    for (int i = 0; i < instances; ++i)
    {
        const double a = chance(0.5, 1);
        const double b = chance(0.5, 1);
        const double c = chance(0.1, 0.4);
        const double h = chance(0.5, 2);
        const std::vector<Vector<2>> outline{{0, 0}, {a, 0}, {a, c}, {c, c}, {c, b}, {0, b}};
        const Assembly<3> assembly = onGround({test::prism(outline, 0, h)});
        const double mu = chance(0.2, 1);
        const LoadVectors loads = pushed(assembly, randomDirection(chance));
        std::vector<ContactPoint<3>> points = findContactPoints(assembly);
        ASSERT_EQ(points.size(), 6U) << "instance " << i;
        const double alpha = collapse(assembly, points, mu, loads).alpha;
        std::erase_if(points, [c](const ContactPoint<3>& point)
                      { return std::abs(point.position.x() - c) + std::abs(point.position.y() - c) < 1e-9; });
        ASSERT_EQ(points.size(), 5U) << "instance " << i;
        EXPECT_NEAR(collapse(assembly, points, mu, loads).alpha, alpha, exact) << "instance " << i;

        Assembly<3> cut = assembly;
        Polyhedron& shape = cut.blocks.front().shape;
        // The bottom, an L seen from below, in four triangles about its re-entrant corner.
        const auto bottom =
            std::find_if(shape.faces.begin(), shape.faces.end(),
                         [&](const std::vector<int>& face) { return areaVector(shape, face).z() < 0; });
        const std::vector<int> corners = *bottom;
        shape.faces.erase(bottom);
        const auto inner =
            std::find_if(corners.begin(), corners.end(),
                         [&](int v) { return (shape.vertices[v] - Vector<3>(c, c, 0)).norm() < 1e-9; })
            - corners.begin();
        for (std::ptrdiff_t k = 1; k <= 4; ++k)
        {
            shape.faces.push_back({corners[inner], corners[(inner + k) % 6], corners[(inner + k + 1) % 6]});
        }
        EXPECT_NEAR(collapse(cut, findContactPoints(cut), mu, loads).alpha, alpha, exact) << "instance " << i;
    }
}

// Law 2.
TEST(LawsOfSpace, AnExtrudedWallEqualsThePlaneWallWhateverItsThickness)
{
    Chance chance(3);
    for (int i = 0; i < instances; ++i)
    {
        RunningBond bond;
        bond.unit = {chance(0.2, 0.6), chance(0.1, 0.3)};
        bond.length = 2 + i % 3;
        bond.courses = 2 + i % 5;
        const Assembly<2> wall = test::wallOnGround(bond);
        const double mu = chance(0.2, 0.9);
        const double thickness = chance(0.1, 2);
        const std::vector<double> masses = test::unitMasses(wall);
        const std::vector<ContactPoint<2>> points = findContactPoints(wall);
        const LimitAnalysis plane = solveLimitAnalysis(limitAnalysisProgram(
            static_cast<int>(wall.blocks.size()) - 1, equilibriumColumns(wall, blockMasses(wall), points),
            std::vector<double>(points.size(), mu),
            {gravityLoad(wall, masses, {0, -1}), inertialLoad(wall, masses, {0, -1}, {1, 0})}));
        ASSERT_EQ(plane.status, CollapseStatus::optimal) << "instance " << i;

        const double alpha = multiplier(test::extruded(wall, thickness), mu, {1, 0, 0});
        EXPECT_NEAR(alpha, plane.alpha, exact) << "instance " << i;
    }
}

// Law 4.
TEST(LawsOfSpace, ABoxOverturnsOrSlidesByItsClosedForm)
{
    Chance chance(4);
    for (int i = 0; i < instances; ++i)
    {
        const double a = chance(0.1, 1);
        const double b = chance(0.1, 1);
        const double h = chance(0.1, 2);
        const double mu = chance(0.1, 1.5);
        const double q = chance(0.05, 1.5);
        const Assembly<3> assembly = onGround({makeBox({-a, -b, 0}, {a, b, 2 * h})});
        const double expected = std::min({mu, a / (h * std::cos(q)), b / (h * std::sin(q))});
        EXPECT_NEAR(multiplier(assembly, mu, {std::cos(q), std::sin(q), 0}), expected, exact)
            << "instance " << i;
    }
}

TEST(LawsOfSpace, OfEqualBoxesOnEachOtherTheWholeStackRocks)
{
    for (const auto& [direction, expected] :
         {std::pair(Vector<3>(1, 0, 0), 1.0 / 3), std::pair(Vector<3>(0, 1, 0), 1.0 / 6),
          std::pair(Vector<3>(1, 1, 0), 0.235702260)})
    {
        EXPECT_NEAR(multiplier(test::tower(0.2, 0.1, 0.2, 6), 0.5, direction), expected, exact);
    }
}

TEST(LawsOfSpace, AnyStackOfEqualBoxesRocksAsAWholeOrSlides)
{
    Chance chance(13);
    for (int i = 0; i < instances; ++i)
    {
        const double a = chance(0.1, 0.4);
        const double b = chance(0.1, 0.4);
        const double h = chance(0.05, 0.3);
        const double mu = chance(0.1, 1.5);
        const double q = chance(0.05, 1.5);
        const int count = 2 + i % 5;
        const double expected = std::min({mu, a / (count * h * std::cos(q)), b / (count * h * std::sin(q))});
        EXPECT_NEAR(multiplier(test::tower(a, b, 2 * h, count), mu, {std::cos(q), std::sin(q), 0}), expected,
                    exact)
            << "instance " << i;
    }
}

TEST(LawsOfSpace, APrismOverturnsAboutAFaceOrACorner)
{
    Chance chance(5);
    for (int i = 0; i < instances; ++i)
    {
        const int sides = 3 + i % 7;
        const double circumradius = chance(0.1, 0.5);
        const double height = chance(1, 3);
        const Assembly<3> assembly =
            onGround({test::prism(test::regularPolygon(sides, circumradius), 0, height)});
        const double half = std::numbers::pi / sides;
        EXPECT_NEAR(multiplier(assembly, 2, {std::cos(half), std::sin(half), 0}),
                    std::min(2.0, circumradius * std::cos(half) / (height / 2)), exact)
            << "instance " << i << ", towards a face";
        // Towards a corner the prism turns about the nearer of the two edges at it, which are the same.
        EXPECT_NEAR(multiplier(assembly, 2, {1, 0, 0}), std::min(2.0, circumradius / (height / 2)), exact)
            << "instance " << i << ", towards a corner";
    }
}

// Law 5.
TEST(LawsOfSpace, PureTorqueOnPointsOfOneRadius)
{
    Chance chance(6);
    for (int i = 0; i < instances; ++i)
    {
        const int sides = 3 + i % 8;
        const double radius = chance(0.1, 1);
        const double height = chance(0.1, 1);
        const double mu = chance(0.1, 1);
        const Assembly<3> assembly = onGround({test::prism(test::regularPolygon(sides, radius), 0, height)});
        LoadVectors loads = pushed(assembly, {1, 0, 0});
        const double weight = -loads.dead[2];
        loads.live.setZero();
        loads.live[5] = 1;
        const LimitAnalysis result = collapse(assembly, findContactPoints(assembly), mu, loads);
        ASSERT_EQ(result.status, CollapseStatus::optimal) << "instance " << i;
        EXPECT_NEAR(result.alpha / (mu * weight * radius), 1, exact) << "instance " << i;
    }
}

TEST(LawsOfSpace, ABoxPushedOffItsCentreTurnsAsItSlides)
{
    const Assembly<3> assembly = onGround({makeBox({-0.3, -0.2, 0}, {0.3, 0.2, 0.1})});
    for (const auto& [eccentricity, expected] : {std::pair(0.1, 0.475286398), std::pair(0.2, 0.422914943)})
    {
        LoadVectors loads = pushed(assembly, {1, 0, 0});
        const double weight = -loads.dead[2];
        // At the height of the base, so that it does not overturn.
        loads.live = pointLoad(assembly, 0, {0, eccentricity, 0}, {weight, 0, 0}).rows;
        EXPECT_NEAR(collapse(assembly, findContactPoints(assembly), 0.5, loads).alpha, expected, exact);
    }
}

// Law 6.
TEST(LawsOfSpace, APrismInAGrooveIsWedgedByTheAssociativeLaw)
{
    Chance chance(7);
    for (int i = 0; i < instances; ++i)
    {
        const double slope = i == 0 ? std::numbers::pi / 4 : i == 1 ? std::numbers::pi / 6 : chance(0.2, 1.2);
        const double mu = i == 0 ? 0.3 : i == 1 ? 0.5 : chance(0.05, 0.9 / std::tan(slope));
        // A triangular prism, its edge down along x, between two fixed wedges.
        const double h = std::tan(slope);
        const std::vector<Vector<2>> section{{0, 0}, {1, h}, {-1, h}};
        const std::vector<Vector<2>> right{{0, 0}, {2, 0}, {2, 2 * h}};
        const std::vector<Vector<2>> left{{0, 0}, {-2, 2 * h}, {-2, 0}};
        // Long, so that it does not overturn.
        const auto along = [](const std::vector<Vector<2>>& outline, double from, double to)
        {
            std::vector<Vector<3>> start;
            std::vector<Vector<3>> end;
            for (const Vector<2>& corner : outline)
            {
                start.emplace_back(from, corner.x(), corner.y());
                end.emplace_back(to, corner.x(), corner.y());
            }
            return makePrism(start, end);
        };
        Assembly<3> assembly;
        assembly.blocks = {
            {along(section, -10, 10), -1}, {along(right, -20, 20), 0}, {along(left, -20, 20), 0}};
        assembly.supports = {{"groove", "blocks"}};
        const double expected =
            mu / std::sqrt(std::pow(std::cos(slope), 2) - std::pow(mu * std::sin(slope), 2));
        EXPECT_NEAR(multiplier(assembly, mu, {1, 0, 0}), expected, exact) << "instance " << i;
    }
}

// Law 7.
TEST(LawsOfSpace, MirroredTurnedMovedScaledAndReorderedItIsTheSame)
{
    Chance chance(8);
    for (int i = 0; i < instances; ++i)
    {
        const Assembly<3> assembly = onGround(randomStack(chance, 4));
        const double mu = chance(0.2, 1);
        const Vector<3> direction = randomDirection(chance);
        const double alpha = multiplier(assembly, mu, direction);
        ASSERT_FALSE(std::isnan(alpha)) << "instance " << i;
        const Eigen::Matrix3d mirror = Vector<3>(-1, 1, 1).asDiagonal();
        EXPECT_NEAR(multiplier(test::transformed(assembly, mirror, 1, {0, 0, 0}), mu, mirror * direction),
                    alpha, 1e-8)
            << "instance " << i << ", mirrored";
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(chance(0, 3), Vector<3>(chance(-1, 1), chance(-1, 1), 1).normalized())
                .toRotationMatrix();
        EXPECT_NEAR(multiplier(test::transformed(assembly, turn, 1, {0, 0, 0}), mu, turn * direction,
                               turn * Vector<3>(0, 0, -1)),
                    alpha, 1e-8)
            << "instance " << i << ", turned";
        EXPECT_NEAR(
            multiplier(test::transformed(assembly, Eigen::Matrix3d::Identity(), 1, {1000, -1000, 1000}), mu,
                       direction),
            alpha, 1e-8)
            << "instance " << i << ", moved";
        EXPECT_NEAR(multiplier(test::transformed(assembly, Eigen::Matrix3d::Identity(), 1e-3, {0, 0, 0}), mu,
                               direction),
                    alpha, 1e-8)
            << "instance " << i << ", scaled";
        Assembly<3> shuffled = assembly;
        std::shuffle(shuffled.blocks.begin(), shuffled.blocks.end(), chance.generator);
        EXPECT_NEAR(multiplier(shuffled, mu, direction), alpha, 1e-8) << "instance " << i << ", reordered";
    }
}

// Law 9.
TEST(LawsOfSpace, APortalInItsPlaneHasTheSlendernessOfItsColumns)
{
    Chance chance(9);
    for (int i = 0; i < instances; ++i)
    {
        const double b = chance(0.1, 0.3); // half the width of a column
        const double drum = chance(0.2, 0.5);
        const int drums = 2 + i % 4;
        std::vector<Polyhedron> shapes;
        for (const double x : {-1.2, 1.2})
        {
            for (int k = 0; k < drums; ++k)
            {
                shapes.push_back(makeBox({x - b, -0.3, k * drum}, {x + b, 0.3, (k + 1) * drum}));
            }
        }
        const double height = drums * drum;
        shapes.push_back(makeBox({-1.6, -0.3, height}, {1.6, 0.3, height + 0.5}));
        const double mu = 5;
        EXPECT_NEAR(multiplier(onGround(shapes), mu, {1, 0, 0}), 2 * b / height, exact) << "instance " << i;
    }
}

// Law 10.
TEST(LawsOfSpace, AStepBuiltInBetweenFixedBlocksNeverCollapses)
{
    Assembly<3> assembly;
    assembly.blocks = {
        {makeBox({0, 0, 0}, {1, 0.3, 0.2}), -1},         {makeBox({-0.5, 0.1, -0.5}, {1.5, 0.3, 0}), 0},
        {makeBox({-0.5, 0.1, 0.2}, {1.5, 0.3, 0.7}), 0}, {makeBox({-0.5, 0, 0}, {0, 0.3, 0.2}), 0},
        {makeBox({1, 0, 0}, {1.5, 0.3, 0.2}), 0},        {makeBox({-0.5, 0.3, -0.5}, {1.5, 0.5, 0.7}), 0}};
    assembly.supports = {{"wall", "blocks"}};
    const LimitAnalysis result =
        collapse(assembly, findContactPoints(assembly), 0.5, pushed(assembly, {1, 0, 0}));
    EXPECT_EQ(result.status, CollapseStatus::unbounded);
    EXPECT_LE(result.certificate.worst(), 1e-9);
}

TEST(LawsOfSpace, StepsBuiltInAnyDepthNeverCollapse)
{
    Chance chance(10);
    for (int i = 0; i < instances; ++i)
    {
        const double depth = chance(0.05, 0.25);
        const double thickness = chance(0.1, 0.3);
        const double width = chance(0.5, 2);
        Assembly<3> assembly;
        // Below, above and on both sides of what is built in, y in [1 - depth, 1].
        assembly.blocks = {{makeBox({0, 0, 0}, {width, 1, thickness}), -1},
                           {makeBox({-0.5, 1 - depth, -0.5}, {width + 0.5, 1, 0}), 0},
                           {makeBox({-0.5, 1 - depth, thickness}, {width + 0.5, 1, 1}), 0},
                           {makeBox({-0.5, 1 - depth, 0}, {0, 1, thickness}), 0},
                           {makeBox({width, 1 - depth, 0}, {width + 0.5, 1, thickness}), 0},
                           {makeBox({-0.5, 1, -0.5}, {width + 0.5, 1.2, 1}), 0}};
        assembly.supports = {{"wall", "blocks"}};
        LoadVectors loads = pushed(assembly, {1, 0, 0});
        const double angle = chance(0, 2 * std::numbers::pi);
        // Anywhere on its free end, in any direction of that face.
        loads.live = pointLoad(assembly, 0, {chance(0, width), 0, chance(0, thickness)},
                               {std::cos(angle), 0, std::sin(angle)})
                         .rows;
        const LimitAnalysis result = collapse(assembly, findContactPoints(assembly), chance(0.1, 1), loads);
        EXPECT_EQ(result.status, CollapseStatus::unbounded) << "instance " << i;
        EXPECT_LE(result.certificate.worst(), 1e-9) << "instance " << i;
    }
}

/// A slab on pads, one of which sinks: its reaction.
LimitAnalysis settle(const Polyhedron& slab, const std::vector<Polyhedron>& pads, std::size_t sinking,
                     double mu)
{
    Assembly<3> assembly;
    assembly.blocks.push_back({slab, -1});
    for (std::size_t i = 0; i < pads.size(); ++i)
    {
        assembly.blocks.push_back({pads[i], i == sinking ? 1 : 0});
    }
    assembly.supports = {{"pads", "blocks"}, {"sinking", "blocks"}};
    const std::vector<ContactPoint<3>> points = findContactPoints(assembly);
    LoadVectors loads = pushed(assembly, {1, 0, 0});
    loads.live.resize(0);
    SpaceConeProgram program = test::programOf(assembly, points, mu, loads);
    program.gap = settlementGaps(assembly, points, SupportMovement<3>{1, {0, 0, -1}});
    return solveSettlement(program);
}

TEST(LawsOfSpace, ASupportThatNeedNotCarryAnythingHasNoReaction)
{
    Chance chance(12);
    for (int i = 0; i < instances; ++i)
    {
        // Pads under both ends, and one or two between them, of which one sinks.
        const double length = chance(1.5, 3);
        const double width = chance(0.2, 1);
        const double pad = chance(0.1, 0.3);
        const auto at = [&](double from, double depth) {
            return makeBox({from, 0, -0.1}, {from + pad, depth, 0});
        };
        std::vector<Polyhedron> pads{at(0, width), at(chance(0.35, 0.6) * length, chance(0.3, 1) * width),
                                     at(length - pad, width)};
        if (i % 2 == 1)
        {
            pads.push_back(at(0.15 * length, width));
        }
        const Polyhedron slab = makeBox({0, 0, 0}, {length, width, chance(0.05, 0.3)});
        const LimitAnalysis result = settle(slab, pads, 1, chance(0.1, 1));
        EXPECT_EQ(result.status, CollapseStatus::optimal) << "instance " << i;
        EXPECT_NEAR(result.alpha, 0, 1e-9) << "instance " << i;
        EXPECT_LE(result.certificate.worst(), 1e-9) << "instance " << i;
        // An outer one bears what the middle one cannot.
        const LimitAnalysis outer = settle(slab, {pads[0], pads[2]}, 1, 0.5);
        EXPECT_EQ(outer.status, CollapseStatus::optimal) << "instance " << i;
        const double weight = volumeProperties(slab).volume;
        EXPECT_NEAR(outer.alpha, weight * (length / 2 - pad) / (length - pad), exact) << "instance " << i;
    }
}

// Slab 2 x 1 x 0.2 on pads of 0.2 x 0.2: two at the corners of the front, one in the middle of the back.
TEST(LawsOfSpace, ASlabOnThreePadsTurnsAboutTheCornersOfTwo)
{
    const Polyhedron slab = makeBox({0, 0, 0}, {2, 1, 0.2});
    const std::vector<Polyhedron> pads{makeBox({0, 0, -0.1}, {0.2, 0.2, 0}),
                                       makeBox({0.9, 0.8, -0.1}, {1.1, 1, 0}),
                                       makeBox({1.8, 0, -0.1}, {2, 0.2, 0})};
    // Of a pair: the axis runs from (1.8, 0) to (0.9, 0.8); of the single one along y = 0.2.
    for (const auto& [sinking, expected] :
         {std::pair(0U, 0.131944444), std::pair(1U, 0.375), std::pair(2U, 0.131944444)})
    {
        const LimitAnalysis result = settle(slab, pads, sinking, 0.5);
        EXPECT_EQ(result.status, CollapseStatus::optimal) << sinking;
        EXPECT_NEAR(result.alpha / 0.4, expected, exact) << sinking;
    }
}

} // namespace
} // namespace drystone
