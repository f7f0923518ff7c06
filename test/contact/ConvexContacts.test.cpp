// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What two convex solids meet with: counts, places and axes of simple positions, and random ones against a
/// search among directions.
#include "contact/space/ConvexContacts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace drystone
{
namespace
{

constexpr double tolerance = 1e-6;

ConvexSolid box(const Vector<3>& lower, const Vector<3>& upper)
{
    return convexSolid(makeBox(lower, upper), tolerance);
}

ConvexSolid turnedBox(const Vector<3>& size, const Vector<3>& turn, const Vector<3>& centre)
{
    return placed(box(-size / 2, size / 2), Vector<3>::Zero(), {centre, turn});
}

std::vector<ConvexContact> contactsOf(const ConvexSolid& first, const ConvexSolid& second,
                                      EdgesAlongFaces edgesAlongFaces = EdgesAlongFaces::edges)
{
    return contactsAlong(partingAxis(first, second, tolerance, SharedEdge::rimsMayTouch), first, second,
                         tolerance, edgesAlongFaces);
}

Vector<3> placeOf(const ConvexContact& contact, const ConvexSolid& first, const ConvexSolid& second)
{
    const ConvexSolid& own = contact.isOfFirst ? first : second;
    const Vector<3>& from = own.vertices[static_cast<std::size_t>(contact.from)];
    return from + contact.part * (own.vertices[static_cast<std::size_t>(contact.to)] - from);
}

} // namespace

TEST(ConvexContacts, ASolidHasOneFaceInEachPlane)
{
    Polyhedron shape = makeBox({0, 0, 0}, {1, 2, 3});
    // Its top in two pieces, with a vertex along an edge.
    shape.vertices.emplace_back(0.5, 0, 3);
    shape.vertices.emplace_back(0.5, 2, 3);
    const auto top = std::find_if(shape.faces.begin(), shape.faces.end(),
                                  [&](const std::vector<int>& face)
                                  { return areaVector(shape, face).normalized().z() > 0.9; });
    const std::vector<int> round = *top;
    std::vector<int> left, right;
    for (const int vertex : round)
    {
        (shape.vertices[static_cast<std::size_t>(vertex)].x() < 0.5 ? left : right).push_back(vertex);
    }
    const auto ordered = [&](std::vector<int> face)
    {
        if (areaVector(shape, face).z() < 0)
        {
            std::reverse(face.begin(), face.end());
        }
        return face;
    };
    const auto withEdge = [&](std::vector<int> side)
    {
        // The two corners of a side, then the new vertices in the order that goes round.
        std::sort(side.begin(), side.end(),
                  [&](int a, int b)
                  {
                      return shape.vertices[static_cast<std::size_t>(a)].y()
                             < shape.vertices[static_cast<std::size_t>(b)].y();
                  });
        return ordered({side[0], side[1], 9, 8});
    };
    *top = withEdge(left);
    shape.faces.push_back(withEdge(right));
    const ConvexSolid solid = convexSolid(shape, tolerance);
    EXPECT_EQ(solid.faces.size(), 6u);
    EXPECT_EQ(solid.edges.size(), 12u);
    for (const std::vector<int>& face : solid.faces)
    {
        EXPECT_EQ(face.size(), 4u);
    }
    EXPECT_NEAR(solid.thickness, 1, 1e-12);
}

TEST(ConvexContacts, ABoxOnABoxHasTheCornersOfWhatTheyShare)
{
    const ConvexSolid lower = box({0, 0, 0}, {1, 1, 1});
    // Smaller, shifted over an edge and over a corner, and turned by 45 degrees: an octagon.
    EXPECT_EQ(contactsOf(lower, box({0.2, 0.2, 1}, {0.8, 0.8, 2})).size(), 4u);
    EXPECT_EQ(contactsOf(lower, box({0.5, 0.2, 1}, {1.5, 0.8, 2})).size(), 4u);
    EXPECT_EQ(contactsOf(lower, box({0.5, 0.5, 1}, {1.5, 1.5, 2})).size(), 4u);
    const ConvexSolid turned = turnedBox({1.2, 1.2, 1}, {0, 0, std::numbers::pi / 4}, {0.5, 0.5, 1.5});
    const std::vector<ConvexContact> octagon = contactsOf(lower, turned);
    EXPECT_EQ(octagon.size(), 8u);
    for (const ConvexContact& contact : octagon)
    {
        const Vector<3> place = placeOf(contact, lower, turned);
        EXPECT_NEAR(place.z(), 1, 1e-12);
        // On the rim of both.
        EXPECT_NEAR(std::max(std::abs(place.x() - 0.5), std::abs(place.y() - 0.5)), 0.5, 1e-12);
        EXPECT_NEAR((std::abs(place.x() - 0.5) + std::abs(place.y() - 0.5)) / std::sqrt(2), 0.6, 1e-12);
    }
}

TEST(ConvexContacts, BlocksThatShareAnEdgeOrACornerAloneDoNotMeet)
{
    const ConvexSolid solid = box({0, 0, 0}, {1, 1, 1});
    EXPECT_TRUE(contactsOf(solid, box({1, 0, 1}, {2, 1, 2})).empty());
    EXPECT_TRUE(contactsOf(solid, box({1, 1, 1}, {2, 2, 2})).empty());
    EXPECT_TRUE(contactsOf(solid, box({1.1, 0, 1.2}, {2, 1, 2})).empty());
}

TEST(ConvexContacts, EdgesMeetAcrossEachOther)
{
    const double quarter = std::numbers::pi / 4;
    const ConvexSolid lower = turnedBox({2, 0.2, 0.2}, {quarter, 0, 0}, {0, 0, 0});
    const ConvexSolid upper =
        turnedBox({0.2, 2, 0.2}, {0, quarter, 0}, {0.3, 0.1, 0.2 * std::sqrt(2.0) + 0.01});
    const PartingAxis axis = partingAxis(lower, upper, tolerance, SharedEdge::rimsMayTouch);
    EXPECT_NEAR(axis.distance, 0.01, 1e-12);
    const std::vector<ConvexContact> contacts =
        contactsAlong(axis, lower, upper, tolerance, EdgesAlongFaces::faces);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_TRUE(contacts[0].isEdgeOnEdge);
    EXPECT_LE((placeOf(contacts[0], lower, upper) - Vector<3>(0.3, 0, 0.1 * std::sqrt(2.0))).norm(), 1e-12);
}

// Pressed into each other and a little tilted, as by elastic joints: along the crossing of two edges the
// boxes enter each other least, if by less than 1 mm, and it was the only point, with the force of all.
TEST(ConvexContacts, FacesPressedIntoEachOtherHaveAllTheirCorners)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> symmetric(-1, 1);
    const ConvexSolid lower = box({-0.2, -0.15, 0}, {0.2, 0.15, 0.6});
    for (int trial = 0; trial < 200; ++trial)
    {
        const Vector<3> tilt = 3e-3 * Vector<3>(symmetric(random), symmetric(random), 0);
        const Vector<3> shift(5e-3 * symmetric(random), 5e-3 * symmetric(random), 0.898);
        const ConvexSolid upper = turnedBox({0.4, 0.3, 0.6}, tilt + Vector<3>(0, 0, 0.3), shift);
        std::vector<Vector<3>> places;
        for (const ConvexContact& contact : contactsOf(lower, upper, EdgesAlongFaces::faces))
        {
            const Vector<3> place = placeOf(contact, lower, upper);
            const auto isThere = [&](const Vector<3>& other) { return (other - place).norm() < 1e-3; };
            if (std::abs(place.z() - 0.6) < 0.01 && std::none_of(places.begin(), places.end(), isThere))
            {
                places.push_back(place);
            }
        }
        EXPECT_EQ(places.size(), 8u) << trial;
    }
}

