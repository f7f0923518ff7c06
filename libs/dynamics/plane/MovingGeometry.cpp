// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Slips of corners along edges in the plane.
#include "dynamics/MovingGeometry.h"

#include <Eigen/Geometry>

#include <cmath>

namespace drystone
{
namespace
{

/// How a point of a block, now at `position`, is displaced; to the last digits, however little that is [m].
Vector<2> displacementOf(const DynamicCase<2>& scene, int block, const Vector<2>& position,
                         const std::vector<Placement<2>>& from, const std::vector<Placement<2>>& to)
{
    const auto index = static_cast<std::size_t>(block);
    const Vector<2> arm = position - scene.blocks[index].centroid - from[index].translation;
    const double turn = to[index].rotation - from[index].rotation;
    const double half = std::sin(turn / 2);
    return to[index].translation - from[index].translation + std::sin(turn) * Vector<2>(-arm.y(), arm.x())
           - 2 * half * half * arm;
}

} // namespace

Shear<2> slip(const Step<2>& step, const std::vector<Placement<2>>& to, std::size_t index,
              const ConeColumns<3, 2>&)
{
    const DynamicCase<2>& scene = step.scene;
    const std::vector<Placement<2>>& from = step.motion.state.placements;
    const ContactPoint<2>& point = step.points[index];
    const auto edgeBlock =
        static_cast<std::size_t>(point.feature.vertexBlock == point.block ? point.neighbour : point.block);
    const Eigen::Rotation2Dd turn(to[edgeBlock].rotation - from[edgeBlock].rotation);
    return Shear<2>((turn * tangent(point))
                        .dot(displacementOf(scene, point.neighbour, point.position, from, to)
                             - displacementOf(scene, point.block, point.position, from, to)));
}

} // namespace drystone
