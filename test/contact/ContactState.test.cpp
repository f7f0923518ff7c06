// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// States of contact points, and outlines of placed blocks.
#include "contact/ContactState.h"
#include "core/Error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace drystone
{

namespace
{

using testing::ElementsAre;
using Forces = std::vector<Vector<2>>;

std::vector<ContactState> statesOf(const Forces& forces, const std::vector<double>& friction)
{
    return contactStates(forces, friction);
}

TEST(ContactState, IsToldFromTheForce)
{
    const Forces forces{{10, 6.5}, {0, 0}, {4, -1}, {4, -2.6}, {1e-6, 0}};
    EXPECT_THAT(statesOf(forces, std::vector<double>(5, 0.65)),
                ElementsAre(ContactState::sliding, ContactState::open, ContactState::sticking,
                            ContactState::sliding, ContactState::open));
}

TEST(ContactState, OfAFrictionlessPointThatPressesIsSliding)
{
    EXPECT_THAT(statesOf({{1, 0}, {0, 0}}, {0, 0}), ElementsAre(ContactState::sliding, ContactState::open));
    EXPECT_THAT(statesOf({{0, 0}}, {0.6}), ElementsAre(ContactState::open));
    EXPECT_TRUE(statesOf({}, {}).empty());
    EXPECT_THROW(statesOf({{1, 0}}, {}), FatalError);
}

TEST(ContactState, ForcesComeInPairs)
{
    Eigen::VectorXd stacked(4);
    stacked << 10, 6.5, 4, -1;
    EXPECT_EQ(pointForces<2>(stacked), (Forces{{10, 6.5}, {4, -1}}));
    EXPECT_THROW(pointForces<2>(stacked.head(3)), FatalError);
}

TEST(Placement, TurnsABlockAboutItsMassCentreAndMovesIt)
{
    const Block<2> block{{{0.1, 0.2}, {2.1, 0.2}, {2.1, 1.2}, {0.1, 1.2}}, 1, -1};
    EXPECT_EQ(placedOutline(block, {}), block.outline); // to the last bit
    const Polygon turned = placedOutline(block, {{1, -1}, std::numbers::pi / 2});
    // mass centre (1.1 0.7), then at (2.1 -0.3); the corner's arm (-1 -0.5) turns to (0.5 -1)
    EXPECT_NEAR((turned[0] - Vector<2>(2.6, -1.3)).norm(), 0, 1e-15);
    EXPECT_NEAR((turned[2] - Vector<2>(1.6, 0.7)).norm(), 0, 1e-15);
}

} // namespace

} // namespace drystone
