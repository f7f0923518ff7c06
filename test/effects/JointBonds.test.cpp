// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Cohesion and tension in motion: where bonds hold and where they break, against closed forms.
#include "../dynamics/Scenes.h"
#include "TakenSteps.h"

#include "effects/JointBonds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace drystone;
using namespace drystone::scenes;

namespace
{

using test::run;

/// How a block may be computed; the closed forms are the same for all of them.
struct Way
{
    std::string name;
    SolverType solver = SolverType::automatic;
    double tolerance = 1e-10;
    FlowRule flowRule = FlowRule::associative;
    bool smallDisplacements = false;
    double theta = 1;

    /// How near to a threshold it distinguishes one side from the other.
    double margin() const { return std::max(1e-5, 10 * std::sqrt(tolerance)); }
};

std::vector<Way> ways()
{
    return {{"automatic"},
            {"interiorPoint", SolverType::interiorPoint, 1e-9},
            {"augmentedLagrangian", SolverType::augmentedLagrangian},
            {"gaussSeidel", SolverType::gaussSeidel, 1e-7},
            {"nonAssociative", SolverType::automatic, 1e-10, FlowRule::nonAssociative},
            {"smallDisplacements", SolverType::automatic, 1e-10, FlowRule::associative, true},
            {"theta 0.5", SolverType::automatic, 1e-10, FlowRule::nonAssociative, false, 0.5}};
}

/// \param cohesion [Pa] \param tension [Pa]
DynamicCase<2> bondedScene(Assembly<2> assembly, const Settings& settings, double cohesion, double tension)
{
    DynamicCase<2> scene = sceneOf(std::move(assembly), settings);
    scene.contact.cohesion = JointStrength{cohesion};
    scene.contact.tension = JointStrength{tension};
    scene.effects = {std::make_shared<JointBonds<2>>(jointBonds(scene.contact, scene.assembly))};
    return scene;
}

/// Of a scene whose last effect is bonds.
int brokenBonds(const DynamicCase<2>& scene, const Motion<2>& motion)
{
    return dynamic_cast<const JointBonds<2>&>(*scene.effects.back()).broken(motion.effectStates.back());
}

DynamicCase<2> bondedScene(Assembly<2> assembly, Settings settings, double cohesion, double tension,
                           const Way& way)
{
    settings.flowRule = way.flowRule;
    settings.tolerance = way.tolerance;
    settings.theta = way.theta;
    DynamicCase<2> scene = bondedScene(std::move(assembly), settings, cohesion, tension);
    scene.solution.solver = way.solver;
    scene.schemes.smallDisplacements = way.smallDisplacements;
    return scene;
}

/// The ground accelerates by `acceleration` g for all time.
void push(DynamicCase<2>& scene, double acceleration)
{
    PulseShape pulse;
    pulse.amplitude = acceleration * g;
    pulse.duration = 1000;
    shake(scene, std::make_shared<RectangularPulse>(pulse));
}

Motion<2> started(const DynamicCase<2>& scene)
{
    return startMotion(scene, stateAtRest(scene.assembly));
}

/// Whether a structure stands exactly as it was built for some steps; else all that it has moved.
void expectRest(const DynamicCase<2>& scene)
{
    Motion<2> motion = started(scene);
    run(scene, motion, 0.005, 5);
    EXPECT_EQ(brokenBonds(scene, motion), 0);
    for (const Placement<2>& placement : motion.state.placements)
    {
        const bool isExact = scene.solution.solver == SolverType::automatic
                             || scene.solution.solver == SolverType::augmentedLagrangian;
        EXPECT_LE(placement.translation.norm(), isExact ? 0 : 1e-7);
    }
}

Motion<2> expectBreak(const DynamicCase<2>& scene, int bonds)
{
    Motion<2> motion = started(scene);
    run(scene, motion, 0.005, 20);
    EXPECT_EQ(brokenBonds(scene, motion), bonds);
    EXPECT_LT(relativeImbalance(motion.energy), 1e-6);
    return motion;
}

/// A block of 1 m x 1 m under a fixed one.
Assembly<2> hangingBlock()
{
    Assembly<2> assembly = ground(-1, 2, 1); // its underside is at y = -1
    assembly.blocks.push_back(rectangle(0, -2, 1, 1));
    return assembly;
}

Assembly<2> standingBlock(double width, double height)
{
    Assembly<2> assembly = ground(-5, 5);
    assembly.blocks.push_back(rectangle(0, 0, width, height));
    return assembly;
}

} // namespace

