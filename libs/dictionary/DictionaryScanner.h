// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The characters of dictionaries: how much of the text ahead is a word, a number, a macro. The rules of the
/// grammar call these.
#pragma once

#include <cstddef>
#include <string>

namespace drystone
{

/// A word may be this long; whatever is longer is not a dictionary.
inline constexpr std::size_t longestWord = 4096;

/// A text whose lines end with CR alone, as those of an old Macintosh, with LF in its place: a comment would
/// go on to the end of the file. Others as they are.
std::string withLineFeeds(std::string text);

bool isSpace(char c);
bool isDigit(char c);

/// Inside a word; brackets are dealt with apart.
bool isWordCharacter(char c);
bool startsWord(char c);

/// Lengths of what starts at `begin`; 0 when it is none.

/// Of the characters of a word. Brackets belong to it when they close inside it: `div(phi,U)` is one word,
/// `a(1 2)` is a word and a list.
std::size_t wordLength(const char* begin, const char* end);

/// Of a word. A lone minus is punctuation.
std::size_t startedWord(const char* begin, const char* end);

/// Of a number; none that goes on as a word: 2D, 0.orig, 1.2.3.
std::size_t numberLength(const char* begin, const char* end);

/// Of `$name`, `${...}`.
std::size_t markedMacro(const char* begin, const char* end);

/// Of `#name`.
std::size_t markedDirective(const char* begin, const char* end);

/// Of what is before the `}` that closes a `{` already taken, and the `}`, other braces inside it being in
/// pairs.
std::size_t bracedText(const char* begin, const char* end);

/// Of what is before the `"` that closes a string, and the `"`; a line ends a string only after a backslash.
std::size_t quotedText(const char* begin, const char* end);

} // namespace drystone
