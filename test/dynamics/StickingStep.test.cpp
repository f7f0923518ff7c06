// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Steps by Coulomb's law in which nothing slides are taken by the associative law, and those in which
/// something does are not.
#include "dynamics/StickingStep.h"

#include "RandomWalls.h"
#include "SpaceScenes.h"
#include "dynamics/Advance.h"
#include "dynamics/VerifiedStep.h"
#include "effects/JointBonds.h"
#include "effects/Restitution.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

using namespace drystone;

namespace
{

/// With the effects that steps call for. \param mu friction
template<int Dim>
DynamicCase<Dim> byCoulombsLaw(Assembly<Dim> assembly, double mu)
{
    DynamicCase<Dim> scene;
    const std::vector<double> densities(assembly.blocks.size(), 2000);
    setStructure(scene, std::move(assembly), densities);
    setGravity<Dim>(scene, -9.81 * Vector<Dim>::Unit(Dim - 1));
    scene.contact.friction = CoulombFriction{mu, FlowRule::nonAssociative};
    scene.schemes.effects.selection = EffectSelection::automatic;
    return scene;
}

/// Square drums on top of each other, on the ground. \param mu friction
DynamicCase<3> columnOfDrums(int drums, double mu)
{
    Assembly<3> assembly;
    assembly.supports.push_back({"ground", "ground"});
    for (int drum = -1; drum < drums; ++drum)
    {
        const double half = drum < 0 ? 3 : 0.2;
        assembly.blocks.push_back(spaceScenes::boxBlock({-half, -half, 0.3 * drum},
                                                        {half, half, 0.3 * drum + 0.3}, drum < 0 ? 0 : -1));
    }
    return byCoulombsLaw(std::move(assembly), mu);
}

/// Velocities as of a rigid column that begins to turn about the edge of its base at x = 0.2. \param speed
/// of turning [1/s]
Motion<3> turning(const DynamicCase<3>& scene, double speed)
{
    DynamicState<3> state = stateAtRest(scene.assembly);
    for (std::size_t block = 0; block < scene.free.size(); ++block)
    {
        if (const int body = scene.free[block]; body >= 0)
        {
            const Vector<3> arm = scene.blocks[block].centroid - Vector<3>(0.2, 0, 0);
            const Vector<3> turn(0, speed, 0);
            state.velocity.segment<6>(6 * body) << turn.cross(arm), turn;
        }
    }
    return startMotion(scene, std::move(state));
}

/// Takes steps, each with all effects too. \return the largest difference, of the error allowed in gaps
double largestDifference(const DynamicCase<3>& scene, Motion<3>& motion, int steps, double timeStep)
{
    for (int step = 0; step < steps; ++step)
    {
        const Motion<3> before = motion;
        if (!advance(scene, motion, timeStep))
        {
            ADD_FAILURE() << "step " << step << " was not solved";
            break;
        }
        verifyStep(scene, before, timeStep, motion);
    }
    return motion.effectUse.largestDifference / (scene.schemes.contactTolerance * scene.blockSize);
}

TEST(StickingStep, AColumnThatRocksWithoutSlidingIsTakenByTheAssociativeLaw)
{
    const DynamicCase<3> scene = columnOfDrums(6, 0.7);
    Motion<3> motion = turning(scene, 0.2);
    EXPECT_LE(largestDifference(scene, motion, 50, 0.002), 1);
    EXPECT_EQ(motion.effectUse.sticking, 50);
    EXPECT_GT(motion.state.placements.back().translation.norm(), 0.01);
}

TEST(StickingStep, ABoxThatSlidesIsNot)
{
    const DynamicCase<3> scene = columnOfDrums(1, 0.3);
    DynamicState<3> state = stateAtRest(scene.assembly);
    state.velocity[0] = 1;
    DynamicCase<3> asGiven = scene;
    asGiven.schemes.effects.selection = EffectSelection::asGiven;
    Motion<3> motion = startMotion(scene, state);
    Motion<3> given = startMotion(asGiven, state);
    for (int step = 0; step < 50; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, 0.002));
        ASSERT_TRUE(advance(asGiven, given, 0.002));
        EXPECT_TRUE(motion.slides);
    }
    EXPECT_EQ(motion.effectUse.sticking, 0);
    EXPECT_LE(differenceOf(scene, motion.state, given.state), 1e-12);
    // Once it has come to rest it sticks, and a proof takes over.
    for (int step = 0; step < 250; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, 0.002));
    }
    EXPECT_FALSE(motion.slides);
}

