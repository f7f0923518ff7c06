// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The case directory: what makes a directory a case, and the times in it.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace drystone
{

/// Where looking at a case directory, or into it, has failed for another reason than that nothing is there.
/// \throws FatalError that names the directory and the reason
void refuseUnreadable(const std::filesystem::path& caseDirectory, std::error_code failure);

/// \throws FatalError, saying what a case is made of, unless the directory has a system/ or a constant/; or
/// why that cannot be seen
void requireCase(const std::filesystem::path& caseDirectory);

/// A file of a case that an application cannot do without.
/// \param repair how the user comes by it, a sentence: `Run blockTexture first.`
/// \return the path of the file
/// \throws FatalIOError when there is no such file, or it cannot be read
std::filesystem::path requireCaseFile(const std::filesystem::path& caseDirectory,
                                      const std::filesystem::path& file, const std::string& repair);

/// A folder of a case whose name is a time.
struct TimeDirectory
{
    double time = 0; ///< [s]
    std::string name;
};

/// All time directories of a case in ascending order; empty when the case has none or does not exist.
std::vector<TimeDirectory> timeDirectories(const std::filesystem::path& caseDirectory);

} // namespace drystone
