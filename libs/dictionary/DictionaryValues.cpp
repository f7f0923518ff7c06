// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of values from the tokens of an entry.
#include "dictionary/Dictionary.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <limits>

namespace drystone
{

namespace
{

/// Values that N{value} may stand for; the memory for more is not there.
constexpr long largestUniformList = 100'000'000;

std::string shown(const Token& token)
{
    const std::string text(token.text.substr(0, 60));
    switch (token.kind)
    {
    case TokenKind::string:
        return fmt::format("\"{}\"", text);
    case TokenKind::verbatim:
        return fmt::format("#{{{}#}}", text);
    case TokenKind::bytes:
        return "a list of bytes";
    default:
        return fmt::format("`{}`", text);
    }
}

/// What a string's author meant: \" is a quote, a backslash before a line's end joins lines, others stay.
std::string unescaped(std::string_view text)
{
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        if (text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == '"' || text[i + 1] == '\n'))
        {
            ++i;
        }
        result += text[i];
    }
    return result;
}

bool isNotFinite(std::string_view text)
{
    std::string lower;
    for (const char c : text)
    {
        lower += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    }
    if (!lower.empty() && (lower.front() == '-' || lower.front() == '+'))
    {
        lower.erase(0, 1);
    }
    return lower == "nan" || lower == "inf" || lower == "infinity";
}

/// Whether a word is the name of a unit, alone or behind a number: kN, 0.6kN.
bool isUnit(std::string_view text)
{
    const std::size_t begin = text.find_first_not_of("+-.0123456789");
    static constexpr std::array units{"N",  "kN", "MN", "Pa", "kPa", "MPa", "GPa", "m",   "mm",
                                      "cm", "kg", "t",  "g",  "s",   "ms",  "deg", "rad", "Hz"};
    if (begin == std::string_view::npos)
    {
        return false;
    }
    // A power or a quotient of units begins with one: N/m2, m2.
    const std::string_view unit = text.substr(begin, text.find_first_of("/*^0123456789", begin) - begin);
    return std::find(units.begin(), units.end(), unit) != units.end();
}

/// What somebody who is used to other notations may have meant, or nothing; begins with a blank.
std::string_view hintFor(const Token& token)
{
    if (token.kind == TokenKind::macro || token.kind == TokenKind::directive)
    {
        return " It has not been expanded.";
    }
    if (token.kind != TokenKind::word && token.kind != TokenKind::number
        && token.kind != TokenKind::punctuation)
    {
        return "";
    }
    if (isNotFinite(token.text))
    {
        return " Only finite numbers can be computed with.";
    }
    if (token.text.find(',') != std::string_view::npos)
    {
        return " Numbers are separated by blanks and have a decimal point: 0.6, not 0,6.";
    }
    // Minus, en dash and em dash of Unicode, which look like a sign.
    for (const std::string_view dash : {"\u2212", "\u2013", "\u2014"})
    {
        if (token.text.find(dash) != std::string_view::npos)
        {
            return " Its minus is none of the keyboard's, as in a text that was copied: type `-` instead.";
        }
    }
    if (token.text.starts_with('='))
    {
        return " An entry is `key value;`, without `=`.";
    }
    if (token.text.ends_with('%'))
    {
        return " A share is a part of 1: 65% is 0.65.";
    }
    if (isUnit(token.text))
    {
        return " Values are in SI units (N, m, kg, s, Pa, rad), which are not written: 5 kN is 5000.";
    }
    return "";
}

template<class Integer>
void readInteger(TokenCursor& cursor, Integer& value)
{
    if (cursor.atEnd() || cursor.peek().kind != TokenKind::number)
    {
        cursor.failExpected("an integer");
    }
    std::string_view text = cursor.peek().text;
    if (text.starts_with('+'))
    {
        text.remove_prefix(1);
    }
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range)
    {
        cursor.fail(fmt::format("{} is out of range: an integer from {} to {} is expected.",
                                shown(cursor.peek()), std::numeric_limits<Integer>::min(),
                                std::numeric_limits<Integer>::max()));
    }
    if (error != std::errc() || end != text.data() + text.size())
    {
        cursor.failExpected("an integer");
    }
    cursor.take();
}

} // namespace

// ---------------------------------------------------------------------------------------------------------
// cursor

TokenCursor::TokenCursor(const Entry& entry)
    : owner(&entry), next(entry.tokens().data()), last(next + entry.tokens().size())
{
    if (entry.isDictionary())
    {
        throw FatalIOError(
            fmt::format("{} is a sub-dictionary, but a value is wanted here: write `{} value;`.",
                        entry.keyword(), entry.keyword()),
            entry.location());
    }
}

