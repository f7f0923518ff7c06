// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which effects a case simulates by what it selects: as given, and with everything on.
#include "dynamics/DynamicCase.h"

#include "../ReportOf.h"
#include "Scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace drystone;
using namespace drystone::scenes;

namespace
{

/// A block that leans over its ground and slides, with all that needs no data left out by hand.
DynamicCase<2> slidingBlock(EffectSelection selection)
{
    Assembly<2> assembly = ground(-2, 5);
    assembly.blocks.push_back(rectangle(0, 0, 1, 0.5));
    DynamicCase<2> scene = sceneOf(std::move(assembly), {.mu = 0.3, .flowRule = FlowRule::associative});
    shake(scene, std::make_shared<ConstantAcceleration>(0.5 * g));
    scene.schemes.smallDisplacements = true;
    scene.schemes.impacts = ImpactInstant::stepStart;
    scene.schemes.effects.selection = selection;
    return scene;
}

DynamicState<2> endOf(const DynamicCase<2>& scene)
{
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    for (int step = 0; step < 20; ++step)
    {
        EXPECT_TRUE(advance(scene, motion, 0.01)) << step;
    }
    return motion.state;
}

TEST(DynamicCase, WithEverythingOnWhatTakesNoDataIsAdded)
{
    DynamicCase<2> scene = slidingBlock(EffectSelection::everything);
    addLeftOut(scene);
    EXPECT_FALSE(scene.schemes.smallDisplacements);
    EXPECT_EQ(scene.flowRule(), FlowRule::nonAssociative);
    EXPECT_EQ(scene.schemes.impacts, ImpactInstant::located);
    EXPECT_THAT(scene.addedEffects,
                testing::ElementsAre("large displacements", "Coulomb's law", "impacts when blocks meet"));
    const DynamicCase<2> once = scene;
    addLeftOut(scene); // nothing is left
    EXPECT_EQ(scene.addedEffects, once.addedEffects);
}

TEST(DynamicCase, OtherSelectionsAddNothing)
{
    for (const EffectSelection selection : {EffectSelection::asGiven, EffectSelection::automatic})
    {
        DynamicCase<2> scene = slidingBlock(selection);
        addLeftOut(scene);
        EXPECT_TRUE(scene.schemes.smallDisplacements);
        EXPECT_EQ(scene.flowRule(), FlowRule::associative);
        EXPECT_EQ(scene.schemes.impacts, ImpactInstant::stepStart);
        EXPECT_THAT(scene.addedEffects, testing::IsEmpty());
    }
}

TEST(DynamicCase, WithoutFrictionThereIsNoFlowRuleToAdd)
{
    DynamicCase<2> scene = slidingBlock(EffectSelection::everything);
    scene.contact.friction.reset();
    addLeftOut(scene);
    EXPECT_FALSE(scene.contact.friction);
    EXPECT_THAT(scene.addedEffects, testing::ElementsAre("large displacements", "impacts when blocks meet"));
}

TEST(DynamicCase, WithEverythingOnTheMotionIsThatOfTheCaseThatNamesIt)
{
    DynamicCase<2> everything = slidingBlock(EffectSelection::everything);
    addLeftOut(everything);
    DynamicCase<2> named = slidingBlock(EffectSelection::asGiven);
    named.schemes.smallDisplacements = false;
    named.schemes.impacts = ImpactInstant::located;
    named.contact.friction->flowRule = FlowRule::nonAssociative;
    const DynamicState<2> one = endOf(everything);
    const DynamicState<2> other = endOf(named);
    EXPECT_EQ(one.placements[1].translation, other.placements[1].translation);
    EXPECT_EQ(one.placements[1].rotation, other.placements[1].rotation);
    // As given the block opens its joint by mu times its slip.
    const DynamicState<2> asGiven = endOf(slidingBlock(EffectSelection::asGiven));
    EXPECT_NEAR(one.placements[1].translation.y(), 0, 1e-8);
    EXPECT_GT(asGiven.placements[1].translation.y(), 1e-3);
}

TEST(Schemes, SelectionsAreNamedAndRefusedByTheirLine)
{
    const auto faultOf = [](const std::string& text)
    { return reportOf([&] { readOptions<Schemes>(Dictionary::readString(text, "schemes")); }); };
    EXPECT_EQ(faultOf("effects { selection everything; }"), "no error");
    EXPECT_THAT(faultOf("effects\n{\nselection everthing; }"),
                testing::AllOf(testing::HasSubstr("Did you mean everything?"), testing::HasSubstr("line 3")));
    EXPECT_THAT(faultOf("effects { selection everything;\nverifyInterval 5; }"),
                testing::HasSubstr("verifyInterval needs `selection automatic;`"));
    EXPECT_THAT(
        faultOf("smallDisplacements yes; effects { selection everything; }\ninitialGaps { perturbation "
                "1e-9; }"),
        testing::AllOf(testing::HasSubstr("remove one of the two"), testing::HasSubstr("line 2")));
}

} // namespace
