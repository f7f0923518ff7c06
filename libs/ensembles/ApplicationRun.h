// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// An application, or a script of the user's, run in a case by a study as a process of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// The result of an application.
struct ApplicationRun
{
    int status = 0;             ///< exit status; 128 + signal when a signal has ended it
    bool isInterrupted = false; ///< this process was requested to stop while it ran
    std::string errorOutput;    ///< the last lines on standard error
    std::string firstErrors;    ///< what it wrote there before, from the beginning: its warnings
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

} // namespace drystone
