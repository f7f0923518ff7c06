// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Structures in memory for the tests of motion: what a case directory would have been read into.
#pragma once

#include "SceneGravity.h"

#include "dynamics/Advance.h"
#include "effects/GroundMotion.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace drystone::scenes
{

/// What the tests vary.
struct Settings
{
    double theta = 1;
    double mu = 0.6;
    FlowRule flowRule = FlowRule::nonAssociative;
    double restitution = 0;
    double tolerance = 1e-11;
    SolverType solver = SolverType::automatic;
    Vector<2> gravity{0, -g};
    double density = 1800;
    ImpactInstant impacts = ImpactInstant::located;
};

inline Block<2> rectangle(double left, double bottom, double width, double height)
{
    return {
        {{left, bottom}, {left + width, bottom}, {left + width, bottom + height}, {left, bottom + height}},
        1,
        -1};
}

/// Ground from `left` to `right` under y = 0, as block 0.
inline Assembly<2> ground(double left, double right, double depth = 1)
{
    Assembly<2> assembly;
    assembly.supports.push_back({"ground", "ground"});
    assembly.blocks.push_back(rectangle(left, -depth, right - left, depth));
    assembly.blocks.back().support = 0;
    return assembly;
}

/// Painleve's rod (1895): a thin rod, inclined by atan 2, slides on its lower end, at the origin, towards the
/// side where friction turns it into the ground. With mu = 2, above (1 + 3 cos^2)/(3 sin cos) = 4/3, the
/// normal force N gives its end the acceleration (1 + 3 cos^2 - 3 mu sin cos) N/m = -0.8 N/m: no finite force
/// keeps it out of the ground, and the motion goes on with an impulse that stops the end at once.
struct PainlevesRod
{
    Block<2> block;
    Vector<2> impulse; ///< that stops the end when it moves at (-1, 0) m/s, along (x, y), over the mass [m/s]
};

inline PainlevesRod painlevesRod()
{
    const double length = 1;
    const double depth = 0.01;
    const Eigen::Rotation2Dd turn(std::atan(2.0));
    Block<2> rod = rectangle(-length / 2, -depth / 2, length, depth);
    Vector<2> lowest(0, 0);
    for (Vector<2>& corner : rod.outline)
    {
        corner = turn * corner;
        lowest = corner.y() < lowest.y() ? corner : lowest;
    }
    for (Vector<2>& corner : rod.outline)
    {
        corner -= lowest;
    }
    // At the end, with arm r from the mass centre: M v+ = P up to inertia, and v+ = 0 there. The impulses, as
    // a share of m v, solve W P = (-v_t, 0) with W = 1/m + (turning part)/J.
    const Vector<2> arm = lowest;
    const double inertia = (length * length + depth * depth) / 12; // over m
    Eigen::Matrix2d compliance;
    compliance << 1 + arm.y() * arm.y() / inertia, -arm.x() * arm.y() / inertia, -arm.x() * arm.y() / inertia,
        1 + arm.x() * arm.x() / inertia;
    return {rod, compliance.inverse() * Vector<2>(1, 0)};
}

inline DynamicCase<2> sceneOf(Assembly<2> assembly, const Settings& settings)
{
    DynamicCase<2> scene;
    const std::vector<double> densities(assembly.blocks.size(), settings.density);
    setStructure(scene, std::move(assembly), densities);
    setGravity(scene, settings.gravity);
    scene.contact.friction = CoulombFriction{settings.mu, settings.flowRule};
    if (settings.restitution > 0)
    {
        scene.contact.restitution = Restitution{settings.restitution};
    }
    scene.schemes.timeIntegration.theta = settings.theta;
    scene.schemes.impacts = settings.impacts;
    scene.solution.tolerance = settings.tolerance;
    scene.solution.solver = settings.solver;
    return scene;
}

/// The ground moves along x.
inline void shake(DynamicCase<2>& scene, std::shared_ptr<const GroundAcceleration> acceleration)
{
    GroundMotion::Component component;
    component.acceleration = std::move(acceleration);
    setGroundMotion<2>(scene.effects, {{component}});
}

/// What the ledger leaves unexplained, relative to the largest of its terms.
inline double relativeImbalance(const EnergyLedger& energy)
{
    const double scale =
        std::max({energy.kinetic, std::abs(energy.potential), std::abs(energy.opening),
                  std::abs(energy.frictionLoss), std::abs(energy.impactLoss), std::abs(energy.externalWork)});
    return imbalance(energy) == 0 ? 0 : std::abs(imbalance(energy)) / scale;
}

} // namespace drystone::scenes
