// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Friction gives unit rays or a scale, cohesion a ray of shear or a disc; tension moves the origin.
#include "conic/form/PointCones.h"

#include <algorithm>
#include <cmath>

namespace drystone
{

template<int Rows, int Forces>
double shearAlone(const ConeProgram<Rows, Forces>& program, int point)
{
    if (!program.hasStrength())
    {
        return 0;
    }
    const Strength& strength = program.strength[static_cast<std::size_t>(point)];
    return std::max(0.0, strength.cohesion - program.friction[point] * strength.tension);
}

PointCones<2> pointCones(const PlaneConeProgram& program, int point)
{
    const double mu = program.friction[point];
    const double length = std::sqrt(1 + mu * mu);
    PointCones<2> cones;
    cones.addRay(Eigen::Vector2d(1, mu) / length);
    if (mu > 0)
    {
        cones.addRay(Eigen::Vector2d(1, -mu) / length);
    }
    if (mu >= largeFriction && !program.hasStrength())
    {
        cones.addRay({1, 0});
    }
    cones.pressingRays = cones.rays;
    if (shearAlone(program, point) > 0)
    {
        cones.addRay({0, 1});
    }
    return cones;
}

PointCones<3> pointCones(const SpaceConeProgram& program, int point)
{
    const double mu = program.friction[point];
    PointCones<3> cones;
    if (mu > 0)
    {
        cones.addRound(Eigen::Vector3d(1, mu, mu) / std::sqrt(1 + mu * mu));
    }
    if (mu == 0 || (mu >= largeFriction && !program.hasStrength()))
    {
        cones.addRay({1, 0, 0});
    }
    cones.pressingRays = cones.rays;
    if (shearAlone(program, point) > 0)
    {
        cones.addRound({0, 1, 1});
    }
    return cones;
}

template<int Rows, int Forces>
Eigen::Matrix<double, Forces, 1> origin(const ConeProgram<Rows, Forces>& program, int point)
{
    Eigen::Matrix<double, Forces, 1> result = Eigen::Matrix<double, Forces, 1>::Zero();
    if (program.hasStrength())
    {
        result[0] = -program.strength[static_cast<std::size_t>(point)].tension;
        if constexpr (Forces == 2)
        {
            result[1] = -shearAlone(program, point);
        }
    }
    return result;
}

template double shearAlone(const PlaneConeProgram&, int);
template double shearAlone(const SpaceConeProgram&, int);
template Eigen::Matrix<double, 2, 1> origin(const PlaneConeProgram&, int);
template Eigen::Matrix<double, 3, 1> origin(const SpaceConeProgram&, int);

} // namespace drystone
