// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Files of a case that nothing reads although they look as if they should be read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drystone
{

/// Names of what is in a folder, sorted, so that the same one is reported each time; none where it cannot be
/// read.
std::vector<std::string> namesIn(const std::filesystem::path& folder);

/// The case directory as an absolute path without `.` and a closing `/`.
std::filesystem::path fullName(const std::filesystem::path& caseDirectory);

/// Name of the case for titles: that of its folder, whichever way the directory was given (`.`, `wall/`).
std::string caseName(const std::filesystem::path& caseDirectory);

/// What applications read from a folder of a case.
struct CaseFolder
{
    std::string name; ///< 0, constant, system
    std::vector<std::string> files;
    /// What OpenFOAM calls something alike, and what is read instead.
    std::vector<std::pair<std::string, std::string>> namesElsewhere;
};
const std::vector<CaseFolder>& caseFolders();

/// Refuses a file in 0/, constant/ or system/, or next to them, that is not read and whose name is
/// - that of a file which is read, in other capitals, in another folder, or with the ending .txt;
/// - what OpenFOAM calls such a file: fvSchemes, fvSolution, ...;
/// - a misspelling of one that is absent: constant/groundMotoin.
/// An optional file would not be missed, and the earthquake would not happen. All else is left alone: names
/// with an ending, hidden ones, copies for safety (`loads~`, `loads.orig`), variants of a file that is there
/// (`groundMotion2`), folders of records. \throws FatalIOError naming the file, what it may have been meant
/// as and how to keep it
void refuseMisnamedFiles(const std::filesystem::path& caseDirectory);

} // namespace drystone
