// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The points of a search that are known: what they depend on, and their rows in
/// postProcessing/parameterSearch/0/history.dat.
#pragma once

#include "ensembles/SearchPoint.h"

#include <filesystem>
#include <map>
#include <vector>

namespace drystone
{

/// postProcessing/parameterSearch/0/ of a case.
std::filesystem::path searchFolder(const std::filesystem::path& caseDirectory);

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

} // namespace drystone
