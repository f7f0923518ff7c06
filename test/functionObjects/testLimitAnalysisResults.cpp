// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What limit analysis leaves in a case, for each of its three answers.
#include "assembly/AssemblyFile.h"
#include "core/Error.h"
#include "core/WholeFile.h"
#include "functionObjects/LimitAnalysisResults.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <unistd.h>

namespace drystone
{

namespace
{

namespace fs = std::filesystem;

/// A block of 1 x 2 m, 20 kN, on the ground.
class LimitAnalysisResults : public testing::Test
{
protected:
    void SetUp() override
    {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        directory = fs::temp_directory_path() / fmt::format("drystone-{}-{}", ::getpid(), test->name());
        Assembly<2> assembly;
        assembly.blocks = {{{{0, 0}, {1, 0}, {1, 2}, {0, 2}}, 1, -1},
                           {{{-1, -1}, {2, -1}, {2, 0}, {-1, 0}}, 1, 0}};
        assembly.supports = {{"ground", "ground"}};
        writeWholeFile(assemblyFile(directory), assemblyText(assembly));
        writeWholeFile(directory / "constant/g", "value (0 -10 0);");
        writeWholeFile(directory / "constant/materialProperties", "density 1000;");
        writeWholeFile(directory / "constant/contactProperties", "friction { type Coulomb; mu 0.4; }");
    }
    void TearDown() override { fs::remove_all(directory); }

    /// Solves the case under its weight and a live load.
    LimitAnalysis solve(const std::string& live)
    {
        writeWholeFile(directory / "constant/loads", "dead { type gravity; } live { " + live + " }");
        const LimitAnalysisCase structure = readLimitAnalysisCase(directory);
        const LimitAnalysis result =
            solveLimitAnalysis(structure.program, interiorPointSettings(structure.solution));
        writeLimitAnalysisResults(directory, structure, {result}, 0.5);
        return result;
    }
    /// The row of the table.
    std::vector<double> row() const
    {
        std::ifstream stream(limitAnalysisTable(directory));
        std::string line;
        std::getline(stream, line);
        EXPECT_EQ(line, "# alpha[-] status[-] blocks[-] contactPoints[-] variables[-] iterations[-] "
                        "primalResidual[-] dualResidual[-] gap[-] cpuTime[s]");
        std::vector<double> values;
        for (std::string word; stream >> word;)
            values.push_back(std::strtod(word.c_str(), nullptr)); // reads inf and nan, unlike >>
        return values;
    }

    fs::path directory;
};

TEST_F(LimitAnalysisResults, OfACollapseHaveTheMultiplier)
{
    solve("type inertial; direction (1 0 0);");
    const std::vector<double> values = row();
    ASSERT_EQ(values.size(), 10U);
    EXPECT_NEAR(values[0], 0.4, 1e-8); // min(mu, b/h)
    EXPECT_EQ(values[1], 0);
    EXPECT_EQ(values[2], 1);
    EXPECT_EQ(values[3], 2);
    EXPECT_EQ(values[4], 5);
    EXPECT_EQ(values[9], 0.5);
    for (const char* file :
         {"postProcessing/limitAnalysis/0/mechanism.svg", "VTK/blocks.vtp.series", "VTK/contacts.vtp.series"})
        EXPECT_TRUE(fs::exists(directory / file)) << file;

    removeLimitAnalysisTable(directory);
    EXPECT_FALSE(fs::exists(limitAnalysisTable(directory)));
    EXPECT_THROW(confirmResults(directory), FatalError);
}

TEST_F(LimitAnalysisResults, OfALoadThatNeverBreaksTheStructureHaveAnInfiniteMultiplier)
{
    EXPECT_EQ(solve("type force; at (0.5 2); value (0 -1 0);").status, CollapseStatus::unbounded);
    EXPECT_EQ(row()[0], std::numeric_limits<double>::infinity());
    EXPECT_EQ(row()[1], 2);
}

TEST_F(LimitAnalysisResults, OfAStructureThatFallsByItselfHaveNoMultiplier)
{
    writeWholeFile(directory / "constant/g", "value (10 -10 0);"); // a slope of 45 degrees
    EXPECT_EQ(solve("type inertial; direction (1 0 0);").status, CollapseStatus::unstable);
    EXPECT_TRUE(std::isnan(row()[0]));
    EXPECT_EQ(row()[1], 1);
}

} // namespace

} // namespace drystone
