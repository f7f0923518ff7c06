// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Time steps against motions that have a closed form.
#include "../Polygons.h"
#include "SceneGravity.h"

#include "dynamics/ThetaStep.h"
#include "effects/Structure.h"

#include "contact/MovingContacts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drystone
{
namespace
{

using test::rectangleOfSize;

/// A structure and all that its steps need.
struct Motion
{
    Assembly<2> assembly{};
    double mu = 0.6;
    FlowRule flowRule = FlowRule::nonAssociative;
    ThetaScheme scheme{};
    Vector<2> gravity{0, -g};

    std::vector<BlockMass<2>> blocks = blockMasses(assembly);
    std::vector<int> free = freeIndices(assembly);
    Eigen::VectorXd mass = massDiagonal(assembly, blocks, std::vector<double>(blocks.size(), 1800));
    DynamicState<2> state = stateAtRest(assembly);
    MovingContacts<2> contacts{assembly};
    StepEnergy energy{};
    double kineticChange = 0;

    void step()
    {
        std::vector<Vector<3>> velocities(blocks.size(), Vector<3>::Zero());
        Eigen::VectorXd load = Eigen::VectorXd::Zero(mass.size());
        for (std::size_t block = 0; block < free.size(); ++block)
        {
            if (free[block] >= 0)
            {
                velocities[block] = state.velocity.segment<3>(3 * free[block]);
                load.segment<2>(3 * free[block]) = mass[3 * free[block]] * gravity;
            }
        }
        const auto& points =
            contacts.update(state.placements, contacts.marginFor(velocities, scheme.timeStep, g));
        const auto columns = equilibriumColumns(assembly, placedMasses(blocks, state.placements), points);
        const PlaneConeProgram program = thetaStepProgram(mass, state.velocity, load, points, columns,
                                                          std::vector<double>(points.size(), mu), scheme);
        const ThetaStep solved =
            solveThetaStep(program, {.flowRule = flowRule, .blockSize = 1, .solver = {.tolerance = 1e-12}});
        ASSERT_EQ(solved.status, SolveStatus::optimal)
            << "at " << state.time << " s, certificate " << solved.certificate.worst();
        const Eigen::VectorXd before = state.velocity;
        advance(state, free, solved.displacement, scheme);
        energy = stepEnergy<2>(solved, mass, load, before, state.velocity, scheme);
        kineticChange = 0.5 * mass.dot(state.velocity.cwiseAbs2() - before.cwiseAbs2());
    }

    double energyError() const
    {
        return kineticChange
               - (energy.loadWork - energy.normalLoss - energy.frictionLoss - energy.algorithmicLoss);
    }
};

Assembly<2> blockOnGround(double width, double height)
{
    Assembly<2> assembly;
    assembly.supports.push_back({"ground", "ground"});
    assembly.blocks.push_back({rectangleOfSize(-5, -1, 10 + width, 1), 1, 0});
    assembly.blocks.push_back({rectangleOfSize(0, 0, width, height), 1, -1});
    return assembly;
}

TEST(ThetaStep, TrapezoidalRuleFallsAsGalileoSays)
{
    Assembly<2> assembly;
    assembly.blocks.push_back({rectangleOfSize(0, 0, 1, 1), 1, -1});
    Motion motion{.assembly = assembly, .scheme = {0.5, 0.01}};
    for (int step = 0; step < 100; ++step)
    {
        ASSERT_NO_FATAL_FAILURE(motion.step());
    }
    EXPECT_NEAR(motion.state.placements[0].translation.y(), -0.5 * g, 1e-12);
    EXPECT_NEAR(motion.state.velocity[1], -g, 1e-12);
}

TEST(ThetaStep, ABlockAtRestStays)
{
    Motion motion{.assembly = blockOnGround(1, 1), .scheme = {1, 0.005}};
    for (int step = 0; step < 1000; ++step)
    {
        ASSERT_NO_FATAL_FAILURE(motion.step());
    }
    EXPECT_LT(motion.state.placements[1].translation.norm(), 1e-12);
    EXPECT_LT(std::abs(motion.state.placements[1].rotation), 1e-12);
}

TEST(ThetaStep, ASlidingBlockStopsWhereCoulombSaysAndDoesNotHop)
{
    Motion motion{.assembly = blockOnGround(1, 0.4), .scheme = {1, 0.0005}};
    motion.state.velocity[0] = 1;
    double highest = 0;
    for (int step = 0; step < 400; ++step)
    {
        ASSERT_NO_FATAL_FAILURE(motion.step());
        highest = std::max(highest, std::abs(motion.state.placements[1].translation.y()));
        EXPECT_NEAR(motion.energyError(), 0, 1e-10 * 360);
    }
    // v^2/(2 mu g); 360 J is the block's kinetic energy at the start.
    EXPECT_NEAR(motion.state.placements[1].translation.x(), 0.0849473, 0.005 * 0.0849473);
    EXPECT_LT(highest, 1e-9);
    EXPECT_LT(motion.state.velocity.norm(), 1e-9);
}

TEST(ThetaStep, ARockingBlockLosesAtImpactWhatHousnerSays)
{
    // Half width over half height gives the slenderness: 1 - 1.5 sin^2 a = 0.9118 for tan a = 1/4.
    Motion motion{.assembly = blockOnGround(0.25, 1), .mu = 5, .scheme = {1, 0.0002}};
    const double start = 0.1;
    const Vector<2> arm(-0.125, 0.5); // from the right corner, about which it is turned, to the centroid
    const Vector<2> turned(std::cos(-start) * arm.x() - std::sin(-start) * arm.y(),
                           std::sin(-start) * arm.x() + std::cos(-start) * arm.y());
    motion.state.placements[1].translation = turned - arm;
    motion.state.placements[1].rotation = -start;
    double before = 0;
    double after = 0;
    for (int step = 0; step < 20000 && after == 0; ++step)
    {
        const double speed = motion.state.velocity[2];
        ASSERT_NO_FATAL_FAILURE(motion.step());
        before = std::max(before, speed);
        // The impact is the first step in which the speed falls while the block turns towards the other side.
        if (motion.state.placements[1].rotation > 1e-3)
        {
            after = speed;
        }
    }
    ASSERT_GT(after, 0);
    const double alpha = std::atan(0.25);
    const double ratio = 1 - 1.5 * std::pow(std::sin(alpha), 2);
    // From the impact to 1e-3 rad the block loses energy to gravity: w1^2 = w0^2 - 2 p^2 (alpha 1e-3).
    const double p2 = 3 * g / (4 * arm.norm());
    const double impact = std::sqrt(after * after + 2 * p2 * (std::cos(alpha - 1e-3) - std::cos(alpha)));
    EXPECT_NEAR(impact / before, ratio, 0.005);
}

TEST(ThetaStep, AFreeAssemblyKeepsItsMomentum)
{
    Assembly<2> assembly;
    assembly.blocks.push_back({rectangleOfSize(0, 0, 1, 0.5), 1, -1});
    assembly.blocks.push_back({rectangleOfSize(0.3, 0.5, 1, 0.5), 1, -1});
    Motion motion{.assembly = assembly, .scheme = {1, 0.001}, .gravity = Vector<2>::Zero()};
    motion.state.velocity << 1, 0.5, 0.2, -0.3, -0.8, 0.1;
    const auto momentum = [&]
    {
        Vector<3> sum = Vector<3>::Zero();
        const auto placed = placedMasses(motion.blocks, motion.state.placements);
        for (int block = 0; block < 2; ++block)
        {
            const Vector<3> p =
                motion.mass.segment<3>(3 * block).cwiseProduct(motion.state.velocity.segment<3>(3 * block));
            const Vector<2> linear = p.head<2>();
            sum += Vector<3>(p.x(), p.y(), p.z() + cross(placed[std::size_t(block)].centroid, linear));
        }
        return sum;
    };
    const Vector<3> start = momentum();
    for (int step = 0; step < 50; ++step)
    {
        ASSERT_NO_FATAL_FAILURE(motion.step());
    }
    EXPECT_LT((momentum() - start).norm() / start.norm(), 1e-12);
}

} // namespace
} // namespace drystone
