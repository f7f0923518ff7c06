// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Programs in axes of their own: the same for a structure that is turned, and the way back.
#include "statics/ProperFrame.h"
#include "SpaceStructures.h"

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

/// Boxes on each other that are turned against each other, pushed obliquely; all of it turned.
SpaceConeProgram turnedBoxes(const Eigen::Matrix3d& turn)
{
    std::vector<Polyhedron> shapes;
    for (int level = 0; level < 5; ++level)
    {
        std::vector<Vector<2>> corners;
        const double angle = 0.3 * level;
        for (int corner = 0; corner < 4; ++corner)
        {
            const double at = angle + 1.5707963 * corner;
            corners.emplace_back(0.5 * std::cos(at) + 0.05 * level, 0.5 * std::sin(at));
        }
        shapes.push_back(test::prism(corners, 0.3 * level, 0.3 * level + 0.3));
    }
    const Assembly<3> assembly = test::transformed(test::onGround(shapes), turn, 1, {0, 0, 0});
    return test::programOf(assembly, findContactPoints(assembly), 0.5,
                           test::pushed(assembly, turn * Vector<3>(0.8, 0.6, 0), turn * Vector<3>(0, 0, -1)));
}

const Eigen::Matrix3d oblique =
    Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();

} // namespace

TEST(ProperFrame, HasTheSameProgramOfAStructureThatIsTurnedOrMirrored)
{
    const Eigen::Matrix3d mirrored = Eigen::Vector3d(1, -1, 1).asDiagonal();
    const SpaceConeProgram one = ProperFrame<6, 3>(turnedBoxes(Eigen::Matrix3d::Identity())).program;
    for (const Eigen::Matrix3d& turn : {oblique, mirrored, Eigen::Matrix3d(oblique * mirrored)})
    {
        const SpaceConeProgram two = ProperFrame<6, 3>(turnedBoxes(turn)).program;
        EXPECT_EQ(one.load, two.load);
        EXPECT_EQ(one.liveLoad, two.liveLoad);
        ASSERT_EQ(one.points(), two.points());
        for (std::size_t point = 0; point < one.contacts.size(); ++point)
        {
            SCOPED_TRACE(point);
            EXPECT_EQ(one.contacts[point].first, two.contacts[point].first);
            EXPECT_EQ(one.contacts[point].second, two.contacts[point].second);
            EXPECT_EQ(one.contacts[point].onFirst, two.contacts[point].onFirst);
            EXPECT_EQ(one.contacts[point].onSecond, two.contacts[point].onSecond);
        }
    }
}

TEST(ProperFrame, GivesPairsBackThatBalanceAndMoveAlike)
{
    for (const double hand : {1.0, -1.0})
    {
        SpaceConeProgram given = turnedBoxes(oblique * Eigen::Vector3d(1, hand, 1).asDiagonal());
        for (std::size_t point = 0; point < given.friction.size(); ++point)
        {
            given.friction[point] = 0.01 * static_cast<double>(point);
        }
        const ProperFrame<6, 3> frame(given);
        CoulombPair pair;
        pair.contactForce = Eigen::VectorXd::LinSpaced(3 * given.points(), -1, 2).array().sin();
        pair.mechanism = Eigen::VectorXd::LinSpaced(6 * given.bodies, 1, 9).array().cos();
        const CoulombPair turned = frame.inGiven(pair);
        constexpr double kept = 1e-8;
        EXPECT_NEAR(given.load.dot(turned.mechanism), frame.program.load.dot(pair.mechanism), kept);
        EXPECT_NEAR(given.liveLoad.dot(turned.mechanism), frame.program.liveLoad.dot(pair.mechanism), kept);
        EXPECT_NEAR(applyEquilibrium(given, turned.contactForce).norm(),
                    applyEquilibrium(frame.program, pair.contactForce).norm(), kept);
        EXPECT_NEAR(applyEquilibrium(given, turned.contactForce).dot(turned.mechanism),
                    applyEquilibrium(frame.program, pair.contactForce).dot(pair.mechanism), kept);
        // By friction, which is another of each point, it is known which is which.
        const Eigen::VectorXd there = applyTransposed(given, turned.mechanism);
        const Eigen::VectorXd here = applyTransposed(frame.program, pair.mechanism);
        for (int point = 0; point < given.points(); ++point)
        {
            const auto place = static_cast<int>(std::lround(100 * frame.program.friction[point]));
            EXPECT_NEAR(there[3 * place], here[3 * point], kept);
            EXPECT_NEAR(there.segment<2>(3 * place + 1).norm(), here.segment<2>(3 * point + 1).norm(), kept);
            EXPECT_NEAR(turned.contactForce[3 * place], pair.contactForce[3 * point], kept);
            EXPECT_NEAR(turned.contactForce.segment<2>(3 * place + 1).dot(there.segment<2>(3 * place + 1)),
                        pair.contactForce.segment<2>(3 * point + 1).dot(here.segment<2>(3 * point + 1)),
                        kept);
        }
        // How far a pair is from the law is the same in any axes.
        const CoulombResiduals inStructure =
            coulombResiduals(given, 0.3, turned.contactForce, turned.mechanism);
        const CoulombResiduals inFrame =
            coulombResiduals(frame.program, 0.3, pair.contactForce, pair.mechanism);
        EXPECT_NEAR(inStructure.balance, inFrame.balance, kept * inFrame.balance);
        EXPECT_NEAR(inStructure.yield, inFrame.yield, kept);
        EXPECT_NEAR(inStructure.flow, inFrame.flow, kept);
        EXPECT_NEAR(inStructure.mismatch, inFrame.mismatch, kept * inFrame.mismatch);
    }
}

} // namespace drystone
