// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contacts between blocks in motion, judged by separating axes, by their own first-order promise and by
/// continuity.
#include "../Polygons.h"

#include "contact/MovingContacts.h"
#include "contact/Penetration.h"
#include "texture/RunningBond.h"
#include "texture/Supports.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

using namespace drystone;

namespace
{

using test::rectangle;

using Placements = std::vector<Placement<2>>;

Assembly<2> assemblyOf(const std::vector<Polygon>& outlines)
{
    Assembly<2> assembly;
    for (const Polygon& outline : outlines)
    {
        assembly.blocks.push_back({outline, 1, -1});
    }
    return assembly;
}

Placements atRest(const Assembly<2>& assembly)
{
    return Placements(assembly.blocks.size());
}

/// Wall 6 of the paper's table 1 on a ground split every half unit.
Assembly<2> wallSix()
{
    RunningBond bond;
    bond.length = 7;
    bond.courses = 21;
    bond.openings = {
        {{1.5, 4}, {2.5, 9}}, {{4.5, 4}, {5.5, 9}}, {{1.5, 12}, {2.5, 17}}, {{4.5, 12}, {5.5, 17}}};
    Assembly<2> wall = makeAssembly(bond);
    addGround(wall, "ground", {0.2, {}, 0});
    return wall;
}

Polygon turnedAbout(const Polygon& outline, double rotation)
{
    return placed(outline, areaProperties(outline).centroid, {Vector<2>::Zero(), rotation});
}

/// Random convex polygon of 3 to 8 corners on an ellipse, of size about 1.
Polygon randomConvex(std::mt19937& random)
{
    std::uniform_real_distribution<double> unit(0, 1);
    const int count = 3 + static_cast<int>(6 * unit(random));
    const double flat = 0.3 + 0.7 * unit(random);
    std::vector<double> angles;
    while (static_cast<int>(angles.size()) < count)
    {
        const double angle = 2 * std::numbers::pi * unit(random);
        if (std::none_of(angles.begin(), angles.end(),
                         [&](double other)
                         { return std::abs(std::remainder(angle - other, 2 * std::numbers::pi)) < 0.2; }))
        {
            angles.push_back(angle);
        }
    }
    std::sort(angles.begin(), angles.end());
    Polygon polygon;
    for (const double angle : angles)
    {
        polygon.emplace_back(0.5 * std::cos(angle), 0.5 * flat * std::sin(angle));
    }
    return polygon;
}

Polygon randomBlock(std::mt19937& random)
{
    std::uniform_real_distribution<double> unit(0, 1);
    if (unit(random) < 0.5)
    {
        return rectangle(0, 0, 0.3 + unit(random), 0.3 + unit(random));
    }
    return randomConvex(random);
}

struct Separation
{
    double distance; ///< largest over all edges' normals of the least distance of the other block
    Vector<2> normal;
};

/// By separating axes over the edges of both convex polygons; the normal points from `b` to `a`.
Separation separation(const Polygon& a, const Polygon& b)
{
    Separation best{-std::numeric_limits<double>::max(), Vector<2>::Zero()};
    for (const bool ofA : {true, false})
    {
        const Polygon& own = ofA ? a : b;
        const Polygon& other = ofA ? b : a;
        for (std::size_t i = 0; i < own.size(); ++i)
        {
            const Vector<2> edge = (own[(i + 1) % own.size()] - own[i]).normalized();
            const Vector<2> normal(edge.y(), -edge.x());
            double least = std::numeric_limits<double>::max();
            for (const Vector<2>& vertex : other)
            {
                least = std::min(least, (vertex - own[i]).dot(normal));
            }
            if (least > best.distance)
            {
                best = {least, ofA ? Vector<2>(-normal) : normal};
            }
        }
    }
    return best;
}

double leastGap(const std::vector<ContactPoint<2>>& points)
{
    double least = std::numeric_limits<double>::max();
    for (const ContactPoint<2>& point : points)
    {
        least = std::min(least, point.gap);
    }
    return least;
}

/// Displacement of the material point of a block that is at `at`, for the motion (u, r) of the block about
/// `centre`.
Vector<2> displacementAt(const Vector<2>& at, const Vector<2>& centre, const Vector<3>& motion)
{
    return motion.head<2>() + motion[2] * perpendicular(at - centre);
}

/// The gap that the step program predicts: g0 - A0' dx.
double predictedGap(const ContactPoint<2>& point, const std::vector<Vector<2>>& centres,
                    const std::vector<Vector<3>>& motions)
{
    return point.gap
           + point.normal.dot(
               displacementAt(point.position, centres[point.block], motions[point.block])
               - displacementAt(point.position, centres[point.neighbour], motions[point.neighbour]));
}

/// The gap of the same corner and edge in another configuration.
double gapOfFeature(const ContactPoint<2>& point, const Assembly<2>& assembly, const Placements& placements)
{
    const int edgeBlock = point.feature.vertexBlock == point.block ? point.neighbour : point.block;
    const auto outline = [&](int block)
    {
        const Polygon& built = assembly.blocks[block].outline;
        return placed(built, areaProperties(built).centroid, placements[block]);
    };
    const Polygon withEdge = outline(edgeBlock);
    const Vector<2> corner = outline(point.feature.vertexBlock)[point.feature.vertex];
    const Vector<2> from = withEdge[point.feature.edge];
    const Vector<2> along = (withEdge[(point.feature.edge + 1) % withEdge.size()] - from).normalized();
    return (corner - from).dot(Vector<2>(along.y(), -along.x()));
}

void expectSameBits(const std::vector<ContactPoint<2>>& a, const std::vector<ContactPoint<2>>& b)
{
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        EXPECT_EQ(a[i].block, b[i].block);
        EXPECT_EQ(a[i].neighbour, b[i].neighbour);
        EXPECT_EQ(a[i].joint, b[i].joint);
        EXPECT_EQ(a[i].position, b[i].position);
        EXPECT_EQ(a[i].normal, b[i].normal);
        EXPECT_EQ(a[i].gap, b[i].gap);
        EXPECT_EQ(a[i].feature, b[i].feature);
    }
}

