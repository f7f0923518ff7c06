// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Parses a name and a value as the grammar would read them in a file, each by itself.
#include "dictionary/GivenEntry.h"

#include "dictionary/Dictionary.h"
#include "dictionary/DictionaryGrammar.h"

#include <fmt/format.h>

#include <utility>

namespace drystone
{

std::string withoutQuotes(std::string_view path)
{
    std::string plain(path);
    std::erase(plain, '"');
    return plain;
}

std::vector<std::string> givenNames(std::string_view path)
{
    std::vector<std::string> names;
    std::string name;
    bool isQuoted = false;
    for (const char c : path)
    {
        isQuoted = isQuoted != (c == '"');
        if (c != '/' || isQuoted)
        {
            name += c;
        }
        else if (!name.empty())
        {
            names.push_back(std::exchange(name, ""));
        }
    }
    if (!name.empty())
    {
        names.push_back(name);
    }
    return names;
}

std::vector<std::string> keywordsOf(std::string_view path)
{
    std::vector<std::string> keywords = givenNames(path);
    for (std::string& keyword : keywords)
    {
        keyword = withoutQuotes(keyword);
    }
    return keywords;
}

namespace
{

/// Whether a value, by itself in order, ends in a comment `// ...` that takes the rest of its line with it.
bool hidesWhatFollows(const std::string& value)
{
    const SourceFile line{"the value given", fmt::format("key {}; next 1;", value)};
    try
    {
        const std::vector<Statement> statements = parseStatements(line);
        return statements.empty() || statements.back().keyword.text != "next";
    }
    catch (const FatalIOError&)
    {
        return true;
    }
}

} // namespace

std::string checkedValue(std::string_view value, std::string_view path)
{
    std::string text(value);
    text.erase(0, text.find_first_not_of(" \t\n"));
    text.erase(text.find_last_not_of(" \t\n") + 1);
    const bool isDictionary = text.starts_with('{');
    const SourceFile entry{"the value given", fmt::format("key {}{}", text, isDictionary ? "\n" : "\n;")};
    const std::vector<Statement> statements = parseStatements(entry);
    if (statements.size() != 1 || !isKeyed(statements.front()))
    {
        throw FatalIOError(
            fmt::format("`{}` is not one value for {}. Write a value without `;`, or `{{ ... }}`.", text,
                        path),
            SourceLocation{entry.name, "", 1});
    }
    if (hidesWhatFollows(text))
    {
        throw FatalIOError(
            fmt::format(
                "`{}` ends in a comment, or is one, which would hide what follows the value in its line. "
                "Give the value alone, or the comment as /* ... */.",
                text),
            SourceLocation{entry.name, "", 1});
    }
    return text;
}

std::string checkedName(const std::string& name)
{
    const auto isOne = [&name]
    {
        try
        {
            const Dictionary dictionary =
                Dictionary::readString(fmt::format("{} 1;", name), "the name given");
            return dictionary.entries().size() == 1
                   && dictionary.entries().front().keyword() == withoutQuotes(name);
        }
        catch (const FatalError&)
        {
            return false;
        }
    };
    if (!isOne())
    {
        throw FatalIOError(
            fmt::format("`{}` is not the name of an entry. Give one word, or a pattern in quotes.", name),
            SourceLocation{"the name given", "", 1});
    }
    return name;
}

bool isDictionaryText(const std::string& value)
{
    return value.starts_with('{');
}

} // namespace drystone
