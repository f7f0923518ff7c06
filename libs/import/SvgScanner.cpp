// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Takes the longest number from the front of the text: a second point or sign begins the next one.
#include "import/SvgScanner.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

bool SvgScanner::isEnd()
{
    skip();
    return rest.empty();
}

bool SvgScanner::isNumber()
{
    skip();
    return !rest.empty() && std::string_view("+-.0123456789").find(rest.front()) != std::string_view::npos;
}

char SvgScanner::letter()
{
    skip();
    const char c = rest.empty() ? '\0' : rest.front();
    rest.remove_prefix(rest.empty() ? 0 : 1);
    return c;
}

double SvgScanner::number(DigitCount* digits)
{
    skip();
    std::size_t end = 0;
    const auto digitsFrom = [&]
    {
        while (end < rest.size() && rest[end] >= '0' && rest[end] <= '9')
        {
            ++end;
        }
    };
    end += !rest.empty() && (rest[0] == '+' || rest[0] == '-') ? 1 : 0;
    digitsFrom();
    if (end < rest.size() && rest[end] == '.')
    {
        ++end;
        digitsFrom();
    }
    if (end + 1 < rest.size() && (rest[end] == 'e' || rest[end] == 'E')
        && std::string_view("+-0123456789").find(rest[end + 1]) != std::string_view::npos)
    {
        end += 2;
        digitsFrom();
    }
    const std::string_view word = rest.substr(0, end);
    if (word.empty())
    {
        refuse(file, line,
               rest.empty() ? "A number is expected at the end: a coordinate is missing."
                            : fmt::format("A number is expected at `{}`.", shown(rest)));
    }
    const double value = numberOf(file, line, word);
    if (digits != nullptr)
    {
        digits->add(word);
    }
    rest.remove_prefix(end);
    return value;
}

std::string_view SvgScanner::word()
{
    skip();
    const std::size_t end = rest.find_first_of("( \t\r\n");
    const std::string_view found = rest.substr(0, end);
    rest.remove_prefix(found.size());
    return found;
}

void SvgScanner::fail(const std::string& fault) const
{
    refuse(file, line, fault);
}

void SvgScanner::skip()
{
    const std::size_t first = rest.find_first_not_of(" \t\r\n,");
    rest.remove_prefix(std::min(first, rest.size()));
}

} // namespace drystone