const Token& TokenCursor::peek() const
{
    if (next == last)
    {
        failExpected("more");
    }
    return *next;
}

const Token& TokenCursor::take()
{
    const Token& token = peek();
    ++next;
    return token;
}

void TokenCursor::expect(char punctuation, std::string_view what)
{
    if (!isNext(punctuation))
    {
        failExpected(what);
    }
    ++next;
}

void TokenCursor::fail(const std::string& message) const
{
    const std::vector<Token>& tokens = owner->tokens();
    if (next != last)
    {
        throw FatalIOError(message, owner->locationOf(*next));
    }
    throw FatalIOError(message, tokens.empty() ? owner->location() : owner->locationOf(tokens.back()));
}

void TokenCursor::failExpected(std::string_view what) const
{
    if (next == last)
    {
        if (owner->tokens().empty())
        {
            fail(fmt::format("{} has no value: {} is expected.", owner->keyword(), what));
        }
        fail(fmt::format("The value of {} ends too early: {} is expected.", owner->keyword(), what));
    }
    fail(fmt::format("The value of {} is wrong: {} is expected but {} is found.{}", owner->keyword(), what,
                     shown(*next), hintFor(*next)));
}

void TokenCursor::expectEnd() const
{
    if (next == last)
    {
        return;
    }
    const std::vector<Token>& tokens = owner->tokens();
    // A value that goes on in another line, where an entry may well have been meant to begin.
    const int lineBefore = next == tokens.data() ? owner->location().line : (next - 1)->line;
    if (next->line > lineBefore && next->kind == TokenKind::word)
    {
        throw FatalIOError(
            fmt::format("The value of {} goes on with {} at line {}. Is a `;` missing at the end of "
                        "line {}?",
                        owner->keyword(), shown(*next), next->line, lineBefore),
            SourceLocation{owner->locationOf(*next).file, owner->location().entry, lineBefore});
    }
    const std::string_view hint = hintFor(*next);
    fail(fmt::format("The value of {} should end before {}.{}", owner->keyword(), shown(*next),
                     hint.empty() ? " Is a `;` missing, or is this one value too many?" : hint));
}

TokenCursor::ListStart TokenCursor::openList()
{
    ListStart start;
    if (next != last && next->kind == TokenKind::word && next->text.starts_with("List<"))
    {
        ++next;
    }
    if (next != last && next->kind == TokenKind::number && next + 1 != last
        && (next[1].is('(') || next[1].is('{')))
    {
        const TokenCursor before = *this;
        long count = 0;
        read(*this, count);
        if (count < 0)
        {
            before.fail(fmt::format("A list cannot have {} values.", count));
        }
        start.count = count;
        if (isNext('{'))
        {
            if (count > largestUniformList)
            {
                before.fail(fmt::format("A list of {} values is too long: {} is the most.", count,
                                        largestUniformList));
            }
            start.uniform = true;
            ++next;
            return start;
        }
    }
    expect('(', "a list `( ... )`");
    return start;
}

void TokenCursor::closeList(const ListStart& start, std::size_t found)
{
    if (start.uniform)
    {
        expect('}', "`}`");
        return;
    }
    if (start.count >= 0 && static_cast<std::size_t>(start.count) != found)
    {
        fail(fmt::format(
            "The list says that it has {} values, but has {}. Correct the number before the `(`, or "
            "leave it out.",
            start.count, found));
    }
    expect(')', "`)`");
}

// ---------------------------------------------------------------------------------------------------------
// values

void read(TokenCursor& cursor, double& value)
{
    if (cursor.atEnd() || cursor.peek().kind != TokenKind::number)
    {
        cursor.failExpected("a number");
    }
    std::string_view text = cursor.peek().text;
    if (text.starts_with('+'))
    {
        text.remove_prefix(1);
    }
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range)
    {
        value = std::strtod(std::string(text).c_str(), nullptr);
        if (!std::isfinite(value))
        {
            cursor.fail(
                fmt::format("{} is too large for a number: 1.8e308 is the largest.", shown(cursor.peek())));
        }
    }
    else if (error != std::errc() || end != text.data() + text.size())
    {
        cursor.failExpected("a number");
    }
    cursor.take();
}

