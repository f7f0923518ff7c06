// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
// What joints dissipate over their faces, compared with what they do at their points: the kinematic bound of
// the mechanism that the points have.
#include "statics/JointDissipation.h"
#include "SpaceStructures.h"
#include "statics/Settlement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace drystone
{
namespace
{

using test::Chance;
using test::onGround;
using test::pushed;
using test::Stresses;

struct Bounds
{
    double ofPoints = 0;
    double ofFaces = 0;
};

/// A box with the side 2 a that is twisted by a couple of 1 N m, and the torsion of its joint: c times the
/// integral of r over the square, c (2 a)3 (sqrt 2 + log(1 + sqrt 2))/6, for a cohesion c of 1 Pa.
struct TwistedBox
{
    Assembly<3> assembly;
    LoadVectors loads;
    double torsion = 0; ///< [N m]
};

TwistedBox twistedBox()
{
    const double a = 0.5;
    TwistedBox box{onGround({makeBox({-a, -a, 0}, {a, a, 0.1})}), {}, 0};
    box.loads = pushed(box.assembly, {1, 0, 0});
    box.loads.live.setZero();
    box.loads.live[5] = 1;
    box.torsion = std::pow(2 * a, 3) * (std::sqrt(2.0) + std::log(1 + std::sqrt(2.0))) / 6;
    return box;
}

/// \param perSide points of a grid
Bounds boundsOf(const Assembly<3>& assembly, double mu, const LoadVectors& loads, const Stresses& stresses,
                int perSide)
{
    std::vector<PatchCells> patches = patchCells(findContactPoints(assembly));
    for (PatchCells& patch : patches)
    {
        cutIntoGrid(patch, perSide);
    }
    SpaceConeProgram program = test::programOf(assembly, pointsOf(patches), mu, loads);
    for (const double area : areasOf(patches))
    {
        program.strength.push_back(
            {stresses.cohesion * area, stresses.tension * area, stresses.crushing * area});
    }
    const LimitAnalysis result = solveLimitAnalysis(program);
    EXPECT_EQ(result.status, CollapseStatus::optimal);
    return {result.alpha,
            result.alpha - sumOf(dissipatedLessByCell(program, patches, loads.live, result.mechanism))};
}

// However few points there are, they find that the box turns about its axis.
TEST(JointDissipation, OfABoxThatIsTwistedGivesTheTorsionOfItsWholeJoint)
{
    const auto [assembly, loads, expected] = twistedBox();
    for (const int perSide : {2, 3, 6, 9})
    {
        const Bounds bounds = boundsOf(assembly, 0, loads, {1, 0}, perSide);
        EXPECT_GT(bounds.ofPoints, 1.01 * expected) << perSide;
        EXPECT_NEAR(bounds.ofFaces, expected, 2e-5 * expected) << perSide;
        EXPECT_GE(bounds.ofFaces, expected * (1 - 1e-9)) << perSide;
    }
}

// A beam that is held at one end alone turns about it as the support of the other is drawn aside: its joint
// there is twisted, which corners resist too much.
TEST(JointDissipation, OfASettlementBoundsTheReactionOfFinerGridsFromBelow)
{
    Assembly<3> assembly;
    assembly.supports = {{"stays", "blocks"}, {"moves", "blocks"}};
    assembly.blocks = {{makeBox({0, 0, 0}, {2, 0.5, 0.3})},
                       {makeBox({0, 0, -1}, {0.4, 0.5, 0}), 0},
                       {makeBox({1.6, 0, -1}, {2, 0.5, 0}), 1}};
    const SupportMovement<3> movement{1, {0, 1, 0}};
    LoadVectors loads = pushed(assembly, {1, 0, 0});
    const auto boundsOf = [&](int perSide)
    {
        std::vector<PatchCells> patches = patchCells(findContactPoints(assembly));
        for (PatchCells& patch : patches)
        {
            cutIntoGrid(patch, perSide);
        }
        SpaceConeProgram program = test::programOf(assembly, pointsOf(patches), 0.3, loads);
        for (const double area : areasOf(patches))
        {
            program.strength.push_back({1e3 * area, 0, 1e6 * area});
        }
        program.liveLoad.resize(0);
        program.gap = settlementGaps(assembly, pointsOf(patches), movement);
        const LimitAnalysis result = solveSettlement(program);
        EXPECT_EQ(result.status, CollapseStatus::optimal);
        return Bounds{result.alpha, result.alpha
                                        + sumOf(dissipatedLessByCell(program, patches, Eigen::VectorXd(),
                                                                     result.mechanism))};
    };
    const Bounds corners = boundsOf(2);
    const Bounds fine = boundsOf(9);
    EXPECT_GT(corners.ofFaces, corners.ofPoints + 0.01 * std::abs(corners.ofPoints));
    EXPECT_GT(fine.ofPoints, corners.ofPoints);
    EXPECT_LT(fine.ofFaces - fine.ofPoints, 0.2 * (corners.ofFaces - corners.ofPoints));
    EXPECT_LE(corners.ofFaces, boundsOf(17).ofFaces * (1 + 1e-9) + 1e-9);
}

TEST(JointDissipation, OfFrictionAloneIsThatOfThePoints)
{
    const Assembly<3> assembly =
        onGround({makeBox({0, 0, 0}, {0.6, 0.4, 0.1}), makeBox({0.1, 0, 0.1}, {0.5, 0.4, 0.3})});
    const Bounds bounds = boundsOf(assembly, 0.5, pushed(assembly, {0.6, 0.8, 0}), {0, 0, 1e9}, 2);
    EXPECT_NEAR(bounds.ofFaces, bounds.ofPoints, 1e-6 * bounds.ofPoints);
}

// A finer grid is an upper bound of its own, which comes near the exact multiplier.
TEST(JointDissipation, BoundsWhatFinerGridsFindFromAbove)
{
    double left = 0; // of the errors of the points
    double all = 0;
    for (int i = 0; i < 20; ++i)
    {
        Chance chance(i);
        const double height = chance(0.3, 1);
        const Assembly<3> assembly = onGround({makeBox({0, 0, 0}, {chance(0.3, 1), chance(0.3, 1), height})});
        LoadVectors loads = pushed(assembly, {chance(-1, 1), chance(-1, 1), 0});
        loads.live[5] += chance(-0.5, 0.5) * loads.live.norm(); // off its centre
        const double mu = chance(0.2, 0.8);
        const double pressure = height * chance(0, 1);
        const Stresses stresses{mu * pressure + height * chance(0, 1), pressure, height * chance(2, 20)};
        const Bounds coarse = boundsOf(assembly, mu, loads, stresses, 3);
        const Bounds fine = boundsOf(assembly, mu, loads, stresses, 17);
        EXPECT_LE(coarse.ofFaces, coarse.ofPoints) << i;
        EXPECT_LE(fine.ofFaces, fine.ofPoints) << i;
        EXPECT_GE(coarse.ofFaces, fine.ofFaces * (1 - 2e-3)) << i;
        left += (coarse.ofFaces - fine.ofFaces) / fine.ofFaces;
        all += (coarse.ofPoints - fine.ofFaces) / fine.ofFaces;
    }
    EXPECT_LT(left, 0.8 * all);
}

// Refined where the mechanism dissipates in excess, the points of a box that is twisted approach the torsion
// of its joint: at least twice as near each time.
TEST(JointDissipation, RefinedJointsFindTheTorsionOfAFace)
{
    const auto [assembly, loads, expected] = twistedBox();
    JointPoints<3> joints;
    joints.patches = patchCells(findContactPoints(assembly));
    joints.points = pointsOf(joints.patches);
    joints.friction.assign(joints.points.size(), 0);
    for (const double area : areasOf(joints.patches))
    {
        joints.strength.push_back({area, 0});
    }
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 5; ++round)
    {
        SpaceConeProgram program = test::programOf(assembly, joints.points, 0, loads);
        program.strength = joints.strength;
        double cohesion = 0;
        for (const Strength& strength : joints.strength)
        {
            cohesion += strength.cohesion;
        }
        ASSERT_NEAR(cohesion, 1, 1e-12); // all of the joint, shared out
        const LimitAnalysis result = solveLimitAnalysis(program);
        ASSERT_EQ(result.status, CollapseStatus::optimal);
        EXPECT_GE(result.alpha, expected * (1 - 1e-9));
        EXPECT_LT(result.alpha - expected, before / 2) << joints.points.size() << " points";
        before = result.alpha - expected;
        refineJoints(joints, dissipatedLessByCell(program, joints.patches, loads.live, result.mechanism));
    }
    EXPECT_LT(before, 7e-3 * expected);
    EXPECT_LT(joints.points.size(), 1000U);
}

// A box on its four corners, each of which bears a quarter of what its joint does, slides on them when it is
// twisted, and no mechanism crushes anything. With its weight all over the joint, at a stress that this
// hardly bears, it takes the torsion of the face, half as much. For larger strengths a finer grid comes from
// above.
TEST(JointDissipation, ForcesAtTheCornersOfATwistedBoxAreNotCarriedByItsFace)
{
    const double mu = 0.5;
    const auto [assembly, loads, torsion] = twistedBox();
    const double weight = -loads.dead[2];
    for (const double reserve : {1.0001, 1.5, 5.0, 100.0}) // strength over what the weight requires
    {
        const Stresses stresses{0, 0, reserve * weight};
        JointPoints<3> joints;
        joints.patches = patchCells(findContactPoints(assembly));
        LimitAnalysis result;
        double first = 0;
        double left = 1;
        for (int round = 0; round < 20 && left > 1e-3; ++round)
        {
            joints.points = pointsOf(joints.patches);
            SpaceConeProgram program = test::programOf(assembly, joints.points, mu, loads);
            joints.friction = program.friction;
            for (const double area : areasOf(joints.patches))
            {
                program.strength.push_back({0, 0, stresses.crushing * area});
            }
            joints.strength = program.strength;
            result = solveLimitAnalysis(program);
            ASSERT_EQ(result.status, CollapseStatus::optimal);
            const auto less =
                carriedLessByCell(program, joints.patches, loads.live, result.mechanism, result.contactForce);
            left = sumOf(less) / result.alpha;
            first = round == 0 ? result.alpha : first;
            refineJoints(joints, less);
        }
        EXPECT_LE(left, 1e-3) << reserve;
        EXPECT_LT(joints.points.size(), 5000U) << reserve;
        if (reserve < 1.001)
        {
            const double expected = mu * reserve * weight * torsion;
            EXPECT_GT(first, 1.8 * expected);
            EXPECT_NEAR(result.alpha, expected, 1e-3 * expected);
        }
        const double fine = boundsOf(assembly, mu, loads, stresses, 33).ofPoints;
        EXPECT_LE(result.alpha, fine * (1 + 1e-3)) << reserve;
        EXPECT_GE(result.alpha, fine * (1 - 7e-3)) << reserve;
    }
}

} // namespace
} // namespace drystone
