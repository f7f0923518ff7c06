// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What limit analysis leaves in a case, for each of its three answers.
#include "functionObjects/LimitAnalysisResults.h"
#include "assembly/AssemblyFile.h"
#include "contact/ClosedAssembly.h"
#include "core/Error.h"
#include "core/WholeFile.h"
#include "functionObjects/CollapseProgressLog.h"
#include "functionObjects/CoulombRangeLog.h"
#include "functionObjects/LimitAnalysisLog.h"
#include "functionObjects/LimitAnalysisTables.h"
#include "functionObjects/LoadMeaning.h"
#include "runControl/CaseFiles.h"
#include "statics/SolveCase.h"
#include "statics/SurfaceContact.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
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
        LimitAnalysisCase structure = readLimitAnalysisCase<2>(directory);
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
        {
            values.push_back(std::strtod(word.c_str(), nullptr)); // reads inf and nan, unlike >>
        }
        return values;
    }

    fs::path directory;
};

TEST(LimitAnalysisTables, AMultiplierOfZeroHasNoSign)
{
    EXPECT_EQ(alphaText(-1e-300), "0.000000");
    EXPECT_EQ(alphaText(-0.0), "0.000000");
    EXPECT_EQ(alphaText(-0.25), "-0.250000");
    CoulombRange range;
    range.lowest = range.highest = range.associative = -0.0;
    EXPECT_THAT(coulombText(range), testing::HasSubstr("\n0 0 0 0 0 inf\n"));
}

TEST(LimitAnalysisTables, SayWhenASearchWasCutShort)
{
    CoulombRange range;
    EXPECT_THAT(coulombText(range), testing::Not(testing::HasSubstr("cutShort")));
    range.cutShortAfter = 60.25;
    EXPECT_THAT(coulombText(range), testing::HasSubstr(" fall[-] cutShortAfter[s]\n0 0 0 0 0 inf 60.25\n"));
}

TEST(LimitAnalysisLog, QuestionsALowestCollapseFarBelowTheAssociativeMultiplier)
{
    CoulombRange range;
    range.associative = 0.372;
    range.lowest = 0.0007;
    EXPECT_EQ(questionOfLowest(range), ""); // none was found
    range.converged = 3;
    EXPECT_THAT(questionOfLowest(range), testing::HasSubstr("0.002 of the associative multiplier"));
    range.lowest = 0.04;
    EXPECT_EQ(questionOfLowest(range), "");
}

TEST(CollapseProgressLog, NamesTheKeyOnceWhenASearchIsLong)
{
    for (const SearchTime time : {SearchTime::endless, SearchTime::limited})
    {
        double now = 100;
        testing::internal::CaptureStdout();
        const auto log = collapseProgressLog(time, [&now] { return now; });
        std::string said;
        for (int second = 0; second < 120; ++second, ++now)
        {
            log({1, second, 0.1, 0.2});
            if (second == 29)
            {
                flushLog();
                said = testing::internal::GetCapturedStdout();
                EXPECT_THAT(said, testing::HasSubstr("path 1"));
                EXPECT_THAT(said, testing::Not(testing::HasSubstr("maximumTime")));
                testing::internal::CaptureStdout();
            }
        }
        flushLog();
        said = testing::internal::GetCapturedStdout();
        const std::size_t first = said.find("maximumTime");
        EXPECT_EQ(first != std::string::npos, time == SearchTime::endless) << said;
        EXPECT_EQ(said.find("maximumTime", time == SearchTime::limited ? 0 : first + 1), std::string::npos)
            << said;
    }
}

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
    for (const char* file : {"postProcessing/limitAnalysis/0/mechanism.svg", "VTK/blocks.vtp.series",
                             "VTK/contacts.vtp.series", "VTK/thrust.vtp.series"})
    {
        EXPECT_TRUE(fs::exists(directory / file)) << file;
    }

    removeLimitAnalysisResults(directory);
    EXPECT_FALSE(fs::exists(limitAnalysisTable(directory)));
    EXPECT_THROW(confirmResults(directory), FatalError);
}

