// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Effects in addition to friction and impact: elastic contact points and damping, against closed forms.
#include "../dynamics/Scenes.h"
#include "TakenSteps.h"

#include "effects/JointElasticity.h"
#include "effects/MassDamping.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <numbers>

using namespace drystone;
using namespace drystone::scenes;

namespace
{

using test::run;

/// One block of 1 m x 1 m on the ground.
DynamicCase<2> blockOnSprings(double normal, double tangential, Settings settings = {})
{
    Assembly<2> assembly = ground(-5, 5);
    assembly.blocks.push_back(rectangle(0, 0, 1, 1));
    DynamicCase<2> scene = sceneOf(std::move(assembly), settings);
    scene.effects = {std::make_shared<JointElasticity<2>>(Elasticity{normal, tangential})};
    return scene;
}

} // namespace

TEST(JointElasticity, ABlockSettlesByItsWeightOverTheStiffnessOfItsPoints)
{
    for (const double stiffness : {1e6, 1e8, 1e10})
    {
        const DynamicCase<2> scene = blockOnSprings(stiffness, 0.5 * stiffness);
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        // Steps far longer than a period: theta 1 then takes all energy out of the springs.
        run(scene, motion, 0.02, 300);
        const double weight = scene.mass[0] * g;
        ASSERT_EQ(motion.points.size(), 2u);
        EXPECT_NEAR(motion.state.placements[1].translation.y() / (-weight / (2 * stiffness)), 1, 1e-9);
        EXPECT_NEAR(motion.contactForces[0].x(), weight / 2, 1e-9 * weight);
        EXPECT_NEAR(motion.energy.elastic, 0.5 * weight * weight / (2 * stiffness),
                    1e-8 * motion.energy.elastic);
        EXPECT_LT(relativeImbalance(motion.energy), 1e-6);
    }
}

TEST(JointElasticity, ABlockOnSpringsHasTheFrequenciesOfItsStiffnessAndMassMatrices)
{
    const double normal = 2e7;
    const double tangential = 1e7;
    Settings settings;
    settings.mu = 5;           // sticks
    settings.tolerance = 1e-9; // steps of 1e-5 s: less than that of the weight is rounding
    DynamicCase<2> scene = blockOnSprings(normal, tangential, settings);
    scene.schemes.smallDisplacements = true; // no moment of the weight about the leaning block
    // K = A C^-1 A' by hand: points at x = -0.5 and 0.5 beside the mass centre, 0.5 under it.
    Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
    for (const double x : {-0.5, 0.5})
    {
        const Eigen::Vector3d up(0, 1, x);      // vertical displacement of the point
        const Eigen::Vector3d along(1, 0, 0.5); // horizontal one
        stiffness += normal * up * up.transpose() + tangential * along * along.transpose();
    }
    const Eigen::Matrix3d mass = scene.mass.asDiagonal();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> modes(stiffness, mass);
    for (int mode = 0; mode < 3; ++mode)
    {
        const double period = 2 * std::numbers::pi / std::sqrt(modes.eigenvalues()[mode]);
        const Eigen::Vector3d shape = modes.eigenvectors().col(mode).normalized();
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        run(scene, motion, 0.02, 300); // settled
        motion.state.velocity = 1e-4 * shape;
        const auto place = [&]
        {
            const Placement<2>& at = motion.state.placements[1];
            return Eigen::Vector3d(at.translation.x(), at.translation.y(), at.rotation)
                .dot(scene.mass.cwiseProduct(shape));
        };
        const double rest = place();
        const double timeStep = period / 2000;
        double before = rest;
        double measured = 0;
        for (int step = 1; step < 3000 && measured == 0; ++step)
        {
            before = place() - rest;
            ASSERT_TRUE(advance(scene, motion, timeStep)) << "step " << step;
            const double now = place() - rest;
            if (step > 1 && before > 0 && now <= 0) // half a period from the start
            {
                measured = 2 * timeStep * (step - 1 + before / (before - now));
            }
        }
        EXPECT_NEAR(measured / period, 1, 5e-3) << "mode " << mode;
    }
}

