// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Small steps of the plane: a block on its corners, and bodies on each other that are pushed about.
#pragma once

#include "conic/ConeProgram.h"

#include <algorithm>
#include <random>

namespace drystone
{

/// Columns of a point at `arm` from the mass centre of the body it presses up on, against fixed ground.
inline ConeColumns<3, 2> standingOn(int body, double armX, double armY)
{
    ConeColumns<3, 2> columns;
    columns.first = body;
    columns.onFirst << 0, -1, -1, 0, -armX, armY;
    return columns;
}

/// A block on two corners under (fx fy m), its inertia 2, 2 and 0.5. \param height of its mass centre
inline PlaneConeProgram blockOnTwoCorners(const Eigen::Vector3d& load, double mu, double height = 1)
{
    PlaneConeProgram program;
    program.bodies = 1;
    program.contacts = {standingOn(0, -0.5, -height), standingOn(0, 0.5, -height)};
    program.friction = {mu, mu};
    program.load = load;
    program.inertia = {Eigen::Vector3d(2, 2, 0.5).asDiagonal()};
    program.gap = Eigen::VectorXd::Zero(4);
    return program;
}

/// A low one, which slides and does not tilt.
inline PlaneConeProgram lowBlock(double push, double weight, double mu)
{
    return blockOnTwoCorners({push, -weight, 0}, mu, 0.1);
}

/// A stack of bodies, each on two points of the one below, without loads.
inline PlaneConeProgram stackOf(int bodies, double mu)
{
    PlaneConeProgram program;
    program.bodies = bodies;
    program.load = Eigen::VectorXd::Zero(3 * bodies);
    for (int body = 0; body < bodies; ++body)
    {
        for (const double x : {-0.5, 0.5})
        {
            ConeColumns<3, 2> columns = standingOn(body, x, -0.5);
            columns.second = body - 1;
            columns.onSecond = -standingOn(body, x, 0.5).onFirst;
            program.contacts.push_back(columns);
            program.friction.push_back(mu);
        }
        program.inertia.push_back(Eigen::Vector3d(1, 1, 0.2).asDiagonal());
    }
    program.gap = Eigen::VectorXd::Zero(4 * bodies);
    return program;
}

/// One whose bodies are pushed at random, without moments.
inline PlaneConeProgram pushedStack(int bodies, std::mt19937& random)
{
    std::uniform_real_distribution<double> symmetric(-1, 1);
    PlaneConeProgram program = stackOf(bodies, 0.3);
    for (int body = 0; body < bodies; ++body)
    {
        program.load.segment<3>(3 * body) << symmetric(random), -1 + 0.5 * symmetric(random), 0;
    }
    return program;
}

/// One that is pushed and turned at random, some of its points open.
inline PlaneConeProgram randomStack(int bodies, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> symmetric(-1, 1);
    PlaneConeProgram program = stackOf(bodies, 0.5);
    for (int body = 0; body < bodies; ++body)
    {
        program.load.segment<3>(3 * body) << symmetric(random), -1 + symmetric(random),
            0.3 * symmetric(random);
    }
    for (Eigen::Index row = 0; row < program.gap.size(); row += 2)
    {
        program.gap[row] = 0.1 * std::max(0.0, symmetric(random));
    }
    return program;
}

} // namespace drystone
