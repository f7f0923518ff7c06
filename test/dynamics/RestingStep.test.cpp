// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What steps at rest cost while the ground shakes, before and after the blocks have moved.
#include "Scenes.h"
#include "SpaceScenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace drystone
{
namespace
{

constexpr double timeStep = 0.002;

/// A strong pulse there and back between weak shaking, which a wall carries at rest [m/s2].
class PulseInTremor final : public GroundAcceleration
{
public:
    double at(double time) const override
    {
        const double tremor = 0.5 * std::sin(2 * std::numbers::pi * 5 * time);
        const bool isIn = time > begin && time < begin + 2 * half;
        return tremor + (isIn ? (time < begin + half ? strong : -strong) : 0);
    }
    double integral(double from, double to) const override
    {
        return (to - from) * at((from + to) / 2); // steps of 2 ms
    }
    std::vector<double> kinks() const override { return {begin, begin + half, begin + 2 * half}; }
    double peak() const override { return strong + 0.5; }

    static constexpr double strong = 6;
    static constexpr double begin = 0.1;
    static constexpr double half = 0.04;
};

struct Shaking
{
    int restingBefore = 0; ///< steps
    int factorisationsBefore = 0;
    int restingAfter = 0;
    int factorisationsAfter = 0;
    double moved = 0; ///< by the farthest block [m]
};

template<int Dim>
Shaking shaken(const DynamicCase<Dim>& scene)
{
    Shaking result;
    Motion<Dim> motion = startMotion(scene, stateAtRest(scene.assembly));
    bool isStill = true;
    for (int step = 0; step < 400; ++step)
    {
        if (!advance(scene, motion, timeStep))
        {
            ADD_FAILURE() << "step " << step;
            break;
        }
        const bool staysStill = isStill && motion.state.velocity.isZero(0);
        isStill = motion.state.velocity.isZero(0);
        const bool isBefore = motion.state.time < PulseInTremor::begin;
        if (staysStill)
        {
            ++(isBefore ? result.restingBefore : result.restingAfter);
            (isBefore ? result.factorisationsBefore : result.factorisationsAfter) +=
                motion.residuals.factorisations;
        }
    }
    for (const Placement<Dim>& placement : motion.state.placements)
    {
        result.moved = std::max(result.moved, placement.translation.norm());
    }
    return result;
}

void expectFewFactorisations(const Shaking& shaking, double farthest)
{
    EXPECT_GE(shaking.restingBefore, 48);
    EXPECT_LE(shaking.factorisationsBefore, 2 * shaking.restingBefore);
    EXPECT_GE(shaking.restingAfter, 50);
    EXPECT_LE(shaking.factorisationsAfter, 2 * shaking.restingAfter);
    EXPECT_GT(shaking.moved, farthest) << "nothing has moved, so that nothing is shown";
}

class StandingBlocks : public testing::TestWithParam<FlowRule>
{
};

/// Blocks 0.4 x 0.2 x 0.2 m in running bond.
template<int Dim>
Block<Dim> brick(double left, double bottom)
{
    if constexpr (Dim == 2)
    {
        return scenes::rectangle(left, bottom, 0.4, 0.2);
    }
    else
    {
        return spaceScenes::boxBlock({left, -0.1, bottom}, {left + 0.4, 0.1, bottom + 0.2});
    }
}

template<int Dim>
void addBricks(Assembly<Dim>& assembly)
{
    for (int course = 0; course < 4; ++course)
    {
        for (int unit = 0; unit < 3; ++unit)
        {
            assembly.blocks.push_back(brick<Dim>(0.4 * unit + 0.1 * (course % 2), 0.2 * course));
        }
    }
}

// The loads change in each step, so that the forces of the last one never balance them. Blocks that have slid
// and rocked are left with gaps of 1e-14 to 1e-10 m in joints that carry, and with others in those that do
// not, at which the interior point had put roundings of forces.
TEST_P(StandingBlocks, TakeAFactorisationAStepBeforeAndAfterTheyHaveMovedInThePlane)
{
    Assembly<2> assembly = scenes::ground(-3, 5);
    addBricks(assembly);
    DynamicCase<2> scene =
        scenes::sceneOf(std::move(assembly), {.mu = 0.45, .flowRule = GetParam(), .tolerance = 1e-9});
    scenes::shake(scene, std::make_shared<PulseInTremor>());
    expectFewFactorisations(shaken(scene), 3e-4);
}

TEST_P(StandingBlocks, TakeAFactorisationAStepBeforeAndAfterTheyHaveMovedInSpace)
{
    Assembly<3> assembly;
    assembly.supports.push_back({"ground", "ground"});
    assembly.blocks.push_back(spaceScenes::boxBlock({-3, -2, -1}, {5, 2, 0}, 0));
    addBricks(assembly);
    DynamicCase<3> scene = spaceScenes::sceneOf(std::move(assembly), 1, 0.45, {0, 0, -g}, GetParam());
    scene.solution.tolerance = 1e-9;
    std::vector<GroundMotion::Component> components(1);
    components[0].acceleration = std::make_shared<PulseInTremor>();
    setGroundMotion<3>(scene.effects, {components});
    expectFewFactorisations(shaken(scene), 3e-4);
}

INSTANTIATE_TEST_SUITE_P(FlowRules, StandingBlocks,
                         testing::Values(FlowRule::associative, FlowRule::nonAssociative),
                         [](const auto& info)
                         { return info.param == FlowRule::associative ? "associative" : "nonAssociative"; });

} // namespace
} // namespace drystone
