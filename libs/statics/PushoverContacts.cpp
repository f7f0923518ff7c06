// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// In space patches are found anew where blocks are now; those too deep are of the far side and left out.
#include "statics/PushoverContacts.h"

#include "contact/space/FacingPatches.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace drystone
{
namespace
{

constexpr double farthestTurn = 0.85; ///< of two faces from facing each other: |n1 + n2|, 50 degrees

/// Contacts leave overlaps of the order of the square of a step. Relative to the mean block size.
constexpr double mayEnter = 0.05;

Eigen::Matrix3d matrixOf(const Vector<3>& rotation)
{
    const double angle = rotation.norm();
    return angle > 0 ? Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix()
                     : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
}

/// The least width across a face [m].
double thicknessOf(const Polyhedron& shape)
{
    double thickness = std::numeric_limits<double>::infinity();
    for (const std::vector<int>& face : shape.faces)
    {
        const Vector<3> normal = areaVector(shape, face).normalized();
        double least = std::numeric_limits<double>::infinity();
        double most = -least;
        for (const Vector<3>& vertex : shape.vertices)
        {
            least = std::min(least, normal.dot(vertex));
            most = std::max(most, normal.dot(vertex));
        }
        thickness = std::min(thickness, most - least);
    }
    return thickness;
}

} // namespace

PushoverContacts<3>::PushoverContacts(const Assembly<3>& assembly)
    : asBuilt(assembly), lastPlacements(assembly.blocks.size())
{
    for (const BlockMass<3>& mass : blockMasses(assembly))
    {
        centres.push_back(mass.centroid);
    }
    for (const Block<3>& block : assembly.blocks)
    {
        // Like contacts of motion: up to a quarter of the thinner block. Farther in is its other side.
        deepest.push_back(thicknessOf(block.shape) / 4);
    }
}

std::vector<ContactPoint<3>> PushoverContacts<3>::update(const std::vector<Placement<3>>& placements,
                                                         double margin)
{
    lastPlacements = placements;
    Assembly<3> now = asBuilt;
    for (std::size_t block = 0; block < now.blocks.size(); ++block)
    {
        now.blocks[block].shape = placedShape(asBuilt.blocks[block], placements[block]);
    }
    const double size = meanBlockSize(asBuilt);
    FacingTolerance tolerance;
    tolerance.distance = margin;
    tolerance.angle = farthestTurn;
    tolerance.straight = 1e-6 * size;
    tolerance.leastLength = 1e-6 * size;
    std::vector<ContactPoint<3>> points;
    int joint = 0;
    for (const FacingPatch& patch : findFacingPatches(now, tolerance))
    {
        const double depth = std::min(deepest[static_cast<std::size_t>(patch.block)],
                                      deepest[static_cast<std::size_t>(patch.neighbour)]);
        if (*std::min_element(patch.gaps.begin(), patch.gaps.end()) < -depth)
        {
            continue;
        }
        for (std::size_t corner = 0; corner < patch.corners.size(); ++corner)
        {
            points.push_back({patch.block, patch.neighbour, joint, patch.corners[corner], patch.normal,
                              patch.gaps[corner], ContactFeature{}});
        }
        ++joint;
    }
    return points;
}

void PushoverContacts<3>::measure(const std::vector<Placement<3>>& placements,
                                  std::vector<ContactPoint<3>>& points) const
{
    for (ContactPoint<3>& point : points)
    {
        Vector<3> position = Vector<3>::Zero();
        Vector<3> normal = Vector<3>::Zero();
        for (const int index : {point.block, point.neighbour})
        {
            const auto block = static_cast<std::size_t>(index);
            const Vector<3> before = centres[block] + lastPlacements[block].translation;
            const Eigen::Matrix3d turn =
                matrixOf(placements[block].rotation) * matrixOf(lastPlacements[block].rotation).transpose();
            position +=
                (centres[block] + placements[block].translation + turn * (point.position - before)) / 2;
            normal += turn * point.normal;
        }
        point.position = position;
        point.normal = normal.normalized();
    }
}

Penetration PushoverContacts<3>::missed(const std::vector<Placement<3>>& placements) const
{
    const Penetration overlap = penetration(asBuilt, placements);
    return overlap.depth > mayEnter * meanBlockSize(asBuilt) ? overlap : Penetration();
}

std::vector<Placement<2>> pushedOn(std::vector<Placement<2>> placements, const std::vector<int>& free,
                                   const Eigen::VectorXd& displacement, double share)
{
    return moved(std::move(placements), free, displacement, share);
}

std::vector<Placement<3>> pushedOn(std::vector<Placement<3>> placements, const std::vector<int>& free,
                                   const Eigen::VectorXd& displacement, double share)
{
    for (std::size_t block = 0; block < free.size(); ++block)
    {
        if (free[block] >= 0)
        {
            placements[block].translation += share * displacement.segment<3>(6 * free[block]);
            const Eigen::Matrix3d turned = matrixOf(share * displacement.segment<3>(6 * free[block] + 3))
                                           * matrixOf(placements[block].rotation);
            const Eigen::AngleAxisd turn(turned);
            placements[block].rotation = turn.angle() * turn.axis();
        }
    }
    return placements;
}

} // namespace drystone
