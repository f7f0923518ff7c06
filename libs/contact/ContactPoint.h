// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contact points: the ends of the joints, where blocks pass forces to each other.
#pragma once

#include "assembly/Assembly.h"
#include "geometry/space/Frame.h"

#include <Eigen/Geometry>

namespace drystone
{

/// Which corner meets which edge. It stays the same for as long as a contact in motion lasts, so that a
/// solver can start from the force that the point carried in the last step.
struct ContactFeature
{
    int vertexBlock = -1; ///< whose corner it is: the point's `block` or its `neighbour`; -1 when not known
    int vertex = -1;      ///< index in that block's outline
    int edge = -1;        ///< index in the other block's outline: edge i runs from vertex i to the next one

    friend bool operator==(const ContactFeature&, const ContactFeature&) = default;
};

/// Whether two points of one pair of blocks are the same at two times. In space either of two corners may be
/// followed where those of both blocks were at one place.
template<int Dim>
bool isSameFeature(const ContactFeature& a, const ContactFeature& b)
{
    return Dim == 2 ? a == b : a.vertex == b.vertex;
}

/// One point where two blocks touch: in the plane, where a corner of one faces an edge of another; in space,
/// of a patch where a face of one lies on a face of another. The contact force (n, t) acts on `block` along
/// (normal, tangent), in space (n, t1, t2) along (normal, tangent1, tangent2), and reversed on `neighbour`; n
/// >= 0 presses the two together.
template<int Dim>
struct ContactPoint
{
    int block = -1;     ///< index in Assembly::blocks
    int neighbour = -1; ///< index in Assembly::blocks
    int joint = -1; ///< index of the joint this point belongs to: one straight shared edge of two blocks, one
                    ///< polygon shared by two of their faces
    Vector<Dim> position = Vector<Dim>::Zero(); ///< [m]
    Vector<Dim> normal = Vector<Dim>::Zero();   ///< unit vector from `neighbour` into `block`
    double gap = 0;                             ///< distance along the normal, negative when overlapping [m]
    ContactFeature feature;                     ///< filled in by MovingContacts
    Vector<Dim> tangent1 = Vector<Dim>::Zero(); ///< in space, filled in by MovingContacts
};

/// Direction of positive shear on `block`: the normal turned by -90 degrees.
inline Vector<2> tangent(const ContactPoint<2>& point)
{
    return {point.normal.y(), -point.normal.x()};
}

/// Directions of a contact force in the plane, columns normal and tangent.
inline Eigen::Matrix2d contactFrame(const ContactPoint<2>& point)
{
    Eigen::Matrix2d frame;
    frame << point.normal, tangent(point);
    return frame;
}

/// Directions of a contact force in space, columns normal, tangent1, tangent2. Of a structure as built by the
/// normal alone (see frameOf): tangent1 is horizontal, and x where the normal is vertical. From there on they
/// turn with the block of the face: found from the normal again they would jump where it leaves the vertical,
/// and with them the force that a point keeps from step to step, and within one.
inline Eigen::Matrix3d contactFrame(const ContactPoint<3>& point)
{
    if (point.tangent1.isZero(0))
    {
        return frameOf(point.normal);
    }
    Eigen::Matrix3d frame;
    frame << point.normal, point.tangent1, point.normal.cross(point.tangent1);
    return frame;
}

/// Contact points of the structure as built. In the plane: for each pair of blocks whose outlines share a
/// straight edge (conforming or not), the two ends of each shared piece. Two edges share a piece when their
/// directions are opposite to 1e-3 rad, they lie within the tolerance of each other at both ends of
/// the piece, and it is longer than the tolerance: 1e-6 of the mean block size (square root of the free
/// blocks' mean face, cube root of their mean volume), or in space what closeJoints allowed
/// (Assembly::closure). Vertices that split a straight edge do not split a joint; blocks that meet at a
/// corner alone have none; neither have two fixed blocks. Gaps are 0.
///
/// In space: for each pair of faces of two blocks that lie on each other, convex or not, the corners of each
/// polygon that they share, in order round it, under the same conditions on directions and distances at all
/// corners. Corners that only split a straight edge of the polygon are left out; blocks that touch along an
/// edge or at a corner alone have no joint. Where the assembly states its joints, these are all, with their
/// points.
///
/// Points of one joint follow each other; joints are sorted by (block, neighbour), block < neighbour. Finding
/// them takes time of order n log n in the number of edges or faces: 0.5 s for 100,000 blocks of the plane.
template<int Dim>
std::vector<ContactPoint<Dim>> findContactPoints(const Assembly<Dim>& assembly);
template<>
std::vector<ContactPoint<2>> findContactPoints(const Assembly<2>& assembly);
template<>
std::vector<ContactPoint<3>> findContactPoints(const Assembly<3>& assembly);

/// The same joints with `pointsPerJoint` points each, at equal distances from end to end. \param ends the two
/// points of each joint, as findContactPoints gives them
std::vector<ContactPoint<2>> divideJoints(const std::vector<ContactPoint<2>>& ends, int pointsPerJoint);

/// The same joints with a grid of points each: the corners first, then where the lines of a grid of `perSide`
/// x `perSide` points over the patch's bounding rectangle, along its longest edge, cross each other within it
/// and its edges. A rectangular patch has exactly the points of the grid. \param corners the points of each
/// joint in order round it, as findContactPoints gives them \param perSide at least 2
std::vector<ContactPoint<3>> divideJoints(const std::vector<ContactPoint<3>>& corners, int perSide);

} // namespace drystone
