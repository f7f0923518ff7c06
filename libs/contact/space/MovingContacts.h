// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contacts of blocks that move in space: those as built followed, others found, over displacements of any
/// size.
#pragma once

#include "contact/MovingContacts.h"
#include "contact/space/ConvexContacts.h"
#include "geometry/Rotation.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

namespace drystone
{

/// The points of the structure as built are followed: each is a corner of one block against the plane of a
/// face of the other, with normal, gap and position measured exactly where the blocks are, as in the plane.
/// So they stay the same points, whatever their gaps, until one of them leaves the face that it was built on
/// by more than a thousandth of the mean block size, or the blocks turn to each other by more than 0.1 rad.
/// From there on, and between blocks that shared no point, what they touch each other with is found anew at
/// each update (see contactsAlong), where they are heading: corners against faces, edges that cross the rim
/// of a face, edges against edges. Which of the two depends on the placements alone.
///
/// Blocks that are not convex are searched as their convex parts (see convexParts). Where parts of a block
/// lie on each other none of another block comes, as it would be within the block; what the parts find twice
/// along a seam counts once.
///
/// Blocks of too many parts are followed only: `update` ends the run where a point of one that closes has
/// left its face by more than a twentieth of the mean block size, or where one runs into a block that it
/// shared no point with.
///
/// The corner of a patch that is a vertex of both blocks may be taken for that of either: it is that which
/// lies on the other's face now, of `block` where they lie at one place. One that is a vertex of neither
/// belongs to `block`.
template<>
class MovingContacts<3>
{
public:
    explicit MovingContacts(const Assembly<3>& assembly, const MovingContactOptions& options = {});

    /// The points where the blocks are now: those that are followed whatever their gaps, those that are found
    /// up to `margin` (see marginFor). \return sorted by (block, neighbour); valid until the next call
    /// \throws FatalError where blocks of too many parts touch anew, or others have entered each other by
    /// more than the options say, as with too long a step
    const std::vector<ContactPoint<3>>& update(const std::vector<Placement<3>>& now, double margin);

    /// The same, those that are found chosen where the blocks are heading and measured where they are now.
    /// \param headings one or more: where blocks are heading by their velocities, and where steps have led
    /// that overlooked contacts
    const std::vector<ContactPoint<3>>& update(const std::vector<Placement<3>>& now,
                                               const std::vector<std::vector<Placement<3>>>& headings,
                                               double margin);

    /// Whether overlookedDepth may be more than 0: however short a step is, which corners and edges meet may
    /// be foreseen otherwise.
    bool mayOverlook() const { return true; }

    /// By how much blocks between which the last update has found points, or looked for some, are deepest in
    /// each other beyond 1e-5 of the mean block size and what these points are pressed in by [m]; mostly 0. A
    /// step to there has overlooked contacts, since which corners and edges meet was foreseen otherwise.
    double overlookedDepth(const std::vector<Placement<3>>& placements) const;

    /// Whether an update finds more if it knows that blocks head there where contacts are overlooked.
    bool findsMoreTowards(const std::vector<Placement<3>>&) const { return true; }

    /// Whether that is more than blocks may enter each other by, so that no update could follow.
    bool isTooDeep(double overlookedDepth) const { return overlookedDepth > mayEnterFound; }

    /// Likewise of one that is found. \param measured the points of the last update, elsewhere
    bool isAnyTooDeep(const std::vector<ContactPoint<3>>& measured) const;

    /// The points of the last update, were the blocks placed so. \param points overwritten
    void measure(const std::vector<Placement<3>>& placements, std::vector<ContactPoint<3>>& points) const;

    /// One of them, by its index.
    ContactPoint<3> pointAt(const std::vector<Placement<3>>& placements, std::size_t index) const;

    /// The margin that lists every pair of blocks that can meet within a step: twice the farthest that any
    /// point of a block travels. \param velocities (ux uy uz rx ry rz) of each block [m/s, rad/s] \param
    /// timeStep [s] \param acceleration bound on what the loads add to the velocity [m/s2]
    double marginFor(const std::vector<Eigen::Matrix<double, 6, 1>>& velocities, double timeStep,
                     double acceleration) const;

    /// Has a block touch nothing from the next update on.
    void leaveOut(int block);

    /// The convex parts that a block is searched as; 0: it is followed only.
    std::size_t parts(int block) const { return solids[static_cast<std::size_t>(block)].size(); }

private:
    /// Vertices or edges of a block are less: their numbers tell points from each other.
    static constexpr int mostFeatures = 1 << 13;

