// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A sound case in which one file read by `ensemble` is any text, named by the first character (see
/// SoundCase): the dictionary, the parameters of another program, a table of samples, what workers have left.
/// The readers may only reject it with a FatalError.
#include "SoundCase.h"

#include "ensembles/Ensemble.h"
#include "ensembles/Evaluate.h"
#include "ensembles/SampleStore.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

namespace
{

using namespace drystone;

constexpr const char* parameterFile = "parameters.in";
constexpr const char* journalFile = "journal.0";
constexpr std::size_t journalResults = 1;

/// The file of the case that an input replaces.
enum InputFile : std::size_t
{
    dictionary,
    parameters,
    journal,
    failures,
    table
};

constexpr std::array<fuzz::CaseFile, 5> inputFiles{
    {{"system/ensembleDict",
      "applications (limitAnalysis);\n"
      "variables { mu { file \"constant/contactProperties\"; entry \"friction/mu\"; } }\n"
      "design { type table; file \"constant/samples.dat\"; }\n"
      "results { alpha { type multiplier; } }\n"},
     {parameterFile, ""},
     {journalFile, ""},
     {"failures", ""},
     {"constant/samples.dat", "# mu\n0.5\n0.6\n"}}};
constexpr auto allFiles = fuzz::joined(inputFiles, fuzz::blockOnGround);

/// Reads the ensemble and the values of its first samples.
void readSamples(const std::filesystem::path& caseDirectory)
{
    const Ensemble ensemble = readEnsemble(caseDirectory, {});
    for (long sample = 0; sample < std::min(ensemble.samples(), 10L); ++sample)
    {
        if (ensemble.sampler->at(sample).size() != ensemble.settings.variables.size())
        {
            std::abort();
        }
    }
}

/// Rows of a journal have a number, a status and all their results, whatever is in the file.
void readRows(const std::filesystem::path& file)
{
    std::map<long, SampleRow> rows;
    readJournal(file, journalResults, rows);
    for (const auto& [sample, row] : rows)
    {
        if (sample < 0 || row.attempts < 0 || row.results.size() != journalResults
            || textOf(row.status).empty())
        {
            std::abort();
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::SoundCase sound(allFiles);
    const auto changed = sound.replaceOne({reinterpret_cast<const char*>(data), size});
    if (!changed)
    {
        return 0;
    }
    const std::filesystem::path& directory = sound.path();
    fuzz::tryReading(
        [&]
        {
            switch (*changed)
            {
            case dictionary:
            case table:
                readSamples(directory);
                break;
            case parameters:
                readParameters(directory / parameterFile);
                break;
            case journal:
                readRows(directory / journalFile);
                break;
            case failures:
                readFailures(directory);
                break;
            default:
                break;
            }
        });
    sound.restore(allFiles[*changed]);
    return 0;
}
