// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reads the search with the entries that it varies, and checks what can be before anything is computed.
#include "ensembles/ParameterSearchCase.h"

#include "core/WholeFile.h"
#include "ensembles/CaseEntry.h"
#include "ensembles/SearchHistory.h"
#include "ensembles/StudyHistory.h"
#include "ensembles/StudyInput.h"
#include "ensembles/WrittenTables.h"
#include "runControl/Case.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

namespace fs = std::filesystem;

ParameterSearch readParameterSearch(const fs::path& caseDirectory, const CommandLine& commandLine)
{
    ParameterSearch search;
    search.caseDirectory = caseDirectory;
    search.pictureFormats = readPictureFormats(caseDirectory);
    search.dictionary =
        Dictionary::readFile(requireCaseFile(caseDirectory, "system/parameterSearchDict",
                                             "It specifies which entries to vary and what to find; "
                                             "etc/annotated/system/parameterSearchDict is one to copy."));
    search.settings = readSearchSettings(search.dictionary);
    std::error_code unknown; // a name that no file can have is not a file
    for (const std::string& directory : search.settings.cases)
    {
        if (!fs::is_directory(caseDirectory / directory, unknown))
        {
            throw FatalIOError(
                fmt::format("There is no directory {} in this case: name one that is.", directory),
                search.dictionary.locationOf("cases"));
        }
    }
    for (const auto& [name, variable] : search.settings.variables)
    {
        const Dictionary& own = search.dictionary.subDict("variables").subDict(name);
        const Entry entry = lookUp(caseDirectory, variable.place, own);
        double value = 0;
        try
        {
            value = entry.as<double>();
        }
        catch (const FatalIOError& error)
        {
            throw FatalIOError(fmt::format("The entry {} of {} cannot be varied: it has to be a number.\n{}",
                                           variable.place.entry, variable.place.file, error.what()),
                               own.locationOf("entry"));
        }
        search.start.push_back(
            variable.start.value_or(std::clamp(value, variable.bounds[0], variable.bounds[1])));
    }
    const StudyRuns runs = runsOf(search);
    for (const auto& [name, result] : search.settings.results)
    {
        requireTable(result.figure, caseDirectory, runs, search.dictionary.subDict("results").subDict(name));
    }
    search.caseInput = historyInput(inputOfStudy(caseDirectory, runs));
    if (commandLine.noFunctionObjects)
    {
        search.options.emplace_back("-noFunctionObjects");
    }
    return search;
}

void requireWritableResults(const ParameterSearch& search)
{
    requireWritable(searchFolder(search.caseDirectory));
    requireWritable(search.caseDirectory / parameterSearchName);
}

} // namespace drystone
