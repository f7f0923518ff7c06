// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Joints between blocks of every shape.
#include "assembly/ContactPoint.h"
#include "assembly/Equilibrium.h"

#include <gtest/gtest.h>

using namespace drystone;

namespace
{

Polygon rectangle(double x0, double y0, double x1, double y1)
{
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

TEST(ContactPoint, ABlockOnTheGroundTouchesAtItsTwoCornersWithTheNormalIntoIt)
{
    Assembly<2> assembly{{{rectangle(0, 0, 1, 1)}, {rectangle(-5, -1, 5, 0), 1, 0}}, {{"ground", "ground"}}};
    const auto points = findContactPoints(assembly);
    ASSERT_EQ(points.size(), 2U);
    EXPECT_EQ(points[0].block, 0);
    EXPECT_EQ(points[0].neighbour, 1);
    EXPECT_EQ(points[0].normal, Vector<2>(0, 1));
    EXPECT_EQ(points[0].position, Vector<2>(0, 0));
    EXPECT_EQ(points[1].position, Vector<2>(1, 0));
    EXPECT_EQ(points[0].joint, points[1].joint);
}

TEST(ContactPoint, BlocksThatMeetAtACornerAloneHaveNoJoint)
{
    Assembly<2> assembly{{{rectangle(0, 0, 1, 1)}, {rectangle(1, 1, 2, 2)}}, {}};
    EXPECT_TRUE(findContactPoints(assembly).empty());
}

TEST(ContactPoint, VerticesThatSplitAnEdgeDoNotDoubleThePoints)
{
    Assembly<2> assembly{{{{{0, 0}, {0.25, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}}},
                          {{{-1, -1}, {2, -1}, {2, 0}, {0.7, 0}, {0.1, 0}, {-1, 0}}}},
                         {}};
    EXPECT_EQ(findContactPoints(assembly).size(), 2U);
}

TEST(ContactPoint, ABlockThatSitsInAConcaveOneHasAJointForEachFace)
{
    Assembly<2> assembly{
        {{{{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}}, {rectangle(1, 1, 2, 2)}}, {}};
    EXPECT_EQ(findContactPoints(assembly).size(), 6U);
}

TEST(ContactPoint, ForcesOnTheTwoBlocksCancelAndMakeNoMomentTogether)
{
    Assembly<2> assembly{{{rectangle(0, 0, 1, 1)}, {rectangle(0.3, 1, 2, 1.5)}}, {}};
    const auto points = findContactPoints(assembly);
    const auto masses = blockMasses(assembly);
    const auto columns = equilibriumColumns(assembly, masses, points);
    ASSERT_EQ(columns.size(), 2U);
    for (std::size_t k = 0; k < columns.size(); ++k)
    {
        for (int j = 0; j < 2; ++j)
        {
            const auto onBlock = columns[k].onBlock.col(j);
            const auto onNeighbour = columns[k].onNeighbour.col(j);
            EXPECT_EQ(onBlock.head<2>(), -onNeighbour.head<2>());
            const double moment = onBlock(2) + cross(masses[0].centroid, onBlock.head<2>()) + onNeighbour(2)
                                  + cross(masses[1].centroid, onNeighbour.head<2>());
            EXPECT_NEAR(moment, 0, 1e-15);
        }
        // Lifting the block by d along the normal opens the gap by d: gap = g0 - A0' dx.
        EXPECT_NEAR(-columns[k].onBlock.col(0).head<2>().dot(points[k].normal), 1, 1e-15);
    }
}

} // namespace