TEST_F(LimitAnalysisResults, OfCombinationsOfLoadsHaveARowEach)
{
    // 1 x 2 m, 20 kN, mu 0.4: slides at 0.4; under 20 kN more it needs twice that load, or overturns.
    writeWholeFile(directory / "constant/loads",
                   "combinations { bare { dead { type gravity; } live { type inertial; direction (1 0); } } "
                   "full { dead { type sum; loads { w { type gravity; } p { type force; at (0.5 2); value "
                   "(0 -20000); } } } live { type inertial; direction (1 0); } multiplier both; } }");
    LimitAnalysisCase structure = readLimitAnalysisCase<2>(directory);
    const std::vector<LimitAnalysis> results = solveLimitAnalyses(structure);
    ASSERT_EQ(results.size(), 3U);
    EXPECT_EQ(results[0].combination, "bare");
    EXPECT_NEAR(results[0].alpha, 0.4, 1e-8);
    EXPECT_NEAR(results[1].alpha, 0.8, 1e-8);
    EXPECT_NEAR(results[2].alpha, -0.8, 1e-8);
    writeLimitAnalysisResults(directory, structure, results, 0.5);
    EXPECT_EQ(row().size(), 30U);
    for (const char* file : {"combinations.dat", "mechanism_bare.svg", "mechanism_full.svg",
                             "mechanism_fullNegative.svg", "thrust_full.dat"})
    {
        EXPECT_TRUE(fs::exists(limitAnalysisTable(directory).replace_filename(file))) << file;
    }
}

TEST_F(LimitAnalysisResults, OfContactBySurfacesAreCertifiedInStressResultants)
{
    for (const double mu : {0.4, 0.7}) // slides; overturns
    {
        writeWholeFile(
            directory / "constant/contactProperties",
            fmt::format("friction {{ type Coulomb; mu {}; }} contact {{ formulation surface; }}", mu));
        writeWholeFile(directory / "constant/loads",
                       "dead { type gravity; } live { type inertial; direction (1 0 0); } multiplier both;");
        LimitAnalysisCase structure = readLimitAnalysisCase<2>(directory);
        for (const LimitAnalysis& result : solveLimitAnalyses(structure))
        {
            EXPECT_EQ(result.status, CollapseStatus::optimal);
            EXPECT_NEAR(std::abs(result.alpha), std::min(mu, 0.5), 1e-8);
            EXPECT_LT(result.certificate.worst(), 1e-9);
            EXPECT_EQ(result.variables, 4); // N, T and M of one joint, and alpha
        }
    }
}