TEST(StickingStep, OnlyWhereForcesThatAreNotUniqueDoNotDecide)
{
    DynamicCase<3> scene = columnOfDrums(2, 0.7);
    EXPECT_TRUE(mayStick(scene));
    DynamicCase<3> other = scene;
    other.schemes.effects.selection = EffectSelection::asGiven;
    EXPECT_FALSE(mayStick(other));
    other = scene;
    other.schemes.timeIntegration.theta = 0.5;
    EXPECT_FALSE(mayStick(other));
    other = scene;
    other.contact.friction = CoulombFriction{0.7, FlowRule::associative};
    EXPECT_FALSE(mayStick(other));
}

/// By Coulomb's law in the plane, on the ground. \param boxes left, right, bottom, top of each
DynamicCase<2> boxesOnGround(const std::vector<std::array<double, 4>>& boxes)
{
    Assembly<2> assembly = randomWalls::ground<2>(1);
    for (const auto& [left, right, bottom, top] : boxes)
    {
        assembly.blocks.push_back(randomWalls::box<2>(left, right, bottom, top, 1));
    }
    return byCoulombsLaw(std::move(assembly), 0.7);
}

bool firstStepMayStick(const DynamicCase<2>& scene)
{
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    Step<2> step(scene, motion, 0.002, {});
    findContacts(step);
    assemble(step);
    return mayStick(step);
}

TEST(StickingStep, InThePlaneOnlyWhereForcesFollowFromTheMotion)
{
    EXPECT_TRUE(firstStepMayStick(boxesOnGround({{0, 1, 0, 1}, {0, 1, 1, 2}, {0.2, 0.9, 2, 3}})));
    EXPECT_TRUE(firstStepMayStick(boxesOnGround({{0, 1, 0, 1}, {2, 3, 0, 1}})));
    EXPECT_FALSE(firstStepMayStick(boxesOnGround({{0, 1, 0, 1}, {1, 2, 0, 1}}))); // a joint beside another
    EXPECT_FALSE(firstStepMayStick(boxesOnGround({{0, 1, 0, 1}, {2, 3, 0, 1}, {0, 3, 1, 2}})));
    // Against a fixed step, whose points press across those of the ground.
    DynamicCase<2> wedged = boxesOnGround({{0, 1, 0, 1}, {1, 2, 0, 0.5}});
    Assembly<2> assembly = wedged.assembly;
    assembly.blocks.back().support = 0;
    setStructure(wedged, std::move(assembly), std::vector<double>(3, 2000));
    setGravity<2>(wedged, {0, -9.81});
    EXPECT_FALSE(firstStepMayStick(wedged));
}

DynamicCase<2> towerOfThePlane()
{
    return boxesOnGround(
        {{0, 0.4, 0, 0.3}, {0, 0.4, 0.3, 0.6}, {0, 0.4, 0.6, 0.9}, {0, 0.4, 0.9, 1.2}, {0, 0.4, 1.2, 1.5}});
}

/// That begins to turn about the edge of its base.
Motion<2> turningTower(const DynamicCase<2>& scene)
{
    DynamicState<2> state = stateAtRest(scene.assembly);
    for (std::size_t block = 0; block < scene.free.size(); ++block)
    {
        if (const int body = scene.free[block]; body >= 0)
        {
            const Vector<2> arm = scene.blocks[block].centroid - Vector<2>(0.4, 0);
            state.velocity.segment<3>(3 * body) << 0.2 * arm.y(), -0.2 * arm.x(), -0.2;
        }
    }
    return startMotion(scene, std::move(state));
}

