// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The broad phase finds exactly the pairs that a comparison of all pairs finds.
#include "geometry/BroadPhase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace drystone;

namespace
{

std::vector<std::pair<int, int>> allPairs(const std::vector<BoundingBox>& boxes)
{
    std::vector<std::pair<int, int>> pairs;
    for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
    {
        for (int j = i + 1; j < static_cast<int>(boxes.size()); ++j)
        {
            if (meet(boxes[i], boxes[j]))
            {
                pairs.emplace_back(i, j);
            }
        }
    }
    return pairs;
}

} // namespace

TEST(BroadPhase, BoxOfAPolygonHoldsItsVertices)
{
    const BoundingBox box = boundingBox({{1, 2}, {4, -1}, {3, 5}});
    EXPECT_EQ(box.lower, Vector<2>(1, -1));
    EXPECT_EQ(box.upper, Vector<2>(4, 5));
    EXPECT_TRUE(contains(enlarged(box, 0.5), box));
    EXPECT_FALSE(contains(box, enlarged(box, 1e-9)));
}

TEST(BroadPhase, NoBoxesGiveNoPairs)
{
    EXPECT_TRUE(findMeetingPairs({}).empty());
    EXPECT_TRUE(findMeetingPairs({boundingBox({{0, 0}, {1, 1}})}).empty());
}

TEST(BroadPhase, BoxesThatTouchMeetAndEmptyBoxesMeetNothing)
{
    const std::vector<BoundingBox> boxes{{{0, 0}, {1, 1}}, {{1, 1}, {2, 2}}, {}, {{2.1, 0}, {3, 1}}, {}};
    EXPECT_EQ(findMeetingPairs(boxes), (std::vector<std::pair<int, int>>{{0, 1}}));
}

TEST(BroadPhase, AgreesWithAllPairsOnRandomBoxesOfVeryDifferentSizes)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int round = 0; round < 60; ++round)
    {
        std::vector<BoundingBox> boxes(1 + 7 * round);
        for (BoundingBox& box : boxes)
        {
            box.lower = {unit(random), unit(random)};
            const Vector<2> size{std::pow(unit(random), 6), std::pow(unit(random), 6)};
            box.upper = box.lower + size;
        }
        EXPECT_EQ(findMeetingPairs(boxes), allPairs(boxes));
    }
}

TEST(BroadPhase, AgreesWithAllPairsWhenAllBoxesAreTheSame)
{
    const std::vector<BoundingBox> boxes(50, BoundingBox{{0, 0}, {1, 1}});
    EXPECT_EQ(findMeetingPairs(boxes).size(), 50U * 49U / 2U);
}

TEST(BroadPhase, AgreesWithAllPairsOnARegularWall)
{
    std::vector<BoundingBox> boxes;
    for (int row = 0; row < 12; ++row)
    {
        for (int column = 0; column < 12; ++column)
        {
            const Vector<2> corner{column + 0.5 * (row % 2), row};
            boxes.push_back({corner, corner + Vector<2>(1, 1)});
        }
    }
    boxes.push_back({{-100, -1}, {100, 0}});
    EXPECT_EQ(findMeetingPairs(boxes), allPairs(boxes));
}

TEST(BroadPhase, PairsOfTwoListsAreThoseThatAComparisonOfAllFinds)
{
    std::mt19937 random(8);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int round = 0; round < 40; ++round)
    {
        std::vector<Box<3>> lists[2];
        for (int list = 0; list < 2; ++list)
        {
            lists[list].resize(static_cast<std::size_t>(round * (list + 2)));
            for (Box<3>& box : lists[list])
            {
                box.lower = {unit(random), unit(random), unit(random)};
                box.upper =
                    box.lower + Vector<3>(std::pow(unit(random), 6), std::pow(unit(random), 3), unit(random));
            }
        }
        if (round > 3)
        {
            lists[1][2] = Box<3>(); // empty
        }
        std::vector<std::pair<int, int>> expected;
        for (std::size_t i = 0; i < lists[0].size(); ++i)
        {
            for (std::size_t j = 0; j < lists[1].size(); ++j)
            {
                if (meet(lists[0][i], lists[1][j]))
                {
                    expected.emplace_back(int(i), int(j));
                }
            }
        }
        EXPECT_EQ(findMeetingPairs<3>(lists[0], lists[1]), expected) << "round " << round;
    }
}
