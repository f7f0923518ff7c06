// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A sound case in which one file read by ensembles and function objects is any text, named by the first
/// character (see SoundCase). The readers may only reject it with a FatalError.
#include "SoundCase.h"

#include "ensembles/AccuracyCostCase.h"
#include "ensembles/IncrementalDynamicsCase.h"
#include "ensembles/ParameterSearchCase.h"
#include "ensembles/StudyHistory.h"
#include "functionObjects/LimitAnalysisResults.h"
#include "io/VtkSeries.h"
#include "runControl/CommandLine.h"
#include "runControl/Time.h"

#include <array>
#include <cstdint>

namespace
{

using namespace drystone;

/// A file of the case and its reader.
struct StudyFile
{
    fuzz::CaseFile file;
    void (*read)(const std::filesystem::path& caseDirectory) = nullptr;
};

constexpr const char* heading = "# of the study\n";
constexpr const char* historyFile = "history.dat";
constexpr const char* tableFile = "table.dat";

void readIncremental(const std::filesystem::path& caseDirectory)
{
    Time time(caseDirectory, ControlDict::required);
    readIncrementalDynamics<2>(caseDirectory, time);
}

void readAccuracy(const std::filesystem::path& caseDirectory)
{
    readAccuracyStudy<2>(caseDirectory);
}

void readSearch(const std::filesystem::path& caseDirectory)
{
    readParameterSearch(caseDirectory, {});
}

void readFunctions(const std::filesystem::path& caseDirectory)
{
    const Time time(caseDirectory, ControlDict::required);
    const DynamicCase<2> scene = readDynamicCase<2>(caseDirectory);
    checkFunctions(time.controlDict(), caseDirectory, scene.assembly);
}

void readSeries(const std::filesystem::path& caseDirectory)
{
    const VtkSeries series(caseDirectory / "VTK", "motion", 0.5);
}

void readRows(const std::filesystem::path& caseDirectory)
{
    for (const HistoryRow& row : readHistory(caseDirectory / historyFile, heading, 3, "fuzz"))
    {
        row.whole(0, 0);
        row.finite(1);
    }
}

void readTable(const std::filesystem::path& caseDirectory)
{
    readColumn(caseDirectory / tableFile, "alpha");
}

constexpr std::array<StudyFile, 7> studyFiles{
    {{{"system/incrementalDynamicsDict", ""}, readIncremental},
     {{"system/accuracyCostDict", ""}, readAccuracy},
     {{"system/parameterSearchDict", ""}, readSearch},
     {{"system/controlDict", "deltaT 0.01; endTime 1;\n"}, readFunctions},
     {{"VTK/motion.vtp.series", ""}, readSeries},
     {{historyFile, ""}, readRows},
     {{tableFile, ""}, readTable}}};

/// Further files required by these readers.
constexpr auto otherFiles = fuzz::joined(
    fuzz::blockOnGround,
    std::array<fuzz::CaseFile, 2>{
        {{"constant/groundMotion", "direction (1 0 0); acceleration { type constant; value 3; }\n"},
         {"constant/record.csv", "t [s],a [m/s2]\n0,0\n0.1,1\n0.2,-1\n0.3,0\n"}}});

constexpr auto allFiles = []
{
    std::array<fuzz::CaseFile, studyFiles.size()> read{};
    std::transform(studyFiles.begin(), studyFiles.end(), read.begin(),
                   [](const StudyFile& study) { return study.file; });
    return fuzz::joined(read, otherFiles);
}();

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::SoundCase sound(allFiles);
    const auto changed = sound.replaceOne({reinterpret_cast<const char*>(data), size});
    if (!changed)
    {
        return 0;
    }
    if (*changed < studyFiles.size())
    {
        fuzz::tryReading([&] { studyFiles[*changed].read(sound.path()); });
    }
    sound.restore(allFiles[*changed]);
    return 0;
}
