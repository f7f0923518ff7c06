// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Dimensions of units, and their check where an entry states a dimension set.
#include "dictionary/Dictionary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <stdexcept>

namespace drystone
{
namespace
{

struct BaseUnit
{
    std::string_view name;
    Dimensions dimensions;
};

// Mass, length, time, temperature, amount, current, luminous intensity.
constexpr BaseUnit baseUnits[] = {
    {"kg", {1, 0, 0, 0, 0, 0, 0}},    {"m", {0, 1, 0, 0, 0, 0, 0}},   {"s", {0, 0, 1, 0, 0, 0, 0}},
    {"K", {0, 0, 0, 1, 0, 0, 0}},     {"mol", {0, 0, 0, 0, 1, 0, 0}}, {"A", {0, 0, 0, 0, 0, 1, 0}},
    {"cd", {0, 0, 0, 0, 0, 0, 1}},    {"N", {1, 1, -2, 0, 0, 0, 0}},  {"Pa", {1, -1, -2, 0, 0, 0, 0}},
    {"J", {1, 2, -2, 0, 0, 0, 0}},    {"W", {1, 2, -3, 0, 0, 0, 0}},  {"Hz", {0, 0, -1, 0, 0, 0, 0}},
    {"rad", {0, 0, 0, 0, 0, 0, 0}},   {"deg", {0, 0, 0, 0, 0, 0, 0}}, {"unit", {0, 1, 0, 0, 0, 0, 0}},
    {"units", {0, 1, 0, 0, 0, 0, 0}}, {"-", {0, 0, 0, 0, 0, 0, 0}},   {"1", {0, 0, 0, 0, 0, 0, 0}},
};

} // namespace

Dimensions dimensionsOf(std::string_view unit)
{
    // Names one after the other, Nm, are multiplied; a number after a name, s2 or s^-2, is its exponent;
    // whatever follows `/` divides.
    Dimensions result{};
    double sign = 1;
    std::size_t i = 0;
    if (unit == "-" || unit.empty())
    {
        return result;
    }
    while (i < unit.size())
    {
        const char c = unit[i];
        if (c == '/')
        {
            sign = -1;
            ++i;
            continue;
        }
        if (c == ' ' || c == '*' || c == '.')
        {
            ++i;
            continue;
        }
        const BaseUnit* longest = nullptr;
        for (const BaseUnit& base : baseUnits)
        {
            if (unit.substr(i).starts_with(base.name)
                && (!longest || base.name.size() > longest->name.size()))
            {
                longest = &base;
            }
        }
        if (!longest)
        {
            throw std::invalid_argument(fmt::format("the unit {} is not known", unit));
        }
        i += longest->name.size();
        std::size_t from = i;
        if (from < unit.size() && unit[from] == '^')
        {
            ++from;
        }
        double exponent = 1;
        const auto [end, error] = std::from_chars(unit.data() + from, unit.data() + unit.size(), exponent,
                                                  std::chars_format::fixed);
        if (error == std::errc())
        {
            i = static_cast<std::size_t>(end - unit.data());
        }
        else if (from != i)
        {
            throw std::invalid_argument(fmt::format("the unit {} has no number after ^", unit));
        }
        else
        {
            exponent = 1;
        }
        for (std::size_t k = 0; k < result.size(); ++k)
        {
            result[k] += sign * exponent * longest->dimensions[k];
        }
    }
    return result;
}

std::string toText(const Dimensions& dimensions)
{
    return fmt::format("[{}]", fmt::join(dimensions, " "));
}

void readDimensions(TokenCursor& cursor, std::string_view unit)
{
    if (cursor.remaining() > 1 && cursor.peek().kind == TokenKind::word
        && cursor.peek().text == cursor.entry().keyword())
    {
        TokenCursor afterName = cursor;
        afterName.take();
        if (afterName.isNext('['))
        {
            cursor = afterName;
        }
    }
    if (!cursor.isNext('['))
    {
        return;
    }
    const TokenCursor before = cursor;
    cursor.take();
    Dimensions given{};
    const Dimensions wanted = dimensionsOf(unit);
    if (!cursor.atEnd() && cursor.peek().kind == TokenKind::number)
    {
        std::size_t found = 0;
        while (!cursor.isNext(']'))
        {
            if (found == given.size())
            {
                before.fail("A dimension set has at most seven exponents: of mass, length, time, "
                            "temperature, amount, current and luminous intensity.");
            }
            read(cursor, given[found++]);
        }
        if (found < 5)
        {
            before.fail("A dimension set has seven exponents: of mass, length, time, temperature, amount, "
                        "current and luminous intensity, for example [1 -3 0 0 0 0 0].");
        }
    }
    else
    {
        std::string text;
        while (!cursor.isNext(']'))
        {
            text += std::string(cursor.take().text) + " ";
        }
        try
        {
            given = dimensionsOf(text);
        }
        catch (const std::invalid_argument& error)
        {
            before.fail(fmt::format("In this dimension set {}.", error.what()));
        }
    }
    cursor.take();
    if (given != wanted)
    {
        before.fail(fmt::format("{} has the dimensions {}, but {} are those of its unit, {}.",
                                cursor.entry().keyword(), toText(given), toText(wanted), unit));
    }
}

} // namespace drystone
