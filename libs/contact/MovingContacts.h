// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contact points between blocks in motion: found anew in each step, over displacements of any size.
#pragma once

#include "contact/ContactPoint.h"
#include "geometry/BroadPhase.h"

#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace drystone
{

/// What edges are taken for that part solids nearly along the normal of a face (0.1 rad), where the solids
/// are in each other.
enum class EdgesAlongFaces
{
    edges, ///< one point where they cross
    faces  ///< of joints that are pressed in by more than edges differ from faces: all corners of the patch
};

/// How finely contacts in motion are distinguished. The defaults suit every case known.
struct MovingContactOptions
{
    double tolerance = 1e-6; ///< least length of a shared piece, relative to the mean block size
    double skin = 0.1; ///< reserve of the neighbour list, relative to the mean block size: time, not result
    /// How far blocks may enter each other in a step, relative to the mean block size. Rigid ones do by
    /// errors only, elastic ones by what their joints give way.
    double mayEnter = 1e-2;
    EdgesAlongFaces edgesAlongFaces = EdgesAlongFaces::edges; ///< in space; of elastic joints faces
};

/// By what elastic joints give way, relative to the mean block size: beyond, a block may come out on the
/// other side.
inline constexpr double mayEnterElastic = 0.25;

template<int Dim>
class MovingContacts;

/// Finds, for given placements of the blocks, the points at which a corner of one block meets, or is about to
/// meet, an edge of another.
///
/// Every point is a corner against an edge. Its normal is the outward normal of that edge where the block is
/// now (from `neighbour` into `block`), its gap the distance of the corner along that normal, and its
/// position the corner itself, for both blocks: the contact force and its reaction act on one line, so that
/// linear and angular momentum are kept exactly at any gap. The equilibrium matrix made from position and
/// normal gives the change of the gap to first order for displacements (u, r) of the edge's block about its
/// mass centre c: gap = n (v - q), v the corner, q a point of the edge, so that
///
///     d gap = n dv - n (u + r x (q - c)) + (r x n)(v - q) = n dv - n (u + r x (v - c)).
///
/// Which corner faces which edge:
/// - Two edges that run in nearly opposite directions (within 15 degrees) share the piece on which they
///   overlap along their common direction, and give a point at each end of it: there ends one edge or the
///   other, and its corner stands against the other edge. So a face that rocks open keeps its far point until
///   that gap exceeds the margin. Pieces shorter than the tolerance are none: where four blocks meet at one
///   point the two pairs across do not touch, and a block that slides over flush blocks does not see the head
///   joints below it.
/// - Otherwise a convex corner stands against an edge towards which it is the foremost of its block, if it
///   projects into the edge by more than the tolerance. For convex blocks apart this is the closest pair.
/// - A corner that is behind two edges of one block has entered through one of them. It keeps the edge
///   through which it is least deep, and both only where the edges meet at a re-entrant corner.
///
/// A joint whose points move past each other's corner changes its `feature` there, at the same position and
/// gap. Points enter the list with a positive gap or, where a corner slides onto the next of two flush
/// blocks, with none: no energy comes in with them.
///
/// The result depends on the placements alone, not on what was found before: the neighbour list kept between
/// calls only saves time. A run that is continued from its placements finds the same points, bit for bit.
///
/// Owns a copy of the outlines; the assembly may go away. Not safe for calls from several threads on one
/// object.
template<>
class MovingContacts<2>
{
public:
    explicit MovingContacts(const Assembly<2>& assembly, const MovingContactOptions& options = {});

    /// Points of the configuration `now`, with gaps up to `margin` (and overlaps up to a quarter of the
    /// thinner block). Two fixed blocks have no contacts with each other.
    /// \param now one for each block, fixed ones too: a fixed block that moves carries its contacts along
    /// \param margin distance at which a pair that is not yet closed is listed [m]. Take it from `marginFor`:
    ///        what is not listed at the beginning of a step can be passed through in it.
    /// \return sorted by (block, neighbour, edge of block, edge of neighbour, corner), block < neighbour; the
    ///         points of one pair of edges (a joint, at most two) follow each other. Valid until the next
    ///         call.
    const std::vector<ContactPoint<2>>& update(const std::vector<Placement<2>>& now, double margin);

    /// The same, with the features chosen where the blocks are heading, and the gaps and normals measured
    /// where they are now: what time stepping should call. Which edge a corner will meet, at two corners that
    /// pass close by each other, cannot be seen from the placements alone; `ahead` (the placements carried on
    /// by one step with the present velocities) tells. With it a tilted block slides over a flush head joint
    /// without catching, and two blocks that fall corner on corner are listed before they overlap. Corners
    /// that are foreseen to pass each other get the line between them with the most room. With `ahead` equal
    /// to `now` the choice is that of the other update, but for these.
    const std::vector<ContactPoint<2>>& update(const std::vector<Placement<2>>& now,
                                               const std::vector<Placement<2>>& ahead, double margin);

    /// The same, with where steps have led that overlooked contacts (see findsMoreTowards): corners at one
    /// place that are left alone on the first way are guarded where another one takes them into each other.
    /// \param headings one or more: where the blocks are heading by their velocities, and these
    const std::vector<ContactPoint<2>>& update(const std::vector<Placement<2>>& now,
                                               const std::vector<std::vector<Placement<2>>>& headings,
                                               double margin);

    /// The points of the last update, in their order, were the blocks placed so: the same corners and edges,
    /// with position, normal and gap measured exactly. The difference of the gaps from the linear prediction
    /// g0 - A0' dx is of second order (rotation times sliding); added to the gaps of the step program and
    /// solved again it makes the step end without that overlap.
    /// \param points overwritten
    void measure(const std::vector<Placement<2>>& placements, std::vector<ContactPoint<2>>& points) const;

    /// One of them, by its index.
    ContactPoint<2> pointAt(const std::vector<Placement<2>>& placements, std::size_t index) const;

    /// Whether the margin of the last update was so large that features may be chosen wrongly, which it is
    /// not in steps in which no point travels by an eighth of a thickness, or corners at one place were left
    /// alone.
    bool mayOverlook() const;

    /// By how much blocks are deepest in each other that the last update has looked at and whose features it
    /// may have chosen wrongly, the margin being more than a quarter of the thinner block, or whose corners
    /// at one place it has left alone [m]. Only where that is more than it was; 0 unless it mayOverlook.
    double overlookedDepth(const std::vector<Placement<2>>& placements) const;

    /// Whether blocks are in each other there whose corners at one place the last update has left alone: it
    /// finds more if it knows that they head there.
    bool findsMoreTowards(const std::vector<Placement<2>>& placements) const;

    /// Whether that is more than blocks may enter each other by.
    bool isTooDeep(double overlookedDepth) const { return overlookedDepth > mayEnter; }

    /// For space, where overlookedDepth leaves out what points are pressed in by.
    bool isAnyTooDeep(const std::vector<ContactPoint<2>>&) const { return false; }

    /// The margin that lists every pair of blocks that can meet within a step: twice the farthest that any
    /// point of a block travels. Features are chosen well as long as no block travels farther in a step than
    /// a quarter of its thickness; what was overlooked otherwise, overlookedDepth tells. \param velocities
    /// (ux uy rz) of each block [m/s, rad/s] \param timeStep [s] \param acceleration bound on what the loads
    /// add to the velocity [m/s2], for instance gravity
    double marginFor(const std::vector<Vector<3>>& velocities, double timeStep, double acceleration) const;

    /// Has a block touch nothing from the next update on. \param block index of the block
    void leaveOut(int block);

    /// How many times the neighbour list was built [-].
    int rebuilds() const { return rebuildCount; }

private:
    /// How a block has turned.
    struct Rotation
    {
        explicit Rotation(const Placement<2>& placement);
        Vector<2> operator()(const Vector<2>& arm) const
        {
            return {cosine * arm.x() - sine * arm.y(), sine * arm.x() + cosine * arm.y()};
        }

        double cosine;
        double sine;
    };

    /// Corners and edges of all blocks, one after the other; edge i of a block runs from its corner i to the
    /// next.
    struct Outlines
    {
        std::vector<Vector<2>> corner;  ///< [m]
        std::vector<Vector<2>> tangent; ///< unit vector along edge i; the outward normal is (y, -x)
        std::vector<BoundingBox> box;   ///< of each block
    };

    /// A corner against an edge of one pair of blocks.
    struct Candidate
    {
        int owner;       ///< 0: the corner is the block's, the edge the neighbour's; 1: the other way round
        int corner;      ///< index into Outlines
        int edge;        ///< index into Outlines
        int pairedEdge;  ///< the edge at the corner that faces `edge`: with it the pair of edges that makes
                         ///< the joint
        double opposing; ///< cosine of the angle between these edges
        double gap;      ///< now [m]
        double gapAhead; ///< [m]

        int blockEdge() const { return owner == 0 ? pairedEdge : edge; }
        int neighbourEdge() const { return owner == 0 ? edge : pairedEdge; }
    };

    /// The lines that can part the blocks near two corners: up to two edges at each of them.
    struct CornerLines
    {
        std::array<Candidate, 4> line;
        int count = 0;
    };

    void addBlock(const Block<2>& block);
    double thicknessOf(int block) const;
    void place(Outlines& outlines, const std::vector<Placement<2>>& placements) const;
    void placeBlock(Outlines& outlines, int block, const Placement<2>& placement) const;
    /// \param turned, turnedEdge rotations of the blocks of its corner and of its edge \param point the one
    /// of that index, of which place, normal and gap are overwritten
    void measure(const std::vector<Placement<2>>& placements, const Rotation& turned,
                 const Rotation& turnedEdge, std::size_t index, ContactPoint<2>& point) const;
    void findNeighbours(double margin);
    bool isLookedAt(int block, int neighbour) const;
    Polygon outlineOf(const Outlines& outlines, int block) const;
    /// By how much two blocks are in each other there, if that is more than they are now; else 0 [m].
    double depthGained(const Outlines& there, int block, int neighbour) const;
    /// Likewise the most of those whose corners were left alone, beyond what counts as touching.
    double depthAtCorners(const std::vector<Placement<2>>& placements) const;
    void findPoints(int block, int neighbour, double margin);

    // The choice of features, of one pair of blocks after the other: gaps from `lowest` to `margin` count
    // [m].
    /// Edges in nearly opposite directions. \return whether some edges face each other that are no faces of
    /// one joint
    bool pairEdges(int block, int neighbour, double lowest, double margin);
    /// Of two such edges both ends of the piece that they share.
    void matchEdges(int blockEdge, int neighbourEdge, double lowest, double margin);
    /// Convex corners that are the foremost of their block towards an edge of the other.
    void standCorners(int owner, int cornerBlock, int edgeBlock, double lowest, double margin);
    /// Two convex corners near each other, each beyond the other's edges: one line that parts them. \return
    /// whether some at one place were left alone
    bool guardCorners(double margin);
    /// The same on each way that the blocks may head.
    void guardOnEachWay(double margin);
    /// Lists a candidate, or where its corner is far behind the edge the line that parts the blocks there.
    void offer(const Candidate& candidate, double lowest, double margin);
    void list(const Candidate& candidate);
    /// Of candidates that exclude each other keeps the one through which its corner has come.
    void dropDeeper();
    void sortCandidates();
    void addFound();

    // Questions of that choice.
    bool mayMeet(int blockEdge, int neighbourEdge, double lowest, double margin) const;
    Candidate measured(int owner, int corner, int edge, int pairedEdge) const;
    /// The corner at that end of the candidate's edge which its corner is nearer to.
    int nearerEnd(const Candidate& candidate) const;
    /// Whether the edges of its corner recede from its edge. \param angle by which they need not [rad]
    bool isForemost(const Candidate& candidate, const Outlines& at, double angle) const;
    CornerLines linesBetween(int blockCorner, int neighbourCorner, const Outlines& at, double angle) const;
    /// The line that parts the blocks near the candidate with the most room ahead; its edge is -1: none does.
    Candidate partingLine(const Candidate& candidate) const;
    /// Whether a point is in a block, or within `reach` of it [m].
    bool holds(int block, const Vector<2>& point, double reach) const;
    bool isOverlapped(const Candidate& candidate) const;
    bool excludeEachOther(const Candidate& a, const Candidate& b) const;

    // Of the blocks as built.
    std::vector<int> first;              ///< block b has the corners first[b] to first[b + 1]
    std::vector<int> next, previous;     ///< corner round the outline
    std::vector<int> vertex;             ///< index of the corner in the block's outline
    std::vector<char> isConvexCorner;    ///< corner turns left
    std::vector<double> edgeLength;      ///< of edge i [m]
    std::vector<Vector<2>> localCorner;  ///< relative to the mass centre [m]
    std::vector<Vector<2>> localTangent; ///< of edge i
    std::vector<Vector<2>> centroids;    ///< of each block [m]
    std::vector<char> isFixed;           ///< block belongs to a support
    std::vector<char> leftOut;           ///< see leaveOut; empty while there is none
    std::vector<double> radii;           ///< of each block about its mass centre [m]
    std::vector<double> deepest;         ///< overlap beyond which a block's contacts are not trusted [m]
    double leastDeepest = std::numeric_limits<double>::max(); ///< of these [m]
    double pointTolerance = 0;                                ///< [m]
    double skin = 0;                                          ///< [m]
    double mayEnter = 0;                                      ///< [m]

    // Of the last update.
    Outlines placedNow, aheadStorage;
    const Outlines* placedAhead =
        nullptr;                         ///< `placedNow` when nothing is said of where the blocks are heading
    std::vector<Outlines> otherHeadings; ///< besides `aheadStorage`
    /// Pairs without a point whose corners lie at one place.
    std::vector<std::pair<int, int>> leftAlone;
    std::vector<BoundingBox> reaches; ///< of each block, now and ahead, with half the margin
    std::vector<BoundingBox> fat;     ///< reach at the last search, with half the skin
    std::vector<std::pair<int, int>> neighbours;
    double lastMargin = 0;                  ///< [m]
    int pairBlock = -1, pairNeighbour = -1; ///< pair being looked at
    std::vector<Candidate> candidates;
    std::vector<ContactPoint<2>> found;
    std::vector<std::pair<int, int>> cornerAndEdge; ///< of each point, indices into Outlines
    int joints = 0;
    int rebuildCount = 0;
};

} // namespace drystone