/// Every point of `a` has one in `b` with the same pair, place, normal and gap, and the other way round.
void expectSamePoints(const std::vector<ContactPoint<2>>& a, const std::vector<ContactPoint<2>>& b,
                      double tolerance)
{
    ASSERT_EQ(a.size(), b.size());
    for (const ContactPoint<2>& point : a)
    {
        const auto matches = std::count_if(b.begin(), b.end(),
                                           [&](const ContactPoint<2>& other)
                                           {
                                               return other.block == point.block
                                                      && other.neighbour == point.neighbour
                                                      && (other.position - point.position).norm() < tolerance
                                                      && (other.normal - point.normal).norm() < tolerance
                                                      && std::abs(other.gap - point.gap) < tolerance;
                                           });
        EXPECT_EQ(matches, 1) << "block " << point.block << " neighbour " << point.neighbour << " at "
                              << point.position.transpose();
    }
}

void expectAtMostTwoPointsForAPairOfEdges(const std::vector<ContactPoint<2>>& points)
{
    for (std::size_t i = 2; i < points.size(); ++i)
    {
        EXPECT_LT(points[i - 2].joint, points[i].joint);
    }
}

} // namespace

TEST(MovingContacts, AsBuiltTheyAreThePointsOfTheWall)
{
    const Assembly<2> wall = wallSix();
    MovingContacts<2> contacts(wall);
    const auto& points = contacts.update(atRest(wall), 1e-3);
    ASSERT_EQ(points.size(), 702U);
    expectSamePoints(points, findContactPoints(wall), 1e-12);
    expectAtMostTwoPointsForAPairOfEdges(points);
    for (const ContactPoint<2>& point : points)
    {
        EXPECT_NEAR(point.gap, 0, 1e-14);
        EXPECT_LT(point.block, point.neighbour);
    }
}

// On springs blocks overlap by more than they are turned against each other: their own corners touch, however
// long the edge that they have sunk into.
TEST(MovingContacts, ABlockThatHasSunkIntoALongEdgeTouchesItByItsOwnCorners)
{
    for (const double halfWidth : {1.0, 4.0, 10.0, 40.0})
    {
        const Assembly<2> assembly =
            assemblyOf({rectangle(-halfWidth, -1, halfWidth, 0), rectangle(0, 0, 0.5, 1)});
        for (const double rotation : {0.0, 1e-6, -1e-6, 1e-4, -1e-4, 1e-3, -1e-3})
        {
            SCOPED_TRACE(testing::Message() << halfWidth << " " << rotation);
            MovingContacts<2> contacts(assembly);
            Placements placements = atRest(assembly);
            placements[1] = {{1e-4, -1e-3}, rotation};
            Placements ahead = placements;
            ahead[1].rotation *= -1;
            const std::vector<ContactPoint<2>> points = contacts.update(placements, ahead, 1e-2);
            ASSERT_EQ(points.size(), 2u);
            for (const ContactPoint<2>& point : points)
            {
                EXPECT_NEAR(std::abs(point.position.x() - 0.25), 0.25, 2e-3);
                EXPECT_NEAR(point.gap, -1e-3, 6e-4);
            }
        }
    }
}

