// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
// Limit analysis with Coulomb's law in space: closed forms, and the lowest multipliers known.
#include "SpaceStructures.h"
#include "dictionary/Dictionary.h"
#include "statics/NonAssociative.h"
#include "texture/Texture.h"

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

void expectCoulomb(const SpaceConeProgram& program, const LimitAnalysis& result)
{
    ASSERT_EQ(result.status, CollapseStatus::optimal);
    const Eigen::VectorXd mechanism = result.mechanism / program.liveLoad.dot(result.mechanism);
    EXPECT_LE(coulombResiduals(program, result.alpha, result.contactForce, mechanism).worst(), 1e-6);
    EXPECT_LE(result.alpha, result.coulomb->associative * (1 + 1e-9));
}

SpaceConeProgram reference(const std::string& name, double mu, const Vector<3>& direction)
{
    const Dictionary dictionary =
        Dictionary::readFile(std::string(DRYSTONE_SOURCE_DIR) + "/test/space/references/" + name);
    const Assembly<3> assembly = makeStructure<3>(dictionary.subDict("blockTextureDict"));
    return test::programOf(assembly, findContactPoints(assembly), mu, test::pushed(assembly, direction));
}

} // namespace

// Law 6: without dilatancy the prism is not wedged.
TEST(CoulombInSpace, APrismInAGrooveSlidesAtMuOverCosine)
{
    test::Chance chance(17);
    for (int i = 0; i < test::instances; ++i)
    {
        SCOPED_TRACE(testing::Message() << "instance " << i);
        const double slope = i == 0 ? EIGEN_PI / 4 : i == 1 ? EIGEN_PI / 6 : chance(0.2, 1.2);
        const double mu = i == 0 ? 0.3 : i == 1 ? 0.5 : chance(0.05, 0.9 / std::tan(slope));
        const double h = std::tan(slope);
        const auto along = [](const std::vector<Vector<2>>& outline, double from, double to)
        {
            std::vector<Vector<3>> start;
            std::vector<Vector<3>> end;
            for (const Vector<2>& corner : outline)
            {
                start.emplace_back(from, corner.x(), corner.y());
                end.emplace_back(to, corner.x(), corner.y());
            }
            return makePrism(start, end);
        };
        Assembly<3> assembly;
        assembly.blocks = {{along({{0, 0}, {1, h}, {-1, h}}, -10, 10), -1},
                           {along({{0, 0}, {2, 0}, {2, 2 * h}}, -20, 20), 0},
                           {along({{0, 0}, {-2, 2 * h}, {-2, 0}}, -20, 20), 0}};
        assembly.supports = {{"groove", "blocks"}};
        const SpaceConeProgram program =
            test::programOf(assembly, findContactPoints(assembly), mu, test::pushed(assembly, {1, 0, 0}));
        const LimitAnalysis result = solveNonAssociative(program);
        expectCoulomb(program, result);
        EXPECT_NEAR(result.alpha, mu / std::cos(slope), 1e-6);
    }
}

// In the first of these rows, as in some small walls that slide as a whole, every path ends without a
// collapse.
TEST(CoulombInSpace, BoxesInARowSlideAtMu)
{
    test::Chance chance(18);
    for (int i = 0; i < test::instances; ++i)
    {
        SCOPED_TRACE(testing::Message() << "instance " << i);
        const double mu = i == 0 ? 0.5 : chance(0.2, 0.6);
        const double height = i == 0 ? 0.3 : chance(0.1, 0.3);
        Assembly<3> assembly;
        assembly.supports = {{"ground", "ground"}};
        assembly.blocks = {{makeBox({-9, -9, -1}, {9, 9, 0}), 0}};
        double left = 0.034;
        for (int box = 0; box < 2 + i % 2; ++box)
        {
            const double right = left + (i == 0 ? 0.37 - 0.001 * box : chance(0.35, 0.5));
            assembly.blocks.push_back({makeBox({left, 0, 0}, {right, 0.7, height}), -1});
            left = right;
        }
        const SpaceConeProgram program =
            test::programOf(assembly, findContactPoints(assembly), mu, test::pushed(assembly, {1, 0, 0}));
        const LimitAnalysis result = solveNonAssociative(program);
        expectCoulomb(program, result);
        EXPECT_NEAR(result.alpha, mu, 1e-6);
        EXPECT_GE(result.coulomb->converged, 1);
    }
}

TEST(CoulombInSpace, TheLWallIsNoHigherThanTheLowestKnown)
{
    const SpaceConeProgram program = reference("wallL316", 0.65, {0, -1, 0});
    const LimitAnalysis result = solveNonAssociative(program);
    expectCoulomb(program, result);
    EXPECT_NEAR(result.coulomb->associative, 0.207494721, 1e-6);
    EXPECT_LE(result.alpha, 0.203232297 + 5e-10);
}

TEST(CoulombInSpace, HousesDomesTowersAndBondsAreAnswered)
{
    struct Case
    {
        const char* name;
        double mu;
        Vector<3> direction;
    };
    for (const Case& structure :
         {Case{"houseWithDoor", 0.65, {1, 0, 0}}, Case{"domeWithOculus", 0.7, {1, 0, 0}},
          Case{"tower", 0.6, {1, 0, 0}}, Case{"englishBond", 0.6, {0, 1, 0}},
          Case{"flemishBond", 0.6, {0, 1, 0}}, Case{"wallL428", 0.65, {0, -1, 0}}})
    {
        SCOPED_TRACE(structure.name);
        const SpaceConeProgram program = reference(structure.name, structure.mu, structure.direction);
        expectCoulomb(program, solveNonAssociative(program));
    }
}

// A box with cohesion over its base: C + mu W, whichever way it is pushed.
TEST(CoulombInSpace, ABoxWithCohesionSlidesAtItsClosedForm)
{
    for (const double angle : {0.0, 0.5, 0.785})
    {
        const Assembly<3> assembly = test::onGround({makeBox({0, 0, 0}, {1, 1, 0.2})});
        SpaceConeProgram program =
            test::programOf(assembly, findContactPoints(assembly), 0.3,
                            test::pushed(assembly, {std::cos(angle), std::sin(angle), 0}));
        program.strength.assign(program.friction.size(), {.cohesion = 0.005}); // of a weight of 0.2
        const LimitAnalysis result = solveNonAssociative(program);
        expectCoulomb(program, result);
        EXPECT_NEAR(result.alpha, 0.3 + 0.02 / 0.2, 1e-6) << angle;
    }
}

TEST(CoulombInSpace, Wall1ExtrudedIsNoHigherThanInThePlane)
{
    const SpaceConeProgram program = reference("extrudedWall1", 0.65, {1, 0, 0});
    const LimitAnalysis result = solveNonAssociative(program, {.starts = 2});
    expectCoulomb(program, result);
    EXPECT_LE(result.alpha, 0.638982 + 5e-7);
}

} // namespace drystone
