// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Gaps and slips of moving contacts to the last digits.
#include "dynamics/MovingGeometry.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// How a point of a block, now at `position`, is displaced; to the last digits, however little that is [m].
Vector<2> displacementOf(const DynamicCase& scene, int block, const Vector<2>& position,
                         const std::vector<Placement<2>>& from, const std::vector<Placement<2>>& to)
{
    const auto index = static_cast<std::size_t>(block);
    const Vector<2> arm = position - scene.blocks[index].centroid - from[index].translation;
    const double turn = to[index].rotation - from[index].rotation;
    const double half = std::sin(turn / 2);
    return to[index].translation - from[index].translation + std::sin(turn) * Vector<2>(-arm.y(), arm.x())
           - 2 * half * half * arm;
}

/// By how far the neighbour has slid past the block at a contact point, along the edge there [m].
double slip(const DynamicCase& scene, const std::vector<Placement<2>>& from,
            const std::vector<Placement<2>>& to, const ContactPoint<2>& point)
{
    const auto edgeBlock =
        static_cast<std::size_t>(point.feature.vertexBlock == point.block ? point.neighbour : point.block);
    const Eigen::Rotation2Dd turn(to[edgeBlock].rotation - from[edgeBlock].rotation);
    return (turn * tangent(point))
        .dot(displacementOf(scene, point.neighbour, point.position, from, to)
             - displacementOf(scene, point.block, point.position, from, to));
}

} // namespace

std::vector<Placement<2>> placementsAfter(const Step& step, const Eigen::VectorXd& displacement, double share)
{
    std::vector<Placement<2>> placements =
        moved(step.motion.state.placements, step.scene.free, displacement, share);
    moveWithSupports(placements, step.supports, share);
    return placements;
}

std::vector<ContactColumns<2>> columnsAt(const DynamicCase& scene,
                                         const std::vector<Placement<2>>& placements,
                                         const std::vector<ContactPoint<2>>& points)
{
    return equilibriumColumns(scene.assembly, placedMasses(scene.blocks, placements), points);
}

void forgetRounding(const DynamicCase& scene, std::vector<ContactPoint<2>>& points)
{
    for (ContactPoint<2>& point : points)
    {
        point.gap = std::abs(point.gap) <= scene.roundingGap ? 0 : point.gap;
    }
}

Relinearisation movingContactGeometry(const Step& step)
{
    return [&step](const Eigen::VectorXd& displacement, const Eigen::VectorXd& contactForce,
                   PlaneConeProgram& program)
    {
        const DynamicCase& scene = step.scene;
        const Motion& motion = step.motion;
        const Eigen::VectorXd linear = applyTransposed(program, displacement);
        std::vector<ContactPoint<2>> points;
        const double early = 1 - step.scheme.theta;
        if (early > 0)
        {
            const auto between = placementsAfter(step, displacement, early);
            motion.contacts->measure(between, points);
            setColumns(program, columnsAt(scene, between, points));
        }
        const auto after = placementsAfter(step, displacement);
        motion.contacts->measure(after, points);
        forgetRounding(scene, points);
        const Eigen::VectorXd closing =
            early > 0 ? applyTransposed(program, displacement) : Eigen::VectorXd(linear);
        double error = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const Eigen::Index row = 2 * static_cast<Eigen::Index>(i);
            const Eigen::Vector2d own = step.gapsOfEffects.size() > 0
                                            ? Eigen::Vector2d(step.gapsOfEffects.segment<2>(row))
                                            : Eigen::Vector2d::Zero();
            const double predicted = program.gap[row] - own[0] - linear[row];
            if (contactForce[row] != 0 || points[i].gap < 0)
            {
                error = std::max(error, std::abs(points[i].gap - predicted));
            }
            const double slid = slip(scene, motion.state.placements, after, step.points[i]);
            if (program.hasStrength() && program.strength[i].cohesion > 0) // where slip decides what holds
            {
                error = std::max(error, std::abs(slid + program.gap[row + 1] - own[1] - linear[row + 1]));
            }
            program.gap[row] = points[i].gap + closing[row] + own[0];
            program.gap[row + 1] = closing[row + 1] - slid + own[1];
        }
        return error;
    };
}

} // namespace drystone
