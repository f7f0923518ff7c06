// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Structures in space for tests: blocks on ground, of unit weight, pushed in a direction.
#pragma once

#include "assembly/Assembly.h"
#include "assembly/Loads.h"
#include "contact/ContactPoint.h"
#include "statics/LimitAnalysis.h"
#include "statics/Settlement.h"
#include "texture/RunningBond.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace drystone::test
{

inline constexpr int instances = 100;
inline constexpr double exact = 1e-6; ///< absolute, on multipliers; the solver's tolerance is 1e-9

/// Strengths of a joint [Pa].
struct Stresses
{
    double cohesion = 0;
    double tension = 0;
    double crushing = std::numeric_limits<double>::infinity();
};

/// The same instances in every run; a failure prints seed and instance.
struct Chance
{
    std::mt19937 generator;
    explicit Chance(unsigned seed) : generator(seed) {}
    double operator()(double lower, double upper)
    {
        return std::uniform_real_distribution<double>(lower, upper)(generator);
    }
};

inline Assembly<3> onGround(const std::vector<Polyhedron>& shapes)
{
    Assembly<3> assembly;
    for (const Polyhedron& shape : shapes)
    {
        assembly.blocks.push_back({shape, -1});
    }
    assembly.blocks.push_back({makeBox({-50, -50, -1}, {50, 50, 0}), 0});
    assembly.supports = {{"ground", "ground"}};
    return assembly;
}

template<int Dim>
std::vector<double> unitMasses(const Assembly<Dim>& assembly)
{
    std::vector<double> masses;
    for (const BlockMass<Dim>& block : blockMasses(assembly))
    {
        masses.push_back(block.volume);
    }
    return masses;
}

inline LoadVectors pushed(const Assembly<3>& assembly, const Vector<3>& direction,
                          const Vector<3>& gravity = {0, 0, -1})
{
    const std::vector<double> masses = unitMasses(assembly);
    return {gravityLoad(assembly, masses, gravity), inertialLoad(assembly, masses, gravity, direction)};
}

inline SpaceConeProgram programOf(const Assembly<3>& assembly, const std::vector<ContactPoint<3>>& points,
                                  double mu, const LoadVectors& loads)
{
    return limitAnalysisProgram(static_cast<int>(loads.dead.size()) / 6,
                                equilibriumColumns(assembly, blockMasses(assembly), points),
                                std::vector<double>(points.size(), mu), loads);
}

inline LimitAnalysis collapse(const Assembly<3>& assembly, const std::vector<ContactPoint<3>>& points,
                              double mu, const LoadVectors& loads)
{
    return solveLimitAnalysis(programOf(assembly, points, mu, loads));
}

/// Multiplier of each block's own weight along a direction; NaN where there is none.
inline double multiplier(const Assembly<3>& assembly, double mu, const Vector<3>& direction,
                         const Vector<3>& gravity = {0, 0, -1})
{
    const LimitAnalysis result =
        collapse(assembly, findContactPoints(assembly), mu, pushed(assembly, direction, gravity));
    return result.status == CollapseStatus::optimal ? result.alpha : std::numeric_limits<double>::quiet_NaN();
}

/// The prism over a polygon of x-y between two heights.
inline Polyhedron prism(const std::vector<Vector<2>>& outline, double bottom, double top)
{
    std::vector<Vector<3>> below;
    std::vector<Vector<3>> above;
    for (const Vector<2>& corner : outline)
    {
        below.emplace_back(corner.x(), corner.y(), bottom);
        above.emplace_back(corner.x(), corner.y(), top);
    }
    return makePrism(below, above);
}

/// The corners of a regular polygon about the origin, the first of them along x.
inline std::vector<Vector<2>> regularPolygon(int sides, double circumradius)
{
    std::vector<Vector<2>> outline;
    for (int k = 0; k < sides; ++k)
    {
        const double angle = 2 * std::numbers::pi * k / sides;
        outline.emplace_back(circumradius * std::cos(angle), circumradius * std::sin(angle));
    }
    return outline;
}

/// Boxes of 2 a, 2 b and the height h on each other, and on the ground.
inline Assembly<3> tower(double a, double b, double h, int count)
{
    std::vector<Polyhedron> boxes;
    for (int k = 0; k < count; ++k)
    {
        boxes.push_back(makeBox({-a, -b, h * k}, {a, b, h * (k + 1)}));
    }
    return onGround(boxes);
}

/// A wall of the plane on the ground, its last block.
inline Assembly<2> wallOnGround(const RunningBond& bond)
{
    Assembly<2> wall = makeAssembly(bond);
    wall.blocks.push_back({{{-9, -1}, {9, -1}, {9, 0}, {-9, 0}}, 1, 0});
    wall.supports = {{"ground", "ground"}};
    return wall;
}

/// The free blocks of a wall of the plane with a thickness, on the ground.
inline Assembly<3> extruded(const Assembly<2>& wall, double thickness)
{
    std::vector<Polyhedron> shapes;
    for (const Block<2>& block : wall.blocks)
    {
        if (block.support < 0)
        {
            std::vector<Vector<3>> front;
            std::vector<Vector<3>> back;
            for (const Vector<2>& corner : block.outline)
            {
                front.emplace_back(corner.x(), 0, corner.y());
                back.emplace_back(corner.x(), thickness, corner.y());
            }
            shapes.push_back(makePrism(back, front)); // counter-clockwise seen from the front
        }
    }
    return onGround(shapes);
}

/// The assembly turned about the origin, scaled and moved.
inline Assembly<3> transformed(Assembly<3> assembly, const Eigen::Matrix3d& turn, double scale,
                               const Vector<3>& move)
{
    for (Block<3>& block : assembly.blocks)
    {
        for (Vector<3>& vertex : block.shape.vertices)
        {
            vertex = scale * (turn * vertex) + move;
        }
        if (turn.determinant() < 0)
        {
            for (std::vector<int>& face : block.shape.faces)
            {
                std::reverse(face.begin(), face.end());
            }
        }
    }
    return assembly;
}

} // namespace drystone::test