void read(TokenCursor& cursor, std::vector<double>& values)
{
    const TokenCursor::ListStart start = cursor.openList();
    if (start.uniform || cursor.atEnd() || cursor.peek().kind != TokenKind::bytes)
    {
        readItems(cursor, start, values);
        return;
    }
    const std::string_view bytes = cursor.peek().text;
    values.resize(bytes.size() / sizeof(double));
    if (!values.empty())
    {
        std::memcpy(values.data(), bytes.data(), bytes.size());
    }
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
    {
        cursor.fail("The list holds a value that is not a finite number.");
    }
    cursor.take();
    cursor.closeList(start, values.size());
}

void read(TokenCursor& cursor, PossiblyInfinite& value)
{
    if (!cursor.atEnd() && cursor.peek().kind == TokenKind::word)
    {
        const std::string_view word = cursor.peek().text;
        if (word == "inf" || word == "-inf")
        {
            value.value = (word == "inf" ? 1 : -1) * std::numeric_limits<double>::infinity();
            cursor.take();
            return;
        }
    }
    read(cursor, value.value);
}

void read(TokenCursor& cursor, int& value)
{
    readInteger(cursor, value);
}

void read(TokenCursor& cursor, long& value)
{
    readInteger(cursor, value);
}

void read(TokenCursor& cursor, bool& value)
{
    if (!cursor.atEnd() && cursor.peek().kind == TokenKind::word)
    {
        const std::string_view word = cursor.peek().text;
        for (const std::string_view yes : {"on", "yes", "true", "y", "t"})
        {
            if (word == yes)
            {
                value = true;
                cursor.take();
                return;
            }
        }
        for (const std::string_view no : {"off", "no", "false", "n", "f", "none"})
        {
            if (word == no)
            {
                value = false;
                cursor.take();
                return;
            }
        }
    }
    cursor.failExpected("one of on off yes no true false");
}

void read(TokenCursor& cursor, std::string& value)
{
    if (cursor.atEnd())
    {
        cursor.failExpected("a word");
    }
    const Token& token = cursor.peek();
    if (token.kind != TokenKind::word && token.kind != TokenKind::string && token.kind != TokenKind::verbatim
        && token.kind != TokenKind::number)
    {
        cursor.failExpected("a word");
    }
    value = token.kind == TokenKind::string ? unescaped(token.text) : std::string(token.text);
    cursor.take();
    if (token.kind == TokenKind::word && cursor.isNext('/')
        && cursor.peek().text.data() == token.text.data() + token.text.size())
    {
        const char* begin = token.text.data();
        const Token& last = cursor.entry().tokens().back();
        const std::ptrdiff_t length = last.text.data() + last.text.size() - begin;
        constexpr std::ptrdiff_t most = 80;
        const bool isOneText = last.file == token.file && length > 0 && length <= most;
        cursor.fail(fmt::format("What has a `/`, a name or arithmetic, goes between quotes: \"{}\".",
                                isOneText ? std::string_view(begin, static_cast<std::size_t>(length))
                                          : std::string_view("constant/record.AT2")));
    }
}

void readComponents(TokenCursor& cursor, double* components, std::size_t count, ThirdComponent third)
{
    const TokenCursor before = cursor;
    if (!cursor.isNext('('))
    {
        cursor.failExpected(fmt::format("a vector of {} numbers, `( ... )`,", count));
    }
    cursor.take();
    std::size_t found = 0;
    while (!cursor.isNext(')'))
    {
        double component = 0;
        const TokenCursor atComponent = cursor;
        read(cursor, component);
        if (found < count)
        {
            components[found] = component;
        }
        else if (count == 2 && found == 2)
        {
            if (component != 0)
            {
                atComponent.fail(
                    fmt::format("The third component of {} must be 0: the structure lies in the x-y "
                                "plane.",
                                cursor.entry().keyword()));
            }
        }
        else
        {
            atComponent.fail(
                fmt::format("The vector of {} has more than {} numbers.", cursor.entry().keyword(), count));
        }
        ++found;
    }
    if (found == 2 && count == 3 && third == ThirdComponent::optional)
    {
        components[found++] = 0;
    }
    if (found == 2 && count == 3)
    {
        before.fail(
            fmt::format("The vector of {} has 2 numbers, but 3 are expected: the case is in space. Give "
                        "x, y and z (up).",
                        cursor.entry().keyword()));
    }
    if (found < count)
    {
        before.fail(fmt::format("The vector of {} has {} numbers, but {} are expected.",
                                cursor.entry().keyword(), found, count));
    }
    cursor.take();
}

void detail::failUnknownWord(const TokenCursor& cursor, const std::string& word,
                             const std::vector<std::string>& validWords)
{
    cursor.fail(unknownWordMessage(cursor.entry().keyword(), word, validWords));
}

} // namespace drystone