TEST(MovingContacts, AsBuiltTheyAreThePointsOfBlocksOfAnyShape)
{
    const std::vector<std::vector<Polygon>> cases{
        // a block in a notch
        {{{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, rectangle(1, 1, 2, 2)},
        // vertices that only split an edge
        {{{0, 0}, {0.25, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}},
         {{-1, -1}, {2, -1}, {2, 0}, {0.7, 0}, {0.1, 0}, {-1, 0}}},
        // three blocks that meet at a point, none of them square
        {{{0, 0}, {1, 0}, {0.4, 0.9}, {0, 1}},
         {{1, 0}, {2, 0}, {2, 1.5}, {0.4, 0.9}},
         {{0, 1}, {0.4, 0.9}, {2, 1.5}, {0, 2}}},
        // four squares that meet at a point
        {rectangle(0, 0, 1, 1), rectangle(1, 0, 2, 1), rectangle(0, 1, 1, 2), rectangle(1, 1, 2, 2)},
        // voussoirs
        {turnedAbout({{0, 0}, {1, 0}, {0.9, 1}, {0.1, 1}}, 0), {{1, 0}, {2, 0.2}, {1.7, 1.2}, {0.9, 1}}}};
    for (const auto& outlines : cases)
    {
        const Assembly<2> assembly = assemblyOf(outlines);
        MovingContacts<2> contacts(assembly);
        expectSamePoints(contacts.update(atRest(assembly), 1e-3), findContactPoints(assembly), 1e-9);
    }
}

TEST(MovingContacts, AWallThatMovesAsOneKeepsItsPoints)
{
    const Assembly<2> wall = wallSix();
    const auto asBuilt = findContactPoints(wall);
    // All blocks turned about the origin, ground included.
    const double rotation = 0.7;
    Placements placements;
    for (const Block<2>& block : wall.blocks)
    {
        const Vector<2> centroid = areaProperties(block.outline).centroid;
        const Vector<2> turned =
            placed({centroid}, Vector<2>::Zero(), {Vector<2>(0.3, -2), rotation}).front();
        placements.push_back({turned - centroid, rotation});
    }
    std::vector<ContactPoint<2>> expected = asBuilt;
    for (ContactPoint<2>& point : expected)
    {
        point.position = placed({point.position}, Vector<2>::Zero(), {Vector<2>(0.3, -2), rotation}).front();
        point.normal = placed({point.normal}, Vector<2>::Zero(), {Vector<2>::Zero(), rotation}).front();
    }
    MovingContacts<2> contacts(wall);
    expectSamePoints(contacts.update(placements, 1e-3), expected, 1e-11);
}

TEST(MovingContacts, FixedBlocksHaveNoContactsWithEachOther)
{
    Assembly<2> assembly = assemblyOf({rectangle(0, 0, 1, 1), rectangle(1, 0, 2, 1)});
    assembly.blocks[0].support = assembly.blocks[1].support = 0;
    MovingContacts<2> contacts(assembly);
    EXPECT_TRUE(contacts.update(atRest(assembly), 0.01).empty());
}

TEST(MovingContacts, AnAssemblyWithoutBlocksHasNone)
{
    MovingContacts<2> contacts{Assembly<2>{}};
    EXPECT_TRUE(contacts.update({}, 0.01).empty());
    EXPECT_EQ(penetration(Assembly<2>{}, {}).depth, 0);
}

TEST(MovingContacts, ARockingBlockKeepsBothCornersWhileTheGapIsWithinTheMargin)
{
    const Assembly<2> assembly = assemblyOf({rectangle(-0.25, 0, 0.25, 2), rectangle(-2, -1, 2, 0)});
    MovingContacts<2> contacts(assembly);
    for (const double rotation : {0.0, 1e-9, 1e-5, 1e-3, 0.019, 0.021, 0.1, 0.5})
    {
        // About the right corner (0.25, 0) for clockwise turns, by mirror image the left one.
        for (const double sense : {1.0, -1.0})
        {
            const Vector<2> pivot(-0.25 * sense, 0);
            const Vector<2> centre(0, 1);
            const double angle = sense * rotation;
            const Vector<2> turned = placed({centre}, pivot, {Vector<2>::Zero(), angle}).front();
            Placements placements = atRest(assembly);
            placements[0] = {turned - centre, angle};
            const auto& points = contacts.update(placements, 0.01);
            const double open = 0.5 * std::sin(rotation);
            ASSERT_EQ(points.size(), open <= 0.01 ? 2U : 1U) << rotation;
            for (const ContactPoint<2>& point : points)
            {
                EXPECT_NEAR(point.normal.y(), 1, 1e-12);
                EXPECT_EQ(point.feature.vertexBlock, 0);
            }
            EXPECT_NEAR(leastGap(points), 0, 1e-14);
            if (points.size() == 2)
            {
                EXPECT_NEAR(std::max(points[0].gap, points[1].gap), open, 1e-14);
            }
        }
    }
}

TEST(MovingContacts, ABlockThatFallsIsListedBeforeItLands)
{
    const Assembly<2> assembly = assemblyOf({rectangle(0, 0.1, 1, 1), rectangle(-5, -1, 5, 0)});
    MovingContacts<2> contacts(assembly);
    Placements placements = atRest(assembly);
    for (int step = 0; step <= 200; ++step)
    {
        placements[0] = {{0, -0.001 * step}, 0.1 * (1 - 0.005 * step)};
        const auto& points = contacts.update(placements, 0.02);
        const Polygon block = placed(assembly.blocks[0].outline,
                                     areaProperties(assembly.blocks[0].outline).centroid, placements[0]);
        for (const Vector<2>& corner : block)
        {
            const auto listed = std::count_if(points.begin(), points.end(),
                                              [&](const ContactPoint<2>& point)
                                              { return (point.position - corner).norm() < 1e-12; });
            EXPECT_EQ(listed, corner.y() <= 0.02 ? 1 : 0) << step;
        }
    }
}

TEST(MovingContacts, TheMarginListsWhateverCanMeetInAStep)
{
    const Assembly<2> assembly = assemblyOf({rectangle(0, 0, 2, 2), rectangle(5, 0, 7, 2)});
    MovingContacts<2> contacts(assembly);
    // 1 m/s and 0.5 rad/s on a radius of sqrt(2).
    const double margin = contacts.marginFor({Vector<3>(0.6, 0.8, 0.5), Vector<3>(0, 0.1, 0)}, 0.01, 10);
    EXPECT_NEAR(margin, 2 * 0.01 * (1 + 0.5 * std::sqrt(2.0) + 0.1), 1e-15);
}

TEST(MovingContacts, TheChangeOfTheGapIsThatOfTheEquilibriumMatrixToSecondOrder)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> symmetric(-1, 1);
    int checked = 0;
    for (int round = 0; round < 4000; ++round)
    {
        const Assembly<2> assembly = assemblyOf({randomBlock(random), randomBlock(random)});
        std::vector<Vector<2>> centres;
        Placements placements = atRest(assembly);
        placements[0] = {{symmetric(random), symmetric(random)}, 3 * symmetric(random)};
        for (std::size_t b = 0; b < 2; ++b)
        {
            centres.push_back(areaProperties(assembly.blocks[b].outline).centroid
                              + placements[b].translation);
        }
        MovingContacts<2> contacts(assembly);
        const auto points = contacts.update(placements, 0.2); // gaps far from zero as well
        const double size = 1e-4;
        std::vector<Vector<3>> motions;
        Placements moved = placements;
        for (std::size_t b = 0; b < 2; ++b)
        {
            motions.push_back(size * Vector<3>(symmetric(random), symmetric(random), symmetric(random)));
            moved[b].translation += motions[b].head<2>();
            moved[b].rotation += motions[b][2];
        }
        std::vector<ContactPoint<2>> measured;
        contacts.measure(moved, measured);
        ASSERT_EQ(measured.size(), points.size());
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            EXPECT_NEAR(gapOfFeature(points[i], assembly, placements), points[i].gap, 1e-14);
            EXPECT_NEAR(gapOfFeature(points[i], assembly, moved), measured[i].gap, 1e-14);
            EXPECT_NEAR(measured[i].gap, predictedGap(points[i], centres, motions), 4 * size * size);
            ++checked;
        }
    }
    EXPECT_GT(checked, 1000);
}

