// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Orders of elimination: of all bodies, the same whichever way couplings are written, and sparse.
#include "linear/EliminationOrder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace drystone
{
namespace
{

std::vector<Coupling> grid(int width, int height)
{
    std::vector<Coupling> couplings;
    for (int y = 0; y < height; ++y)
    {
        for (int x = 0; x < width; ++x)
        {
            const int body = y * width + x;
            if (x + 1 < width)
            {
                couplings.push_back({body, body + 1});
            }
            if (y + 1 < height)
            {
                couplings.push_back({body, body + width});
            }
        }
    }
    return couplings;
}

bool hasAll(std::vector<int> order, int bodies)
{
    std::sort(order.begin(), order.end());
    for (int body = 0; body < bodies; ++body)
    {
        if (order.size() != static_cast<std::size_t>(bodies) || order[static_cast<std::size_t>(body)] != body)
        {
            return false;
        }
    }
    return true;
}

} // namespace

TEST(EliminationOrder, TheHubOfAStarComesLast)
{
    std::vector<Coupling> star;
    for (int body = 1; body < 8; ++body)
    {
        star.push_back({0, body});
    }
    const std::vector<int> order = eliminationOrder(8, star);
    ASSERT_TRUE(hasAll(order, 8));
    // The last spoke and the hub are a pair of equals.
    EXPECT_TRUE(order[7] == 0 || order[6] == 0);
}

TEST(EliminationOrder, BodiesThatTouchNothingKeepTheirOrder)
{
    EXPECT_TRUE(eliminationOrder(0, {}).empty());
    EXPECT_EQ(eliminationOrder(3, {}), (std::vector<int>{0, 1, 2}));
    EXPECT_EQ(eliminationOrder(2, {{1, 1}}), (std::vector<int>{0, 1})) << "with itself is with nobody";
}

/// Hard: by minimum degree and by dissection, couplings twice, turned and in another order.
TEST(EliminationOrder, IsTheSameForTheSameCouplings)
{
    for (const int width : {5, 30, 80})
    {
        const int bodies = width * width;
        std::vector<Coupling> couplings = grid(width, width);
        const std::vector<int> order = eliminationOrder(bodies, couplings);
        EXPECT_TRUE(hasAll(order, bodies)) << width;
        const std::vector<Coupling> once = couplings;
        for (const Coupling& pair : once)
        {
            couplings.push_back({pair[1], pair[0]});
        }
        std::shuffle(couplings.begin(), couplings.end(), std::mt19937(1));
        EXPECT_EQ(eliminationOrder(bodies, couplings), order) << width;
    }
}

TEST(EliminationOrder, PlacesAreItsInverse)
{
    const std::vector<int> order{2, 0, 3, 1};
    const std::vector<int> places = placesIn(order);
    EXPECT_EQ(places, (std::vector<int>{1, 3, 0, 2}));
    EXPECT_EQ(placesIn(places), order);
    EXPECT_TRUE(placesIn({}).empty());
}

TEST(EliminationOrder, CouplingsOfPlacesKeepTheirSides)
{
    const std::vector<int> places{1, 3, 0, 2};
    EXPECT_EQ(couplingsByPlace({{0, 1}, {3, 2}}, places), (std::vector<Coupling>{{1, 3}, {2, 0}}));
    EXPECT_TRUE(couplingsByPlace({}, places).empty());
}

} // namespace drystone
