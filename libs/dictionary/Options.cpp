// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Declared settings: checks and messages, and the texts made from declarations.
#include "dictionary/Options.h"

#include "dictionary/Registry.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <set>

namespace drystone
{

using Form = OptionDescription::Form;
using Presence = OptionDescription::Presence;

// ---------------------------------------------------------------------------------------------------------
// values

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

// ---------------------------------------------------------------------------------------------------------
// option

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

std::string rangeText(double lowest, bool lowestAllowed, double highest, bool highestAllowed)
{
    const bool hasLowest = std::isfinite(lowest);
    const bool hasHighest = std::isfinite(highest);
    if (hasLowest && hasHighest && lowestAllowed && highestAllowed)
    {
        return fmt::format("from {} to {}", lowest, highest);
    }
    std::string text;
    if (hasLowest)
    {
        text = fmt::format("{} {}", lowestAllowed ? "at least" : "above", lowest);
    }
    if (hasHighest)
    {
        text +=
            fmt::format("{}{} {}", text.empty() ? "" : ", ", highestAllowed ? "at most" : "below", highest);
    }
    return text;
}

/// Faults of one dictionary, reported together.
class Faults
{
public:
    template<typename Reading>
    void collectFrom(const Reading& reading)
    {
        if (isFull())
        {
            return;
        }
        try
        {
            reading();
        }
        catch (const FatalIOError& fault)
        {
            collected.push_back(fault);
        }
    }
    bool isEmpty() const { return collected.empty(); }
    bool isFull() const { return collected.size() >= most; }

    /// Whether a key that is not known is said to be likely this one: it is then not missing as well.
    bool suggest(const std::string& key) const
    {
        return std::any_of(collected.begin(), collected.end(),
                           [&](const FatalIOError& fault) {
                               return std::string_view(fault.what()).find("Did you mean " + key + "?")
                                      != std::string_view::npos;
                           });
    }

    /// One error with all the messages, each but the last followed by its place, which is in the text. With
    /// one fault it is that fault.
    void report() const
    {
        if (collected.empty())
        {
            return;
        }
        std::string text;
        for (std::size_t i = 0; i + 1 < collected.size(); ++i)
        {
            text += fmt::format("{}\n\n{}\n\n", collected[i].what(), describe(collected[i].location()));
        }
        throw FatalIOError(text + collected.back().what(), collected.back().location(),
                           collected.front().exitStatus());
    }

private:
    static constexpr std::size_t most = 20; ///< more than a user reads
    std::vector<FatalIOError> collected;
};

std::string withUnit(const OptionDescription& option)
{
    return option.unit.empty() ? "" : fmt::format(" [{}]", option.unit);
}

} // namespace

Option& Option::unit(std::string unitName)
{
    dimensionsOf(unitName); // a unit that is not known is an error of the declaration
    about.unit = std::move(unitName);
    return *this;
}

Option& Option::above(double limit)
{
    lowest = limit;
    lowestAllowed = false;
    about.range = rangeText(lowest, lowestAllowed, highest, highestAllowed);
    return *this;
}

Option& Option::atLeast(double limit)
{
    lowest = limit;
    lowestAllowed = true;
    about.range = rangeText(lowest, lowestAllowed, highest, highestAllowed);
    return *this;
}

Option& Option::below(double limit)
{
    highest = limit;
    highestAllowed = false;
    about.range = rangeText(lowest, lowestAllowed, highest, highestAllowed);
    return *this;
}

Option& Option::atMost(double limit)
{
    highest = limit;
    highestAllowed = true;
    about.range = rangeText(lowest, lowestAllowed, highest, highestAllowed);
    return *this;
}

Option& Option::orInfinite()
{
    infiniteAllowed = true;
    return *this;
}

Option& Option::usual(double from, double to, std::string note)
{
    usuallyFrom = from;
    usuallyTo = to;
    usualNote = std::move(note);
    about.usual = rangeText(from, true, to, true);
    return *this;
}

Option& Option::oneOf(std::vector<std::string> allowedWords)
{
    about.words = std::move(allowedWords);
    return *this;
}

Option& Option::example(std::string text)
{
    about.exampleText = std::move(text);
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
                                   withUnit(about), about.range),
                       placeOf(number, entry));
}