TEST(MovingContacts, AgreeWithSeparatingAxesOnRandomPairs)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    const double margin = 0.02;
    int overlapping = 0;
    int apart = 0;
    for (int round = 0; round < 30000; ++round)
    {
        const Assembly<2> assembly = assemblyOf({randomBlock(random), randomBlock(random)});
        Placements placements = atRest(assembly);
        placements[0] = {{2 * unit(random) - 1, 2 * unit(random) - 1}, 6.3 * unit(random)};
        placements[1].rotation = unit(random) < 0.3 ? placements[0].rotation : 6.3 * unit(random);
        const auto outline = [&](int b)
        {
            const Polygon& built = assembly.blocks[b].outline;
            return placed(built, areaProperties(built).centroid, placements[b]);
        };
        // Bring the pair to the wanted distance along the normal.
        const double wanted = unit(random) < 0.5 ? -1e-3 * unit(random) : margin * unit(random);
        for (int repeat = 0; repeat < 3; ++repeat)
        {
            const Separation found = separation(outline(0), outline(1));
            placements[0].translation += (wanted - found.distance) * found.normal;
        }
        const Separation found = separation(outline(0), outline(1));
        MovingContacts<2> contacts(assembly);
        const auto& points = contacts.update(placements, margin);
        expectAtMostTwoPointsForAPairOfEdges(points);
        if (found.distance > 1e-12)
        {
            ++apart;
            for (const ContactPoint<2>& point : points)
            {
                EXPECT_GT(point.gap, 0) << "round " << round;
            }
        }
        else if (found.distance > -2e-3 && found.distance < -1e-5)
        {
            ++overlapping;
            ASSERT_FALSE(points.empty()) << "round " << round << " depth " << found.distance;
            // Some point says so, and none makes more of it than the corner region allows.
            EXPECT_LE(leastGap(points), 0.95 * found.distance) << "round " << round;
            EXPECT_GE(leastGap(points), 2 * found.distance) << "round " << round;
        }
    }
    EXPECT_GT(overlapping, 5000);
    EXPECT_GT(apart, 5000);
}