    /// A corner of one block against the plane of a face of another, or an edge against an edge; as built.
    struct Pair
    {
        int cornerBlock = -1;
        int faceBlock = -1;
        Vector<3> corner;                        ///< or a point of its edge [m]
        Vector<3> onFace;                        ///< a point of the face, or of the other edge [m]
        Vector<3> outward;                       ///< normal of the face
        Vector<3> shear;                         ///< tangent1 of the point
        std::vector<Vector<3>> outline;          ///< of the face, of points that are followed [m]
        Vector<3> edge = Vector<3>::Zero();      ///< direction, of an edge against
        Vector<3> otherEdge = Vector<3>::Zero(); ///< an edge
    };
    /// Of points that are followed: those of one pair of blocks.
    struct KnownPair
    {
        int block;
        int neighbour;
        std::size_t begin; ///< of asBuilt
        std::size_t end;
        /// Of parts, those of the block times those of the neighbour: whether they are built on each other;
        /// empty where each block is one.
        std::vector<char> isBuilt;
        /// As built, of those that are not; infinite where there are none [m].
        double clearance = std::numeric_limits<double>::infinity();
    };
    /// A pair of blocks between which points were searched.
    struct SearchedPair
    {
        int block;
        int neighbour;
        int followed; ///< index of the known pair of which points are followed too; -1: none
    };
    /// Where the blocks are, and back to where they were built.
    struct Places
    {
        const std::vector<Placement<3>>& now;
        double margin;
        std::vector<Swing<3>> forth;
        std::vector<Swing<3>> back;
        PlacedSolids here;
        std::vector<PlacedSolids> headings;
    };
    /// What a part of one block meets a part of another with.
    struct PartContact
    {
        ConvexContact contact;
        std::size_t part;      ///< of the block
        std::size_t otherPart; ///< of the neighbour
    };
    const Pair& pairOf(std::size_t index) const
    {
        const ContactPoint<3>& point = points[index];
        const int ofFound = foundIndex[index];
        const auto built = static_cast<std::size_t>(point.feature.vertex);
        return ofFound >= 0 ? found[static_cast<std::size_t>(ofFound)]
               : pairs[built].cornerBlock == point.feature.vertexBlock ? pairs[built]
                                                                       : *others[built];
    }
    Pair pairAt(const ContactPoint<3>& point, int cornerBlock) const;
    double outsideOf(const Pair& pair, const Places& places) const;
    double wayApart(const KnownPair& pair, const Places& places) const;
    bool isFollowed(const KnownPair& pair, const Places& places) const;
    bool isSearched(int block, int neighbour) const;
    bool arePartsBuilt(const SearchedPair& pair, std::size_t part, std::size_t otherPart) const;
    double toleranceOf(int block, int neighbour) const
    {
        return std::max(tolerances[static_cast<std::size_t>(block)],
                        tolerances[static_cast<std::size_t>(neighbour)]);
    }
    /// Pairs, not both fixed, that touch as built without a point there: at an edge or a corner.
    std::map<std::pair<int, int>, double> pairsAtEdges() const;
    /// What parts a convex part of a block from one of its neighbour; those of blocks that are built at an
    /// edge do not touch there, see SharedEdge.
    PartingAxis axisBetween(const ConvexSolid& first, const ConvexSolid& second, int block,
                            int neighbour) const;
    void follow(const KnownPair& pair, const Places& places);
    void findBuiltParts(KnownPair& pair) const;
    void find(const SearchedPair& pair, Places& places);
    std::vector<PartContact> contactsTowards(PlacedSolids& heading, const SearchedPair& pair,
                                             Places& places) const;
    std::vector<PartContact> contactsOfParts(const ConvexSolid& there, const ConvexSolid& otherThere,
                                             const PartContact& parts, int block, int neighbour,
                                             Places& places) const;
    double pressedIn(int block, int neighbour, const std::vector<Placement<3>>& placements) const;
    void refuseDeepPoints() const;
    Pair pairOfContact(const PartContact& meeting, int block, int neighbour) const;
    int featureOf(const PartContact& meeting, int block, int neighbour) const;
    ContactPoint<3> foundPoint(const PartContact& meeting, const Pair& pair, int block, int neighbour,
                               const Places& places) const;
    void addFound(const ContactPoint<3>& point, Pair pair, std::size_t firstOfPair);
    /// \param swingOfCorner, swingOfFace of the blocks of its corner and of its face
    ContactPoint<3> pointAt(const std::vector<Placement<3>>& placements, const Swing<3>& swingOfCorner,
                            const Swing<3>& swingOfFace, std::size_t index) const;
    ContactPoint<3> measured(ContactPoint<3> point, const Pair& pair,
                             const std::vector<Placement<3>>& placements, const Swing<3>& swingOfCorner,
                             const Swing<3>& swingOfFace) const;
    std::vector<std::pair<int, int>> meetingPairs(const Places& places) const;
    void refuseLostPoints(const KnownPair& pairAsBuilt, const Places& places) const;
    void refuseMeeting(int block, int neighbour, const std::vector<Placement<3>>& now) const;

    Assembly<3> assembly;
    std::vector<Vector<3>> centroids;
    std::vector<ContactPoint<3>> asBuilt;
    std::vector<Pair> pairs;                 ///< one a point as built
    std::vector<std::optional<Pair>> others; ///< the other way round, where the point is a vertex of both
    std::vector<KnownPair> known;            ///< sorted
    /// See pairsAtEdges; with what their faces are in each other by there, as built and at least toleranceOf
    /// [m].
    std::map<std::pair<int, int>, double> atEdges;
    std::vector<std::vector<ConvexSolid>>
        solids;                ///< as built: the convex parts of each block; empty: too many
    std::vector<double> radii; ///< of each block about its mass centre [m]
    std::vector<char> isLeftOut;
    double blockSize = 1;
    double tolerance = 1e-6;        ///< [m]
    std::vector<double> tolerances; ///< of each block: no less than its faces are uneven by [m]
    double mayEnterFound;           ///< [m]
    EdgesAlongFaces edgesAlongFaces;

    // Of the last update.
    std::vector<ContactPoint<3>> points;
    std::vector<int> foundIndex; ///< of each point: in `found`, or -1 where it is followed
    std::vector<Pair> found;
    int foundJoints = 0;
    std::vector<SearchedPair> searched;
};

} // namespace drystone