TEST_F(LimitAnalysisResults, ACertificateInStressResultantsTellsAWrongAnswer)
{
    writeWholeFile(directory / "constant/contactProperties",
                   "friction { type Coulomb; mu 0.7; } contact { formulation surface; }");
    writeWholeFile(directory / "constant/loads",
                   "dead { type gravity; } live { type inertial; direction (1 0 0); }");
    LimitAnalysisCase structure = readLimitAnalysisCase<2>(directory);
    const LimitAnalysis right = solveLimitAnalysis(structure);
    const auto worst = [&](const LimitAnalysis& result)
    {
        return certifySurfaceContact(
                   structure.assembly,
                   jointResultants(structure.points, structure.friction, result.contactForce),
                   structure.loads, result)
            .worst();
    };
    EXPECT_LT(worst(right), 1e-9);
    LimitAnalysis wrong = right;
    wrong.alpha *= 1.01;
    EXPECT_GT(worst(wrong), 1e-3);
    wrong = right;
    wrong.mechanism[2] *= 1.01; // turns more than it lifts
    EXPECT_GT(worst(wrong), 1e-3);
    wrong = right;
    wrong.contactForce *= 1.01;
    EXPECT_GT(worst(wrong), 1e-3);
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

TEST_F(LimitAnalysisResults, OfOtherLoadsAreRemovedAndNothingElse)
{
    const fs::path folder = limitAnalysisTable(directory).parent_path();
    for (const char* earlier :
         {"mechanism_wind.svg", "thrust_wind.svg", "thrust_wind.dat", "mechanismNegative.svg"})
    {
        writeWholeFile(folder / earlier, "of an earlier run");
    }
    for (const char* earlier : {"blocks_wind.vtp.series", "blocks_wind_000000.vtp", "thrust_wind.vtp.series"})
    {
        writeWholeFile(directory / "VTK" / earlier, "of an earlier run");
    }
    const fs::path others[] = {folder / "notes_wind.svg", folder / "mechanisms.svg",
                               directory / "VTK/blocks_windows_000000.vtp"};
    for (const fs::path& other : others)
    {
        writeWholeFile(other, "of the user");
    }
    solve("type inertial; direction (1 0 0);");
    for (const char* earlier :
         {"mechanism_wind.svg", "thrust_wind.svg", "thrust_wind.dat", "mechanismNegative.svg"})
    {
        EXPECT_FALSE(fs::exists(folder / earlier)) << earlier;
    }
    for (const char* earlier : {"blocks_wind.vtp.series", "blocks_wind_000000.vtp", "thrust_wind.vtp.series"})
    {
        EXPECT_FALSE(fs::exists(directory / "VTK" / earlier)) << earlier;
    }
    for (const fs::path& other : others)
    {
        EXPECT_TRUE(fs::exists(other)) << other;
    }
    EXPECT_TRUE(fs::exists(folder / "mechanism.svg"));
    EXPECT_TRUE(fs::exists(directory / "VTK/blocks.vtp.series"));
}

TEST_F(LimitAnalysisResults, OfBlocksThatNothingHoldsNameTheCause)
{
    Assembly<2> assembly = readAssembly<2>(directory);
    assembly.blocks.push_back({{{0, 3}, {1, 3}, {1, 4}, {0, 4}}, 1, -1});
    writeWholeFile(assemblyFile(directory), assemblyText(assembly));
    const LimitAnalysis result = solve("type inertial; direction (1 0 0);");
    testing::internal::CaptureStdout();
    printLimitAnalysis(readLimitAnalysisCase<2>(directory), {result});
    const std::string log = testing::internal::GetCapturedStdout();
    EXPECT_NE(log.find("Status: unstable (the blocks cannot carry the dead load: the mechanism is written)\n"
                       "Cause: a block with no path to a support through joints: 2."),
              std::string::npos)
        << log;
}

TEST_F(LimitAnalysisResults, OfTheNegativeEndHaveItsSignByCoulombsLawToo)
{
    writeWholeFile(directory / "constant/contactProperties",
                   "friction { type Coulomb; mu 0.4; flowRule nonAssociative; }");
    writeWholeFile(directory / "constant/loads", "dead { type gravity; } live { type inertial; direction (1 "
                                                 "0); } multiplier both;");
    LimitAnalysisCase structure = readLimitAnalysisCase<2>(directory);
    std::vector<LimitAnalysis> results = solveLimitAnalyses(structure);
    ASSERT_EQ(results.size(), 2U);
    ASSERT_TRUE(results[0].coulomb && results[1].coulomb);
    EXPECT_NEAR(results[0].coulomb->lowest, 0.4, 1e-6);
    EXPECT_NEAR(results[0].coulomb->associative, 0.4, 1e-6);
    EXPECT_NEAR(results[1].coulomb->lowest, -0.4, 1e-6);
    EXPECT_NEAR(results[1].coulomb->highest, -0.4, 1e-6);
    EXPECT_NEAR(results[1].coulomb->associative, -0.4, 1e-6);
    EXPECT_EQ(results[1].coulomb->fall, -std::numeric_limits<double>::infinity());

    const auto log = [&]
    {
        testing::internal::CaptureStdout();
        printLimitAnalysis(structure, results);
        return testing::internal::GetCapturedStdout();
    };
    const std::string ordinary = log();
    EXPECT_THAT(ordinary, testing::HasSubstr("associative, an upper bound: 0.400000\n"));
    EXPECT_THAT(ordinary, testing::HasSubstr("alpha -0.400000 to -0.400000 ("));
    EXPECT_THAT(ordinary, testing::HasSubstr("associative, a lower bound: -0.400000\n"));
    EXPECT_THAT(ordinary, testing::Not(testing::HasSubstr("The multiplier is")));
    EXPECT_THAT(ordinary, testing::Not(testing::HasSubstr("may fall")));

    // What is not found, and pairs on the other side of zero.
    results[1].status = CollapseStatus::upperBound;
    results[1].coulomb->converged = 0;
    results[1].coulomb->safe = -0.1;
    const std::string bound = log();
    EXPECT_THAT(bound, testing::HasSubstr("Collapse load multiplier alpha >= -0.4"));
    EXPECT_THAT(bound,
                testing::HasSubstr("its multiplier is at least that of the associative law, -0.400000, "
                                   "and at most that of joints without friction, -0.100000"));
    results[1].status = CollapseStatus::unbounded;
    const std::string searched = log();
    EXPECT_THAT(searched, testing::HasSubstr("Status: unbounded (some forces carry any multiple of the live "
                                             "load, and no collapse by Coulomb's law was found"));
    EXPECT_THAT(searched, testing::HasSubstr("which proves none: any has a multiplier of at most -0.100000"));
    results[1].coulomb->safe = -std::numeric_limits<double>::infinity();
    const std::string proved = log();
    EXPECT_THAT(proved,
                testing::HasSubstr("Status: unbounded (no load of this direction makes it collapse)"));
    EXPECT_THAT(proved, testing::HasSubstr("Coulomb's law: provably no collapse"));
    results[1].status = CollapseStatus::optimal;
    results[1].coulomb->safe = -0.1;
    results[1].alpha = 0.01;
    EXPECT_THAT(log(), testing::HasSubstr("The multiplier is above zero: some forces at rest"));
}

TEST_F(LimitAnalysisResults, QuestionsAStrengthInAnotherUnit)
{
    // 20 kN on a joint of 1 m2, which bears 5 N where MPa were meant, and 0.4 of that by friction.
    const auto warnings = [&](const std::string& properties)
    {
        writeWholeFile(directory / "constant/contactProperties",
                       "friction { type Coulomb; mu 0.4; }\n" + properties);
        const LimitAnalysis result = solve("type inertial; direction (1 0 0);");
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        printLimitAnalysis(readLimitAnalysisCase<2>(directory), {result});
        testing::internal::GetCapturedStdout();
        return testing::internal::GetCapturedStderr();
    };
    const std::string warning = warnings("crushing { strength 5; }");
    EXPECT_THAT(warning, testing::HasSubstr("strength = 5 [Pa] is little beside the dead load"));
    EXPECT_THAT(warning, testing::HasSubstr("bear 5.385 N at most"));
    EXPECT_THAT(warning, testing::HasSubstr("of its 20 kN"));
    EXPECT_THAT(warning, testing::HasSubstr("`strength 5e+06;`"));
    EXPECT_THAT(warning, testing::HasSubstr("constant/contactProperties/crushing/strength at line 2."));
    EXPECT_THAT(warnings("\ncrushing { strength 5e6; } joints {\n 0-ground { crushing { strength 4; } } }"),
                testing::HasSubstr("joints/0-ground/crushing/strength at line 4."));
    EXPECT_EQ(warnings("crushing { strength 5e6; }"), "");
    EXPECT_THAT(warnings("\n\n\ncrushing { strength 1e4; }"),
                testing::AllOf(testing::HasSubstr("at line 5."), testing::Not(testing::HasSubstr("in MPa"))));
    // By pressure and friction it bears less than its weight, with cohesion in all more.
    EXPECT_EQ(warnings("cohesion { strength 2e4; } crushing { strength 1e4; }"), "");
}

TEST_F(LimitAnalysisResults, QuestionsStrengthsOfNoStoneWhereThereIsNoAnswer)
{
    const auto warnings = [&](const std::string& properties, CollapseStatus status)
    {
        writeWholeFile(directory / "constant/contactProperties",
                       "friction { type Coulomb; mu 0.4; }\n" + properties);
        LimitAnalysis result = solve("type inertial; direction (1 0 0);");
        result.status = status;
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        printLimitAnalysis(readLimitAnalysisCase<2>(directory), {result});
        testing::internal::GetCapturedStdout();
        return testing::internal::GetCapturedStderr();
    };
    const std::string warning = warnings("cohesion { strength 2e12; }\njoints {\n"
                                         "0-ground { tension { strength 2e9; } } }",
                                         CollapseStatus::notConverged);
    EXPECT_THAT(warning, testing::HasSubstr("strength = 2e+12 [Pa] is above that of the hardest stone"));
    EXPECT_THAT(warning, testing::HasSubstr("constant/contactProperties/cohesion/strength at line 2."));
    EXPECT_THAT(warning, testing::HasSubstr("joints/0-ground/tension/strength at line 4."));
    EXPECT_EQ(warnings("cohesion { strength 1e9; }", CollapseStatus::notConverged), "");
    EXPECT_EQ(warnings("cohesion { strength 2e9; }", CollapseStatus::optimal), "");
}

TEST_F(LimitAnalysisResults, StatesTheMultiplierInForces)
{
    // 20 kN, pushed at its top corner by 1 kN: it rocks at 20 x 0.5 / 2 = 5 kN.
    const LimitAnalysis result = solve("type force; at (0 2); value (1000 0);");
    const LimitAnalysisCase structure = readLimitAnalysisCase<2>(directory);
    EXPECT_THAT(loadMeaning(structure, result),
                testing::ElementsAre("Dead load: 20 kN along (0 -1)",
                                     "Live load: 1 kN along (1 0); at collapse 5 kN, 0.25 of the dead load"));
}

// A fill on both sides of a wall pressed it down only: the log said "no load of this direction" and not
// which.
TEST_F(LimitAnalysisResults, StatesTheLoadsWhereThereIsNoMultiplier)
{
    const LimitAnalysis result = solve("type force; at (0.5 2); value (0 -1000);");
    const LimitAnalysisCase structure = readLimitAnalysisCase<2>(directory);
    ASSERT_EQ(result.status, CollapseStatus::unbounded);
    EXPECT_THAT(loadMeaning(structure, result),
                testing::ElementsAre("Dead load: 20 kN along (0 -1)", "Live load: 1 kN along (0 -1)"));
    testing::internal::CaptureStdout();
    printLimitAnalysis(structure, {result});
    EXPECT_THAT(testing::internal::GetCapturedStdout(),
                testing::HasSubstr("Live load: 1 kN along (0 -1)\nStatus: unbounded"));
}

TEST_F(LimitAnalysisResults, SaysThatACoupleHasNoResultant)
{
    const LimitAnalysis result = solve("type sum; loads { a { type force; at (0 2); value (1000 0); } "
                                       "b { type force; at (0 1); value (-1000 0); } }");
    const LimitAnalysisCase structure = readLimitAnalysisCase<2>(directory);
    EXPECT_THAT(loadMeaning(structure, result),
                testing::Contains("Live load: its forces cancel, there is no resultant"));
}

// It was said that the forces of such a load cancel.
TEST(LoadMeaning, ALoadCaseThatIsNoneSaysSo)
{
    LoadVectors loads;
    loads.cases = {{"fill", Eigen::VectorXd::Zero(3)}};
    EXPECT_THAT(caseMeaning<2>(loads), testing::ElementsAre("Load case fill: no force on any block"));
}

TEST_F(LimitAnalysisResults, NamesTheCaseInTitlesHoweverItsDirectoryIsGiven)
{
    EXPECT_EQ(caseName("/somewhere/wall"), "wall");
    EXPECT_EQ(caseName("/somewhere/wall/"), "wall");
    EXPECT_EQ(caseName("/somewhere/wall/."), "wall");
    EXPECT_EQ(caseName("."), std::filesystem::current_path().filename().string());
}

TEST(ForceText, ChoosesTheUnit)
{
    EXPECT_EQ(forceText(0), "0 N");
    EXPECT_EQ(forceText(312.04), "312 N");
    EXPECT_EQ(forceText(-48999.6478), "-49 kN");
    EXPECT_EQ(forceText(1.2041e6), "1.204 MN");
}

} // namespace

} // namespace drystone