TEST(MovingContacts, RandomPairsThatHeadIntoEachOtherHaveAPointThatClosesBeyondItsGap)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    const double way = 0.01;
    const double turn = 0.02;
    int entering = 0;
    int missed = 0;
    for (int round = 0; round < 30000; ++round)
    {
        const Assembly<2> assembly = assemblyOf({randomBlock(random), randomBlock(random)});
        Placements placements = atRest(assembly);
        placements[0] = {{2 * unit(random) - 1, 2 * unit(random) - 1}, 6.3 * unit(random)};
        placements[1].rotation = 6.3 * unit(random);
        const auto outline = [&](const Placements& at, int b)
        {
            const Polygon& built = assembly.blocks[b].outline;
            return placed(built, areaProperties(built).centroid, at[b]);
        };
        const auto distanceAt = [&](const Placements& at)
        { return separation(outline(at, 0), outline(at, 1)).distance; };
        const double wanted = way * unit(random);
        for (int repeat = 0; repeat < 3; ++repeat)
        {
            const Separation found = separation(outline(placements, 0), outline(placements, 1));
            placements[0].translation += (wanted - found.distance) * found.normal;
        }
        Placements ahead = placements;
        ahead[0].translation += way * Vector<2>(2 * unit(random) - 1, 2 * unit(random) - 1);
        ahead[0].rotation += turn * (2 * unit(random) - 1);
        if (distanceAt(placements) < 1e-4 || distanceAt(ahead) > -1e-4)
        {
            continue;
        }
        ++entering;
        MovingContacts<2> contacts(assembly);
        contacts.update(placements, ahead, 4 * (way + turn));
        std::vector<ContactPoint<2>> measured;
        contacts.measure(ahead, measured);
        missed += measured.empty() || leastGap(measured) >= 0 ? 1 : 0;
    }
    EXPECT_GT(entering, 1000);
    EXPECT_EQ(missed, 0) << "of " << entering;
}

TEST(MovingContacts, ABlockThatSlidesOverFlushBlocksDoesNotCatchOnTheirJoints)
{
    // A course of 10 blocks with flush tops on the ground, and a slider that goes from one end to the other.
    // Settlement and rounding make the tops differ by less than the tolerance.
    std::vector<Polygon> outlines;
    for (int i = 0; i < 10; ++i)
    {
        const double top = 1 + 1e-10 * ((7 * i) % 5 - 2);
        outlines.push_back(rectangle(i, 0, i + 1, top));
    }
    outlines.push_back(rectangle(0.2, 1, 1.5, 1.6));
    const Assembly<2> assembly = assemblyOf(outlines);
    const int slider = 10;
    std::vector<Vector<2>> centres(11, Vector<2>::Zero());
    MovingContacts<2> contacts(assembly);
    const double step = 0.00371;
    for (const double sense : {1.0, -1.0})
    {
        for (int k = 0; k < 2300; ++k)
        {
            Placements placements = atRest(assembly);
            placements[slider].translation.x() = sense > 0 ? k * step : 8.5 - k * step;
            std::vector<Vector<3>> motions(11, Vector<3>::Zero());
            motions[slider].x() = sense * step;
            Placements ahead = placements;
            ahead[slider].translation.x() += sense * step;
            for (const bool look : {false, true})
            {
                const auto& points = look ? contacts.update(placements, ahead, 2.5 * step)
                                          : contacts.update(placements, 2.5 * step);
                int under = 0;
                for (const ContactPoint<2>& point : points)
                {
                    if (point.neighbour == slider)
                    {
                        ++under;
                        EXPECT_NEAR(point.normal.y(), -1, 1e-12) << k; // from the slider into the course
                        EXPECT_GT(predictedGap(point, centres, motions), -1e-9) << k;
                    }
                }
                EXPECT_GE(under, 2);
            }
        }
    }
}

TEST(MovingContacts, ATiltedBlockThatSlidesOverFlushBlocksDoesNotCatchWhenItIsToldWhereItIsHeading)
{
    std::vector<Polygon> outlines;
    for (int i = 0; i < 5; ++i)
    {
        outlines.push_back(rectangle(i, 0, i + 1, 1));
    }
    outlines.push_back(rectangle(0, 1, 1, 1.5));
    const Assembly<2> assembly = assemblyOf(outlines);
    const int slider = 5;
    const double step = 0.00371;
    MovingContacts<2> contacts(assembly);
    for (const double tilt :
         {1e-9, 1e-6, 1e-3, 0.1, 0.3, 0.7, 1.0, 1.5, -1e-9, -1e-3, -0.1, -0.4, -0.9, -1.5})
    {
        for (const double sense : {1.0, -1.0})
        {
            const Polygon turned = turnedAbout(outlines[slider], tilt);
            double lowest = 2;
            for (const Vector<2>& corner : turned)
            {
                lowest = std::min(lowest, corner.y());
            }
            for (int k = 0; k < 700; ++k)
            {
                Placements placements = atRest(assembly);
                const double at = sense > 0 ? 0.9 + k * step : 3.5 - k * step;
                placements[slider] = {{at, 1 - lowest}, tilt};
                Placements ahead = placements;
                ahead[slider].translation.x() += sense * step;
                std::vector<Vector<3>> motions(6, Vector<3>::Zero());
                motions[slider].x() = sense * step;
                std::vector<Vector<2>> centres(6, Vector<2>::Zero());
                for (const ContactPoint<2>& point : contacts.update(placements, ahead, 2.5 * step))
                {
                    if (point.neighbour == slider)
                    {
                        EXPECT_GT(predictedGap(point, centres, motions), -1e-9)
                            << tilt << " " << sense << " " << k;
                    }
                }
            }
        }
    }
}

