// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Walls whose coordinates were turned by any angle and written with few digits keep their joints, and carry
/// what they carry otherwise.
#include "Structures.h"

#include "assembly/AssemblyFile.h"
#include "statics/SolveCase.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <random>

namespace drystone
{
namespace
{

enum class Rounding
{
    decimals,
    significant
};

/// Points and multiplier of a wall as a case states it, all of it turned: blocks, gravity and live load.
std::pair<std::size_t, LimitAnalysis> analysed(Assembly<2> assembly, double angle, Rounding rounding,
                                               int digits)
{
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    const auto written = [&](double value)
    {
        return std::stod(rounding == Rounding::decimals ? fmt::format("{:.{}f}", value, digits)
                                                        : fmt::format("{:.{}g}", value, digits));
    };
    for (Block<2>& block : assembly.blocks)
    {
        for (Vector<2>& corner : block.outline)
        {
            corner = {written(cosine * corner.x() - sine * corner.y()),
                      written(sine * corner.x() + cosine * corner.y())};
        }
    }
    const auto directory =
        std::filesystem::path(testing::TempDir())
        / ("rounded-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(directory / "constant/assembly");
    const auto write = [&](const std::string& file, const std::string& text)
    { std::ofstream(directory / file) << text; };
    write("constant/assembly/blocks", assemblyText(assembly));
    write("constant/g", fmt::format("value ({} {} 0);", 9.81 * sine, -9.81 * cosine));
    write("constant/materialProperties", "unitWeight 1000;");
    write("constant/contactProperties", "friction { type Coulomb; mu 0.65; flowRule associative; }");
    write(
        "constant/loads",
        fmt::format("dead {{ type gravity; }} live {{ type inertial; direction ({} {} 0); }}", cosine, sine));
    LimitAnalysisCase<2> structure = readLimitAnalysisCase<2>(directory);
    LimitAnalysis result = solveLimitAnalysis(structure);
    std::filesystem::remove_all(directory);
    return {structure.points.size(), std::move(result)};
}

class RoundedWalls : public testing::TestWithParam<int>
{
};

TEST_P(RoundedWalls, KeepTheirJointsAndTheirMultiplier)
{
    const Wall wall = paperWalls()[static_cast<std::size_t>(GetParam())];
    const Assembly<2> assembly = standing(wall.bond).assembly;
    const double reference = analysed(assembly, 0, Rounding::significant, 17).second.alpha;
    EXPECT_NEAR(reference, wall.alpha, 5e-7);
    std::mt19937 random(20261122u + static_cast<unsigned>(GetParam()));
    std::uniform_real_distribution<double> angles(-std::numbers::pi, std::numbers::pi);
    for (int digits = 5; digits <= 9; ++digits)
    {
        for (const Rounding rounding : {Rounding::decimals, Rounding::significant})
        {
            for (int turn = 0; turn < 4; ++turn)
            {
                const double angle = turn == 0 ? std::numbers::pi / 18 : angles(random);
                SCOPED_TRACE(fmt::format("{} {} digits, turned by {}", digits,
                                         rounding == Rounding::decimals ? "decimal" : "significant", angle));
                const auto [points, result] = analysed(assembly, angle, rounding, digits);
                EXPECT_EQ(points, static_cast<std::size_t>(wall.points));
                ASSERT_EQ(result.status, CollapseStatus::optimal);
                // Coordinates go up to 2.5 m. A unit of the last digit is to the multiplier as to the blocks,
                // of 0.2 m.
                const double unit = std::pow(10.0, rounding == Rounding::decimals ? -digits : 1 - digits);
                EXPECT_NEAR(result.alpha, reference, 5 * unit + 1e-8);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(OneAndThree, RoundedWalls, testing::Values(0, 2));

} // namespace
} // namespace drystone
