// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contacts of blocks that move in space: those found at the start, followed over displacements of any size.
#pragma once

#include "contact/MovingContacts.h"
#include "geometry/Rotation.h"

#include <optional>

namespace drystone
{

/// Follows the contact points of the structure as built: each is a corner of one block against the plane of a
/// face of the other, with normal, gap and position measured exactly where the blocks are, as in the plane.
/// New points are not found, so that it stands only as long as the points of the start are all there are:
/// `update` ends the run where a point that closes has left the face that it was built on by more than a
/// twentieth of the mean block size, or where blocks run into each other that share no point.
///
/// The corner of a patch that is a vertex of both blocks may be taken for that of either: it is that which
/// lies on the other's face now, of `block` where they lie at one place. One that is a vertex of neither
/// belongs to `block`.
template<>
class MovingContacts<3>
{
public:
    explicit MovingContacts(const Assembly<3>& assembly, const MovingContactOptions& options = {});

    /// The points where the blocks are now, all of them whatever their gaps.
    /// \throws FatalError where they no longer suffice
    const std::vector<ContactPoint<3>>& update(const std::vector<Placement<3>>& now, double margin);
    const std::vector<ContactPoint<3>>& update(const std::vector<Placement<3>>& now,
                                               const std::vector<Placement<3>>& ahead, double margin);

    /// The points of the last update, were the blocks placed so. \param points overwritten
    void measure(const std::vector<Placement<3>>& placements, std::vector<ContactPoint<3>>& points) const;

    /// One of them, by its index.
    ContactPoint<3> pointAt(const std::vector<Placement<3>>& placements, std::size_t index) const;

    /// All points are always listed: nothing depends on it.
    double marginFor(const std::vector<Eigen::Matrix<double, 6, 1>>&, double, double) const { return 0; }

    /// Has a block touch nothing from the next update on.
    void leaveOut(int block);

private:
    /// A corner of one block against the plane of a face of another, as built.
    struct Pair
    {
        int cornerBlock = -1;
        int faceBlock = -1;
        Vector<3> corner;               ///< [m]
        Vector<3> outward;              ///< normal of the face
        Vector<3> shear;                ///< tangent1 of the point
        std::vector<Vector<3>> outline; ///< of the face [m]
    };
    const Pair& pairOf(const ContactPoint<3>& point) const
    {
        const auto index = static_cast<std::size_t>(point.feature.vertex);
        return pairs[index].cornerBlock == point.feature.vertexBlock ? pairs[index] : *others[index];
    }
    Pair pairAt(const ContactPoint<3>& point, bool isOfNeighbour) const;
    double outsideOf(const Pair& pair, const Vector<3>& place, const std::vector<Placement<3>>& now,
                     const std::vector<Swing<3>>& back) const;
    void chooseCorners(const std::vector<Placement<3>>& now, const std::vector<Swing<3>>& back);
    /// \param swingOfCorner, swingOfFace of the blocks of its corner and of its face
    ContactPoint<3> pointAt(const std::vector<Placement<3>>& placements, const Swing<3>& swingOfCorner,
                            const Swing<3>& swingOfFace, std::size_t index) const;
    void refuseLostPoints(const std::vector<Placement<3>>& now, const std::vector<Swing<3>>& back) const;
    void refuseNewContacts(const std::vector<Placement<3>>& now) const;

    Assembly<3> assembly;
    std::vector<Vector<3>> centroids;
    std::vector<ContactPoint<3>> asBuilt;
    std::vector<ContactPoint<3>> points;
    std::vector<Pair> pairs;                 ///< one a point as built
    std::vector<std::optional<Pair>> others; ///< the other way round, where the point is a vertex of both
    std::vector<std::pair<int, int>> known;  ///< pairs of blocks that share points, sorted
    std::vector<char> isLeftOut;
    double blockSize = 1;
};

} // namespace drystone