TEST(JointElasticity, StifferPointsComeEverNearerToTheRigidBlock)
{
    // Newmark's block: 0.9196875 m. A thousandfold range of stiffness.
    const auto distance = [](std::optional<double> stiffness)
    {
        Settings settings;
        settings.mu = 0.2;
        DynamicCase<2> scene = blockOnSprings(1, 1, settings);
        scene.effects.clear();
        if (stiffness)
        {
            scene.effects = {std::make_shared<JointElasticity<2>>(Elasticity{*stiffness, *stiffness})};
        }
        PulseShape pulse;
        pulse.amplitude = 0.5 * g;
        pulse.duration = 0.5;
        shake(scene, std::make_shared<RectangularPulse>(pulse));
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        run(scene, motion, 2e-3, 1000);
        EXPECT_LT(relativeImbalance(motion.energy), 1e-6);
        return std::abs(motion.state.placements[1].translation.x());
    };
    const double rigid = distance({});
    EXPECT_NEAR(rigid, 0.9196875, 5e-3 * rigid);
    double last = 1;
    for (const double stiffness : {1e6, 1e7, 1e8, 1e9})
    {
        const double error = std::abs(distance(stiffness) - rigid);
        EXPECT_LT(error, last) << stiffness;
        last = error;
    }
    EXPECT_LT(last, 1e-4 * rigid);
}

TEST(JointElasticity, ABlockThatIsPushedBelowItsFrictionComesToRestWithItsShearInTheSprings)
{
    // Over displacements of any size too, where shear leaves nothing to be seen in the places of the blocks.
    for (const bool small : {true, false})
    {
        const double stiffness = 1e7;
        DynamicCase<2> scene = blockOnSprings(stiffness, 0.5 * stiffness);
        scene.schemes.smallDisplacements = small;
        shake(scene, std::make_shared<ConstantAcceleration>(-0.3 * g)); // pushes to the right
        Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
        run(scene, motion, 0.02, 500);
        const double weight = scene.mass[0] * g;
        // Two points share 0.3 W; the block leans by the moment 0.5 m 0.3 W over its rocking stiffness.
        const double lean = 0.15 * weight / (2 * stiffness * 0.25);
        EXPECT_NEAR(motion.state.placements[1].translation.x(), 0.3 * weight / stiffness + 0.5 * lean,
                    1e-3 * weight / stiffness);
        EXPECT_NEAR(motion.contactForces[0].y() + motion.contactForces[1].y(), -0.3 * weight, 1e-6 * weight);
        EXPECT_LT(motion.state.velocity.norm(), 1e-9);
        EXPECT_LT(relativeImbalance(motion.energy), 1e-6);
    }
}

TEST(MassDamping, ABlockThatFallsReachesTheVelocityAtWhichDampingCarriesIt)
{
    Settings settings;
    Assembly<2> assembly = ground(-5, 5);
    assembly.blocks.push_back(rectangle(0, 500, 1, 1));
    DynamicCase<2> scene = sceneOf(std::move(assembly), settings);
    scene.effects = {std::make_shared<MassDamping<2>>(Damping{4})};
    Motion<2> motion = startMotion(scene, stateAtRest(scene.assembly));
    // v1 = (v0 + g dt)/(1 + a dt) in each step of theta 1
    double velocity = 0;
    for (int step = 0; step < 1000; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, 0.01));
        velocity = (velocity - 0.01 * g) / 1.04;
        ASSERT_NEAR(motion.state.velocity[1], velocity, 1e-11);
    }
    EXPECT_NEAR(motion.state.velocity[1], -g / 4, 1e-10);
    EXPECT_GT(motion.energy.dampingLoss, 0);
    EXPECT_LT(relativeImbalance(motion.energy), 1e-10);
}

TEST(MassDamping, DecaysAsTheExponentialToSecondOrderWithThetaOneHalf)
{
    const auto error = [](double timeStep)
    {
        Settings settings;
        settings.theta = 0.5;
        settings.gravity.setZero();
        Assembly<2> assembly = ground(-5, 5);
        assembly.blocks.push_back(rectangle(0, 5, 1, 1));
        DynamicCase<2> scene = sceneOf(std::move(assembly), settings);
        scene.effects = {std::make_shared<MassDamping<2>>(Damping{2})};
        DynamicState<2> start = stateAtRest(scene.assembly);
        start.velocity << 1, 0.5, 3;
        Motion<2> motion = startMotion(scene, start);
        run(scene, motion, timeStep, static_cast<int>(std::lround(1 / timeStep)));
        EXPECT_LT(relativeImbalance(motion.energy), 1e-12);
        return std::abs(motion.state.velocity[2] - 3 * std::exp(-2.0));
    };
    const double coarse = error(0.02);
    const double fine = error(0.01);
    EXPECT_NEAR(coarse / fine, 4, 0.05);
}