TEST(ConvexContacts, ACornerAboveAFaceIsOne)
{
    const ConvexSolid floor = box({-2, -2, -1}, {2, 2, 0});
    const Vector<3> turn =
        std::acos(1 / std::sqrt(3.0)) * Vector<3>(1, -1, 0).normalized(); // its diagonal upright
    const ConvexSolid cube = turnedBox({1, 1, 1}, turn, {0, 0, std::sqrt(0.75) + 1e-3});
    const PartingAxis axis = partingAxis(floor, cube, tolerance, SharedEdge::rimsMayTouch);
    EXPECT_NEAR(axis.distance, 1e-3, 1e-12);
    const std::vector<ConvexContact> contacts =
        contactsAlong(axis, floor, cube, tolerance, EdgesAlongFaces::faces);
    const auto lowest = std::min_element(contacts.begin(), contacts.end(),
                                         [&](const ConvexContact& a, const ConvexContact& b) {
                                             return placeOf(a, floor, cube).z() < placeOf(b, floor, cube).z();
                                         });
    ASSERT_NE(lowest, contacts.end());
    EXPECT_LE((placeOf(*lowest, floor, cube) - Vector<3>(0, 0, 1e-3)).norm(), 1e-12);
}

// No direction parts two solids more, nor lets them enter each other less, than the axis that is found.
TEST(ConvexContacts, NoDirectionPartsSolidsMoreThanTheAxis)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> symmetric(-1, 1);
    const auto vector = [&] { return Vector<3>(symmetric(random), symmetric(random), symmetric(random)); };
    for (int trial = 0; trial < 200; ++trial)
    {
        const ConvexSolid first = turnedBox({1, 0.7, 0.5}, 3 * vector(), {0, 0, 0});
        const ConvexSolid second = turnedBox({0.6, 0.9, 0.4}, 3 * vector(), vector());
        const PartingAxis axis = partingAxis(first, second, tolerance, SharedEdge::mayTouch);
        double most = -1e9;
        for (int sample = 0; sample < 3000; ++sample)
        {
            const Vector<3> direction = vector().normalized();
            double end = -1e9;
            double begin = 1e9;
            for (const Vector<3>& vertex : first.vertices)
            {
                end = std::max(end, direction.dot(vertex));
            }
            for (const Vector<3>& vertex : second.vertices)
            {
                begin = std::min(begin, direction.dot(vertex));
            }
            most = std::max(most, begin - end);
        }
        // Solids whose nearest parts are corners are farther apart than along any axis of faces and edges.
        EXPECT_GE(axis.distance, std::min(most, 0.0) - 20 * tolerance) << trial;
        EXPECT_LE(axis.distance, most + 0.06) << trial; // directions some 2 degrees apart
        EXPECT_TRUE(most <= 0 || axis.distance > 0) << trial;
    }
}

} // namespace drystone
