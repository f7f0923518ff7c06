// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Programs that have an answer but are ill-conditioned in double precision: chains of many blocks, thrusts
/// that hardly fit, friction without limit, coordinates with noise, samples that happen to be degenerate.
#include "Structures.h"

#include "texture/Arch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

using namespace drystone;

namespace
{

/// Circular, of radius 1, under its weight and pushed sideways by a share of it.
PlaneConeProgram archProgram(int voussoirs, double thickness, double mu)
{
    Arch arch;
    arch.thickness = thickness;
    arch.voussoirs = voussoirs;
    const WeighedStructure structure(makeAssembly(arch));
    return structure.program(mu, structure.weightLoads());
}

/// Turned about the origin, then each corner of each block moved on its own by at most `noise` [m] in x and
/// y.
Assembly<2> turnedWithNoise(Assembly<2> assembly, double degrees, double noise, unsigned seed)
{
    std::mt19937_64 engine(seed);
    const auto anything = [&]
    { return noise * (2 * std::ldexp(static_cast<double>(engine() >> 11), -53) - 1); };
    const double angle = degrees * std::numbers::pi / 180;
    for (Block<2>& block : assembly.blocks)
    {
        for (Vector<2>& corner : block.outline)
        {
            const Vector<2> turned(std::cos(angle) * corner.x() - std::sin(angle) * corner.y(),
                                   std::sin(angle) * corner.x() + std::cos(angle) * corner.y());
            corner = {turned.x() + anything(), turned.y() + anything()};
        }
    }
    return assembly;
}

/// Within a number of factorisations: what is repeated hundreds of times has been given up before. An arch
/// that is 1e-8 of its radius thicker than the least takes up to 352 of them, by how the program rounds; all
/// others below 300.
LimitAnalysis expectSolved(const PlaneConeProgram& program, CollapseStatus status = CollapseStatus::optimal)
{
    LimitAnalysis result = solveLimitAnalysis(program);
    EXPECT_EQ(result.status, status);
    EXPECT_LE(result.certificate.worst(), 1e-9);
    EXPECT_LE(result.factorisations, 400);
    return result;
}

} // namespace

TEST(WellPosedPrograms, ArchesOfUpTo2000VoussoirsCollapseAtTheSameMultiplier)
{
    // The condition of the Schur system of a chain grows with the fourth power of its length.
    for (const int voussoirs : {500, 1000, 2000})
    {
        for (const double mu : {0.7, 2.0, 50.0})
        {
            SCOPED_TRACE(testing::Message() << voussoirs << " voussoirs, mu " << mu);
            const LimitAnalysis result = expectSolved(archProgram(voussoirs, 0.15, mu));
            EXPECT_NEAR(result.alpha, 0.144329, 3e-6); // hinges, no sliding
        }
    }
}

TEST(WellPosedPrograms, ArchesNearTheirLeastThicknessStandOrFall)
{
    // Which lies at 0.106720904 and has alpha = 3.7 (t - t0) above. Nearer than 5e-8 from below the loads
    // are carried but for 2e-7 of them, and openings known to 16 digits do not prove more than that.
    constexpr double least = 0.106720904;
    for (const double mu : {0.7, 50.0})
    {
        for (const double less : {1e-5, 7e-6, 3e-6, 1e-6, 3e-7, 1e-7})
        {
            SCOPED_TRACE(testing::Message() << "thinner by " << less << ", mu " << mu);
            expectSolved(archProgram(27, least - less, mu), CollapseStatus::unstable);
        }
        for (const double more : {1e-8, 1e-7, 3e-7, 1e-6, 3e-6, 7e-6, 1e-5})
        {
            SCOPED_TRACE(testing::Message() << "thicker by " << more << ", mu " << mu);
            const LimitAnalysis result = expectSolved(archProgram(27, least + more, mu));
            EXPECT_NEAR(result.alpha, 3.738 * more, 0.01 * more + 5e-9);
        }
    }
}

TEST(WellPosedPrograms, FrictionWithoutLimitIsThatOfBlocksThatCannotSlide)
{
    // Multipliers approach those of friction without limit as 1/mu.
    const std::vector<double> unlimited{1.904762, 1.142857, 0.685714, 0.457143, 0.336767, 0.706965};
    for (std::size_t wall = 0; wall < unlimited.size(); ++wall)
    {
        const WeighedStructure structure = standing(paperWalls()[wall].bond);
        for (const double mu : {1e2, 1e3, 1e4, 1e5, 1e6, 1e9})
        {
            SCOPED_TRACE(testing::Message() << "wall " << wall + 1 << ", mu " << mu);
            const LimitAnalysis result = expectSolved(structure.program(mu, structure.weightLoads()));
            EXPECT_NEAR(result.alpha, unlimited[wall], 1e-6 + 0.1 / mu);
            EXPECT_LE(result.factorisations, 30);
        }
    }
}

TEST(WellPosedPrograms, NoiseInTheCoordinatesOfATurnedWallChangesItsMultiplierByAsLittle)
{
    // 0.923914863 without noise: gravity and the push turn against the wall.
    const Assembly<2> wall = standing(paperWalls()[0].bond).assembly;
    for (unsigned seed = 101; seed <= 112; ++seed)
    {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        const WeighedStructure structure(turnedWithNoise(wall, 10, 1e-8, seed));
        EXPECT_EQ(structure.points.size(), 174U);
        const LimitAnalysis result = expectSolved(structure.program(0.65, structure.weightLoads()));
        EXPECT_NEAR(result.alpha, 0.923914863, 1e-6);
    }
}

TEST(WellPosedPrograms, DegenerateSamplesTakeNoHundredsOfIterations)
{
    const std::vector<std::array<double, 3>> samples{{0.6969588618842943, 0.401518942506131, 0.662423253},
                                                     {0.7062461356642525, 0.4073741488759306, 0.672366361}};
    for (const auto& [mu, length, alpha] : samples)
    {
        SCOPED_TRACE(testing::Message() << "mu " << mu << ", unit length " << length);
        RunningBond bond = paperWalls()[0].bond;
        bond.unit.x() = length;
        const WeighedStructure structure = standing(bond);
        const LimitAnalysis result = expectSolved(structure.program(mu, structure.weightLoads()));
        EXPECT_NEAR(result.alpha, alpha, 1e-8);
        EXPECT_LE(result.iterations, 70); // those of starts that failed count
    }
}