namespace
{

/// Amplitude of a block of 0.5 m x 2 m after it was released at `start` and has swung to the other side once.
/// \param facets of its base, which is crowned by `crown` [m]: 1 is flat. A base of many facets rolls over,
/// and each of them takes 1/facets^2 of the loss of a flat one.
double amplitudeAfterOneSwing(int facets, double crown, double start, double damping)
{
    constexpr double halfWidth = 0.25;
    Block<2> block;
    block.thickness = 1;
    block.support = -1;
    for (int i = 0; i <= facets; ++i)
    {
        const double x = halfWidth * (2.0 * i / facets - 1);
        block.outline.emplace_back(x, crown * x * x / (halfWidth * halfWidth));
    }
    block.outline.emplace_back(halfWidth, 2);
    block.outline.emplace_back(-halfWidth, 2);
    Assembly<2> assembly = ground(-4, 4);
    assembly.blocks.push_back(block);
    Settings settings;
    settings.mu = 5;
    DynamicCase<2> scene = sceneOf(std::move(assembly), settings);
    if (damping > 0)
    {
        scene.effects = {std::make_shared<MassDamping<2>>(Damping{damping})};
    }
    // On its left corner.
    const Vector<2> arm = scene.blocks[1].centroid - block.outline.front();
    const Vector<2> turned(std::cos(start) * arm.x() - std::sin(start) * arm.y(),
                           std::sin(start) * arm.x() + std::cos(start) * arm.y());
    DynamicState<2> state = stateAtRest(scene.assembly);
    state.placements[1] = {turned - arm - Vector<2>(0, crown), start};
    Motion<2> motion = startMotion(scene, state);
    double amplitude = 0;
    while (motion.state.time < 3)
    {
        EXPECT_TRUE(advance(scene, motion, 2.5e-4)) << motion.state.time;
        const double other = -motion.state.placements[1].rotation;
        if (other < amplitude && amplitude > 0.01)
        {
            break;
        }
        amplitude = std::max(amplitude, other);
    }
    EXPECT_LT(relativeImbalance(motion.energy), 1e-9);
    return amplitude;
}

} // namespace

TEST(MassDamping, EquivalentToHousnersLossSwingsARollingBlockAsFarAsAnImpactLetsARockingOne)
{
    const double slenderness = 0.24497866;
    for (const double share : {0.3, 0.5, 0.8})
    {
        const double start = share * slenderness;
        const double rocking = amplitudeAfterOneSwing(1, 0, start, 0);
        // 40 facets over 0.004 rad: of the energy at theta = 0 hardly anything is lost where an impact takes
        // 17%,
        const double free = amplitudeAfterOneSwing(40, 5e-4, start, 0);
        const auto energy = [slenderness](double rotation)
        { return std::cos(slenderness - rotation) - std::cos(slenderness); };
        EXPECT_GT(energy(free) / energy(start), 0.97);
        const double ratio = 1 - 1.5 * std::pow(std::sin(slenderness), 2);
        // (backward Euler's own loss, of first order in the step, comes on top)
        EXPECT_NEAR(energy(rocking) / energy(start), ratio * ratio, 0.01);
        // and it is damping that takes what the impact takes.
        const double coefficient = equivalentDamping({slenderness, 1.03077641, start}, g);
        const double damped = amplitudeAfterOneSwing(40, 5e-4, start, coefficient);
        EXPECT_NEAR(damped / rocking, 1, 0.02) << "from " << share;
        const double housner = slenderness - std::acos(std::cos(slenderness) + ratio * ratio * energy(start));
        EXPECT_NEAR(damped / housner, 1, 0.02) << "from " << share;
    }
}

TEST(MassDamping, EquivalentToHousnersLossFollowsTheClosedRelation)
{
    // The figures of both equations, integrated by a Runge-Kutta method: a/p at half the critical rotation.
    const double p = std::sqrt(0.75 * g / 1.03);
    EXPECT_NEAR(equivalentDamping({0.1, 1.03, 0.05}, g) / p, 0.0213, 5e-5);
    EXPECT_NEAR(equivalentDamping({0.245, 1.03, 0.1225}, g) / p, 0.1370, 5e-5);
    // More for small amplitudes, in proportion to the square root of size and gravity.
    EXPECT_GT(equivalentDamping({0.245, 1.03, 0.01}, g), equivalentDamping({0.245, 1.03, 0.1}, g));
    // As 1 over the root of the smallest amplitudes, which rounding does not reach.
    for (const double amplitude : {1e-6, 1e-9, 1e-17})
    {
        EXPECT_NEAR(equivalentDamping({0.245, 1.03, amplitude}, g) * std::sqrt(amplitude)
                        / (equivalentDamping({0.245, 1.03, 1e-5}, g) * std::sqrt(1e-5)),
                    1, 1e-4)
            << amplitude;
    }
    EXPECT_NEAR(equivalentDamping({0.245, 4.12, 0.1}, g) / equivalentDamping({0.245, 1.03, 0.1}, g), 0.5,
                1e-12);
}