TEST(MovingContacts, BlocksThatFallCornerOnCornerAreListedBeforeTheyOverlapWhenToldWhereTheyAreHeading)
{
    // A square on its corner above another one, shifted sideways by less than it falls in a step.
    const double half = std::sqrt(0.5);
    const Polygon diamond{{0, -half}, {half, 0}, {0, half}, {-half, 0}};
    const Assembly<2> assembly = assemblyOf({diamond, diamond});
    MovingContacts<2> contacts(assembly);
    for (const double shift : {0.0, 1e-12, 1e-7, 1e-4, -1e-4, 3e-3, -3e-3})
    {
        Placements placements = atRest(assembly);
        placements[0].translation = {shift, 2 * half + 0.004};
        Placements ahead = placements;
        ahead[0].translation.y() -= 0.01;
        const auto& points = contacts.update(placements, ahead, 0.03);
        ASSERT_FALSE(points.empty()) << shift;
        double closest = 1;
        for (const ContactPoint<2>& point : points)
        {
            EXPECT_GT(point.gap, 0);
            closest = std::min(closest, gapOfFeature(point, assembly, ahead));
        }
        EXPECT_LT(closest, -1e-3); // the listed edge is one that the fall would cross
    }
}

TEST(MovingContacts, CornersAtOnePlaceTouchWhenTheBlocksCloseAndNotAtRestOrWhereOneSlidesPastTheOther)
{
    const double half = std::sqrt(0.5);
    const Polygon diamond{{0, -half}, {half, 0}, {0, half}, {-half, 0}};
    const Assembly<2> assembly = assemblyOf({diamond, diamond});
    MovingContacts<2> contacts(assembly);
    Placements placements = atRest(assembly);
    placements[0].translation = {0, 2 * half + 1e-6};
    const auto pointsToward = [&](double x, double y)
    {
        Placements ahead = placements;
        ahead[0].translation += Vector<2>(x, y);
        return contacts.update(placements, ahead, 0.03);
    };
    EXPECT_EQ(pointsToward(0, -2e-6).size(), 1U); // onto the corner, ahead by less than makes a joint
    EXPECT_EQ(pointsToward(0, -4e-6).size(), 4U);
    EXPECT_TRUE(pointsToward(0, 0).empty());
    EXPECT_TRUE(pointsToward(0, 1e-3).empty());
    EXPECT_TRUE(pointsToward(1e-6, -1e-6).empty()); // along an edge of the other one
    EXPECT_TRUE(pointsToward(-1e-6, -1e-6).empty());
}

TEST(MovingContacts, CornersAtOnePlaceThatWereLeftAloneAreGuardedWhereAnotherHeadingTakesThemIntoEachOther)
{
    const double half = std::sqrt(0.5);
    const Polygon diamond{{0, -half}, {half, 0}, {0, half}, {-half, 0}};
    const Assembly<2> assembly = assemblyOf({diamond, diamond});
    MovingContacts<2> contacts(assembly);
    Placements rest = atRest(assembly);
    rest[0].translation = {0, 2 * half};
    const auto towards = [&rest](double x, double y)
    {
        Placements there = rest;
        there[0].translation += Vector<2>(x, y);
        return there;
    };
    const Placements down = towards(0, -1e-3);
    const Placements beside = towards(1e-3, -1e-3); // along an edge of the other one
    ASSERT_TRUE(contacts.update(rest, {rest}, 0.03).empty());
    EXPECT_TRUE(contacts.mayOverlook());
    EXPECT_TRUE(contacts.findsMoreTowards(down));
    EXPECT_NEAR(contacts.overlookedDepth(down), 1e-3 * half, 1e-12);
    EXPECT_FALSE(contacts.findsMoreTowards(rest));
    EXPECT_FALSE(contacts.findsMoreTowards(beside));
    EXPECT_EQ(contacts.overlookedDepth(beside), 0);
    EXPECT_TRUE(contacts.update(rest, {rest, beside}, 0.03).empty());
    EXPECT_EQ(contacts.update(rest, {rest, beside, down}, 0.03).size(), 1U);
    EXPECT_FALSE(contacts.mayOverlook());
    EXPECT_TRUE(contacts.update(rest, {rest}, 0.03).empty()); // headings are forgotten
}

