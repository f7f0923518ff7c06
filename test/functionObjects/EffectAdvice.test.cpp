// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Advice before a run: closed criteria against blocks whose answers are known.
#include "functionObjects/EffectAdvice.h"
#include "../dynamics/Scenes.h"
#include "effects/JointElasticity.h"

#include <gtest/gtest.h>

#include <limits>

using namespace drystone;
using namespace drystone::scenes;

namespace
{

/// A block of 0.5 m x 2 m, alpha = min(mu, 0.25), shaken along x and y by constant accelerations [g].
DynamicCase<2> shakenBlock(double mu, double horizontal, double vertical = 0)
{
    Assembly<2> assembly = ground(-5, 5);
    assembly.blocks.push_back(rectangle(0, 0, 0.5, 2));
    Settings settings;
    settings.mu = mu;
    settings.flowRule = FlowRule::associative;
    DynamicCase<2> scene = sceneOf(std::move(assembly), settings);
    const auto add = [&scene](const Eigen::Vector3d& direction, double value)
    {
        GroundMotion::Component component;
        component.direction = direction;
        component.acceleration = std::make_shared<ConstantAcceleration>(value * g);
        GroundMotion ground = groundMotionOf(scene.effects);
        ground.components.push_back(component);
        setGroundMotion(scene.effects, ground);
    };
    if (horizontal != 0)
    {
        add(Eigen::Vector3d::UnitX(), horizontal);
    }
    if (vertical != 0)
    {
        add(Eigen::Vector3d::UnitY(), vertical);
    }
    return scene;
}

EffectAdvice adviceFor(const DynamicCase<2>& scene)
{
    return adviseEffects(scene, stateAtRest(scene.assembly));
}

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

} // namespace

TEST(EffectAdvice, BelowAlphaStaticsSufficeAndDemandIsTheInclinationOfTheLoad)
{
    const DynamicCase<2> scene = shakenBlock(0.6, 0.2);
    const EffectAdvice advice = adviceFor(scene);
    ASSERT_TRUE(advice.isAssessed);
    EXPECT_NEAR(advice.capacity, 0.25 / 0.2, 1e-6);
    EXPECT_NEAR(advice.frictionDemand, 0.2, 2e-4);
    const std::string text = adviceText(scene, advice);
    EXPECT_TRUE(contains(text, "Peak a/g = 0.2 is below")) << text;
    EXPECT_TRUE(contains(text, "alpha = 0.25)")) << text;
    EXPECT_TRUE(contains(text, "no joint slides")) << text;
    EXPECT_FALSE(contains(text, "Warning")) << text;
}

TEST(EffectAdvice, BeyondAlphaABlockRocksWhereFrictionIsMoreThanItsSlenderness)
{
    const EffectAdvice rocking = adviceFor(shakenBlock(0.6, 0.5));
    EXPECT_NEAR(rocking.capacity, 0.25 / 0.5, 1e-6);
    EXPECT_NEAR(rocking.frictionDemand, 0.25, 2e-4);
    const DynamicCase<2> scene = shakenBlock(0.1, 0.5);
    const EffectAdvice sliding = adviceFor(scene);
    EXPECT_NEAR(sliding.capacity, 0.1 / 0.5, 1e-6);
    EXPECT_NEAR(sliding.frictionDemand, 0.25, 2e-4);
    EXPECT_TRUE(contains(adviceText(scene, sliding), "joints slide")) << adviceText(scene, sliding);
    EXPECT_TRUE(contains(adviceText(scene, sliding), "exceeds")) << adviceText(scene, sliding);
}

TEST(EffectAdvice, WarnsWithinFivePercentOfABorderAndNotBeyond)
{
    const auto text = [](double mu, double peak)
    {
        const DynamicCase<2> scene = shakenBlock(mu, peak);
        return adviceText(scene, adviceFor(scene));
    };
    EXPECT_TRUE(contains(text(0.6, 0.241), "Warning: the peak")) << text(0.6, 0.241);
    EXPECT_TRUE(contains(text(0.6, 0.26), "Warning: the peak")) << text(0.6, 0.26);
    EXPECT_FALSE(contains(text(0.6, 0.235), "Warning")) << text(0.6, 0.235);
    EXPECT_FALSE(contains(text(0.6, 0.27), "Warning")) << text(0.6, 0.27);
    EXPECT_TRUE(contains(text(0.26, 0.4), "Warning: the friction demand")) << text(0.26, 0.4);
    EXPECT_EQ(margin(0.94, 1), Margin::below);
    EXPECT_EQ(margin(0.96, 1), Margin::nearLimit);
    EXPECT_EQ(margin(1.04, 1), Margin::nearLimit);
    EXPECT_EQ(margin(1.06, 1), Margin::above);
    EXPECT_EQ(margin(1, std::numeric_limits<double>::infinity()), Margin::below);
}

TEST(EffectAdvice, OfTwoComponentsTheWorstCornerCounts)
{
    // Rising ground presses, falling ground relieves: a_h/(g - a_v) = b/h at the worst, so that
    // s 0.2 = 0.25 (1 - s 0.3).
    const EffectAdvice advice = adviceFor(shakenBlock(0.6, 0.2, 0.3));
    EXPECT_NEAR(advice.capacity, 0.25 / (0.2 + 0.25 * 0.3), 1e-6);
    EXPECT_NEAR(advice.peak, std::hypot(0.2, 0.3) * g, 1e-9);
    // Friction is demanded by what can be carried: up to 0.25 where the block would rock.
    EXPECT_NEAR(advice.frictionDemand, 0.25, 3e-4);
}

TEST(EffectAdvice, IsSilentWhereItsCriteriaDoNotHold)
{
    DynamicCase<2> scene = shakenBlock(0.6, 0.2);
    DynamicState<2> start = stateAtRest(scene.assembly);
    start.velocity[0] = 1;
    EXPECT_FALSE(adviseEffects(scene, start).isAssessed);
    EXPECT_TRUE(contains(adviceText(scene, adviseEffects(scene, start)), "do not start at rest"));
    scene.effects = {std::make_shared<JointElasticity<2>>(Elasticity{1e8, 1e8})};
    EXPECT_FALSE(adviceFor(scene).isAssessed);
}

TEST(EffectAdvice, OfAStillGroundTheDeadLoadDecides)
{
    DynamicCase<2> scene = shakenBlock(0.6, 0);
    EXPECT_TRUE(contains(adviceText(scene, adviceFor(scene)), "stay at rest"));
    // A block that overhangs its support by more than half falls.
    Assembly<2> assembly = ground(-5, 0.2);
    assembly.blocks.push_back(rectangle(0, 0, 0.5, 2));
    scene = sceneOf(std::move(assembly), Settings());
    EXPECT_EQ(adviceFor(scene).capacity, 0);
    EXPECT_TRUE(contains(adviceText(scene, adviceFor(scene)), "cannot carry their dead load"));
}
