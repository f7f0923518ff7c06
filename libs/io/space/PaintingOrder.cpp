// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Relations of pairs of blocks that are seen over each other, sorted topologically.
#include "io/space/PaintingOrder.h"

#include "geometry/BroadPhase.h"
#include "geometry/Polygon.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace drystone
{
namespace
{

/// How far `other` is in front of a plane of a face of `one`: positive when all of it is.
double leastHeight(const ShownBlock& other, const Vector<3>& origin, const Vector<3>& normal)
{
    double least = std::numeric_limits<double>::max();
    for (const Vector<3>& vertex : other.shape.vertices)
    {
        least = std::min(least, normal.dot(vertex - origin));
    }
    return least;
}

/// Whether `one` is to be painted before `other`.
bool isBehind(const ShownBlock& one, const ShownBlock& other, const View& view)
{
    // The plane that has the most room between the two decides; rounding must not.
    double best = -std::numeric_limits<double>::max();
    bool result = view.towardsViewer.dot(one.centre) < view.towardsViewer.dot(other.centre);
    for (const auto& [owner, stranger] : {std::pair(&one, &other), std::pair(&other, &one)})
    {
        for (const std::vector<int>& face : owner->shape.faces)
        {
            const Vector<3> normal = areaVector(owner->shape, face).normalized();
            const double slope = normal.dot(view.towardsViewer);
            if (std::abs(slope) < 1e-3)
            {
                continue;
            }
            const double room =
                leastHeight(*stranger, owner->shape.vertices[static_cast<std::size_t>(face.front())], normal);
            if (room > best)
            {
                best = room;
                // The stranger is beyond the face: in front of the owner if the face looks at the viewer.
                result = (slope > 0) == (owner == &one);
            }
        }
    }
    return result;
}

Polygon seenCorners(const ShownBlock& block, const View& view)
{
    Polygon places;
    for (const Vector<3>& vertex : block.shape.vertices)
    {
        places.push_back(view.seen(vertex));
    }
    return places;
}

/// How far places reach along a direction: from, to.
std::pair<double, double> rangeAlong(const Polygon& places, const Vector<2>& direction)
{
    double least = std::numeric_limits<double>::max();
    double most = -least;
    for (const Vector<2>& place : places)
    {
        least = std::min(least, direction.dot(place));
        most = std::max(most, direction.dot(place));
    }
    return {least, most};
}

/// Whether two blocks hide parts of each other, as far as their hulls go: no line along an edge of either, as
/// it is seen, has them on its two sides. Where they do not, either may be painted first, and a relation
/// between them would only close rings of others.
bool isOverlapping(const ShownBlock& one, const ShownBlock& other, const View& view)
{
    const Polygon ofOne = seenCorners(one, view);
    const Polygon ofOther = seenCorners(other, view);
    const Vector<2> extent = one.box.upper - one.box.lower + other.box.upper - other.box.lower;
    const double touching = 1e-6 * extent.maxCoeff(); // neighbours that only touch hide nothing
    for (const auto& [shape, places] : {std::pair(&one.shape, &ofOne), std::pair(&other.shape, &ofOther)})
    {
        for (const std::vector<int>& face : shape->faces)
        {
            for (std::size_t corner = 0; corner < face.size(); ++corner)
            {
                const Vector<2> edge = (*places)[face[(corner + 1) % face.size()]] - (*places)[face[corner]];
                if (edge.norm() <= touching)
                {
                    continue;
                }
                const Vector<2> across = Vector<2>(edge.y(), -edge.x()).normalized();
                const auto [leastOne, mostOne] = rangeAlong(ofOne, across);
                const auto [leastOther, mostOther] = rangeAlong(ofOther, across);
                if (std::min(mostOne, mostOther) - std::max(leastOne, leastOther) <= touching)
                {
                    return false;
                }
            }
        }
    }
    return true;
}

/// Which blocks have to wait for which.
struct Relations
{
    std::vector<std::vector<int>> inFront; ///< of each block: those that it is behind
    std::vector<int> behind;               ///< how many are to be painted before each
};

Relations relationsOf(const std::vector<ShownBlock>& shown, const View& view)
{
    std::vector<Box<2>> boxes;
    for (const ShownBlock& block : shown)
    {
        boxes.push_back(block.box);
    }
    Relations relations{std::vector<std::vector<int>>(shown.size()), std::vector<int>(shown.size(), 0)};
    for (const auto& [one, other] : findMeetingPairs(boxes))
    {
        if (isOverlapping(shown[one], shown[other], view))
        {
            const bool isOneFirst = isBehind(shown[one], shown[other], view);
            relations.inFront[isOneFirst ? one : other].push_back(isOneFirst ? other : one);
            ++relations.behind[isOneFirst ? other : one];
        }
    }
    return relations;
}

/// How far the centre of a block is towards the viewer [m], and its index.
using BlockAtDepth = std::pair<double, int>;
using FarthestFirst = std::priority_queue<BlockAtDepth, std::vector<BlockAtDepth>, std::greater<>>;

} // namespace

std::vector<int> paintingOrder(const std::vector<ShownBlock>& shown, const View& view)
{
    Relations relations = relationsOf(shown, view);
    FarthestFirst ready; // those that wait for none
    std::vector<BlockAtDepth> all;
    for (std::size_t i = 0; i < shown.size(); ++i)
    {
        all.emplace_back(view.towardsViewer.dot(shown[i].centre), static_cast<int>(i));
        if (relations.behind[i] == 0)
        {
            ready.push(all.back());
        }
    }
    std::vector<BlockAtDepth> sorted = all;
    std::sort(sorted.begin(), sorted.end());
    std::vector<char> isPainted(shown.size(), false);
    auto left = sorted.begin(); // all before it are painted
    const auto takeNext = [&]
    {
        if (!ready.empty())
        {
            const int next = ready.top().second;
            ready.pop();
            return next;
        }
        // All that are left wait for each other: the farthest of them.
        left = std::find_if(left, sorted.end(),
                            [&](const BlockAtDepth& block) { return !isPainted[block.second]; });
        return left->second;
    };
    std::vector<int> order;
    while (order.size() < shown.size())
    {
        const int next = takeNext();
        isPainted[next] = true;
        order.push_back(next);
        for (const int other : relations.inFront[next])
        {
            if (--relations.behind[other] == 0 && !isPainted[other])
            {
                ready.push(all[other]);
            }
        }
    }
    return order;
}

} // namespace drystone
