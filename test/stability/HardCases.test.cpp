// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Runs each hard case with each solver, holds it to its limit or to the list of expected failures, and
/// leaves a row for the table that `ctest -L stability` prints.
#include "Suite.h"

#include "peers/Peers.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace drystone
{
namespace
{

struct HardRun
{
    std::size_t number; ///< of the case, in the order of the table
    StabilityCase hard;
    SolverType solver;
};

/// What GoogleTest prints of a parameter.
void PrintTo(const HardRun& run, std::ostream* stream)
{
    *stream << run.hard.name << " " << nameOf(run.solver);
}

std::vector<StabilityCase> allCases()
{
    std::vector<StabilityCase> all;
    for (const auto& family : {limitAnalysisCases(), stepCases(), motionCases(), wallCases()})
    {
        all.insert(all.end(), family.begin(), family.end());
    }
    return all;
}

std::vector<HardRun> runs(Length length)
{
    std::vector<HardRun> chosen;
    std::size_t number = 0;
    for (const StabilityCase& hard : allCases())
    {
        ++number;
        for (const SolverType solver : hard.solvers)
        {
            if (hard.length == length)
            {
                chosen.push_back({number, hard, solver});
            }
        }
    }
    return chosen;
}

const ExpectedFailure* expectedFailure(const std::string& name, SolverType solver)
{
    for (const ExpectedFailure& failure : expectedFailures())
    {
        if (failure.name == name && failure.solver == solver)
        {
            return &failure;
        }
    }
    return nullptr;
}

/// Rows of the table, a folder a case and a file a solver; printTable.cmake puts them together.
void tabulate(const HardRun& run, const Outcome& outcome, double limit, const std::string& verdict,
              double seconds)
{
    namespace fs = std::filesystem;
    const fs::path folder =
        fs::path(DRYSTONE_BINARY_DIR) / "stability" / fmt::format("{:03}.{}", run.number, run.hard.name);
    fs::create_directories(folder);
    std::ofstream(folder / "about") << fmt::format("{}: {}\n    {}\n", run.hard.name, run.hard.measure,
                                                   run.hard.hard);
    std::ofstream(folder / ("row." + nameOf(run.solver)))
        << fmt::format("    {:<20}{:>12.3e}{:>12.1e}{:>9.2f} s  {}\n", nameOf(run.solver), outcome.figure,
                       limit, seconds, verdict);
}

class HardCases : public testing::TestWithParam<HardRun>
{
};

TEST_P(HardCases, HoldOrAreListed)
{
    const HardRun& run = GetParam();
    const double limit = run.solver == SolverType::gaussSeidel ? run.hard.looseLimit : run.hard.limit;
    const double start = cpuSeconds();
    const Outcome outcome = run.hard.run(run.solver);
    const double seconds = cpuSeconds() - start;
    const bool holds = outcome.broken.empty() && outcome.figure <= limit; // false for NaN
    const ExpectedFailure* expected = expectedFailure(run.hard.name, run.solver);

    std::string verdict = holds ? "holds" : expected ? "expected failure" : "FAILS";
    for (const std::string& remark : {outcome.note, outcome.broken})
    {
        verdict += remark.empty() ? "" : ": " + remark;
    }
    if (!holds && expected)
    {
        verdict += fmt::format(" ({})", expected->reason);
    }
    tabulate(run, outcome, limit, verdict, seconds);
    if (expected)
    {
        EXPECT_FALSE(holds) << "it holds now: take it off the list in ExpectedFailures.cpp";
    }
    else
    {
        EXPECT_TRUE(holds) << run.hard.measure << ": " << outcome.figure << ", allowed " << limit << "; "
                           << outcome.broken;
    }
}

std::string nameOfRun(const testing::TestParamInfo<HardRun>& info)
{
    return info.param.hard.name + "_" + nameOf(info.param.solver);
}

INSTANTIATE_TEST_SUITE_P(Ordinary, HardCases, testing::ValuesIn(runs(Length::ordinary)), nameOfRun);
INSTANTIATE_TEST_SUITE_P(Nightly, HardCases, testing::ValuesIn(runs(Length::nightly)), nameOfRun);

TEST(ExpectedFailures, NameCasesThatThereAre)
{
    const auto all = allCases();
    for (const ExpectedFailure& failure : expectedFailures())
    {
        EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                                [&](const StabilityCase& hard)
                                {
                                    return hard.name == failure.name
                                           && std::count(hard.solvers.begin(), hard.solvers.end(),
                                                         failure.solver);
                                }))
            << failure.name << " " << nameOf(failure.solver);
    }
}

} // namespace
} // namespace drystone