void Option::questionNumber(double number, const Entry& entry) const
{
    if (number >= usuallyFrom && number <= usuallyTo)
    {
        return;
    }
    printWarningOnce(fmt::format("{} = {}{} is unusual: usual is {}{}. It is used as it stands.", about.key,
                                 number, withUnit(about), about.usual,
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

// --------------------------------------------------------------------------------------------------------
// options

Option& Options::add(OptionDescription::Presence presence, std::string key, std::string doc)
{
    Option& option = options.emplace_back();
    option.about.key = std::move(key);
    option.about.doc = std::move(doc);
    option.about.presence = presence;
    return option;
}

Option& Options::addOwnNames(std::string doc)
{
    Option& option = add(Presence::mayBeAbsent, "", std::move(doc));
    option.about.form = Form::ownNames;
    return option;
}

void Options::readElsewhere(const std::vector<std::string>& keys, const std::string& doc)
{
    for (const std::string& key : keys)
    {
        add(Presence::mayBeAbsent, key, doc).about.form = Form::elsewhere;
    }
}

void Options::check(std::string key, std::function<std::string()> fault)
{
    rules.push_back({std::move(key), std::move(fault)});
}

void Options::question(std::string key, std::function<std::string()> doubt)
{
    questions.push_back({std::move(key), std::move(doubt)});
}

const Option* Options::ownNamesOption() const
{
    for (const Option& option : options)
    {
        if (option.about.form == Form::ownNames)
        {
            return &option;
        }
    }
    return nullptr;
}

bool Options::isDeclared(const std::string& key) const
{
    return std::any_of(options.begin(), options.end(),
                       [&key](const Option& option) { return option.about.key == key; });
}

void Options::refuseUnknownKeys(const Dictionary& dictionary) const
{
    const bool isRoot = dictionary.location().entry.empty();
    Faults faults;
    for (const Entry& entry : dictionary.entries())
    {
        // What a macro stands for has been read; and every file may have a header.
        if (entry.isUsed() || isDeclared(entry.keyword()) || (isRoot && entry.keyword() == "FoamFile"))
        {
            continue;
        }
        if (entry.isPattern())
        {
            const auto matches = patternMatcher(entry.keyword(), entry.location());
            if (std::any_of(options.begin(), options.end(),
                            [&matches](const Option& option) { return matches(option.about.key); }))
            {
                continue;
            }
        }
        if (ownNamesOption() && entry.isDictionary())
        {
            continue;
        }
        if (entry.keyword().starts_with("#list"))
        {
            faults.collectFrom(
                [&]
                {
                    throw FatalIOError(
                        "There is a list without a keyword, which nothing reads. Write `keyword ( ... );`.",
                        entry.location());
                });
            continue;
        }
        if (faults.isFull())
        {
            break;
        }
        std::vector<std::string> keys;
        for (const Option& option : options)
        {
            if (option.about.form != Form::ownNames)
            {
                keys.push_back(option.about.key);
            }
        }
        faults.collectFrom(
            [&] { throw FatalIOError(unknownWordMessage("key", entry.keyword(), keys), entry.location()); });
    }
    faults.report();
}

std::vector<std::string> Options::typesOf(const Option& option)
{
    OptionDescription description = option.about;
    if (option.describeMembers)
    {
        option.describeMembers(description);
    }
    std::vector<std::string> types;
    for (const OptionDescription::Alternative& alternative : description.alternatives)
    {
        types.push_back(alternative.name);
    }
    return types;
}

void Options::readFrom(const Dictionary& dictionary) const
{
    Faults faults;
    faults.collectFrom([&] { refuseUnknownKeys(dictionary); });
    for (const Option& option : options)
    {
        const OptionDescription& about = option.about;
        if (about.form == Form::elsewhere)
        {
            continue;
        }
        if (about.form == Form::ownNames)
        {
            for (const Entry& entry : dictionary.entries())
            {
                const bool isHeader = dictionary.location().entry.empty() && entry.keyword() == "FoamFile";
                if (!isHeader && !isDeclared(entry.keyword()) && entry.isDictionary() && !entry.isUsed())
                {
                    faults.collectFrom([&] { option.readEntry(entry); });
                }
            }
            continue;
        }
        if (const Entry* entry = dictionary.find(about.key))
        {
            faults.collectFrom([&] { option.readEntry(*entry); });
        }
        else if (about.presence == Presence::required && !faults.suggest(about.key))
        {
            std::string message = fmt::format(
                "The {} {} is missing: {}{}.",
                about.form == Form::value || about.form == Form::dictionaryList ? "entry" : "sub-dictionary",
                about.key, about.doc, withUnit(about));
            if (!about.exampleText.empty())
            {
                message += fmt::format(" Write for example `{} {};`.", about.key, about.exampleText);
            }
            else if (const std::vector<std::string> types = typesOf(option); !types.empty())
            {
                message += fmt::format(" Write `{} {{ type ...; }}` with one of the types {}.", about.key,
                                       fmt::join(types, " "));
            }
            faults.collectFrom([&] { throw FatalIOError(message, dictionary.location()); });
        }
    }
    faults.report(); // rules are about values that are known
    for (const Rule& rule : rules)
    {
        const std::string fault = rule.fault();
        if (!fault.empty())
        {
            throw FatalIOError(fault, dictionary.locationOf(rule.key));
        }
    }
    for (const Rule& question : questions)
    {
        const std::string doubt = question.fault();
        if (!doubt.empty())
        {
            printWarningOnce(doubt, dictionary.locationOf(question.key));
        }
    }
}

std::vector<OptionDescription> Options::descriptions() const
{
    std::vector<OptionDescription> result;
    for (const Option& option : options)
    {
        result.push_back(option.about);
        if (option.describeMembers)
        {
            option.describeMembers(result.back());
        }
    }
    return result;
}

void failSelection(const Dictionary& dictionary, const std::string& family,
                   const std::vector<std::string>& words)
{
    const Entry* type = dictionary.find("type");
    if (!type)
    {
        std::vector<std::string> sorted = words;
        std::sort(sorted.begin(), sorted.end());
        throw FatalIOError(fmt::format("The entry type is missing: it chooses the {}.\n\nValid {} types: {}",
                                       family, family, fmt::join(sorted, " ")),
                           dictionary.location());
    }
    throw FatalIOError(unknownWordMessage(family + " type", type->as<std::string>(), words),
                       type->tokens().empty() ? type->location() : type->locationOf(type->tokens().front()));
}

} // namespace drystone
