// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the parts of the reader of dictionaries share while they read one: its texts, the dictionaries and
/// files that are open, and the counts that end a dictionary that doubles itself.
#pragma once

#include "dictionary/Dictionary.h"
#include "dictionary/EntryPath.h"
#include "dictionary/SourceText.h"

#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <string_view>
#include <vector>

namespace drystone
{

struct DictionaryReading
{
    std::shared_ptr<SourceText> source = std::make_shared<SourceText>(); ///< owns what tokens point into
    std::vector<Dictionary*> scopes;              ///< open dictionaries, the innermost last
    std::vector<std::filesystem::path> openFiles; ///< each included by the one before it
    std::filesystem::path caseDirectory = ".";
    std::size_t filesRead = 0;
    std::size_t expandedTokens = 0; ///< added by macros and includes
};

/// Where a token stands, in the dictionary that is open.
inline SourceLocation locationOf(const DictionaryReading& reading, const Token& token)
{
    const std::string name(token.text);
    return {token.file->name, joined(reading.scopes.back()->location().entry, name), token.line};
}

/// \throws FatalIOError: a directive stands without what it needs
[[noreturn]] inline void failArgument(const DictionaryReading& reading, const Token& directive,
                                      std::string_view expected)
{
    throw FatalIOError(fmt::format("{} is to be followed by {}.", directive.text, expected),
                       locationOf(reading, directive));
}

} // namespace drystone
