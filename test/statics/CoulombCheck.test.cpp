// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The check of pairs by Coulomb's law, by pairs that are right by hand and the same made wrong in one way
/// each.
#include "statics/CoulombCheck.h"
#include "Structures.h"

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

/// A block 1 x 1 on the ground, pushed to the right with alpha of its weight 1000 N: it slides at alpha = mu
/// = 0.3.
struct SlidingBlock
{
    PlaneConeProgram program;
    double alpha = 0.3;
    Eigen::VectorXd force = Eigen::VectorXd::Zero(4);
    Eigen::VectorXd mechanism = Eigen::Vector3d(1e-3, 0, 0);

    SlidingBlock()
    {
        Assembly<2> assembly;
        assembly.supports = {{"ground", "ground"}};
        assembly.blocks = {rectangle(0, 0, 1, 1), rectangle(-1, -1, 2, 0, 0)};
        const WeighedStructure structure(std::move(assembly));
        program = structure.program(alpha, structure.weightLoads());
        // Moments about the centroid: the shear of 300 N at half a metre, the normal forces at either end.
        for (int point = 0; point < 2; ++point)
        {
            const bool isLeft = structure.points[static_cast<std::size_t>(point)].position.x() < 0.5;
            const double normal = isLeft ? 350 : 650;
            const double backwards =
                tangent(structure.points[static_cast<std::size_t>(point)]).x() > 0 ? -1 : 1;
            force.segment<2>(2 * point) << normal, backwards * alpha * normal;
        }
        // The columns may say which way pressure and moment go.
        if (residuals().balance > 1e-6)
        {
            std::swap(force[0], force[2]);
            std::swap(force[1], force[3]);
        }
    }
    CoulombResiduals residuals() const { return coulombResiduals(program, alpha, force, mechanism); }
};

} // namespace

TEST(CoulombCheck, AcceptsASlidingBlock)
{
    EXPECT_LE(SlidingBlock().residuals().worst(), 1e-12);
}

TEST(CoulombCheck, SeesForcesThatDoNotBalance)
{
    SlidingBlock pair;
    pair.alpha *= 1.001;
    EXPECT_GT(pair.residuals().balance, 1e-4);
    pair.alpha = 0.3;
    pair.force *= 1.001;
    EXPECT_GT(pair.residuals().balance, 1e-4);
}

TEST(CoulombCheck, SeesAMechanismOfAnotherLength)
{
    SlidingBlock pair;
    pair.mechanism *= 1.01;
    EXPECT_NEAR(pair.residuals().balance, 0.01, 1e-9);
}

TEST(CoulombCheck, SeesShearBeyondTheCone)
{
    SlidingBlock pair;
    for (double& mu : pair.program.friction)
    {
        mu = 0.299;
    }
    EXPECT_GT(pair.residuals().yield, 5e-4);
}

TEST(CoulombCheck, SeesTension)
{
    SlidingBlock pair;
    pair.force[0] = -1;
    EXPECT_GT(pair.residuals().yield, 1e-3);
}

TEST(CoulombCheck, SeesDilatancy)
{
    SlidingBlock pair;
    pair.mechanism[1] = 0.3 * pair.mechanism[0];
    EXPECT_NEAR(pair.residuals().flow, 0.3, 1e-9);
}

TEST(CoulombCheck, SeesPenetration)
{
    SlidingBlock pair;
    pair.mechanism[1] = -1e-4 * pair.mechanism[0];
    EXPECT_NEAR(pair.residuals().flow, 1e-4, 1e-9);
}

TEST(CoulombCheck, SeesShearThatIsNotAtItsLimitOrAlongTheSlip)
{
    SlidingBlock below;
    for (double& mu : below.program.friction)
    {
        mu = 0.4;
    }
    EXPECT_GT(below.residuals().flow, 0.04);
    EXPECT_GT(below.residuals().mismatch, 0.04);
    SlidingBlock reversed;
    reversed.mechanism[0] *= -1;
    EXPECT_GT(reversed.residuals().flow, 0.3);
}

TEST(CoulombCheck, KnowsCohesion)
{
    SlidingBlock pair;
    pair.program.strength.assign(2, {.cohesion = 100});
    EXPECT_GT(pair.residuals().flow, 0.01) << "sliding below the limit";
    pair.program.strength.assign(2, {.cohesion = 15});
    for (double& mu : pair.program.friction)
    {
        mu = 0.27;
    }
    // C + mu n of the points: 109.5 and 190.5 of the 300 N, not 105 and 195.
    const int more = pair.force[0] > pair.force[2] ? 0 : 1;
    pair.force[2 * more + 1] *= 190.5 / 195;
    pair.force[3 - 2 * more] *= 109.5 / 105;
    EXPECT_LE(pair.residuals().worst(), 1e-12);
}

TEST(CoulombCheck, IsInfiniteForWhatIsNoNumber)
{
    SlidingBlock pair;
    pair.force[1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(pair.residuals().worst(), std::numeric_limits<double>::infinity());
}

} // namespace drystone
