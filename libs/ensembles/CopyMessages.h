// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What applications say in copies of a case, as messages about the case: studies alone know that it is a
/// copy.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace drystone
{

/// The last lines of what an application wrote on standard error, without the folder of the copy and without
/// what frames a message.
std::string faultOfCopy(std::string message, const std::filesystem::path& copy);

/// The warnings among what an application wrote on standard error, without the line that begins each, about
/// files of the case in place of those of the copy.
std::vector<std::string> warningsOfCopy(const std::string& errors, const std::filesystem::path& copy,
                                        const std::filesystem::path& caseDirectory);

/// Warnings of many runs in copies, printed as ones of this program: each once, whatever its numbers, and
/// none that this program has printed itself.
class WarningsOfCopies
{
public:
    void print(const std::vector<std::string>& warnings);

private:
    std::set<std::string> printed; ///< without their numbers
};

} // namespace drystone
