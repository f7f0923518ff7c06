// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "io/space/PaintingOrder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace drystone
{
namespace
{

/// A box from its lower to its upper corner.
ShownBlock boxAt(const Vector<3>& lower, const Vector<3>& upper, const View& view)
{
    ShownBlock block;
    for (int corner = 0; corner < 8; ++corner)
    {
        const auto at = [&](int axis) { return (corner >> axis) % 2 == 0 ? lower[axis] : upper[axis]; };
        block.shape.vertices.emplace_back(at(0), at(1), at(2));
        extend<2>(block.box, view.seen(block.shape.vertices.back()));
    }
    block.shape.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    block.centre = (lower + upper) / 2;
    return block;
}

// Seen from above a small box lies on a large one whose centre is nearer to the viewer than its own.
TEST(PaintingOrder, OfABoxOnALargerOneFollowsTheFaceBetweenThem)
{
    const View view = axonometricView(Vector<3>(0, -1, 1).normalized());
    const ShownBlock large = boxAt({0, 0, 0}, {10, 10, 1}, view);
    const ShownBlock small = boxAt({4, 9, 1}, {5, 10, 1.2}, view);
    ASSERT_GT(view.towardsViewer.dot(large.centre), view.towardsViewer.dot(small.centre));
    EXPECT_EQ(paintingOrder({small, large}, view), std::vector({1, 0}));
    EXPECT_EQ(paintingOrder({large, small}, view), std::vector({0, 1}));
}

// Four bars round a square, each over the next: there is no order, and all are painted once.
TEST(PaintingOrder, OfARingHasEachBlockOnce)
{
    const View view = axonometricView({0, 0, 1});
    const auto bar = [&](const Vector<3>& lower, const Vector<3>& upper, const Vector<3>& rise)
    {
        ShownBlock block = boxAt(lower, upper, view);
        for (Vector<3>& vertex : block.shape.vertices)
        {
            vertex.z() += rise.dot(vertex - lower);
        }
        return block;
    };
    std::vector<ShownBlock> ring{
        bar({0, 0, 0}, {4, 1, 0.1}, {1, 0, 0}), bar({3, 0, 0}, {4, 4, 0.1}, {0, 1, 0}),
        bar({0, 3, 4}, {4, 4, 4.1}, {-1, 0, 0}), bar({0, 0, 4}, {1, 4, 4.1}, {0, -1, 0})};
    std::vector<int> order = paintingOrder(ring, view);
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, std::vector({0, 1, 2, 3}));
}

TEST(PaintingOrder, OfBlocksApartIsByTheirDistance)
{
    const View view = axonometricView({0, -1, 0});
    const std::vector<ShownBlock> row{boxAt({0, 0, 0}, {1, 1, 1}, view), boxAt({2, 4, 0}, {3, 5, 1}, view),
                                      boxAt({4, 2, 0}, {5, 3, 1}, view)};
    EXPECT_EQ(paintingOrder(row, view), std::vector({1, 2, 0}));
    EXPECT_TRUE(paintingOrder({}, view).empty());
}

} // namespace
} // namespace drystone
