// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Joints that crush under the dead load alone, where two or three points would carry it: no multiplier, but
/// the range in which a live load holds the block up.
#include "Structures.h"

#include "assembly/AssemblyFile.h"
#include "statics/SolveCase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace drystone
{
namespace
{

enum class SideWall
{
    none,
    onTheLeft ///< without friction, of a joint that does not crush
};

/// A block of 2 x 1 m and W = 2000 N that stands on 1.2 m of its base and is pushed to the left by alpha kN
/// at its middle, so that its resultant is at 1 m - alpha/4 m. The joint bears S = 5000 N in all, and W so on
/// 0.48 m: no nearer than 0.24 m to either end.
LimitAnalysis analysed(SideWall wall)
{
    Assembly<2> assembly;
    assembly.supports = {{"base", "blocks"}, {"side", "blocks"}};
    assembly.blocks = {rectangle(0, 0, 2, 1), rectangle(0, -1, 1.2, 0, 0)};
    if (wall == SideWall::onTheLeft)
    {
        assembly.blocks.push_back(rectangle(-1, 0, 0, 1, 1));
    }
    else
    {
        assembly.supports.pop_back();
    }
    const auto directory =
        std::filesystem::path(testing::TempDir())
        / ("crushed-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(directory / "constant/assembly");
    const auto write = [&](const std::string& file, const std::string& text)
    { std::ofstream(directory / file) << text; };
    write("constant/assembly/blocks", assemblyText(assembly));
    write("constant/g", "value (0 -9.81 0);");
    write("constant/materialProperties", "unitWeight 1000;");
    write("constant/contactProperties",
          "joints { 0-base { friction { mu 10; } crushing { strength 4166.6666666666667; } } }");
    write("constant/loads",
          "dead { type gravity; } live { type force; at (1 0.5 0); value (-1000 0 0); block 0; }");
    LimitAnalysisCase<2> structure = readLimitAnalysisCase<2>(directory);
    LimitAnalysis result = solveLimitAnalysis(structure);
    std::filesystem::remove_all(directory);
    return result;
}

TEST(CrushingUnderDeadLoad, IsNoCollapseAtTheLoadThatTheOtherEndOfTheJointBears)
{
    const LimitAnalysis result = analysed(SideWall::none);
    EXPECT_EQ(result.status, CollapseStatus::unstable);
    EXPECT_LT(result.mechanism[1] + 0.2 * result.mechanism[2], 0) << "it goes down at 1.2 m";
    EXPECT_LE(result.certificate.worst(), 1e-9);
    ASSERT_TRUE(result.held);
    EXPECT_NEAR(result.held->least, 4 * (1 - 0.96), 1e-6);
    EXPECT_NEAR(result.held->largest, 4 * (1 - 0.24), 1e-6);
}

TEST(CrushingUnderDeadLoad, IsNoAnswerWithoutLimitWhereTheLiveLoadPressesOnAWall)
{
    const LimitAnalysis result = analysed(SideWall::onTheLeft);
    EXPECT_EQ(result.status, CollapseStatus::unstable);
    ASSERT_TRUE(result.held);
    EXPECT_NEAR(result.held->least, 4 * (1 - 0.96), 1e-6);
    EXPECT_TRUE(std::isinf(result.held->largest));
}

} // namespace
} // namespace drystone
