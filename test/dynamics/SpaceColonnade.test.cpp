// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Columns of drums under architraves, whose ground shakes in three directions: they come to rest and begin
/// to move again many times.
#include "SpaceScenes.h"

#include "effects/GroundMotion.h"
#include "texture/space/Extrusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace drystone
{
namespace
{

constexpr double pitch = 2.4;        // of the columns [m]
constexpr double shaft = 5;          // its height [m]
constexpr double radiusAtFoot = 0.5; // of the corners [m]
constexpr double radiusAtHead = 0.4;

struct Colonnade
{
    int sides;
    int columns;
    int drums;
};

/// A drum with its axis at x, from one height to another; it tapers as the shaft does.
Block<3> drum(int sides, double x, double lower, double upper)
{
    const auto radiusAt = [](double height)
    { return radiusAtFoot + (radiusAtHead - radiusAtFoot) * height / shaft; };
    Polygon outline;
    for (int side = 0; side < sides; ++side)
    {
        const double angle = 2 * std::numbers::pi * (side + 0.5) / sides;
        outline.emplace_back(std::cos(angle), std::sin(angle));
    }
    Block<3> block;
    block.shape = extruded(outline, lower, upper);
    for (Vector<3>& vertex : block.shape.vertices)
    {
        const double height = vertex.y(); // the prism lies along y
        const double radius = radiusAt(height);
        vertex = {x + radius * vertex.x(), -radius * vertex.z(), height};
    }
    return block;
}

Assembly<3> built(const Colonnade& colonnade)
{
    using spaceScenes::boxBlock;
    constexpr double abacus = 0.4;
    constexpr double architrave = 0.7;
    const double length = (colonnade.columns - 1) * pitch;
    Assembly<3> assembly;
    assembly.supports.push_back({"ground", "ground"});
    assembly.blocks.push_back(boxBlock({-1, -1, -0.4}, {length + 1, 1, 0}, 0));
    for (int column = 0; column < colonnade.columns; ++column)
    {
        const double x = column * pitch;
        for (int i = 0; i < colonnade.drums; ++i)
        {
            assembly.blocks.push_back(
                drum(colonnade.sides, x, shaft * i / colonnade.drums, shaft * (i + 1) / colonnade.drums));
        }
        assembly.blocks.push_back(boxBlock({x - 0.55, -0.55, shaft}, {x + 0.55, 0.55, shaft + abacus}));
    }
    for (int bay = 0; bay + 1 < colonnade.columns; ++bay)
    {
        const double left = bay == 0 ? -0.5 : bay * pitch;
        const double right = bay + 2 == colonnade.columns ? length + 0.5 : (bay + 1) * pitch;
        assembly.blocks.push_back(
            boxBlock({left, -0.4, shaft + abacus}, {right, 0.4, shaft + abacus + architrave}));
    }
    return assembly;
}

/// As an earthquake begins: waves that grow, of another length in each direction.
GroundMotion shaking(double along, double across)
{
    const auto waves = [](double growth, double perSecond, const Vector<3>& direction)
    {
        constexpr double interval = 0.02;
        std::vector<double> times;
        std::vector<double> values;
        for (int i = 0; i <= 100; ++i)
        {
            const double time = i * interval;
            times.push_back(time);
            values.push_back(growth * time * std::sin(2 * std::numbers::pi * perSecond * time));
        }
        GroundMotion::Component component;
        component.acceleration = tabulatedAcceleration(std::move(times), std::move(values),
                                                       Interpolation::linear, OutOfBounds::zero);
        component.direction = direction;
        return component;
    };
    return {{waves(along, 2.1, Vector<3>::UnitX()), waves(across, 1.3, Vector<3>::UnitY()),
             waves(across / 2, 3.7, Vector<3>::UnitZ())}};
}

class ColonnadeInSpace : public testing::TestWithParam<Colonnade>
{
};

// Such structures stopped within half a second: points that had given way in the last step were rigid in the
// next, which pushed blocks that stand apart by 1e-10 m, again and again; the programs of what begins to move
// went round in threes; and each took hundreds of factorisations to show whether it stands still.
TEST_P(ColonnadeInSpace, ComesToRestAndBeginsToMoveByCoulombsLaw)
{
    constexpr int steps = 500;
    DynamicCase<3> scene = spaceScenes::sceneOf(built(GetParam()), 1, 0.7, {0, 0, -g});
    scene.solution.tolerance = 1e-8;
    setGroundMotion<3>(scene.effects, shaking(3, 1));
    Motion<3> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < steps; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, 0.002)) << "step " << step;
        EXPECT_LE(motion.residuals.primalResidual, scene.solution.tolerance) << "step " << step;
        EXPECT_LE(motion.residuals.dualResidual, scene.solution.tolerance) << "step " << step;
    }
    double moved = 0;
    for (const Placement<3>& placement : motion.state.placements)
    {
        moved = std::max(moved, placement.translation.norm());
    }
    EXPECT_GT(moved, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(OfDrums, ColonnadeInSpace, testing::Values(Colonnade{12, 4, 2}, Colonnade{16, 4, 4}),
                         [](const auto& colonnade) {
                             return std::to_string(colonnade.param.drums) + "With"
                                    + std::to_string(colonnade.param.sides) + "Sides";
                         });

} // namespace
} // namespace drystone
