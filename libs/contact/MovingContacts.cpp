// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Corner-edge contacts between placed blocks: neighbour list, choice of features, measures.
#include "contact/MovingContacts.h"

#include "contact/Facing.h"
#include "geometry/PolygonShape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <tuple>

namespace drystone
{

namespace
{

/// Edges are paired as faces of one joint up to this angle from parallel. Beyond it the far end of a face
/// stands off by a quarter of its length, and the common direction says little about which corner an edge
/// will meet.
const double leastOpposing = std::cos(15 * M_PI / 180);

/// Corners of two blocks this close, relative to the tolerance, are at the same place: then the corner of
/// `block` is taken, so that rounding errors do not decide.
constexpr double sameCorner = 1e-3;

/// A corner is foremost towards an edge if its own edges recede from it, up to this angle [rad]: then the
/// line of the edge parts the blocks near there.
constexpr double nearlyForemost = 0.02;

/// Overlaps are trusted up to this part of the thinner block: well above any that a step may leave, and below
/// the depth at which a corner is nearer to the far side.
constexpr double deepestPart = 0.25;

Vector<2> outwardNormal(const Vector<2>& tangent)
{
    return {tangent.y(), -tangent.x()};
}

/// Indices of the vertices at which the outline turns: those along a straight edge part no joint.
std::vector<int> turningVertices(const Polygon& outline, double tolerance)
{
    const Polygon kept = withoutStraightVertices(outline, tolerance);
    std::vector<int> indices;
    for (std::size_t i = 0; i < outline.size(); ++i)
    {
        const bool isRepeated = outline[i] == outline[(i + 1) % outline.size()];
        if (!isRepeated && std::find(kept.begin(), kept.end(), outline[i]) != kept.end())
        {
            indices.push_back(static_cast<int>(i));
        }
    }
    return indices;
}

/// Whether the segments from a to b and from c to d cross each other between their ends.
bool segmentsCross(const Vector<2>& a, const Vector<2>& b, const Vector<2>& c, const Vector<2>& d)
{
    return cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

} // namespace

MovingContacts<2>::MovingContacts(const Assembly<2>& assembly, const MovingContactOptions& options)
{
    const std::size_t blocks = assembly.blocks.size();
    std::vector<AreaProperties> properties;
    properties.reserve(blocks);
    for (const Block<2>& block : assembly.blocks)
    {
        properties.push_back(areaProperties(block.outline));
    }
    const double size = meanBlockSize(assembly);
    tolerance_ = options.tolerance * size;
    skin_ = options.skin * size;

    first_.push_back(0);
    for (std::size_t b = 0; b < blocks; ++b)
    {
        const Polygon& outline = assembly.blocks[b].outline;
        const std::vector<int> turning = turningVertices(outline, tolerance_ / 2);
        const int begin = first_.back();
        const int count = static_cast<int>(turning.size());
        double radius = 0;
        bool isConvex = true;
        for (int i = 0; i < count; ++i)
        {
            const Vector<2>& before = outline[turning[(i + count - 1) % count]];
            const Vector<2>& here = outline[turning[i]];
            const Vector<2>& after = outline[turning[(i + 1) % count]];
            next_.push_back(begin + (i + 1) % count);
            previous_.push_back(begin + (i + count - 1) % count);
            vertex_.push_back(turning[i]);
            localCorner_.push_back(here - properties[b].centroid);
            length_.push_back((after - here).norm());
            localTangent_.push_back((after - here) / length_.back());
            isConvex_.push_back(cross(here - before, after - here) > 0);
            isConvex = isConvex && isConvex_.back();
            radius = std::max(radius, localCorner_.back().norm());
        }
        // The thickness: of a convex block the least distance between parallel supports, one of which holds
        // an edge; of a concave one a lower bound, the least distance of a corner from an edge that does not
        // end there.
        double thickness = std::numeric_limits<double>::max();
        for (int edge = begin; edge < begin + count; ++edge)
        {
            double farthest = 0;
            for (int corner = begin; corner < begin + count; ++corner)
            {
                const Vector<2> arm = localCorner_[corner] - localCorner_[edge];
                farthest = std::max(farthest, -arm.dot(outwardNormal(localTangent_[edge])));
                if (!isConvex && corner != edge && corner != next_[edge])
                {
                    thickness = std::min(thickness, distance(localCorner_[corner], localCorner_[edge],
                                                             localCorner_[next_[edge]]));
                }
            }
            thickness = std::min(thickness, farthest);
        }
        centroid_.push_back(properties[b].centroid);
        isFixed_.push_back(assembly.blocks[b].support >= 0);
        radius_.push_back(radius);
        deepest_.push_back(deepestPart * thickness);
        first_.push_back(begin + count);
    }
    for (Outlines* outlines : {&now_, &aheadStorage_})
    {
        outlines->corner.resize(localCorner_.size());
        outlines->tangent.resize(localCorner_.size());
        outlines->box.resize(blocks);
    }
    reach_.resize(blocks);
}

void MovingContacts<2>::place(Outlines& outlines, const std::vector<Placement<2>>& placements) const
{
    for (std::size_t b = 0; b < centroid_.size(); ++b)
    {
        const double cosine = std::cos(placements[b].rotation);
        const double sine = std::sin(placements[b].rotation);
        const Vector<2> centre = centroid_[b] + placements[b].translation;
        BoundingBox box;
        for (int i = first_[b]; i < first_[b + 1]; ++i)
        {
            const Vector<2>& local = localCorner_[i];
            const Vector<2>& along = localTangent_[i];
            const Vector<2> corner(centre.x() + (cosine * local.x() - sine * local.y()),
                                   centre.y() + (sine * local.x() + cosine * local.y()));
            outlines.corner[i] = corner;
            outlines.tangent[i] = {cosine * along.x() - sine * along.y(),
                                   sine * along.x() + cosine * along.y()};
            box.lower = box.lower.cwiseMin(corner);
            box.upper = box.upper.cwiseMax(corner);
        }
        outlines.box[b] = box;
    }
}

const std::vector<ContactPoint<2>>& MovingContacts<2>::update(const std::vector<Placement<2>>& now,
                                                              double margin)
{
    assert(now.size() == centroid_.size());
    place(now_, now);
    ahead_ = &now_;
    findNeighbours(margin);
    return points_;
}

const std::vector<ContactPoint<2>>& MovingContacts<2>::update(const std::vector<Placement<2>>& now,
                                                              const std::vector<Placement<2>>& ahead,
                                                              double margin)
{
    assert(now.size() == centroid_.size() && ahead.size() == centroid_.size());
    place(now_, now);
    place(aheadStorage_, ahead);
    ahead_ = &aheadStorage_;
    findNeighbours(margin);
    return points_;
}

void MovingContacts<2>::leaveOut(int block)
{
    isLeftOut_.resize(isFixed_.size(), false);
    isLeftOut_[static_cast<std::size_t>(block)] = true;
}

void MovingContacts<2>::findNeighbours(double margin)
{
    bool isCurrent = fat_.size() == reach_.size();
    for (std::size_t b = 0; b < reach_.size(); ++b)
    {
        const BoundingBox box{now_.box[b].lower.cwiseMin(ahead_->box[b].lower),
                              now_.box[b].upper.cwiseMax(ahead_->box[b].upper)};
        reach_[b] = enlarged(box, margin / 2);
        isCurrent = isCurrent && contains(fat_[b], reach_[b]);
    }
    if (!isCurrent)
    {
        fat_.clear();
        for (const BoundingBox& box : reach_)
        {
            fat_.push_back(enlarged(box, skin_ / 2));
        }
        neighbours_ = findMeetingPairs(fat_);
        ++rebuilds_;
    }
    points_.clear();
    cornerAndEdge_.clear();
    joint_ = 0;
    for (const auto& [block, neighbour] : neighbours_)
    {
        // Asked of every pair in the list, so that its reserve cannot change the result.
        const bool isLeftOut = !isLeftOut_.empty() && (isLeftOut_[block] || isLeftOut_[neighbour]);
        if (!isLeftOut && !(isFixed_[block] && isFixed_[neighbour]) && meet(reach_[block], reach_[neighbour]))
        {
            findPoints(block, neighbour, margin);
        }
    }
}

MovingContacts<2>::Candidate MovingContacts<2>::measured(int owner, int corner, int edge,
                                                         int pairedEdge) const
{
    Candidate candidate{owner, corner, edge, pairedEdge, 0, 0, 0};
    candidate.opposing = -ahead_->tangent[edge].dot(ahead_->tangent[pairedEdge]);
    candidate.gap = (now_.corner[corner] - now_.corner[edge]).dot(outwardNormal(now_.tangent[edge]));
    candidate.gapAhead =
        ahead_ == &now_
            ? candidate.gap
            : (ahead_->corner[corner] - ahead_->corner[edge]).dot(outwardNormal(ahead_->tangent[edge]));
    return candidate;
}

bool MovingContacts<2>::isForemost(const Candidate& candidate, const Outlines& at, double angle) const
{
    const Vector<2> reversed = -at.tangent[candidate.edge];
    return cross(at.tangent[previous_[candidate.corner]], reversed) >= -angle
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
        for (const int edge : {previous_[other], other})
        {
            const bool leavingFaces = at.tangent[edge].dot(at.tangent[corner])
                                      < at.tangent[edge].dot(at.tangent[previous_[corner]]);
            const Candidate line = measured(owner, corner, edge, leavingFaces ? corner : previous_[corner]);
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
    for (int edge = first_[block]; edge < first_[block + 1]; ++edge)
    {
        const Vector<2>& a = now_.corner[edge];
        const Vector<2>& b = now_.corner[next_[edge]];
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
    const double foot = (now_.corner[candidate.corner] - now_.corner[edge]).dot(now_.tangent[edge]);
    return 2 * foot < length_[edge] ? edge : next_[edge];
}

bool MovingContacts<2>::isOverlapped(const Candidate& candidate) const
{
    const int cornerBlock = candidate.owner == 0 ? block_ : neighbour_;
    const int edgeBlock = candidate.owner == 0 ? neighbour_ : block_;
    const Vector<2>& corner = now_.corner[candidate.corner];
    const int end = nearerEnd(candidate);
    // The corner is inside, or (it may lie beyond the end of the edge) the end of the edge is, or their edges
    // cross.
    if (holds(edgeBlock, corner, tolerance_) || holds(cornerBlock, now_.corner[end], tolerance_))
    {
        return true;
    }
    for (const int a : {previous_[candidate.corner], candidate.corner})
    {
        for (const int b : {previous_[end], end})
        {
            if (segmentsCross(now_.corner[a], now_.corner[next_[a]], now_.corner[b], now_.corner[next_[b]]))
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
    if (isConvex_[candidate.corner] && isConvex_[end]
        && (now_.corner[candidate.corner] - now_.corner[end]).squaredNorm() <= reach * reach)
    {
        const bool cornerIsTheBlocks = candidate.owner == 0;
        const CornerLines lines = linesBetween(cornerIsTheBlocks ? candidate.corner : end,
                                               cornerIsTheBlocks ? end : candidate.corner, now_, 0);
        for (int i = 0; i < lines.count; ++i)
        {
            const Candidate& line = lines.line[i];
            if (line.gap >= -tolerance_ && (best.edge < 0 || line.gapAhead > best.gapAhead))
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
    if (candidate.gap < -10 * tolerance_)
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
    for (Candidate& other : candidates_)
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
    candidates_.push_back(candidate);
}

void MovingContacts<2>::matchEdges(int blockEdge, int neighbourEdge, double lowest, double margin)
{
    // Most pairs of parallel edges are far apart. Within 15 degrees no gap lies beyond those of the ends by a
    // tenth.
    const Vector<2> normal = outwardNormal(now_.tangent[neighbourEdge]);
    const double firstGap = (now_.corner[blockEdge] - now_.corner[neighbourEdge]).dot(normal);
    const double lastGap = (now_.corner[next_[blockEdge]] - now_.corner[neighbourEdge]).dot(normal);
    if (std::min(firstGap, lastGap) > 1.1 * margin || std::max(firstGap, lastGap) < 1.1 * lowest)
    {
        return;
    }
    // Both edges are measured along their common direction. It halves the angle between them, so that neither
    // is preferred, and of two corners that face each other at an end of the piece exactly one is the inner
    // one.
    const Vector<2> along = (ahead_->tangent[neighbourEdge] - ahead_->tangent[blockEdge]).normalized();
    const Vector<2>& origin = ahead_->corner[neighbourEdge];
    const double neighbourEnds[2] = {0, (ahead_->corner[next_[neighbourEdge]] - origin).dot(along)};
    const double blockEnds[2] = {(ahead_->corner[next_[blockEdge]] - origin).dot(along),
                                 (ahead_->corner[blockEdge] - origin).dot(along)};
    const double low = std::max(blockEnds[0], neighbourEnds[0]);
    const double high = std::min(blockEnds[1], neighbourEnds[1]);
    if (high - low <= tolerance_)
    {
        return;
    }
    for (const int end : {0, 1})
    {
        const int blockCorner = end == 0 ? next_[blockEdge] : blockEdge;
        const int neighbourCorner = end == 0 ? neighbourEdge : next_[neighbourEdge];
        const double inward = (blockEnds[end] - neighbourEnds[end]) * (end == 0 ? 1 : -1);
        // A re-entrant corner stands against nothing: what reaches it is the corner that lies in it.
        const bool blockIsInner = isConvex_[blockCorner] == isConvex_[neighbourCorner]
                                      ? inward >= -sameCorner * tolerance_
                                      : isConvex_[blockCorner] != 0;
        Candidate chosen = blockIsInner ? measured(0, blockCorner, neighbourEdge, blockEdge)
                                        : measured(1, neighbourCorner, blockEdge, neighbourEdge);
        if (chosen.gap < -tolerance_)
        {
            // Where the faces close towards this end, either line alone keeps the blocks apart. Never take
            // one that is already violated while the other is not: the corner did not come that way.
            const Candidate outer = blockIsInner ? measured(1, neighbourCorner, blockEdge, neighbourEdge)
                                                 : measured(0, blockCorner, neighbourEdge, blockEdge);
            if (chosen.gapAhead >= outer.gapAhead && outer.gap >= -tolerance_)
            {
                chosen = outer;
            }
        }
        offer(chosen, lowest, margin);
    }
}

void MovingContacts<2>::standCorners(int owner, int cornerBlock, int edgeBlock, double lowest, double margin)
{
    const Outlines& at = *ahead_;
    for (int corner = first_[cornerBlock]; corner < first_[cornerBlock + 1]; ++corner)
    {
        const Vector<2>& position = at.corner[corner];
        const BoundingBox& box = reach_[edgeBlock];
        if (!isConvex_[corner] || position.x() < box.lower.x() - margin
            || position.x() > box.upper.x() + margin || position.y() < box.lower.y() - margin
            || position.y() > box.upper.y() + margin)
        {
            continue;
        }
        const Vector<2>& arriving = at.tangent[previous_[corner]];
        const Vector<2>& leaving = at.tangent[corner];
        for (int edge = first_[edgeBlock]; edge < first_[edgeBlock + 1]; ++edge)
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
            if (foot <= tolerance_ || foot >= length_[edge] - tolerance_)
            {
                continue;
            }
            offer(
                measured(owner, corner, edge, towardsLeaving > towardsArriving ? corner : previous_[corner]),
                lowest, margin);
        }
    }
}

void MovingContacts<2>::guardCorners(double margin)
{
    // Two corners apart, each beyond the other's edges. Any one line that parts them is enough. A line with
    // which they are level comes first: along it they slide, or have just lost contact, and any other one
    // would be a wall across the way of a block that slides over flush blocks. Else it is the line that the
    // motion ahead leaves the most room: it binds only if the step turns out otherwise than foreseen, and
    // then by no more than that change. At corners at one place every line is level: they are left alone, as
    // where four blocks meet, but where the motion ahead crosses all the lines; then they get the one that it
    // crosses last.
    const double level = 10 * tolerance_;
    for (int blockCorner = first_[block_]; blockCorner < first_[block_ + 1]; ++blockCorner)
    {
        for (int neighbourCorner = first_[neighbour_]; neighbourCorner < first_[neighbour_ + 1];
             ++neighbourCorner)
        {
            const double apart = (now_.corner[blockCorner] - now_.corner[neighbourCorner]).squaredNorm();
            if (!isConvex_[blockCorner] || !isConvex_[neighbourCorner] || apart > margin * margin)
            {
                continue;
            }
            const bool areAtOnePlace = apart < level * level;
            Candidate best{0, -1, -1, -1, 0, 0, 0};
            bool bestIsLevel = false;
            const CornerLines lines = linesBetween(blockCorner, neighbourCorner, *ahead_, nearlyForemost);
            for (int i = 0; i < lines.count; ++i)
            {
                const Candidate& line = lines.line[i];
                const bool isLevel = std::abs(line.gap) <= level;
                if (line.gap >= -tolerance_
                    && (best.edge < 0 || (isLevel && !bestIsLevel)
                        || (isLevel == bestIsLevel && line.gapAhead > best.gapAhead)))
                {
                    best = line;
                    bestIsLevel = isLevel;
                }
            }
            const bool closes = best.gap - best.gapAhead > sameCorner * tolerance_;
            if (best.edge >= 0 && (areAtOnePlace ? closes : best.gapAhead > tolerance_))
            {
                offer(best, -tolerance_, margin);
            }
        }
    }
}

bool MovingContacts<2>::excludeEachOther(const Candidate& a, const Candidate& b) const
{
    if (a.corner == b.corner)
    {
        const bool meetInside = (next_[a.edge] == b.edge && !isConvex_[b.edge])
                                || (next_[b.edge] == a.edge && !isConvex_[a.edge]);
        return a.edge != b.edge && !meetInside;
    }
    const bool sameCornerPair = (a.corner == b.edge || a.corner == next_[b.edge])
                                && (b.corner == a.edge || b.corner == next_[a.edge]);
    return sameCornerPair && -ahead_->tangent[a.edge].dot(ahead_->tangent[b.edge]) < leastOpposing;
}

void MovingContacts<2>::dropDeeper()
{
    const auto isWorse = [this](const Candidate& a, const Candidate& b)
    {
        const bool aIsForemost = isForemost(a, *ahead_, nearlyForemost);
        if (aIsForemost != isForemost(b, *ahead_, nearlyForemost))
        {
            return !aIsForemost; // the line of a keeps its corner away, but not the rest of the corner's
                                 // block
        }
        const double same = sameCorner * tolerance_;
        const bool aIsOpen = a.gap >= -tolerance_;
        const bool bIsOpen = b.gap >= -tolerance_;
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
    for (std::size_t i = 0; i < candidates_.size(); ++i)
    {
        for (std::size_t j = 0; j < candidates_.size(); ++j)
        {
            const Candidate& a = candidates_[i];
            const Candidate& b = candidates_[j];
            if (a.gapAhead >= 0 && b.gapAhead >= 0)
            {
                continue;
            }
            if (excludeEachOther(a, b) && isWorse(a, b))
            {
                candidates_.erase(candidates_.begin() + static_cast<std::ptrdiff_t>(i));
                --i;
                break;
            }
        }
    }
}

void MovingContacts<2>::findPoints(int block, int neighbour, double margin)
{
    candidates_.clear();
    block_ = block;
    neighbour_ = neighbour;
    const double lowest = -std::min(deepest_[block], deepest_[neighbour]);
    const Outlines& at = *ahead_;
    bool anyOblique = false;
    for (int blockEdge = first_[block]; blockEdge < first_[block + 1]; ++blockEdge)
    {
        for (int neighbourEdge = first_[neighbour]; neighbourEdge < first_[neighbour + 1]; ++neighbourEdge)
        {
            const double opposing = -at.tangent[blockEdge].dot(at.tangent[neighbourEdge]);
            if (opposing >= leastOpposing)
            {
                matchEdges(blockEdge, neighbourEdge, lowest, margin);
            }
            // Square blocks side by side have no other pairs; a corner can stand on an edge only beside such
            // a pair.
            anyOblique = anyOblique || (opposing > 1e-3 && opposing < leastOpposing);
        }
    }
    if (anyOblique)
    {
        standCorners(0, block, neighbour, lowest, margin);
        standCorners(1, neighbour, block, lowest, margin);
    }
    if (candidates_.empty() && ahead_ != &now_)
    {
        guardCorners(margin);
    }
    if (candidates_.size() > 1)
    {
        dropDeeper();
        std::sort(candidates_.begin(), candidates_.end(),
                  [](const Candidate& a, const Candidate& b)
                  {
                      const int blockEdgeA = a.owner == 0 ? a.pairedEdge : a.edge;
                      const int blockEdgeB = b.owner == 0 ? b.pairedEdge : b.edge;
                      const int neighbourEdgeA = a.owner == 0 ? a.edge : a.pairedEdge;
                      const int neighbourEdgeB = b.owner == 0 ? b.edge : b.pairedEdge;
                      return std::tie(blockEdgeA, neighbourEdgeA, a.owner, a.corner)
                             < std::tie(blockEdgeB, neighbourEdgeB, b.owner, b.corner);
                  });
    }
    int lastBlockEdge = -1;
    int lastNeighbourEdge = -1;
    for (const Candidate& candidate : candidates_)
    {
        const bool cornerIsTheBlocks = candidate.owner == 0;
        const int blockEdge = cornerIsTheBlocks ? candidate.pairedEdge : candidate.edge;
        const int neighbourEdge = cornerIsTheBlocks ? candidate.edge : candidate.pairedEdge;
        if (blockEdge != lastBlockEdge || neighbourEdge != lastNeighbourEdge)
        {
            lastBlockEdge = blockEdge;
            lastNeighbourEdge = neighbourEdge;
            ++joint_;
        }
        cornerAndEdge_.emplace_back(candidate.corner, candidate.edge);
        ContactPoint<2>& point = points_.emplace_back();
        point.block = block;
        point.neighbour = neighbour;
        point.joint = joint_ - 1;
        point.position = now_.corner[candidate.corner];
        const Vector<2> normal = outwardNormal(now_.tangent[candidate.edge]);
        point.normal = cornerIsTheBlocks ? normal : Vector<2>(-normal);
        point.gap = candidate.gap;
        point.feature = {cornerIsTheBlocks ? block : neighbour, vertex_[candidate.corner],
                         vertex_[candidate.edge]};
    }
}

void MovingContacts<2>::measure(const std::vector<Placement<2>>& placements,
                                std::vector<ContactPoint<2>>& points) const
{
    assert(placements.size() == centroid_.size());
    points = points_;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const auto [corner, edge] = cornerAndEdge_[i];
        ContactPoint<2>& point = points[i];
        const bool cornerIsTheBlocks = point.feature.vertexBlock == point.block;
        const int cornerBlock = cornerIsTheBlocks ? point.block : point.neighbour;
        const int edgeBlock = cornerIsTheBlocks ? point.neighbour : point.block;
        const Eigen::Rotation2Dd turned(placements[cornerBlock].rotation);
        const Eigen::Rotation2Dd turnedEdge(placements[edgeBlock].rotation);
        const Vector<2> cornerArm = turned * localCorner_[corner];
        const Vector<2> normal = outwardNormal(turnedEdge * localTangent_[edge]);
        // Differences of places first, so that a structure far from the origin keeps its digits.
        const Vector<2> centres = (centroid_[cornerBlock] - centroid_[edgeBlock])
                                  + (placements[cornerBlock].translation - placements[edgeBlock].translation);
        point.gap = (centres + cornerArm - turnedEdge * localCorner_[edge]).dot(normal);
        point.position = centroid_[cornerBlock] + placements[cornerBlock].translation + cornerArm;
        point.normal = cornerIsTheBlocks ? normal : Vector<2>(-normal);
    }
}

double MovingContacts<2>::marginFor(const std::vector<Vector<3>>& velocities, double timeStep,
                                    double acceleration) const
{
    assert(velocities.size() == radius_.size());
    double fastest = 0;
    for (std::size_t b = 0; b < radius_.size(); ++b)
    {
        fastest = std::max(fastest, velocities[b].head<2>().norm() + std::abs(velocities[b][2]) * radius_[b]);
    }
    return 2 * timeStep * (fastest + acceleration * timeStep);
}

} // namespace drystone
