// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Text of words and lines: broken into lines for terminals, what -help prints of an application and of its
/// dictionaries, and parted at blanks.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// Longest line of -help, in characters.
constexpr int widthOfHelp = 80;

/// `text` broken at blanks into lines of at most `width` characters, each ended by a newline; lines that
/// `text` has are kept. A word longer than a line has a line of its own. \return "" for an empty text
std::string paragraph(std::string_view text, int width);

/// A term and what there is to say of it: the description begins in column `indentation` and all its lines
/// do. A term that reaches that far has a line of its own. \param width of the whole, in characters
std::string hangingParagraph(std::string_view term, std::string_view description, int indentation, int width);

/// What stands between blanks, tabs and newlines.
std::vector<std::string> wordsOf(const std::string& text);

} // namespace drystone
