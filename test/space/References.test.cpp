// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
// Structures that two other programs have solved (second-order cones by CVXOPT; pyramids about and within the
// cones by HiGHS): each file in references/ holds a blockTextureDict with the counts and multipliers that
// must come out.
#include "../MadeStructure.h"
#include "SpaceStructures.h"
#include "dictionary/Dictionary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

const fs::path folder = fs::path(DRYSTONE_SOURCE_DIR) / "test/space/references";

std::vector<std::string> names()
{
    std::vector<std::string> result;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    {
        result.push_back(entry.path().filename().string());
    }
    std::sort(result.begin(), result.end());
    return result;
}

constexpr double gate = 1e-6; ///< absolute; references have seven digits

class SpaceReference : public testing::TestWithParam<std::string>
{
};

TEST_P(SpaceReference, HasItsCountsAndMultipliers)
{
    const Dictionary reference = Dictionary::readFile(folder / GetParam());
    const Assembly<3> assembly = madeStructure<3>(reference.subDict("blockTextureDict"));
    const std::vector<ContactPoint<3>> points = findContactPoints(assembly);
    const auto free = std::count_if(assembly.blocks.begin(), assembly.blocks.end(),
                                    [](const Block<3>& block) { return block.support < 0; });
    const std::vector<int> counts{static_cast<int>(free), points.empty() ? 0 : points.back().joint + 1,
                                  static_cast<int>(points.size())};
    EXPECT_EQ(counts, reference.get<std::vector<int>>("counts"));
    const auto mu = reference.get<double>("mu");
    int solved = 0;
    if (const Dictionary* multipliers = reference.findDict("multipliers"))
    {
        for (const Entry& entry : multipliers->entries())
        {
            const Dictionary& load = entry.dictionary();
            const LimitAnalysis result =
                test::collapse(assembly, points, load.getOrDefault<double>("mu", mu),
                               test::pushed(assembly, load.get<Vector<3>>("direction")));
            EXPECT_EQ(result.status, CollapseStatus::optimal) << entry.keyword();
            EXPECT_NEAR(result.alpha, load.get<double>("alpha"), gate) << entry.keyword();
            EXPECT_LE(result.certificate.worst(), 1e-9) << entry.keyword();
            ++solved;
        }
    }
    if (const Dictionary* settlements = reference.findDict("settlements"))
    {
        for (const Entry& entry : settlements->entries())
        {
            const Dictionary& settlement = entry.dictionary();
            const auto name = settlement.get<std::string>("support");
            const auto support = std::find_if(assembly.supports.begin(), assembly.supports.end(),
                                              [&](const Support& one) { return one.name == name; });
            ASSERT_NE(support, assembly.supports.end()) << name;
            LoadVectors loads = test::pushed(assembly, {1, 0, 0});
            loads.live.resize(0);
            SpaceConeProgram program = test::programOf(assembly, points, mu, loads);
            program.gap =
                settlementGaps(assembly, points,
                               SupportMovement<3>{static_cast<int>(support - assembly.supports.begin()),
                                                  settlement.get<Vector<3>>("direction").normalized()});
            const LimitAnalysis result = solveSettlement(program);
            EXPECT_EQ(result.status, CollapseStatus::optimal) << entry.keyword();
            EXPECT_NEAR(result.alpha, settlement.get<double>("reaction"), gate) << entry.keyword();
            ++solved;
        }
    }
    EXPECT_GT(solved, 0);
}

INSTANTIATE_TEST_SUITE_P(Files, SpaceReference, testing::ValuesIn(names()),
                         [](const auto& file) { return file.param; });

} // namespace
} // namespace drystone
