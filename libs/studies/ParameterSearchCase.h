// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A search in a case directory: what it reads, runs, says and leaves behind.
///
/// parameterSearch/evaluation   the copy of the case in which the applications run
/// parameterSearch/best         that of the best point so far, with its results
/// postProcessing/parameterSearch/0/
///     history.dat              a row for each point; a search that is begun again computes none of them anew
///     best.dat                 the row of the best one, and how many were tried
///     parameterSearch.svg      the objective over the evaluations, or over the variable when there is one
#pragma once

#include "core/CommandLine.h"
#include "studies/ParameterSearch.h"

#include <cstdint>
#include <filesystem>

namespace drystone
{

/// A search that has been read and checked.
struct ParameterSearch
{
    std::filesystem::path caseDirectory;
    ParameterSearchSettings settings;
    Dictionary dictionary;     ///< system/parameterSearchDict, for the places of messages
    std::vector<double> start; ///< of the variables
    std::uint64_t caseFingerprint = 0;
    std::vector<std::string> options; ///< for the applications
};

/// Reads system/parameterSearchDict and looks up the entries that it names.
/// \throws FatalIOError for what is wrong with it, or with a dictionary that has an entry to be varied
ParameterSearch readParameterSearch(const std::filesystem::path& caseDirectory,
                                    const CommandLine& commandLine);

/// One point that was computed.
struct SearchRecord
{
    std::vector<double> variables;
    std::vector<double> results; ///< as the tables have them: nan where there is none
    int exitStatus = 0;          ///< of the application that failed; 0: none did
    double cpuTime = 0;          ///< [s]
};

/// The points that are known, on the disk after each of them.
class SearchHistory
{
public:
    /// Reads what an earlier search of the case has left; nothing is written yet.
    /// \throws FatalError when it is a history of other variables, results, applications or files than now
    explicit SearchHistory(const ParameterSearch& search);

    const SearchRecord* find(const std::vector<double>& variables) const;
    void add(SearchRecord record);
    const std::vector<SearchRecord>& records() const { return records_; }

private:
    const ParameterSearch& search_;
    std::filesystem::path file_;
    std::vector<SearchRecord> records_;
    std::map<std::vector<double>, std::size_t> places_;
};

/// Before the first evaluation: variables, results, objective, constraints, algorithms.
void printSearch(const ParameterSearch& search, const SearchHistory& history);

/// Runs the search, prints a line for each evaluation and writes the history.
/// \throws FatalError or FatalIOError when a point cannot be evaluated
SearchOutcome carryOut(const ParameterSearch& search, SearchHistory& history);

/// The best point, and how sure it is.
void printOutcome(const ParameterSearch& search, const SearchHistory& history, const SearchOutcome& outcome);

/// best.dat and parameterSearch.svg.
void writeOutcome(const ParameterSearch& search, const SearchHistory& history, const SearchOutcome& outcome);

/// 0; 2 when the last local algorithm did not reach its tolerance, or no point meets the constraints; 128 +
/// signal (130 for Ctrl-C) when interrupted.
int exitStatus(const SearchOutcome& outcome);

} // namespace drystone
