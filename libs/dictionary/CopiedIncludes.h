// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Dictionaries in copies of a case, which include and name the same files as those of the case.
#pragma once

#include <filesystem>
#include <string>

namespace drystone
{

/// The text of a file of a case as it has to be elsewhere, in a copy of the case: the names of included files
/// that lead out of the case, `#include "../../shared/mu"`, become absolute, and those of entries `file`, as
/// `file "../shared/tower.obj";`. A text that is no dictionary stays as it is. \param file that the text is
/// of \param caseDirectory of the case
std::string withFilesFromOutside(const std::string& text, const std::filesystem::path& file,
                                 const std::filesystem::path& caseDirectory);

} // namespace drystone
