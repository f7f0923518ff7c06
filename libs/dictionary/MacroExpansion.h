// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Values in place of macros and of arithmetic: `$name`, `${name:-value}`, `#calc "2*$length"`.
#pragma once

#include "dictionary/DictionaryReading.h"

#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// The name in `$name` or `${name}`, with macros inside the braces replaced. \param depth of `${${...}}`
std::string nameOf(const DictionaryReading& reading, std::string_view text, const SourceLocation& location,
                   int depth = 0);

/// A text in which every `$name` and `${name}` is replaced by the value of its entry.
/// \throws FatalIOError for one that has none
std::string substituted(const DictionaryReading& reading, std::string_view text,
                        const SourceLocation& location, int depth = 0);

/// Appends the tokens that a macro stands for. \param bracket the innermost one that is open around the
/// macro,
/// `;` when there is none \throws FatalIOError
void expandMacro(DictionaryReading& reading, const Token& macro, std::vector<Token>& into,
                 char bracket = ';');

/// Appends the result of #calc. \param argument the expression \throws FatalIOError
void appendResult(DictionaryReading& reading, const Token& directive, const Token& argument,
                  std::vector<Token>& into);

/// Counts tokens that were added. \throws FatalIOError beyond ten million: entries which double each other
/// would fill any memory
void countExpanded(DictionaryReading& reading, std::size_t count, const SourceLocation& location);

} // namespace drystone
