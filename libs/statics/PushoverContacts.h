// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Contacts of a structure that is followed over large displacements at rest: in the plane those of motion,
/// in space the patches where faces face each other.
#pragma once

#include "contact/MovingContacts.h"
#include "contact/Penetration.h"

#include <vector>

namespace drystone
{

struct FacingPatch;

template<int Dim>
class PushoverContacts;

/// Corners against edges (contact/MovingContacts.h). Corners of two blocks at one place, which are left alone
/// there, touch each other as long as they did in the position before: so a lintel stays on a column of which
/// the corner that carries it is at the lintel's end.
template<>
class PushoverContacts<2>
{
public:
    explicit PushoverContacts(const Assembly<2>& assembly);

    /// Points with gaps up to `margin` [m], where the blocks are placed.
    std::vector<ContactPoint<2>> update(const std::vector<Placement<2>>& placements, double margin);
    /// The points of the last update, were the blocks placed so; their gaps change too.
    void measure(const std::vector<Placement<2>>& placements, std::vector<ContactPoint<2>>& points) const;
    /// None: corners against edges are all there is.
    Penetration missed(const std::vector<Placement<2>>&) const { return {}; }

private:
    Assembly<2> asBuilt;
    MovingContacts<2> contacts;
    double onePlace; ///< corners that are this near to each other are at one place [m]
    std::vector<ContactPoint<2>> lastPoints;
    std::vector<ContactPoint<2>> kept; ///< the last of these, which `contacts` does not know
};

/// The corners of the patches where faces of two blocks face each other, turned from each other by up to 50
/// degrees: a block that rocks about an edge keeps the patch under it, whose gap grows from nothing at that
/// edge. The normal is that of the face which a corner touches, as in the plane, or across two edges that
/// cross. Where a corner or an edge alone meets another block there is no contact; `missed` finds such
/// blocks.
template<>
class PushoverContacts<3>
{
public:
    explicit PushoverContacts(const Assembly<3>& assembly);

    std::vector<ContactPoint<3>> update(const std::vector<Placement<3>>& placements, double margin);
    /// Points move with the blocks whose corners they are, and their normals with the faces that these touch;
    /// others are halfway between where the two blocks take them.
    void measure(const std::vector<Placement<3>>& placements, std::vector<ContactPoint<3>>& points) const;
    /// The deepest overlap of blocks that no contact parts: one of more than a twentieth of their mean size.
    Penetration missed(const std::vector<Placement<3>>& placements) const;

private:
    /// What meets at a point.
    enum class Touch
    {
        cornerOfBlock,     ///< and a face of the neighbour
        cornerOfNeighbour, ///< and a face of the block
        edges              ///< that cross each other
    };

    /// Finds what meets at a corner of a patch, and sets position, normal and gap of the point by it.
    static Touch setTouch(const Assembly<3>& now, const FacingPatch& patch, double tolerance,
                          ContactPoint<3>& point);

    Assembly<3> asBuilt;
    std::vector<Vector<3>> centres;           ///< of mass, as built [m]
    std::vector<double> deepest;              ///< overlap beyond which faces are not those of a contact [m]
    std::vector<Placement<3>> lastPlacements; ///< of the last update
    std::vector<Touch> touches;               ///< of the points of the last update
};

/// Placements moved by displacements of the free blocks, (ux uy rz) or (ux uy uz rx ry rz) each, times
/// `share`, as finite rotations. \param free see freeIndices
std::vector<Placement<2>> pushedOn(std::vector<Placement<2>> placements, const std::vector<int>& free,
                                   const Eigen::VectorXd& displacement, double share);
std::vector<Placement<3>> pushedOn(std::vector<Placement<3>> placements, const std::vector<int>& free,
                                   const Eigen::VectorXd& displacement, double share);

} // namespace drystone
