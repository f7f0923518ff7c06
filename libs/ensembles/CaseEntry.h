// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// An entry of a dictionary of a case that a search or an ensemble gives other values: `file` and `entry`.
#pragma once

#include "dictionary/Options.h"

#include <filesystem>
#include <set>
#include <string>

namespace drystone
{

struct CaseEntry
{
    std::string file;  ///< in the case directory
    std::string entry; ///< keywords with slashes between
};
void declare(Options& options, CaseEntry& entry);

/// The entry as the case has it.
/// \param own dictionary with the keys `file` and `entry`, for the location in messages
/// \throws FatalIOError when there is no such file, or no such entry in it
Entry lookUp(const std::filesystem::path& caseDirectory, const CaseEntry& entry, const Dictionary& own);

/// Gives the entry another value in a copy of the case. \throws FatalIOError when the text is no value
void setEntry(const std::filesystem::path& caseDirectory, const CaseEntry& entry, const std::string& value);

/// What is wrong with a name that is to be used in arithmetic; empty when nothing is: letters, digits and _,
/// a letter first, without a meaning of its own.
std::string faultOfName(const std::string& name);

/// What is wrong with a name, or with its being among others that it must differ from; empty: nothing.
/// \param names of variables and results so far; gets this one
std::string faultOfNextName(const std::string& name, std::set<std::string>& names);

/// What is wrong with an entry that is one of several to be set; empty: nothing.
/// \param places of those so far; gets this one
std::string faultOfNextEntry(const CaseEntry& entry, std::set<std::string>& places);

} // namespace drystone
