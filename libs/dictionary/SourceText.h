// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The text that dictionaries are read from, and its tokens.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

namespace drystone
{

/// A file that was read.
struct SourceFile
{
    std::string name; ///< as the user would name it
    std::string text;
};

/// All text that the tokens of a dictionary may view: files, and results of arithmetic. Nothing is ever
/// moved.
struct SourceText
{
    std::deque<SourceFile> files;
};

enum class TokenKind : std::uint8_t
{
    word,
    number,      ///< digits, sign, point, exponent: not yet converted
    string,      ///< "...", the text being what is between the quotes, not yet unescaped
    verbatim,    ///< #{ ... #}, the text being what is between
    punctuation, ///< one of ( ) [ ] { } ; and lone : , = + - * /
    macro,       ///< $name or ${name}, with the $
    directive,   ///< #name, with the #
    bytes        ///< the numbers of a binary list, 8 bytes each, as they are in memory
};

/// The smallest piece of a dictionary that means something. Views its source text.
struct Token
{
    std::string_view text;
    const SourceFile* file = nullptr;
    std::int32_t line = 0;
    TokenKind kind = TokenKind::word;

    bool is(char punctuation) const { return kind == TokenKind::punctuation && text.front() == punctuation; }
};

} // namespace drystone