TEST(JointBonds, ABlockHangsUntilItsWeightExceedsTensionTimesArea)
{
    const double weight = 1800 * g;
    for (const Way& way : ways())
    {
        SCOPED_TRACE(way.name);
        const double margin = way.margin();
        expectRest(bondedScene(hangingBlock(), {}, weight, weight * (1 + margin), way));
        const DynamicCase<2> weak = bondedScene(hangingBlock(), {}, weight, weight * (1 - margin), way);
        const Motion<2> motion = expectBreak(weak, 2);
        // It falls freely from the start: theta 1 makes that g t (t + dt)/2.
        const double fallen = way.theta == 1 ? g * 0.1 * 0.105 / 2 : g * 0.01 / 2;
        EXPECT_NEAR(-motion.state.placements[1].translation.y(), fallen, 1e-9);
        EXPECT_NEAR(motion.energy.impactLoss, 0, way.tolerance * weight * fallen);
        EXPECT_NEAR(motion.energy.frictionLoss, 0, way.tolerance * weight * fallen);
    }
}

TEST(JointBonds, ABlockOnASlopeSlipsAtTheAngleOfCohesionAndFriction)
{
    const double mu = 0.4;
    const double cohesion = 5000;
    const double weight = 1800 * g * 2 * 0.5;
    // W sin = mu W cos + c A, A = 2 m2, by bisection.
    double low = 0;
    double high = 1.5;
    while (high - low > 1e-14)
    {
        const double angle = (low + high) / 2;
        (weight * std::sin(angle) > mu * weight * std::cos(angle) + 2 * cohesion ? high : low) = angle;
    }
    for (const Way& way : ways())
    {
        SCOPED_TRACE(way.name);
        for (const double side : {-1.0, 1.0})
        {
            const double angle = low + side * way.margin();
            Settings settings;
            settings.mu = mu;
            settings.gravity = g * Vector<2>(std::sin(angle), -std::cos(angle));
            const DynamicCase<2> scene = bondedScene(standingBlock(2, 0.5), settings, cohesion, 0, way);
            if (side < 0)
            {
                expectRest(scene);
                continue;
            }
            const Motion<2> motion = expectBreak(scene, 2);
            // What cohesion held is free at once.
            const double acceleration = g * (std::sin(angle) - mu * std::cos(angle));
            if (way.flowRule == FlowRule::nonAssociative)
            {
                EXPECT_NEAR(motion.state.velocity[0], 0.1 * acceleration, 1e-9);
            }
        }
    }
}

TEST(JointBonds, APushThresholdIsFrictionAndCohesion)
{
    const double weight = 1800 * g * 2 * 0.5;
    for (const Way& way : ways())
    {
        SCOPED_TRACE(way.name);
        Settings settings;
        settings.mu = 0.3;
        DynamicCase<2> scene = bondedScene(standingBlock(2, 0.5), settings, 4000, 0, way);
        const double threshold = 0.3 + 2 * 4000 / weight;
        push(scene, threshold * (1 - way.margin()));
        expectRest(scene);
        push(scene, threshold * (1 + way.margin()));
        expectBreak(scene, 2);
    }
}

TEST(JointBonds, AGluedMonolithRocksAtTheAccelerationOfTheHandFormula)
{
    // About the toe: m a h = W b + (s A/2) 2 b, so a/g = (b/h) (1 + s A/W).
    const double weight = 1800 * g * 0.5 * 2;
    const double tension = 0.7 * weight / 0.5;
    for (const Way& way : ways())
    {
        SCOPED_TRACE(way.name);
        DynamicCase<2> scene = bondedScene(standingBlock(0.5, 2), {}, 2 * tension, tension, way);
        const double threshold = 0.25 * 1.7;
        push(scene, threshold * (1 - way.margin()));
        expectRest(scene);
        push(scene, threshold * (1 + way.margin()));
        const Motion<2> motion = expectBreak(scene, 1); // the heel; the toe turns
        EXPECT_GT(std::abs(motion.state.placements[1].rotation), 1e-3);
    }
}

