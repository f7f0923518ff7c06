// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which corner of two blocks faces which edge: the choice of features of MovingContacts.
#include "contact/MovingContacts.h"

#include "contact/EdgeNormal.h"
#include "geometry/PolygonShape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace drystone
{
namespace
{

/// Edges are paired as faces of one joint up to this angle from parallel. Beyond it the far end of a face
/// stands off by a quarter of its length, and the common direction says little about which corner an edge
/// will meet.
const double leastOpposing = std::cos(15 * std::numbers::pi / 180);

/// Corners of two blocks this close, relative to the tolerance, are at the same place: then the corner of
/// `block` is taken, so that rounding errors do not decide.
constexpr double sameCorner = 1e-3;

/// A corner that is deep behind an edge may have come round its end if that is no farther away than so many
/// times its depth: edges that pass it there are turned against each other by a tenth and more.
constexpr double reachRoundEnd = 10;

/// A corner is foremost towards an edge if its own edges recede from it, up to this angle [rad]: then the
/// line of the edge parts the blocks near there.
constexpr double nearlyForemost = 0.02;

/// Whether the segments from a to b and from c to d cross each other between their ends.
bool segmentsCross(const Vector<2>& a, const Vector<2>& b, const Vector<2>& c, const Vector<2>& d)
{
    return cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

} // namespace

MovingContacts<2>::Candidate MovingContacts<2>::measured(int owner, int corner, int edge,
                                                         int pairedEdge) const
{
    Candidate candidate{owner, corner, edge, pairedEdge, 0, 0, 0};
    candidate.opposing = -placedAhead->tangent[edge].dot(placedAhead->tangent[pairedEdge]);
    candidate.gap =
        (placedNow.corner[corner] - placedNow.corner[edge]).dot(outwardNormal(placedNow.tangent[edge]));
    candidate.gapAhead = placedAhead == &placedNow ? candidate.gap
                                                   : (placedAhead->corner[corner] - placedAhead->corner[edge])
                                                         .dot(outwardNormal(placedAhead->tangent[edge]));
    return candidate;
}

bool MovingContacts<2>::isForemost(const Candidate& candidate, const Outlines& at, double angle) const
{
    const Vector<2> reversed = -at.tangent[candidate.edge];
    return cross(at.tangent[previous[candidate.corner]], reversed) >= -angle
           && cross(reversed, at.tangent[candidate.corner]) >= -angle;
}

MovingContacts<2>::CornerLines MovingContacts<2>::linesBetween(int blockCorner, int neighbourCorner,
                                                               const Outlines& at, double angle) const
{
    CornerLines lines;
    for (const int owner : {0, 1})
    {
        const int corner = owner == 0 ? blockCorner : neighbourCorner;
        const int other = owner == 0 ? neighbourCorner : blockCorner;
        for (const int edge : {previous[other], other})
        {
            const bool leavingFaces =
                at.tangent[edge].dot(at.tangent[corner]) < at.tangent[edge].dot(at.tangent[previous[corner]]);
            const Candidate line = measured(owner, corner, edge, leavingFaces ? corner : previous[corner]);
            if (isForemost(line, at, angle))
            {
                lines.line[lines.count++] = line;
            }
        }
    }
    return lines;
}

bool MovingContacts<2>::holds(int block, const Vector<2>& point, double reach) const
{
    bool isInside = false;
    double distance = std::numeric_limits<double>::max();
    for (int edge = first[block]; edge < first[block + 1]; ++edge)
    {
        const Vector<2>& a = placedNow.corner[edge];
        const Vector<2>& b = placedNow.corner[next[edge]];
        if ((a.y() > point.y()) != (b.y() > point.y())
            && point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
        {
            isInside = !isInside;
        }
        distance = std::min(distance, drystone::distance(point, a, b));
    }
    return isInside || distance <= reach;
}

int MovingContacts<2>::nearerEnd(const Candidate& candidate) const
{
    const int edge = candidate.edge;
    const double foot =
        (placedNow.corner[candidate.corner] - placedNow.corner[edge]).dot(placedNow.tangent[edge]);
    return 2 * foot < edgeLength[edge] ? edge : next[edge];
}

bool MovingContacts<2>::isOverlapped(const Candidate& candidate) const
{
    const int cornerBlock = candidate.owner == 0 ? pairBlock : pairNeighbour;
    const int edgeBlock = candidate.owner == 0 ? pairNeighbour : pairBlock;
    const Vector<2>& corner = placedNow.corner[candidate.corner];
    const int end = nearerEnd(candidate);
    // The corner is inside, or (it may lie beyond the end of the edge) the end of the edge is, or their edges
    // cross.
    if (holds(edgeBlock, corner, pointTolerance) || holds(cornerBlock, placedNow.corner[end], pointTolerance))
    {
        return true;
    }
    for (const int a : {previous[candidate.corner], candidate.corner})
    {
        for (const int b : {previous[end], end})
        {
            if (segmentsCross(placedNow.corner[a], placedNow.corner[next[a]], placedNow.corner[b],
                              placedNow.corner[next[b]]))
            {
                return true;
            }
        }
    }
    return false;
}

MovingContacts<2>::Candidate MovingContacts<2>::partingLine(const Candidate& candidate) const
{
    Candidate best{0, -1, -1, -1, 0, 0, 0};
    const int end = nearerEnd(candidate);
    const double reach = 10 * candidate.gap;
    if (isConvexCorner[candidate.corner] && isConvexCorner[end]
        && (placedNow.corner[candidate.corner] - placedNow.corner[end]).squaredNorm() <= reach * reach)
    {
        const bool cornerIsTheBlocks = candidate.owner == 0;
        const CornerLines lines = linesBetween(cornerIsTheBlocks ? candidate.corner : end,
                                               cornerIsTheBlocks ? end : candidate.corner, placedNow, 0);
        for (int i = 0; i < lines.count; ++i)
        {
            const Candidate& line = lines.line[i];
            if (line.gap >= -pointTolerance && (best.edge < 0 || line.gapAhead > best.gapAhead))
            {
                best = line;
            }
        }
    }
    return best;
}

void MovingContacts<2>::offer(const Candidate& candidate, double lowest, double margin)
{
    if (!(candidate.gap >= lowest && candidate.gap <= margin))
    {
        return;
    }
    if (candidate.gap < -10 * pointTolerance)
    {
        // Looked at where the blocks are heading, an edge was chosen that the corner is already behind.
        // Either another line at these corners still parts the blocks, then that is their contact, or they do
        // overlap.
        const Candidate parting = partingLine(candidate);
        if (parting.edge >= 0)
        {
            if (parting.gap <= margin)
            {
                list(parting);
            }
            return;
        }
        if (!isOverlapped(candidate))
        {
            return;
        }
    }
    list(candidate);
}

void MovingContacts<2>::list(const Candidate& candidate)
{
    // A blunt corner can face the same edge with both of its own: the more parallel one makes the joint.
    for (Candidate& other : candidates)
    {
        if (other.corner == candidate.corner && other.edge == candidate.edge)
        {
            if (candidate.opposing > other.opposing)
            {
                other = candidate;
            }
            return;
        }
    }
    candidates.push_back(candidate);
}

/// Most pairs of parallel edges are far apart. Within 15 degrees no gap lies beyond those of the ends by a
/// tenth.
inline bool MovingContacts<2>::mayMeet(int blockEdge, int neighbourEdge, double lowest, double margin) const
{
    const Vector<2> normal = outwardNormal(placedNow.tangent[neighbourEdge]);
    const Vector<2>& corner = placedNow.corner[neighbourEdge];
    const double firstGap = (placedNow.corner[blockEdge] - corner).dot(normal);
    const double lastGap = (placedNow.corner[next[blockEdge]] - corner).dot(normal);
    return std::min(firstGap, lastGap) <= 1.1 * margin && std::max(firstGap, lastGap) >= 1.1 * lowest;
}

void MovingContacts<2>::matchEdges(int blockEdge, int neighbourEdge, double lowest, double margin)
{
    // Both edges are measured along their common direction. It halves the angle between them, so that neither
    // is preferred, and of two corners that face each other at an end of the piece exactly one is the inner
    // one.
    const Vector<2> along =
        (placedAhead->tangent[neighbourEdge] - placedAhead->tangent[blockEdge]).normalized();
    const Vector<2>& origin = placedAhead->corner[neighbourEdge];
    const double neighbourEnds[2] = {0, (placedAhead->corner[next[neighbourEdge]] - origin).dot(along)};
    const double blockEnds[2] = {(placedAhead->corner[next[blockEdge]] - origin).dot(along),
                                 (placedAhead->corner[blockEdge] - origin).dot(along)};
    const double low = std::max(blockEnds[0], neighbourEnds[0]);
    const double high = std::min(blockEnds[1], neighbourEnds[1]);
    if (high - low <= pointTolerance)
    {
        return;
    }
    for (const int end : {0, 1})
    {
        const int blockCorner = end == 0 ? next[blockEdge] : blockEdge;
        const int neighbourCorner = end == 0 ? neighbourEdge : next[neighbourEdge];
        const double inward = (blockEnds[end] - neighbourEnds[end]) * (end == 0 ? 1 : -1);
        // A re-entrant corner stands against nothing: what reaches it is the corner that lies in it.
        const bool blockIsInner = isConvexCorner[blockCorner] == isConvexCorner[neighbourCorner]
                                      ? inward >= -sameCorner * pointTolerance
                                      : isConvexCorner[blockCorner] != 0;
        Candidate chosen = blockIsInner ? measured(0, blockCorner, neighbourEdge, blockEdge)
                                        : measured(1, neighbourCorner, blockEdge, neighbourEdge);
        if (chosen.gap < -pointTolerance && std::abs(inward) <= reachRoundEnd * -chosen.gap)
        {
            // Where the faces close towards this end, either line alone keeps the blocks apart. Never take
            // one that is already violated while the other is not: the corner did not come that way. But a
            // corner in the middle of a long edge has come through it, as one on a spring does.
            const Candidate outer = blockIsInner ? measured(1, neighbourCorner, blockEdge, neighbourEdge)
                                                 : measured(0, blockCorner, neighbourEdge, blockEdge);
            if (chosen.gapAhead >= outer.gapAhead && outer.gap >= -pointTolerance)
            {
                chosen = outer;
            }
        }
        offer(chosen, lowest, margin);
    }
}

void MovingContacts<2>::standCorners(int owner, int cornerBlock, int edgeBlock, double lowest, double margin)
{
    const Outlines& at = *placedAhead;
    for (int corner = first[cornerBlock]; corner < first[cornerBlock + 1]; ++corner)
    {
        const Vector<2>& position = at.corner[corner];
        const BoundingBox& box = reaches[edgeBlock];
        if (!isConvexCorner[corner] || position.x() < box.lower.x() - margin
            || position.x() > box.upper.x() + margin || position.y() < box.lower.y() - margin
            || position.y() > box.upper.y() + margin)
        {
            continue;
        }
        const Vector<2>& arriving = at.tangent[previous[corner]];
        const Vector<2>& leaving = at.tangent[corner];
        for (int edge = first[edgeBlock]; edge < first[edgeBlock + 1]; ++edge)
        {
            // The corner is foremost towards the edge if the reversed edge direction lies between those of
            // the corner's own edges.
            const Vector<2> reversed = -at.tangent[edge];
            const double towardsArriving = arriving.dot(reversed);
            const double towardsLeaving = leaving.dot(reversed);
            if (cross(arriving, reversed) <= 0 || cross(reversed, leaving) <= 0
                || std::max(towardsArriving, towardsLeaving) >= leastOpposing)
            {
                continue;
            }
            const double foot = (position - at.corner[edge]).dot(at.tangent[edge]);
            if (foot <= pointTolerance || foot >= edgeLength[edge] - pointTolerance)
            {
                continue;
            }
            offer(measured(owner, corner, edge, towardsLeaving > towardsArriving ? corner : previous[corner]),
                  lowest, margin);
        }
    }
}

bool MovingContacts<2>::guardCorners(double margin)
{
    // Two corners apart, each beyond the other's edges. Any one line that parts them is enough. A line with
    // which they are level comes first: along it they slide, or have just lost contact, and any other one
    // would be a wall across the way of a block that slides over flush blocks. Else it is the line that the
    // motion ahead leaves the most room: it binds only if the step turns out otherwise than foreseen, and
    // then by no more than that change. Where the motion ahead goes far through all of them it is one of them
    // that has to stop it. At corners at one place every line is level: they are left alone, as where four
    // blocks meet, but where the motion ahead crosses all the lines; then they get the one that it crosses
    // last.
    const double level = 10 * pointTolerance;
    const auto isBetter = [level](const Candidate& line, const Candidate& best)
    {
        const bool isLevel = std::abs(line.gap) <= level;
        const bool isBestLevel = std::abs(best.gap) <= level;
        return best.edge < 0 || (isLevel && !isBestLevel)
               || (isLevel == isBestLevel && line.gapAhead > best.gapAhead);
    };
    const auto bestLine = [&](int blockCorner, int neighbourCorner)
    {
        Candidate best{0, -1, -1, -1, 0, 0, 0};
        const CornerLines lines = linesBetween(blockCorner, neighbourCorner, *placedAhead, nearlyForemost);
        for (int i = 0; i < lines.count; ++i)
        {
            const Candidate& line = lines.line[i];
            if (line.gap >= -pointTolerance && isBetter(line, best))
            {
                best = line;
            }
        }
        return best;
    };
    bool leavesSome = false;
    for (int blockCorner = first[pairBlock]; blockCorner < first[pairBlock + 1]; ++blockCorner)
    {
        for (int neighbourCorner = first[pairNeighbour]; neighbourCorner < first[pairNeighbour + 1];
             ++neighbourCorner)
        {
            const double apart =
                (placedNow.corner[blockCorner] - placedNow.corner[neighbourCorner]).squaredNorm();
            if (!isConvexCorner[blockCorner] || !isConvexCorner[neighbourCorner] || apart > margin * margin)
            {
                continue;
            }
            const bool areAtOnePlace = apart < level * level;
            const Candidate best = bestLine(blockCorner, neighbourCorner);
            const bool closes = best.gap - best.gapAhead > sameCorner * pointTolerance;
            const bool passesAll = best.gap > level && best.gapAhead < -level;
            if (best.edge >= 0 && (areAtOnePlace ? closes : passesAll || best.gapAhead > pointTolerance))
            {
                offer(best, -pointTolerance, margin);
            }
            else
            {
                leavesSome = leavesSome || areAtOnePlace;
            }
        }
    }
    return leavesSome;
}

void MovingContacts<2>::guardOnEachWay(double margin)
{
    const bool leavesSome = guardCorners(margin);
    for (const Outlines& heading : otherHeadings)
    {
        if (!leavesSome || !candidates.empty())
        {
            break;
        }
        placedAhead = &heading;
        guardCorners(margin);
        placedAhead = &aheadStorage;
    }
    if (leavesSome && candidates.empty())
    {
        leftAlone.emplace_back(pairBlock, pairNeighbour);
    }
}

bool MovingContacts<2>::excludeEachOther(const Candidate& a, const Candidate& b) const
{
    if (a.corner == b.corner)
    {
        const bool meetInside = (next[a.edge] == b.edge && !isConvexCorner[b.edge])
                                || (next[b.edge] == a.edge && !isConvexCorner[a.edge]);
        return a.edge != b.edge && !meetInside;
    }
    const bool sameCornerPair =
        (a.corner == b.edge || a.corner == next[b.edge]) && (b.corner == a.edge || b.corner == next[a.edge]);
    return sameCornerPair && -placedAhead->tangent[a.edge].dot(placedAhead->tangent[b.edge]) < leastOpposing;
}

void MovingContacts<2>::dropDeeper()
{
    const auto isWorse = [this](const Candidate& a, const Candidate& b)
    {
        const bool aIsForemost = isForemost(a, *placedAhead, nearlyForemost);
        if (aIsForemost != isForemost(b, *placedAhead, nearlyForemost))
        {
            return !aIsForemost; // the line of a keeps its corner away, but not the rest of the corner's
                                 // block
        }
        const double same = sameCorner * pointTolerance;
        const bool aIsOpen = a.gap >= -pointTolerance;
        const bool bIsOpen = b.gap >= -pointTolerance;
        if (aIsOpen != bIsOpen)
        {
            return bIsOpen; // the corner is already behind the line of a, so it did not come through a
        }
        const double passedA = a.gap - a.gapAhead;
        const double passedB = b.gap - b.gapAhead;
        if (aIsOpen && a.gapAhead < 0 && b.gapAhead < 0 && passedA > same && passedB > same)
        {
            // On its way in it crosses both lines, and it is inside when it has crossed the second one.
            return a.gap * passedB < b.gap * passedA - same * same;
        }
        return a.gapAhead < b.gapAhead - same;
    };
    const auto isBehindAhead = [](const Candidate& candidate) { return candidate.gapAhead < 0; };
    if (std::none_of(candidates.begin(), candidates.end(), isBehindAhead))
    {
        return;
    }
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
        for (std::size_t j = 0; j < candidates.size(); ++j)
        {
            const Candidate& a = candidates[i];
            const Candidate& b = candidates[j];
            if (a.gapAhead >= 0 && b.gapAhead >= 0)
            {
                continue;
            }
            if (excludeEachOther(a, b) && isWorse(a, b))
            {
                candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(i));
                --i;
                break;
            }
        }
    }
}

bool MovingContacts<2>::pairEdges(int block, int neighbour, double lowest, double margin)
{
    bool anyOblique = false;
    const Vector<2>* const tangent = placedAhead->tangent.data();
    const int endOfBlock = first[block + 1];
    const int beginOfNeighbour = first[neighbour];
    const int endOfNeighbour = first[neighbour + 1];
    // Square blocks side by side have no pairs of edges between these two; a corner can stand on an edge only
    // beside such a pair.
    constexpr double leastOblique = 1e-3;
    for (int blockEdge = first[block]; blockEdge < endOfBlock; ++blockEdge)
    {
        const double x = tangent[blockEdge].x(); // no vector: one product of two numbers for each pair
        const double y = tangent[blockEdge].y();
        for (int neighbourEdge = beginOfNeighbour; neighbourEdge < endOfNeighbour; ++neighbourEdge)
        {
            const double opposing = -(x * tangent[neighbourEdge].x() + y * tangent[neighbourEdge].y());
            if (opposing <= leastOblique)
            {
                continue;
            }
            if (opposing < leastOpposing)
            {
                anyOblique = true;
            }
            else if (mayMeet(blockEdge, neighbourEdge, lowest, margin))
            {
                matchEdges(blockEdge, neighbourEdge, lowest, margin);
            }
        }
    }
    return anyOblique;
}

} // namespace drystone
