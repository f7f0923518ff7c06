// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A search in a case directory: its input, its runs, its log and its files.
///
/// parameterSearch/evaluation   the copy of the case in which the applications run
/// parameterSearch/best         that of the best point so far, with its results
/// postProcessing/parameterSearch/0/
///     history.dat              a row for each point; a search that is restarted repeats none of them
///     best.dat                 the row of the best one, and the number of points
///     parameterSearch.svg      the objective over the evaluations, or over the variable when there is one
#pragma once

#include "ensembles/ParameterSearch.h"
#include "runControl/CommandLine.h"
#include "runControl/PictureFormats.h"

#include <cstdint>
#include <filesystem>

namespace drystone
{

/// A search that has been read and checked.
struct ParameterSearch
{
    std::filesystem::path caseDirectory;
    ParameterSearchSettings settings;
    Dictionary dictionary;     ///< system/parameterSearchDict, for the location in messages
    std::vector<double> start; ///< of the variables
    std::uint64_t caseFingerprint = 0;
    std::vector<std::string> options; ///< for the applications
    PictureFormats pictureFormats{PictureFormat::svg};
};

/// Reads system/parameterSearchDict and looks up the entries that it names.
/// \throws FatalIOError for faults in it, or in a dictionary with an entry to be varied
ParameterSearch readParameterSearch(const std::filesystem::path& caseDirectory,
                                    const CommandLine& commandLine);

/// Checks, before anything is computed, whether the folders of the search can be written.
/// \throws FatalError naming the one that cannot
void requireWritableResults(const ParameterSearch& search);

/// One computed point.
struct SearchRecord
{
    std::vector<double> variables;
    std::vector<double> results; ///< as the tables have them: nan where there is none
    int exitStatus = 0;          ///< of the application that failed; 0: none did
    double cpuTime = 0;          ///< [s]
};

/// The known points, written to disk after each of them.
class SearchHistory
{
public:
    /// Reads the points of an earlier search of the case; nothing is written yet.
    /// \throws FatalError when it is a history of other variables, results, applications or files than now
    explicit SearchHistory(const ParameterSearch& parameterSearch);

    const SearchRecord* find(const std::vector<double>& variables) const;
    void add(SearchRecord record);
    const std::vector<SearchRecord>& records() const { return knownRecords; }

private:
    const ParameterSearch& search;
    std::filesystem::path file;
    std::vector<SearchRecord> knownRecords;
    std::map<std::vector<double>, std::size_t> places;
};

/// Before the first evaluation: variables, results, objective, constraints, algorithms.
void printSearch(const ParameterSearch& search, const SearchHistory& history);

/// Runs the search, prints a line for each evaluation and writes the history.
/// \throws FatalError or FatalIOError when a point cannot be evaluated
SearchOutcome carryOut(const ParameterSearch& search, SearchHistory& history);

/// The best point, and how reliable it is.
void printOutcome(const ParameterSearch& search, const SearchHistory& history, const SearchOutcome& outcome);

/// best.dat and parameterSearch.svg.
void writeOutcome(const ParameterSearch& search, const SearchHistory& history, const SearchOutcome& outcome);

/// 0; 2 when the last local algorithm did not reach its tolerance, or no point meets the constraints; 128 +
/// signal (130 for Ctrl-C) when interrupted.
int exitStatus(const SearchOutcome& outcome);

} // namespace drystone