TEST(JointBonds, ABrokenJointIsADryOne)
{
    // A pulse breaks the base; a second one, that the bond would have withstood, then rocks the block as one
    // that never was glued.
    const auto after = [](double tension)
    {
        Settings settings;
        DynamicCase<2> scene = bondedScene(standingBlock(0.5, 2), settings, 2 * tension, tension);
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        motion.state.velocity[2] = 0.5;
        run(scene, motion, 0.002, 400);
        return motion;
    };
    const Motion<2> glued = after(100);
    const Motion<2> dry = after(0);
    EXPECT_NEAR(glued.state.placements[1].rotation, dry.state.placements[1].rotation, 1e-4);
    EXPECT_NE(dry.state.placements[1].rotation, 0);
}

TEST(JointBonds, OfAChainTheWeakestLinkBreaksAndTheRestHolds)
{
    // Three blocks hang one under the other: joints carry 3 W, 2 W and W, and bear 2.5 W.
    const double weight = 1800 * g;
    for (const Way& way : ways())
    {
        SCOPED_TRACE(way.name);
        Assembly<2> assembly = hangingBlock();
        assembly.blocks.push_back(rectangle(0, -3, 1, 1));
        assembly.blocks.push_back(rectangle(0, -4, 1, 1));
        const DynamicCase<2> scene = bondedScene(std::move(assembly), {}, 2.5 * weight, 2.5 * weight, way);
        const Motion<2> motion = expectBreak(scene, 2);
        for (int block : {1, 2, 3})
        {
            EXPECT_LT(motion.state.placements[block].translation.y(), -0.04);
            EXPECT_NEAR(motion.state.placements[block].translation.y(),
                        motion.state.placements[1].translation.y(), 1e-8);
        }
    }
}

TEST(JointBonds, GluedBlocksSpinAsOne)
{
    Assembly<2> assembly = ground(-5, 5);
    assembly.blocks.push_back(rectangle(0, 3, 1, 1));
    assembly.blocks.push_back(rectangle(0, 4, 1, 1));
    for (const FlowRule flowRule : {FlowRule::associative, FlowRule::nonAssociative})
    {
        Settings settings;
        settings.gravity = {0, 0};
        settings.flowRule = flowRule;
        const DynamicCase<2> scene = bondedScene(assembly, settings, 1e6, 1e6);
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        const double spin = 2;
        motion.state.velocity << spin * 0.5, 0, spin, -spin * 0.5, 0, spin; // about (0.5, 4)
        run(scene, motion, 0.005, 400);
        EXPECT_EQ(brokenBonds(scene, motion), 0);
        const Placement<2>& lower = motion.state.placements[1];
        const Placement<2>& upper = motion.state.placements[2];
        EXPECT_NEAR(lower.rotation, upper.rotation, 1e-7);
        EXPECT_GT(lower.rotation, 3);
        // The mass centres stay a block's height apart, along the turned axis; sliding leaves what the
        // tolerance of gaps allows in each step.
        const Vector<2> apart = Vector<2>(0, 1) + upper.translation - lower.translation;
        const Vector<2> expected(-std::sin(lower.rotation), std::cos(lower.rotation));
        EXPECT_NEAR((apart - expected).norm(), 0, 1e-5);
        // Each joint's end passes the centripetal force of half the couple.
        const double centripetal = 1800 * spin * spin * 0.5;
        double pull = 0;
        for (const Vector<2>& force : motion.contactForces)
        {
            pull -= force.x();
        }
        EXPECT_NEAR(pull, centripetal, 0.05 * centripetal);
    }
}

TEST(JointBonds, GluedBlocksSpinningTooFastPart)
{
    // m w2 h/2 each, against s A: 1800 x 0.5 w2 N.
    for (const double ratio : {0.95, 1.05})
    {
        Assembly<2> assembly = ground(-5, 5);
        assembly.blocks.push_back(rectangle(0, 3, 1, 1));
        assembly.blocks.push_back(rectangle(0, 4, 1, 1));
        Settings settings;
        settings.gravity = {0, 0};
        const double spin = 2;
        const DynamicCase<2> scene = bondedScene(assembly, settings, 1e6, 900 * spin * spin / ratio);
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        motion.state.velocity << spin * 0.5, 0, spin, -spin * 0.5, 0, spin;
        run(scene, motion, 0.001, 100);
        EXPECT_EQ(brokenBonds(scene, motion), ratio > 1 ? 2 : 0);
    }
}

