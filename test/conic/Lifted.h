// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Programs of the plane lifted into space, for tests and benchmarks: their answers must be the plane's.
#pragma once

#include "conic/ConeProgram.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace drystone
{

/// Each contact point becomes two, `half` in front of the plane and behind it, with round friction cones and
/// half the strength each. Bodies may move out of the plane, but nothing pushes them there, so that
/// multiplier and displacements in the plane are those of the program of the plane. Rows fx fy fz mx my mz.
inline SpaceConeProgram lifted(const PlaneConeProgram& plane, double half = 0.1)
{
    SpaceConeProgram space;
    space.bodies = plane.bodies;
    const auto rows = [&plane](const Eigen::VectorXd& ofPlane)
    {
        Eigen::VectorXd result = Eigen::VectorXd::Zero(ofPlane.size() > 0 ? 6 * plane.bodies : 0);
        for (int body = 0; 6 * body < result.size(); ++body)
        {
            result[6 * body] = ofPlane[3 * body];
            result[6 * body + 1] = ofPlane[3 * body + 1];
            result[6 * body + 5] = ofPlane[3 * body + 2];
        }
        return result;
    };
    space.load = rows(plane.load);
    space.liveLoad = rows(plane.liveLoad);
    for (const Eigen::Matrix3d& block : plane.inertia)
    {
        Eigen::Matrix<double, 6, 6> inertia = Eigen::Matrix<double, 6, 6>::Zero();
        inertia.diagonal() << block(0, 0), block(1, 1), block(0, 0), block(2, 2), block(2, 2), block(2, 2);
        space.inertia.push_back(inertia);
    }
    const auto lift = [](const Eigen::Matrix<double, 3, 2>& onBody, double side)
    {
        // The lever arm from the moments of the two forces of the plane, m = x f_y - y f_x.
        Eigen::Matrix2d levers;
        levers << onBody(1, 0), -onBody(0, 0), onBody(1, 1), -onBody(0, 1);
        const Eigen::Vector2d arm = levers.inverse() * Eigen::Vector2d(onBody(2, 0), onBody(2, 1));
        const Eigen::Vector3d at(arm.x(), arm.y(), side);
        const double outwards = onBody(0, 0) * onBody(1, 1) - onBody(0, 1) * onBody(1, 0); // +-1, opposite of
        Eigen::Matrix<double, 6, 3> columns;                                               // both bodies
        for (int column = 0; column < 3; ++column)
        {
            const Eigen::Vector3d force = column < 2
                                              ? Eigen::Vector3d(onBody(0, column), onBody(1, column), 0)
                                              : Eigen::Vector3d(0, 0, outwards);
            columns.col(column) << force, at.cross(force);
        }
        return columns;
    };
    for (int point = 0; point < plane.points(); ++point)
    {
        const auto index = static_cast<std::size_t>(point);
        const ConeColumns<3, 2>& columns = plane.contacts[index];
        for (const double side : {-half, half})
        {
            ConeColumns<6, 3> liftedColumns;
            liftedColumns.first = columns.first;
            liftedColumns.second = columns.second;
            if (columns.first >= 0)
            {
                liftedColumns.onFirst = lift(columns.onFirst, side);
            }
            if (columns.second >= 0)
            {
                liftedColumns.onSecond = lift(columns.onSecond, side);
                if (columns.first >= 0) // whose outward force is opposite, while both determinants are alike
                {
                    liftedColumns.onSecond.col(2) = -liftedColumns.onSecond.col(2);
                }
            }
            space.contacts.push_back(liftedColumns);
            space.friction.push_back(plane.friction[index]);
            if (plane.hasStrength())
            {
                const Strength& strength = plane.strength[index];
                space.strength.push_back(
                    {strength.cohesion / 2, strength.tension / 2, strength.crushing / 2});
            }
        }
    }
    if (plane.gap.size() > 0)
    {
        space.gap = Eigen::VectorXd::Zero(3 * space.points());
        for (int point = 0; point < space.points(); ++point)
        {
            space.gap.segment<2>(3 * point) = plane.gap.segment<2>(2 * (point / 2));
        }
    }
    return space;
}

} // namespace drystone
