// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The files that a dictionary consists of: which one an #include names, and its text.
#pragma once

#include "dictionary/DictionaryReading.h"

#include <filesystem>
#include <optional>

namespace drystone
{

/// The case that a file belongs to: what holds its system/ or constant/, or else its own directory.
std::filesystem::path caseOf(const std::filesystem::path& file);

bool isInclude(const Token& directive);

/// The file that a directive names; nothing when it need not be there and is not. \throws FatalIOError where
/// there is none, or where files include each other in a loop
std::optional<std::filesystem::path> included(const DictionaryReading& reading, const Token& directive,
                                              const Token& argument);

/// Reads a file, or takes its text from memory (FilesInMemory.h). \param whence where it is included; empty:
/// the first file \return owned by `reading` \throws FatalIOError
const SourceFile& load(DictionaryReading& reading, const std::filesystem::path& path,
                       const SourceLocation& whence);

} // namespace drystone