TEST(JointBonds, UnitsOfForceChangeNothing)
{
    const auto endOf = [](double unit)
    {
        Settings settings;
        settings.density = 1800 * unit;
        DynamicCase<2> scene = bondedScene(standingBlock(0.5, 2), settings, 3e4 * unit, 1e4 * unit);
        push(scene, 0.5);
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        run(scene, motion, 0.005, 60);
        EXPECT_EQ(brokenBonds(scene, motion), 1);
        return motion.state.placements[1].rotation;
    };
    const double rotation = endOf(1);
    EXPECT_GT(std::abs(rotation), 0.05);
    for (const double unit : {1e-9, 1e-3, 1e6})
    {
        EXPECT_NEAR(endOf(unit), rotation, 1e-9);
    }
}

TEST(JointBonds, StrengthsBelongToJointsByName)
{
    Assembly<2> assembly = standingBlock(1, 1);
    assembly.blocks.push_back(rectangle(0, 1, 1, 1));
    Settings settings;
    DynamicCase<2> scene = sceneOf(std::move(assembly), settings);
    JointProperties glued;
    glued.cohesion = JointStrength{1000};
    NamePattern name;
    name.text = "1-2";
    name.matches = [](std::string_view joint) { return joint == "1-2"; };
    scene.contact.joints.emplace_back(name, glued);
    const std::vector<Bond<2>> bonds = jointBonds(scene.contact, scene.assembly);
    scene.effects = {std::make_shared<JointBonds<2>>(bonds)};
    ASSERT_EQ(bonds.size(), 4u);
    int held = 0;
    for (const Bond<2>& bond : bonds)
    {
        EXPECT_EQ(bond.strength.cohesion, bond.block == 1 ? 500 : 0); // half of 1 m2 a point
        held += bond.strength.cohesion > 0;
    }
    EXPECT_EQ(held, 2);
    const Motion<2> motion = started(scene);
    EXPECT_EQ(brokenBonds(scene, motion), 0);
    EXPECT_EQ(std::count(motion.effectStates[0].flags.begin(), motion.effectStates[0].flags.end(), true), 2);
    scene.contact.joints[0].second.cohesion = JointStrength{0};
    EXPECT_TRUE(jointBonds(scene.contact, scene.assembly).empty());
}

TEST(JointBonds, EndsThatAreApartFromTheStartDoNotHold)
{
    const DynamicCase<2> scene = bondedScene(standingBlock(1, 1), {}, 1e6, 1e6);
    DynamicState<2> state = stateAtRest(scene.assembly);
    state.placements[1].translation = {0.01, 0};
    const Motion<2> motion = startMotion(scene, state);
    EXPECT_EQ(brokenBonds(scene, motion), 2);
}

TEST(JointBonds, HoldThroughAnImpactThatPressesThem)
{
    // Glued blocks fall flat on the ground and rebound as one.
    Assembly<2> assembly = ground(-5, 5);
    assembly.blocks.push_back(rectangle(0, 0.5, 1, 1));
    assembly.blocks.push_back(rectangle(0, 1.5, 1, 1));
    Settings settings;
    settings.restitution = 0.5;
    const DynamicCase<2> scene = bondedScene(std::move(assembly), settings, 1e6, 1e6);
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    run(scene, motion, 0.002, 300);
    EXPECT_EQ(brokenBonds(scene, motion), 0);
    EXPECT_NEAR(motion.state.placements[1].translation.y(), motion.state.placements[2].translation.y(), 1e-7);
    EXPECT_LT(relativeImbalance(motion.energy), 1e-6);
}

TEST(JointBonds, CrossLockedBlocksOfAWallFindTheirPoints)
{
    // Running bond of three courses: every bond has a point, and none breaks under the weight.
    Assembly<2> assembly = ground(-1, 5);
    for (int course = 0; course < 3; ++course)
    {
        for (int unit = 0; unit < 3; ++unit)
        {
            const double left = unit + (course % 2 == 0 ? 0 : 0.5);
            assembly.blocks.push_back(rectangle(0.4 * left, 0.175 * course, 0.4, 0.175));
        }
    }
    for (const FlowRule flowRule : {FlowRule::associative, FlowRule::nonAssociative})
    {
        Settings settings;
        settings.flowRule = flowRule;
        DynamicCase<2> scene = bondedScene(assembly, settings, 1e5, 1e5);
        push(scene, 2); // far beyond what a dry one stands
        expectRest(scene);
        push(scene, 200);
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        run(scene, motion, 0.002, 10);
        EXPECT_GT(brokenBonds(scene, motion), 0);
    }
}