TEST(MovingContacts, AHalfOpenedFaceThatIsCarriedBesideAnotherDoesNotTouchIt)
{
    // Falls past a wall with a clearance below the margin: the only contacts are those with the wall, none is
    // above it.
    const Assembly<2> assembly = assemblyOf({rectangle(0, 0, 1, 2), rectangle(1.0001, 2.001, 2.0001, 3)});
    MovingContacts<2> contacts(assembly);
    for (int k = 0; k < 400; ++k)
    {
        Placements placements = atRest(assembly);
        placements[1].translation.y() = -0.00731 * k;
        for (const ContactPoint<2>& point : contacts.update(placements, 0.02))
        {
            EXPECT_NEAR(point.normal.x(), -1, 1e-12) << k;
            EXPECT_NEAR(point.gap, 1e-4, 1e-12);
        }
    }
}

TEST(MovingContacts, ABlockThatSlidesOffAnEndHandsItsContactOver)
{
    // The slider's corner passes the end of the block below: first the corner stands on the block, then the
    // block's corner stands against the slider. Both places and gaps join without a jump.
    const Assembly<2> assembly = assemblyOf({rectangle(0, 0, 1, 1), rectangle(0, 1, 0.8, 1.5)});
    MovingContacts<2> contacts(assembly);
    double last = 0.8;
    for (int k = 0; k < 700; ++k)
    {
        Placements placements = atRest(assembly);
        placements[1] = {{0.001 * k, 0.4 * std::sin(1e-4)}, 1e-4};
        const auto& points = contacts.update(placements, 0.01);
        ASSERT_EQ(points.size(), 2U);
        double right = -1;
        for (const ContactPoint<2>& point : points)
        {
            right = std::max(right, point.position.x());
            EXPECT_NEAR(std::abs(point.gap), 0, 1e-4);
        }
        EXPECT_NEAR(right, last, 0.0011);
        EXPECT_NEAR(right, std::min(1.0, 0.8 + 0.001 * k), 1e-4);
        last = right;
    }
}

TEST(MovingContacts, DeepInitialOverlapsPushTheWayTheyCame)
{
    // 1 mm of overlap of blocks of the same width, or shifted by half of that: up and down, never sideways.
    for (const double shift : {0.0, 1e-16, 1e-9, 5e-4, -5e-4, 0.1})
    {
        const Assembly<2> assembly =
            assemblyOf({rectangle(0, 0, 0.4, 0.175), rectangle(shift, 0.174, 0.4 + shift, 0.35)});
        MovingContacts<2> contacts(assembly);
        const auto& points = contacts.update(atRest(assembly), 1e-3);
        ASSERT_EQ(points.size(), 2U) << shift;
        for (const ContactPoint<2>& point : points)
        {
            EXPECT_NEAR(point.gap, -1e-3, 1e-15);
            EXPECT_EQ(point.normal, Vector<2>(0, -1));
        }
        EXPECT_NEAR(penetration(assembly, atRest(assembly)).depth, 1e-3, 1e-15);
    }
}