/// Takes steps, each with all effects too. \return how many of them had all blocks as one body
int stepsAsOneBody(const DynamicCase<2>& scene, Motion<2>& motion, int steps)
{
    int asOne = 0;
    for (int step = 0; step < steps; ++step)
    {
        const Motion<2> before = motion;
        EXPECT_TRUE(advance(scene, motion, 0.002));
        verifyStep(scene, before, 0.002, motion);
        asOne += !motion.bodies.empty() && simulatedBodies(motion) == 1 ? 1 : 0;
    }
    return asOne;
}

TEST(StickingStep, ATowerOfThePlaneThatRocksIsOneBody)
{
    const DynamicCase<2> scene = towerOfThePlane();
    Motion<2> motion = turningTower(scene);
    const int asOne = stepsAsOneBody(scene, motion, 100);
    EXPECT_GE(asOne, 78);
    EXPECT_EQ(motion.effectUse.sticking, 100);
    EXPECT_EQ(motion.effectUse.verified, 100);
    EXPECT_LE(motion.effectUse.largestDifference, scene.schemes.contactTolerance * scene.blockSize);
}

// Nothing meets while it turns; when its base comes down again, all blocks are considered.
TEST(StickingStep, SoItIsWithRestitutionUntilItComesDown)
{
    DynamicCase<2> scene = towerOfThePlane();
    scene.contact.restitution = Restitution{0.3};
    Motion<2> motion = turningTower(scene);
    int asOne = 0;
    int collisions = 0;
    for (int step = 0; step < 300; ++step)
    {
        asOne += stepsAsOneBody(scene, motion, 1);
        if (motion.collisions > 0)
        {
            ++collisions;
            EXPECT_TRUE(motion.bodies.empty()) << step;
        }
    }
    EXPECT_GE(asOne, 150);
    EXPECT_GT(collisions, 0);
    EXPECT_EQ(motion.effectUse.verified, 300);
    EXPECT_LE(motion.effectUse.largestDifference, scene.schemes.contactTolerance * scene.blockSize);
}

// Bonds that friction makes up for are left out with the steps' law; those that hold a block in the air are
// not.
TEST(StickingStep, BondsMatterWhereFrictionAloneDoesNotHold)
{
    const auto bonded = [](DynamicCase<2> scene)
    {
        scene.contact.cohesion = JointStrength{1e6};
        scene.contact.tension = JointStrength{1e6};
        scene.effects.push_back(std::make_shared<JointBonds<2>>(jointBonds(scene.contact, scene.assembly)));
        return scene;
    };
    DynamicCase<2> tower = bonded(towerOfThePlane());
    tower.contact.cohesion = tower.contact.tension = JointStrength{10};
    tower.effects.back() = std::make_shared<JointBonds<2>>(jointBonds(tower.contact, tower.assembly));
    Motion<2> turning = turningTower(tower);
    EXPECT_GE(stepsAsOneBody(tower, turning, 100), 70);
    EXPECT_LE(turning.effectUse.largestDifference, tower.schemes.contactTolerance * tower.blockSize);
    // A shelf that leans out of a tower by more than its half.
    const DynamicCase<2> shelf = bonded(boxesOnGround({{0, 0.4, 0, 0.3}, {0.25, 0.8, 0.3, 0.4}}));
    Motion<2> held = turningTower(shelf);
    held.state.velocity.setZero();
    stepsAsOneBody(shelf, held, 20);
    EXPECT_EQ(held.effectUse.sticking, 0);
    EXPECT_LE(held.state.velocity.lpNorm<Eigen::Infinity>(), 1e-12);
}

} // namespace
