// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Runs that are known are not repeated; those of other input are.
#include "ensembles/IncrementalHistory.h"

#include "../ReportOf.h"
#include "core/Error.h"
#include "core/WholeFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

using namespace drystone;

namespace
{

class IncrementalHistoryTest : public testing::Test
{
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / fmt::format("drystone-history-{}", ::getpid());
        std::filesystem::create_directories(folder / "postProcessing");
        study.criterion.summary = "displacement above 1 mm";
        study.criterion.figure.name = "displacement";
        study.criterion.figure.unit =
            std::string("m"); // GCC 12 takes a literal for out of bounds (its bug 105329)
        study.motions = {{"first", {}, 2.5}, {"second", {}, 1.5}};
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    IncrementalHistory<2> history() const { return {folder, folder / "postProcessing", study}; }

    std::filesystem::path folder;
    IncrementalDynamics<2> study;
};

IncrementalRun someRun(double intensity)
{
    IncrementalRun run;
    run.intensity = intensity;
    run.factor = 1 / 3.0;
    run.verdict = Verdict::meets;
    run.largest = 0.1 / 3;
    run.endTime = 0.7;
    run.steps = 35;
    run.worstResidual = 1e-11;
    run.cpuTime = 0.25;
    return run;
}

TEST_F(IncrementalHistoryTest, RunsAreReadBackToTheLastBit)
{
    EXPECT_EQ(history().count(), 0u);
    {
        IncrementalHistory<2> written = history();
        written.add(1, someRun(0.1 + 0.2));
        written.add(0, someRun(0.5));
    }
    const IncrementalHistory<2> read = history();
    EXPECT_EQ(read.changeOfInput(), "");
    ASSERT_EQ(read.count(), 2u);
    const IncrementalRun& run = read.known()[1].at(0);
    EXPECT_EQ(run.intensity, 0.1 + 0.2);
    EXPECT_EQ(run.factor, 1 / 3.0);
    EXPECT_EQ(run.verdict, Verdict::meets);
    EXPECT_EQ(run.largest, 0.1 / 3);
    EXPECT_EQ(run.endTime, 0.7);
    EXPECT_EQ(run.steps, 35);
    EXPECT_EQ(run.worstResidual, 1e-11);
}

TEST_F(IncrementalHistoryTest, OfOtherInputIsLeftAside)
{
    history().add(0, someRun(0.5));
    study.motions[1].peak = 1.6;
    EXPECT_EQ(history().changeOfInput(), "what system/incrementalDynamicsDict requests of a run has changed");
    EXPECT_EQ(history().count(), 0u);
    study.motions[1].peak = 1.5;
    EXPECT_EQ(history().count(), 1u);
    std::filesystem::create_directories(folder / "constant");
    std::ofstream(folder / "constant/g") << "value (0 -9.81 0);";
    EXPECT_EQ(history().changeOfInput(), "constant/g is new");
    IncrementalHistory<2> again = history();
    again.add(0, someRun(0.6));
    ASSERT_EQ(history().count(), 1u);
    EXPECT_EQ(history().known()[0].at(0).intensity, 0.6);
}

// Its direction, start and padding leave the peak of a record as it is, and so does most of its file.
TEST_F(IncrementalHistoryTest, OfOtherRecordsIsLeftAside)
{
    const std::string records = "records { first { file \"records/a.csv\"; direction (1 0 0); } second "
                                "{ file \"constant/b.csv\"; } }";
    const std::string other = "what system/incrementalDynamicsDict requests of a run has changed";
    std::filesystem::create_directories(folder / "system");
    std::filesystem::create_directories(folder / "records");
    const auto write =
        [&](const char* file, std::string text, const std::string& old = "", const char* with = "")
    {
        text.replace(text.find(old), old.size(), with);
        writeWholeFile(folder / file, text);
    };
    write("system/incrementalDynamicsDict", records);
    write("records/a.csv", "0 1");
    history().add(0, someRun(0.5));
    EXPECT_EQ(history().count(), 1u);
    for (const char* changed :
         {"direction (0 1 0)", "direction (1 0 0); start 2", "direction (1 0 0); padding (1 0)"})
    {
        write("system/incrementalDynamicsDict", records, "direction (1 0 0)", changed);
        EXPECT_EQ(history().changeOfInput(), other) << changed;
    }
    write("system/incrementalDynamicsDict", "jobs 3; // layout\n" + records);
    EXPECT_EQ(history().changeOfInput(), "");
    write("records/a.csv", "0 1 ");
    EXPECT_EQ(history().changeOfInput(), "records/a.csv has changed");
}

TEST_F(IncrementalHistoryTest, DamagedRowsAreNamed)
{
    history().add(0, someRun(0.5));
    const auto file = folder / "postProcessing/history.dat";
    const std::string sound = contentOfFile(file);
    const int line = static_cast<int>(std::count(sound.begin(), sound.end(), '\n')) + 1;
    for (const char* row : {"7 0.5 1 1 1 1 1 1 1", "2 0.5 1 1 1 1 1 1 1 0", "-1 0.5 1 1 1 1 1 1 1 0",
                            "1e300 0.5 1 1 1 1 1 1 1 0", "0.5 0.5 1 1 1 1 1 1 1 0", "nan 0.5 1 1 1 1 1 1 1 0",
                            "1 nan 1 1 1 1 1 1 1 0", "1 0.5 1 3 1 1 1 1 1 0", "1 0.5 1 0.5 1 1 1 1 1 0",
                            "1 0.5 1 1 1 1 1e30 1 1 0", "1 0.5 1 1 1 1 1 1 1 2"})
    {
        writeWholeFile(file, sound + row + "\n");
        const std::string report = reportOf([&] { history(); });
        EXPECT_THAT(report, HasSubstr(fmt::format("file: {} at line {}.", file.string(), line))) << row;
    }
}

TEST_F(IncrementalHistoryTest, RowsThatContradictThemselvesOrOthersAreNamed)
{
    study.gravity = 10;
    study.criterion.limit = 0.01;
    IncrementalRun sound = someRun(0.5);
    sound.factor = 0.5 * 10 / 2.5;
    history().add(0, sound);
    EXPECT_EQ(history().count(), 1u);
    const auto file = folder / "postProcessing/history.dat";
    const std::string text = contentOfFile(file);
    const int line = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
    // motion, intensity, factor, verdict, largest, ...
    const std::vector<std::pair<std::string, std::string>> rows{
        {"0 0.6 2 1 0.02 1 1 1 1 0", "2.4, which makes the peak of first the intensity 0.6"},
        {"0 0.6 2.4 0 0.02 1 1 1 1 0", "1 where displacement is 0.02, and the limit of it 0.01"},
        {"0 0.6 2.4 1 0.002 1 1 1 1 0", "0 where displacement is 0.002"},
        {"0 0.5 2 1 0.02 1 1 1 1 0", "no row of motion 0 before"}};
    for (const auto& [row, fault] : rows)
    {
        writeWholeFile(file, text + row + "\n");
        const std::string report = reportOf([&] { history(); });
        EXPECT_THAT(report, AllOf(HasSubstr(fault), HasSubstr(fmt::format(" at line {}.", line)))) << row;
    }
    writeWholeFile(file, text + "0 0.6 2.4 1 0.02 1 1 1 1 0\n");
    EXPECT_EQ(history().count(), 2u);
}

TEST_F(IncrementalHistoryTest, DamagedFilesAreNotTakenForThoseOfOtherInput)
{
    writeWholeFile(folder / "postProcessing/history.dat", "");
    EXPECT_THROW(history(), FatalIOError);
}

} // namespace
