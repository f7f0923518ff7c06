// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Runs that are known are not repeated; rows that have been changed, are there twice or contradict
/// themselves are refused.
#include "ensembles/AccuracyHistory.h"

#include "../ReportOf.h"
#include "core/Error.h"
#include "core/WholeFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace drystone;
using testing::HasSubstr;

namespace
{

class AccuracyHistoryTest : public testing::Test
{
protected:
    void SetUp() override
    {
        study.caseDirectory =
            std::filesystem::temp_directory_path() / fmt::format("drystone-accuracy-{}", ::getpid());
        study.heading = historyHeading(
            study.caseDirectory, Dictionary::readString("quantities { first { type energy; } }", "dict"));
        study.quantities.resize(1);
        file = accuracyFolder(study.caseDirectory) / "history.dat";
        key.setting.deltaT = 0.01;
        key.setting.tolerance = 1e-8;
        key.phase = {0, 2};
    }
    void TearDown() override { std::filesystem::remove_all(study.caseDirectory); }

    std::string faultOf(const std::string& text) const
    {
        writeWholeFile(file, text);
        return reportOf([&] { const AccuracyRuns runs(study); });
    }

    AccuracyStudy study;
    RunKey key;
    Measurement run{1 / 3.0, 0.001, 70, 0.25, 1e-11, RunEnd::done};
    std::filesystem::path file;
};

TEST_F(AccuracyHistoryTest, RunsAreReadBackToTheLastBit)
{
    AccuracyRuns written(study);
    written.add(key, run);
    key.phase.index = 1;
    written.add(key, {std::numeric_limits<double>::quiet_NaN(), 0, 3, 0.1, 1, RunEnd::unsolved});
    written.write();
    const AccuracyRuns read(study);
    EXPECT_EQ(read.size(), 2u);
    ASSERT_TRUE(read.find(key));
    EXPECT_EQ(read.find(key)->end, RunEnd::unsolved);
    key.phase.index = 0;
    ASSERT_TRUE(read.find(key));
    EXPECT_EQ(read.find(key)->value, 1 / 3.0);
}

TEST_F(AccuracyHistoryTest, ADigitThatWasChangedIsFoundInEveryColumn)
{
    AccuracyRuns written(study);
    written.add(key, run);
    written.write();
    const std::string sound = contentOfFile(file);
    EXPECT_EQ(faultOf(sound), "no error");
    const std::size_t row = sound.find("\n0 0.01 ") + 1;
    ASSERT_NE(row, 0u);
    for (std::size_t at = row; at + 1 < sound.size(); ++at)
    {
        std::string changed = sound;
        changed[at] = changed[at] == '1' ? '2' : '1';
        EXPECT_THAT(faultOf(changed),
                    testing::AllOf(HasSubstr("history.dat at line "), HasSubstr("emove the row")))
            << changed;
    }
}

TEST_F(AccuracyHistoryTest, ARunThatIsThereTwiceOrContradictsItselfIsNamed)
{
    AccuracyRuns written(study);
    written.add(key, run);
    written.write();
    const std::string sound = contentOfFile(file);
    const auto line = std::count(sound.begin(), sound.end(), '\n') + 1;
    const std::string row = sound.substr(sound.find("\n0 0.01 ") + 1);
    std::string other = row;
    other.replace(other.find("0.333"), 5, "0.444");
    for (const std::string& twice : {row, other})
    {
        EXPECT_THAT(
            faultOf(sound + twice),
            testing::AllOf(HasSubstr("phase[-], column 13 of a row of the history, is 0: it takes what "
                                     "no row before has with this setting"),
                           HasSubstr(fmt::format("history.dat at line {}.", line))));
    }
    std::string failed = row;
    failed.replace(failed.size() - 2, 1, "1");
    EXPECT_THAT(faultOf(study.heading + failed),
                HasSubstr("value, column 15 of a row of the history, is 0.333"));
}

} // namespace
