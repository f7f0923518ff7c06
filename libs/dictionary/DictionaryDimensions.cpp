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

/// The longest name of a unit that the text begins with. \param unit all of the text, for the message
const BaseUnit& unitAt(std::string_view text, std::string_view unit)
{
    const BaseUnit* longest = nullptr;
    for (const BaseUnit& base : baseUnits)
    {
        if (text.starts_with(base.name) && (!longest || base.name.size() > longest->name.size()))
        {
            longest = &base;
        }
    }
    if (!longest)
    {
        throw std::invalid_argument(fmt::format("the unit {} is not known", unit));
    }
    return *longest;
}

/// Takes the number that the text begins with, as s2 or s^-2 have one; 1 where there is none. \param unit all
/// of the text, for the message
double takeExponent(std::string_view& text, std::string_view unit)
{
    const std::size_t hat = text.starts_with('^') ? 1 : 0;
    double exponent = 1;
    const auto [end, error] =
        std::from_chars(text.data() + hat, text.data() + text.size(), exponent, std::chars_format::fixed);
    if (error == std::errc())
    {
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        return exponent;
    }
    if (hat > 0)
    {
        throw std::invalid_argument(fmt::format("the unit {} has no number after ^", unit));
    }
    return 1;
}

/// The exponents in brackets, which have been opened. \param before the brackets, for messages
Dimensions exponentsOf(TokenCursor& cursor, const TokenCursor& before)
{
    Dimensions given{};
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
    return given;
}

/// The same, of units in brackets, as [kg m^-3].
Dimensions unitsOf(TokenCursor& cursor, const TokenCursor& before)
{
    std::string text;
    while (!cursor.isNext(']'))
    {
        text += std::string(cursor.take().text) + " ";
    }
    try
    {
        return dimensionsOf(text);
    }
    catch (const std::invalid_argument& error)
    {
        before.fail(fmt::format("In this dimension set {}.", error.what()));
    }
}

} // namespace

Dimensions dimensionsOf(std::string_view unit)
{
    // Names one after the other, Nm, are multiplied; a number after a name, s2 or s^-2, is its exponent;
    // whatever follows `/` divides.
    Dimensions result{};
    double sign = 1;
    if (unit == "-")
    {
        return result;
    }
    for (std::string_view rest = unit; !rest.empty();)
    {
        const char c = rest.front();
        if (c == '/' || c == ' ' || c == '*' || c == '.')
        {
            sign = c == '/' ? -1 : sign;
            rest.remove_prefix(1);
            continue;
        }
        const BaseUnit& base = unitAt(rest, unit);
        rest.remove_prefix(base.name.size());
        const double exponent = takeExponent(rest, unit);
        for (std::size_t k = 0; k < result.size(); ++k)
        {
            result[k] += sign * exponent * base.dimensions[k];
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
    const Dimensions wanted = dimensionsOf(unit);
    const bool hasExponents = !cursor.atEnd() && cursor.peek().kind == TokenKind::number;
    const Dimensions given = hasExponents ? exponentsOf(cursor, before) : unitsOf(cursor, before);
    cursor.take();
    if (given != wanted)
    {
        before.fail(fmt::format("{} has the dimensions {}, but {} are those of its unit, {}.",
                                cursor.entry().keyword(), toText(given), toText(wanted), unit));
    }
}

} // namespace drystone
