// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One declared key: its bounds, and the checks of what a user gives.
#include "dictionary/Option.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

namespace drystone
{

OptionDescription::OptionDescription() = default;
OptionDescription::~OptionDescription() = default;
OptionDescription::OptionDescription(const OptionDescription&) = default;
OptionDescription::OptionDescription(OptionDescription&&) noexcept = default;
OptionDescription& OptionDescription::operator=(const OptionDescription&) = default;
OptionDescription& OptionDescription::operator=(OptionDescription&&) noexcept = default;

void OptionDescription::allowAbsence()
{
    if (presence == Presence::hasDefault)
    {
        presence = Presence::mayBeAbsent;
    }
}

std::string OptionDescription::unitText() const
{
    return unit.empty() ? "" : fmt::format(" [{}]", unit);
}

namespace
{

/// Line of the number in question, when it can be found among the tokens.
SourceLocation placeOf(double number, const Entry& entry)
{
    for (const Token& token : entry.tokens())
    {
        if (token.kind == TokenKind::number
            && std::strtod(std::string(token.text).c_str(), nullptr) == number)
        {
            return entry.locationOf(token);
        }
    }
    return entry.location();
}

/// One end of a range; infinite where there is none.
struct Bound
{
    double value = 0;
    bool isAllowed = true; ///< the value itself is in the range
};

std::string rangeText(const Bound& lowest, const Bound& highest)
{
    const bool hasLowest = std::isfinite(lowest.value);
    const bool hasHighest = std::isfinite(highest.value);
    if (hasLowest && hasHighest && lowest.isAllowed && highest.isAllowed)
    {
        return fmt::format("from {} to {}", lowest.value, highest.value);
    }
    std::string text;
    if (hasLowest)
    {
        text = fmt::format("{} {}", lowest.isAllowed ? "at least" : "above", lowest.value);
    }
    if (hasHighest)
    {
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", highest.isAllowed ? "at most" : "below",
                            highest.value);
    }
    return text;
}

} // namespace

Option& Option::unit(std::string_view unitName)
{
    dimensionsOf(unitName); // a unit that is not known is an error of the declaration
    about.unit = unitName;
    return *this;
}

Option& Option::above(double limit)
{
    lowest = limit;
    lowestAllowed = false;
    about.range = rangeText({lowest, lowestAllowed}, {highest, highestAllowed});
    return *this;
}

Option& Option::atLeast(double limit)
{
    lowest = limit;
    lowestAllowed = true;
    about.range = rangeText({lowest, lowestAllowed}, {highest, highestAllowed});
    return *this;
}

Option& Option::below(double limit)
{
    highest = limit;
    highestAllowed = false;
    about.range = rangeText({lowest, lowestAllowed}, {highest, highestAllowed});
    return *this;
}

Option& Option::atMost(double limit)
{
    highest = limit;
    highestAllowed = true;
    about.range = rangeText({lowest, lowestAllowed}, {highest, highestAllowed});
    return *this;
}

Option& Option::orInfinite()
{
    infiniteAllowed = true;
    return *this;
}

Option& Option::usual(double from, double to, std::string_view note)
{
    usuallyFrom = from;
    usuallyTo = to;
    usualNote = note;
    about.usual = rangeText({from}, {to});
    return *this;
}

Option& Option::oneOf(std::vector<std::string> allowedWords)
{
    about.words = std::move(allowedWords);
    return *this;
}

Option& Option::example(std::string_view text)
{
    about.exampleText = text;
    return *this;
}

void Option::checkNumber(double number, const Entry& entry) const
{
    const bool lowEnough = number < highest || (highestAllowed && number == highest);
    const bool highEnough = number > lowest || (lowestAllowed && number == lowest);
    if (lowEnough && highEnough)
    {
        return questionNumber(number, entry);
    }
    throw FatalIOError(fmt::format("{} = {}{} is out of range: it must be {}.", about.key, number,
                                   about.unitText(), about.range),
                       placeOf(number, entry));
}

void Option::questionNumber(double number, const Entry& entry) const
{
    if (number >= usuallyFrom && number <= usuallyTo)
    {
        return;
    }
    printWarningOnce(fmt::format("{} = {}{} is unusual: usual is {}{}. It is used as it stands.", about.key,
                                 number, about.unitText(), about.usual,
                                 usualNote.empty() ? "" : "; " + usualNote),
                     placeOf(number, entry));
}

void Option::checkWord(const std::string& word, const Entry& entry) const
{
    if (about.words.empty() || std::find(about.words.begin(), about.words.end(), word) != about.words.end())
    {
        return;
    }
    throw FatalIOError(unknownWordMessage(about.key, word, about.words),
                       entry.tokens().empty() ? entry.location() : entry.locationOf(entry.tokens().front()));
}

void Option::readEntry(const Entry& entry) const
{
    entry.markUsed();
    readValue(entry, *this);
}

void Option::readUnit(TokenCursor& cursor) const
{
    if (!about.unit.empty())
    {
        readDimensions(cursor, about.unit);
    }
}

void Option::readNumber(TokenCursor& cursor, double& number) const
{
    if (infiniteAllowed)
    {
        PossiblyInfinite value;
        read(cursor, value);
        number = value.value;
    }
    else
    {
        read(cursor, number);
    }
}

} // namespace drystone
