// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Regular expressions by the standard library, kept small because it recurses on their size.
#include "dictionary/DictionaryPattern.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <memory>
#include <regex>

namespace drystone
{

namespace
{

constexpr std::size_t longestPattern = 1000;
/// Copies that {n,m} may make, all repetitions of a pattern multiplied.
constexpr long mostRepetitions = 1000;
/// No keyword or name is longer than this, and matching takes time and stack with the length.
constexpr std::size_t longestMatched = 500;

long repetitions(const std::string& pattern)
{
    long product = 1;
    for (std::size_t i = 0; i < pattern.size(); ++i)
    {
        if (pattern[i] == '\\')
        {
            ++i;
            continue;
        }
        if (pattern[i] != '{')
        {
            continue;
        }
        long largest = 1;
        long number = 0;
        for (++i; i < pattern.size() && pattern[i] != '}'; ++i)
        {
            number = std::isdigit(static_cast<unsigned char>(pattern[i])) != 0
                         ? number * 10 + (pattern[i] - '0')
                         : 0;
            largest = std::max(largest, number);
            if (largest > mostRepetitions)
            {
                return largest;
            }
        }
        product *= largest;
        if (product > mostRepetitions)
        {
            return product;
        }
    }
    return product;
}

} // namespace

std::function<bool(const std::string&)> patternMatcher(const std::string& pattern,
                                                       const SourceLocation& location)
{
    if (pattern.empty())
    {
        throw FatalIOError(
            "There is nothing between the quotes: a name, or a regular expression, is wanted here.",
            location);
    }
    if (pattern.size() > longestPattern || repetitions(pattern) > mostRepetitions)
    {
        throw FatalIOError(
            fmt::format("The regular expression is too large: more than {} characters, or more than "
                        "{} repetitions by {{n,m}}. Write a shorter one.",
                        longestPattern, mostRepetitions),
            location);
    }
    try
    {
        // __polynomial is how libstdc++ calls breadth-first matching: no pattern can make it slow.
        auto flags = std::regex::extended | std::regex::nosubs | std::regex_constants::__polynomial;
        // (?i) in front: capital and small letters are the same.
        const bool ignoresCase = pattern.starts_with("(?i)");
        if (ignoresCase)
        {
            flags |= std::regex::icase;
        }
        const auto expression =
            std::make_shared<const std::regex>(pattern.substr(ignoresCase ? 4 : 0), flags);
        return [expression](const std::string& word)
        { return word.size() <= longestMatched && std::regex_match(word, *expression); };
    }
    catch (const std::regex_error& error)
    {
        throw FatalIOError(
            fmt::format("\"{}\" is not a regular expression: {}. A keyword between quotes is one; "
                        "without quotes it is a plain name.",
                        pattern, error.what()),
            location);
    }
}

std::string alternativeWithoutName(const std::string& pattern, const std::vector<std::string>& names)
{
    const auto isOfNames = [](unsigned char c)
    { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '|'; };
    if (pattern.size() > 2 && pattern.front() == '(' && pattern.back() == ')')
    {
        return alternativeWithoutName(pattern.substr(1, pattern.size() - 2), names);
    }
    if (pattern.find('|') == std::string::npos || !std::all_of(pattern.begin(), pattern.end(), isOfNames))
    {
        return {};
    }
    for (std::size_t begin = 0; begin <= pattern.size();)
    {
        const std::size_t end = std::min(pattern.find('|', begin), pattern.size());
        const std::string name = pattern.substr(begin, end - begin);
        if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
        {
            return name;
        }
        begin = end + 1;
    }
    return {};
}

} // namespace drystone
