// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contact points that are followed in space: which of two corners that were at one place is taken, and that
/// the point stays the same.
#include "contact/space/MovingContacts.h"

#include "geometry/space/Polyhedron.h"

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

/// Two boxes beside each other, faces at x = 0, from z = 0 to 0.2.
Assembly<3> sideBySide()
{
    Assembly<3> assembly;
    assembly.blocks = {{makeBox({-0.4, 0, 0}, {0, 0.1, 0.2}), -1}, {makeBox({0, 0, 0}, {0.4, 0.1, 0.2}), -1}};
    return assembly;
}

/// Points of the joint after the second block has risen by so much.
std::vector<ContactPoint<3>> risenBy(MovingContacts<3>& contacts, double rise)
{
    std::vector<Placement<3>> placements(2);
    placements[1].translation = Vector<3>(0, 0, rise);
    return contacts.update(placements, 0);
}

TEST(SpaceMovingContacts, OfTwoCornersThatSlidePastEachOtherThatOnTheFaceIsTaken)
{
    MovingContacts<3> contacts(sideBySide());
    const std::vector<ContactPoint<3>> asBuilt = risenBy(contacts, 0);
    ASSERT_EQ(asBuilt.size(), 4u);
    for (const double rise : {1e-13, 1e-7, 1e-3, -1e-3})
    {
        const std::vector<ContactPoint<3>> points = risenBy(contacts, rise);
        ASSERT_EQ(points.size(), 4u);
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            // Where the faces end that lie on each other: from the lower end of the higher block to the upper
            // end of the other.
            const bool isAtUpperEnd = asBuilt[i].position.z() > 0.1;
            const double end = isAtUpperEnd ? 0.2 + std::min(0.0, rise) : std::max(0.0, rise);
            EXPECT_NEAR(points[i].position.z(), end, 1e-12) << "rise " << rise;
            EXPECT_NEAR(points[i].gap, 0, 1e-15);
            EXPECT_NEAR(points[i].normal.x(), -1, 1e-15) << "into the first block";
            EXPECT_TRUE(isSameFeature<3>(points[i].feature, asBuilt[i].feature));
            for (std::size_t j = 0; j < i; ++j)
            {
                EXPECT_FALSE(isSameFeature<3>(points[i].feature, points[j].feature));
            }
        }
    }
    // Rounding does not decide.
    for (const ContactPoint<3>& point : risenBy(contacts, 1e-13))
    {
        EXPECT_EQ(point.feature.vertexBlock, 0);
    }
    EXPECT_EQ(contacts.pointAt(std::vector<Placement<3>>(2), 0).position, asBuilt[0].position);
}

} // namespace
} // namespace drystone
