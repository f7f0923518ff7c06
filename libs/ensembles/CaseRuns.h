// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Copies of a case, applications run in them, and numbers read from their tables: common to all studies that
/// repeat whole cases.
#pragma once

#include "ensembles/CaseEntry.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drystone
{

/// Copies the input of a case: all but results (VTK, postProcessing, logs, times other than 0) and the files
/// of a search (parameterSearch). An existing `target` is removed first. \throws FatalError
void copyCase(const std::filesystem::path& caseDirectory, const std::filesystem::path& target);

/// The files that copyCase copies, sorted.
std::vector<std::filesystem::path> filesOfCase(const std::filesystem::path& caseDirectory);

/// The result of an application.
struct ApplicationRun
{
    int status = 0;             ///< exit status; 128 + signal when a signal has ended it
    bool isInterrupted = false; ///< this process was requested to stop while it ran
    std::string errorOutput;    ///< on standard error
};

/// Whether what a study runs is a program of the user's own, in the case: `./prepare`.
bool isScript(const std::string& application);

/// Why a script that is to run in the case cannot; empty: it can, or is no script but an application.
std::string faultOfScript(const std::filesystem::path& caseDirectory, const std::string& application);

/// Runs an application of Drystone, from the folder of the running executable, in a case; its output goes to
/// log.<application> there. A name with a slash is a script in the case, which is run there without options.
/// The application ends when this process does. A signal that requests this program to stop is passed on.
/// \throws FatalError when there is no such application
ApplicationRun runInCase(const std::string& application, const std::filesystem::path& caseDirectory,
                         const std::vector<std::string>& options);

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
    std::string directory; ///< of `cases`
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
/// \throws FatalError with the message of the application, where no set of entries lets it begin
void requireReadableCase(const std::filesystem::path& caseDirectory, const std::filesystem::path& target,
                         const std::vector<std::vector<OtherEntry>>& sets,
                         const CaseApplications& applications);

} // namespace drystone