TEST(MovingContacts, ACornerInAReentrantCornerTouchesBothOfItsEdges)
{
    const Polygon angle{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    for (const double overlap : {0.0, 1e-9, 1e-5, 1e-3})
    {
        const Assembly<2> assembly = assemblyOf({angle, rectangle(1 - overlap, 1 - overlap, 1.8, 1.8)});
        MovingContacts<2> contacts(assembly);
        const auto& points = contacts.update(atRest(assembly), 0.01);
        ASSERT_EQ(points.size(), 4U) << overlap;
        int below = 0;
        for (const ContactPoint<2>& point : points)
        {
            below += std::abs(point.normal.y() + 1) < 1e-12;
            EXPECT_NEAR(point.gap, -overlap, 1e-12);
        }
        EXPECT_EQ(below, 2);
        // The nearest point outside is the re-entrant corner itself.
        EXPECT_NEAR(penetration(assembly, atRest(assembly)).depth, std::sqrt(2.0) * overlap, 1e-12);
    }
}

namespace
{

/// Blocks that start as a wall and drift apart, turn and tumble, step by step.
Placements tumbled(const Assembly<2>& assembly, int step)
{
    Placements placements = atRest(assembly);
    for (std::size_t b = 0; b < placements.size(); ++b)
    {
        if (assembly.blocks[b].support < 0)
        {
            const double phase = 1.7 * static_cast<double>(b);
            const double grown = 2e-3 * step;
            placements[b] = {{grown * std::sin(phase), grown * std::cos(3 * phase)},
                             grown * std::sin(5 * phase)};
        }
    }
    return placements;
}

} // namespace

TEST(MovingContacts, TheNeighbourListDoesNotChangeTheResult)
{
    const Assembly<2> wall = wallSix();
    MovingContacts<2> withHistory(wall);
    MovingContactOptions wide;
    wide.skin = 2;
    MovingContacts<2> withWideSkin(wall, wide);
    for (int step = 0; step < 60; ++step)
    {
        const Placements now = tumbled(wall, step);
        const Placements ahead = tumbled(wall, step + 1);
        const double margin = step % 3 == 0 ? 0.02 : 0.005;
        const bool look = step % 2 == 0;
        const auto& points = look ? withHistory.update(now, ahead, margin) : withHistory.update(now, margin);
        MovingContacts<2> fresh(wall);
        expectSameBits(points, look ? fresh.update(now, ahead, margin) : fresh.update(now, margin));
        expectSameBits(points,
                       look ? withWideSkin.update(now, ahead, margin) : withWideSkin.update(now, margin));
        expectAtMostTwoPointsForAPairOfEdges(points);
    }
    EXPECT_GT(withHistory.rebuilds(), 1);
    EXPECT_LT(withHistory.rebuilds(), 40);
    EXPECT_LE(withWideSkin.rebuilds(), 2);
}

TEST(MovingContacts, PointsAreSortedByPairAndNamedByCornerAndEdge)
{
    const Assembly<2> wall = wallSix();
    MovingContacts<2> contacts(wall);
    const Placements placements = tumbled(wall, 10);
    const auto& points = contacts.update(placements, 0.01);
    ASSERT_GT(points.size(), 200U);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const ContactPoint<2>& point = points[i];
        EXPECT_NEAR(point.normal.norm(), 1, 1e-14);
        EXPECT_NEAR(gapOfFeature(point, wall, placements), point.gap, 1e-13);
        if (i > 0)
        {
            EXPECT_LE(std::make_pair(points[i - 1].block, points[i - 1].neighbour),
                      std::make_pair(point.block, point.neighbour));
            EXPECT_LE(points[i - 1].joint, point.joint);
        }
    }
}

TEST(MovingContacts, TheMirroredSceneGivesTheMirroredPoints)
{
    const auto mirrored = [](Polygon outline)
    {
        std::reverse(outline.begin(), outline.end());
        for (Vector<2>& vertex : outline)
        {
            vertex.x() = -vertex.x();
        }
        return outline;
    };
    const Assembly<2> wall = wallSix();
    Assembly<2> image = wall;
    for (Block<2>& block : image.blocks)
    {
        block.outline = mirrored(block.outline);
    }
    MovingContacts<2> contacts(wall);
    MovingContacts<2> ofImage(image);
    for (const int step : {0, 1, 5, 20, 50})
    {
        Placements placements = tumbled(wall, step);
        std::vector<ContactPoint<2>> expected = contacts.update(placements, 0.01);
        for (Placement<2>& placement : placements)
        {
            placement.translation.x() *= -1;
            placement.rotation *= -1;
        }
        for (ContactPoint<2>& point : expected)
        {
            point.position.x() *= -1;
            point.normal.x() *= -1;
        }
        expectSamePoints(ofImage.update(placements, 0.01), expected, 1e-12);
    }
}

TEST(MovingContacts, AgreeWithThePenetrationOfAWallInMotion)
{
    // All pairs, by an independent measure: where two blocks overlap some point says so, and to the right
    // depth; where none do, no gap is negative.
    const Assembly<2> wall = wallSix();
    MovingContacts<2> contacts(wall);
    for (int step = 0; step < 20; ++step)
    {
        Placements placements = tumbled(wall, step);
        const auto& points = contacts.update(placements, 0.005);
        std::vector<Polygon> outlines;
        for (std::size_t b = 0; b < placements.size(); ++b)
        {
            const Polygon& built = wall.blocks[b].outline;
            outlines.push_back(placed(built, areaProperties(built).centroid, placements[b]));
        }
        const int blocks = static_cast<int>(outlines.size());
        for (int a = 0; a < blocks; ++a)
        {
            for (int b = a + 1; b < blocks; ++b)
            {
                double least = 1;
                for (const ContactPoint<2>& point : points)
                {
                    if (point.block == a && point.neighbour == b)
                    {
                        least = std::min(least, point.gap);
                    }
                }
                const double depth = wall.blocks[a].support < 0 || wall.blocks[b].support < 0
                                         ? overlapDepth(outlines[a], outlines[b])
                                         : 0;
                if (depth > 1e-5 && depth < 0.03) // far below the deepest that is trusted
                {
                    EXPECT_LE(least, -0.9 * depth) << step << ": " << a << " " << b;
                    EXPECT_GE(least, -2 * depth) << step << ": " << a << " " << b;
                }
                else if (depth == 0)
                {
                    EXPECT_GT(least, -1e-12) << step << ": " << a << " " << b;
                }
            }
        }
    }
}
