// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Towers of boxes on the ground as cone programs, in the plane and in space: the simplest structure that can
/// be made as hard as one likes. Their multipliers are known in closed form.
#pragma once

#include "conic/ConeProgram.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace drystone
{

/// What a tower is made of. Gravity is 9.81 m/s2 along -y in the plane and along -z in space.
struct Tower
{
    /// A box, in space; the plane has its x and z, and a depth of 1.
    struct Box
    {
        Eigen::Vector3d centre;
        Eigen::Vector3d halfSize;
        double mass = 1;
    };
    std::vector<Box> boxes; ///< from the ground up, each on the one before
    double mu = 0.65;
    int pointsPerSide = 2;      ///< of a face, both ends counted
    Eigen::Vector2d push{1, 0}; ///< direction of the live load, alpha times the weight; x only in the plane
};

/// Boxes of width and depth 1 and height 1/2. \param massRatio mass of the top box over that of the bottom
/// one; the others in geometric progression, the bottom one weighs 1 kg
inline Tower evenTower(int boxes, double massRatio = 1, double mu = 0.65, int pointsPerSide = 2)
{
    Tower tower;
    tower.mu = mu;
    tower.pointsPerSide = pointsPerSide;
    for (int box = 0; box < boxes; ++box)
    {
        const double share = boxes > 1 ? double(box) / (boxes - 1) : 0;
        tower.boxes.push_back({{0, 0, 0.25 + 0.5 * box}, {0.5, 0.5, 0.25}, std::pow(massRatio, share)});
    }
    return tower;
}

/// Where two boxes, or a box and the ground, touch: centre and half sizes of a horizontal rectangle.
struct TowerFace
{
    Eigen::Vector2d low;
    Eigen::Vector2d high;
    double height;
};
inline TowerFace faceUnder(const Tower& tower, std::size_t box)
{
    const Tower::Box& above = tower.boxes[box];
    TowerFace face{above.centre.head<2>() - above.halfSize.head<2>(),
                   above.centre.head<2>() + above.halfSize.head<2>(), above.centre.z() - above.halfSize.z()};
    if (box > 0)
    {
        const Tower::Box& below = tower.boxes[box - 1];
        face.low = face.low.cwiseMax(below.centre.head<2>() - below.halfSize.head<2>());
        face.high = face.high.cwiseMin(below.centre.head<2>() + below.halfSize.head<2>());
    }
    return face;
}

/// Largest alpha: above each face the boxes slide at mu, and tip where the resultant of weight and push
/// leaves the face. Infinite without a push.
inline double towerMultiplier(const Tower& tower, int dimensions)
{
    double alpha = tower.mu / (dimensions == 2 ? std::abs(tower.push.x()) : tower.push.norm());
    for (std::size_t box = 0; box < tower.boxes.size(); ++box)
    {
        double mass = 0;
        Eigen::Vector3d moment = Eigen::Vector3d::Zero();
        for (std::size_t above = box; above < tower.boxes.size(); ++above)
        {
            mass += tower.boxes[above].mass;
            moment += tower.boxes[above].mass * tower.boxes[above].centre;
        }
        const Eigen::Vector3d centre = moment / mass;
        const TowerFace face = faceUnder(tower, box);
        for (int axis = 0; axis < dimensions - 1; ++axis)
        {
            const double drift = tower.push[axis] * (centre.z() - face.height);
            if (drift != 0)
            {
                const double edge = drift > 0 ? face.high[axis] : face.low[axis];
                alpha = std::min(alpha, (edge - centre[axis]) / drift);
            }
        }
    }
    return alpha;
}

/// Columns of a point of the plane at which `body` stands on what is below: normal up, tangent along x.
/// \param arm from the mass centre
inline Eigen::Matrix<double, 3, 2> uprightColumns(const Eigen::Vector2d& arm)
{
    Eigen::Matrix<double, 3, 2> columns;
    columns << 0, -1, -1, 0, -arm.x(), arm.y();
    return columns;
}

/// Likewise in space: normal along z, tangents along x and y.
inline Eigen::Matrix<double, 6, 3> uprightColumns(const Eigen::Vector3d& arm)
{
    Eigen::Matrix<double, 6, 3> columns;
    const Eigen::Vector3d axes[3] = {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(),
                                     Eigen::Vector3d::UnitY()};
    for (int column = 0; column < 3; ++column)
    {
        columns.col(column) << -axes[column], -arm.cross(axes[column]);
    }
    return columns;
}

/// Limit analysis of a tower in the plane: points along the width of each face.
inline PlaneConeProgram planeLimitAnalysis(const Tower& tower)
{
    PlaneConeProgram program;
    program.bodies = static_cast<int>(tower.boxes.size());
    program.load = Eigen::VectorXd::Zero(3 * program.bodies);
    program.liveLoad = program.load;
    for (int body = 0; body < program.bodies; ++body)
    {
        const Tower::Box& box = tower.boxes[body];
        const TowerFace face = faceUnder(tower, body);
        for (int i = 0; i < tower.pointsPerSide; ++i)
        {
            const double share = double(i) / (tower.pointsPerSide - 1);
            const Eigen::Vector2d at((1 - share) * face.low.x() + share * face.high.x(), face.height);
            ConeColumns<3, 2> columns;
            columns.first = body;
            columns.onFirst =
                uprightColumns(Eigen::Vector2d(at - Eigen::Vector2d(box.centre.x(), box.centre.z())));
            if (body > 0)
            {
                const Eigen::Vector3d& below = tower.boxes[body - 1].centre;
                columns.second = body - 1;
                columns.onSecond =
                    -uprightColumns(Eigen::Vector2d(at - Eigen::Vector2d(below.x(), below.z())));
            }
            program.contacts.push_back(columns);
            program.friction.push_back(tower.mu);
        }
        program.load[3 * body + 1] = -9.81 * box.mass;
        program.liveLoad[3 * body] = 9.81 * box.mass * tower.push.x();
    }
    return program;
}

/// Limit analysis of a tower in space: points around the rim of each face.
inline SpaceConeProgram spaceLimitAnalysis(const Tower& tower)
{
    SpaceConeProgram program;
    program.bodies = static_cast<int>(tower.boxes.size());
    program.load = Eigen::VectorXd::Zero(6 * program.bodies);
    program.liveLoad = program.load;
    for (int body = 0; body < program.bodies; ++body)
    {
        const Tower::Box& box = tower.boxes[body];
        const TowerFace face = faceUnder(tower, body);
        const Eigen::Vector2d corners[5] = {
            face.low, {face.high.x(), face.low.y()}, face.high, {face.low.x(), face.high.y()}, face.low};
        for (int side = 0; side < 4; ++side)
        {
            for (int i = 0; i + 1 < tower.pointsPerSide; ++i)
            {
                const double share = double(i) / (tower.pointsPerSide - 1);
                const Eigen::Vector2d in = (1 - share) * corners[side] + share * corners[side + 1];
                const Eigen::Vector3d at(in.x(), in.y(), face.height);
                ConeColumns<6, 3> columns;
                columns.first = body;
                columns.onFirst = uprightColumns(Eigen::Vector3d(at - box.centre));
                if (body > 0)
                {
                    columns.second = body - 1;
                    columns.onSecond = -uprightColumns(Eigen::Vector3d(at - tower.boxes[body - 1].centre));
                }
                program.contacts.push_back(columns);
                program.friction.push_back(tower.mu);
            }
        }
        program.load[6 * body + 2] = -9.81 * box.mass;
        program.liveLoad.segment<2>(6 * body) = 9.81 * box.mass * tower.push;
    }
    return program;
}

/// Mass, and moments of inertia of a full box: about y in the plane.
inline Eigen::Vector3d planeMass(const Tower::Box& box)
{
    const Eigen::Vector3d& h = box.halfSize;
    return box.mass * Eigen::Vector3d(1, 1, (h.x() * h.x() + h.z() * h.z()) / 3);
}
inline Eigen::Matrix<double, 6, 1> spaceMass(const Tower::Box& box)
{
    const Eigen::Vector3d squares = box.halfSize.cwiseAbs2() / 3;
    Eigen::Matrix<double, 6, 1> mass;
    mass << 1, 1, 1, squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y();
    return box.mass * mass;
}

/// The first step in time from rest, pushed by alpha times the live load: backward Euler, 0.002 s.
inline PlaneConeProgram planeStep(const Tower& tower, double alpha)
{
    constexpr double timeStep = 0.002;
    PlaneConeProgram program = planeLimitAnalysis(tower);
    program.load += alpha * program.liveLoad;
    program.liveLoad.resize(0);
    program.gap = Eigen::VectorXd::Zero(2 * program.points());
    for (const Tower::Box& box : tower.boxes)
    {
        program.inertia.push_back((planeMass(box) / (timeStep * timeStep)).asDiagonal());
    }
    return program;
}
inline SpaceConeProgram spaceStep(const Tower& tower, double alpha)
{
    constexpr double timeStep = 0.002;
    SpaceConeProgram program = spaceLimitAnalysis(tower);
    program.load += alpha * program.liveLoad;
    program.liveLoad.resize(0);
    program.gap = Eigen::VectorXd::Zero(3 * program.points());
    for (const Tower::Box& box : tower.boxes)
    {
        program.inertia.push_back((spaceMass(box) / (timeStep * timeStep)).asDiagonal());
    }
    return program;
}

} // namespace drystone
