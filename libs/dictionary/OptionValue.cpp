// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Names and texts of the values that declared keys can have.
#include "dictionary/OptionValue.h"

#include "dictionary/DictionaryPattern.h"

#include <fmt/format.h>

namespace drystone
{

void read(TokenCursor& cursor, NamePattern& value)
{
    const TokenCursor before = cursor;
    const bool isPattern = !cursor.atEnd() && cursor.peek().kind == TokenKind::string;
    read(cursor, value.text);
    if (isPattern)
    {
        value.matches = patternMatcher(value.text, before.entry().locationOf(before.peek()));
    }
    else
    {
        value.matches = [name = value.text](const std::string& word) { return word == name; };
    }
}

namespace detail
{

void assignName(std::string& name, const Entry& entry)
{
    if (entry.isPattern())
    {
        throw FatalIOError(
            fmt::format("\"{}\" is a name between quotes, which stands for a regular expression; a plain "
                        "name is wanted here.",
                        entry.keyword()),
            entry.location());
    }
    name = entry.keyword();
}

void assignName(NamePattern& name, const Entry& entry)
{
    name.text = entry.keyword();
    if (entry.isPattern())
    {
        name.matches = patternMatcher(name.text, entry.location());
    }
    else
    {
        name.matches = [plain = name.text](const std::string& word) { return word == plain; };
    }
}

std::string textOf(double value)
{
    return fmt::format("{}", value);
}

std::string textOf(int value)
{
    return std::to_string(value);
}

std::string textOf(long value)
{
    return std::to_string(value);
}

std::string textOf(bool value)
{
    return value ? "on" : "off";
}

std::string textOf(const std::string& value)
{
    // OpenFOAM does not take a dot first for a word.
    const bool isWord = !value.empty() && value.front() != '.'
                        && value.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                   "0123456789_.:")
                               == std::string::npos;
    return isWord ? value : fmt::format("\"{}\"", value);
}

} // namespace detail

} // namespace drystone
