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
Vector<2> displacementOf(const Step<2>& step, int block, const Vector<2>& position,
                         const BlockMotions<2>::Motion& motion)
{
    const auto index = static_cast<std::size_t>(block);
    const Vector<2> arm =
        position - step.scene.blocks[index].centroid - step.motion.state.placements[index].translation;
    return motion.translation + motion.swing.across(arm) - motion.swing.along(arm);
}

} // namespace

Shear<2> slip(const Step<2>& step, BlockMotions<2>& motions, std::size_t index, const ConeColumns<3, 2>&)
{
    const ContactPoint<2>& point = step.points[index];
    const int edgeBlock = point.feature.vertexBlock == point.block ? point.neighbour : point.block;
    const Vector<2> along = Eigen::Rotation2Dd(motions.of(edgeBlock).turn) * tangent(point);
    return Shear<2>(
        along.dot(displacementOf(step, point.neighbour, point.position, motions.of(point.neighbour))
                  - displacementOf(step, point.block, point.position, motions.of(point.block))));
}

} // namespace drystone
