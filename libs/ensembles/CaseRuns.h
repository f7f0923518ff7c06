// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Applications run in copies of a case with other values: common to all studies that repeat whole cases.
#pragma once

#include "ensembles/ApplicationRun.h"
#include "ensembles/CaseEntry.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace drystone
{

/// An entry of a case with another value, as its text.
using OtherEntry = std::pair<CaseEntry, std::string>;

/// What is run in a copy of a case.
struct CaseApplications
{
    std::vector<std::string> applications; ///< in this order, up to the first that fails
    std::vector<std::string> cases{"."};   ///< in each of which all of them are run, in the copy
    std::vector<std::string> options;
};

/// The application with which a copy has ended: the one that failed, or the last.
struct CaseRun : ApplicationRun
{
    std::string application;
    std::string directory;             ///< of `cases`
    std::vector<std::string> warnings; ///< of all applications, about the case in place of its copy
};

/// Copies a case to `target` with other values of some entries, and runs applications there, until one fails
/// or this process is requested to stop. \throws as copyCase, setEntry and runInCase; FatalError where one
/// fails and the disk is full
CaseRun runCopy(const std::filesystem::path& caseDirectory, const std::filesystem::path& target,
                const std::vector<OtherEntry>& entries, const CaseApplications& applications);

/// Whether the applications can begin, tried in a copy of a case that is removed again: blocks are made and
/// checked, and what computes reads its input and checks it (-dry-run). Scripts are not run, nor what comes
/// after one. \throws as runCopy
CaseRun tryCopy(const std::filesystem::path& caseDirectory, const std::filesystem::path& target,
                const std::vector<OtherEntry>& entries, const CaseApplications& applications);

/// Tries a case as tryCopy does, with one set of entries after the other until one can begin, and says why
/// where none can. Says in the log where no copy can be written.
/// \return what it warns of \throws FatalError with the message of the application, where no set of entries
/// lets it begin
std::vector<std::string> requireReadableCase(const std::filesystem::path& caseDirectory,
                                             const std::filesystem::path& target,
                                             const std::vector<std::vector<OtherEntry>>& sets,
                                             const CaseApplications& applications);

} // namespace drystone
