// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Loops over the bytes that count brackets as they go; nothing is kept from one call to the next.
#include "dictionary/DictionaryScanner.h"

#include <algorithm>
#include <cstring>

namespace drystone
{
namespace
{

/// Length of `$name`, `${...}`; 0 when it is none.
std::size_t macroLength(const char* begin, const char* end)
{
    const char* limit = begin + std::min<std::size_t>(static_cast<std::size_t>(end - begin), longestWord);
    const char* at = begin + 1;
    if (at != limit && *at == '{')
    {
        int depth = 0;
        for (; at != limit && *at != '\n'; ++at)
        {
            if (*at == '{')
            {
                ++depth;
            }
            else if (*at == '}' && --depth == 0)
            {
                return static_cast<std::size_t>(at + 1 - begin);
            }
        }
        return 0;
    }
    int depth = 0;
    for (; at != limit; ++at)
    {
        if (*at == '/')
        {
            if (at + 1 == limit || at[1] == '/' || at[1] == '*')
            {
                break;
            }
        }
        else if (*at == '(' || *at == '[')
        {
            ++depth;
        }
        else if (*at == ')' || *at == ']')
        {
            if (depth-- == 0)
            {
                break;
            }
        }
        else if (!isWordCharacter(*at) || *at == '$' || (*at == ',' && depth == 0))
        {
            break;
        }
    }
    return at == begin + 1 ? 0 : static_cast<std::size_t>(at - begin);
}

} // namespace

std::string withLineFeeds(std::string text)
{
    const auto isBinary = [](char c)
    {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x20 && !isSpace(c);
    };
    const bool isOld = text.find('\n') == std::string::npos && text.find('\r') != std::string::npos;
    if (isOld && std::none_of(text.begin(), text.end(), isBinary))
    {
        std::replace(text.begin(), text.end(), '\r', '\n');
    }
    return text;
}

bool isSpace(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

std::size_t wordLength(const char* begin, const char* end)
{
    const char* limit = begin + std::min<std::size_t>(static_cast<std::size_t>(end - begin), longestWord + 1);
    const char* firstOpen = nullptr;
    int depth = 0;
    const char* at = begin;
    for (; at != limit && isWordCharacter(*at); ++at)
    {
        if (*at == '(' || *at == '[')
        {
            if (depth++ == 0)
            {
                firstOpen = at;
            }
        }
        else if (*at == ')' || *at == ']')
        {
            if (depth == 0)
            {
                break;
            }
            --depth;
        }
    }
    return static_cast<std::size_t>((depth > 0 ? firstOpen : at) - begin);
}

bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

bool isWordCharacter(char c)
{
    return !isSpace(c) && c != '"' && c != '\'' && c != '/' && c != ';' && c != '{' && c != '}';
}

bool startsWord(char c)
{
    return isWordCharacter(c) && !std::strchr("()[]:,=+*$#", c);
}

std::size_t numberLength(const char* begin, const char* end)
{
    const char* at = begin;
    const auto digits = [&at, end]
    {
        const char* first = at;
        while (at != end && isDigit(*at))
        {
            ++at;
        }
        return at != first;
    };
    if (at != end && (*at == '+' || *at == '-'))
    {
        ++at;
    }
    bool any = digits();
    if (at != end && *at == '.')
    {
        ++at;
        any = digits() || any;
    }
    if (!any)
    {
        return 0;
    }
    if (at != end && (*at == 'e' || *at == 'E'))
    {
        const char* mantissa = at++;
        if (at != end && (*at == '+' || *at == '-'))
        {
            ++at;
        }
        if (!digits())
        {
            at = mantissa;
        }
    }
    if (at != end && startsWord(*at) && (*at < '<' || *at > '>'))
    {
        return 0;
    }
    return static_cast<std::size_t>(at - begin);
}

std::size_t startedWord(const char* begin, const char* end)
{
    if (!startsWord(*begin))
    {
        return 0;
    }
    // A lone minus is punctuation.
    const std::size_t length = wordLength(begin, end);
    return length == 1 && *begin == '-' ? 0 : length;
}

std::size_t markedMacro(const char* begin, const char* end)
{
    return *begin == '$' ? macroLength(begin, end) : 0;
}

std::size_t markedDirective(const char* begin, const char* end)
{
    const char* at = begin + 1;
    while (at != end && ((*at >= 'a' && *at <= 'z') || (*at >= 'A' && *at <= 'Z') || isDigit(*at)))
    {
        ++at;
    }
    return *begin == '#' && at > begin + 1 ? static_cast<std::size_t>(at - begin) : 0;
}

std::size_t bracedText(const char* begin, const char* end)
{
    int depth = 0;
    for (const char* at = begin; at != end; ++at)
    {
        if (*at == '{')
        {
            ++depth;
        }
        else if (*at == '}' && depth-- == 0)
        {
            return static_cast<std::size_t>(at + 1 - begin);
        }
    }
    return 0;
}

std::size_t quotedText(const char* begin, const char* end)
{
    for (const char* at = begin; at != end && *at != '\n'; ++at)
    {
        if (*at == '"')
        {
            return static_cast<std::size_t>(at + 1 - begin);
        }
        if (*at == '\\' && at + 1 != end)
        {
            ++at;
        }
    }
    return 0;
}

} // namespace drystone
