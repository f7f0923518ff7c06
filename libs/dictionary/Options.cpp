// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Declared settings: reading them, and the faults of a dictionary.
#include "dictionary/Options.h"

#include "dictionary/DictionaryPattern.h"
#include "dictionary/Registry.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace drystone
{

using Form = OptionDescription::Form;
using Presence = OptionDescription::Presence;

namespace
{

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

/// How a key that is missing may be written, where that is known: a sentence. \param types of the models that
/// it chooses from, if any
std::string exampleOfMissing(const OptionDescription& about, const std::vector<std::string>& types)
{
    if (about.form == Form::value && !about.exampleText.empty())
    {
        return fmt::format(" Write for example `{} {};`.", about.key, about.exampleText);
    }
    const std::string body = types.empty() ? "..." : "type ...;";
    std::string example = fmt::format("{} {{ {} }}", about.key, body);
    if (about.form == Form::namedDictionaries)
    {
        example = fmt::format("{} {{ {} {{ {} }} }}", about.key,
                              about.exampleText.empty() ? "name" : about.exampleText, body);
    }
    else if (about.form == Form::dictionaryList)
    {
        example = fmt::format("{} ( {{ {} }} );", about.key, body);
    }
    else if (types.empty())
    {
        return "";
    }
    return types.empty()
               ? fmt::format(" Write for example `{}`.", example)
               : fmt::format(" Write `{}` with one of the types {}.", example, fmt::join(types, " "));
}

} // namespace

Option& Options::add(OptionDescription::Presence presence, std::string_view key, std::string_view doc)
{
    Option& option = options.emplace_back();
    option.about.key = key;
    option.about.doc = doc;
    option.about.presence = presence;
    return option;
}

Options::Options() = default;
Options::~Options() = default;

void Options::describeAs(Option& option, OptionDescription::Form form, std::string_view type)
{
    option.about.form = form;
    option.about.type = type;
    option.about.allowAbsence();
}

Option& Options::addOwnNames(std::string_view doc)
{
    Option& option = add(Presence::mayBeAbsent, "", doc);
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

void Options::check(std::string_view key, std::function<std::string()> fault)
{
    rules.push_back({std::string(key), std::move(fault)});
}

void Options::question(std::string_view key, std::function<std::string()> doubt)
{
    questions.push_back({std::string(key), std::move(doubt)});
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
            const std::string message = fmt::format(
                "The {} {} is missing: {}{}.{}",
                about.form == Form::value || about.form == Form::dictionaryList ? "entry" : "sub-dictionary",
                about.key, about.doc, about.unitText(), exampleOfMissing(about, typesOf(option)));
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
        const Entry* misspelt = dictionary.findExact(nearestWord("type", dictionary.keywords()));
        throw FatalIOError(
            fmt::format("The entry type is missing: it chooses the {}.{}\n\nValid {} types: {}", family,
                        misspelt ? fmt::format(" Did you mean type with {} at line {}?", misspelt->keyword(),
                                               misspelt->location().line)
                                 : "",
                        family, fmt::join(sorted, " ")),
            dictionary.location());
    }
    throw FatalIOError(unknownWordMessage(family + " type", type->as<std::string>(), words),
                       type->tokens().empty() ? type->location() : type->locationOf(type->tokens().front()));
}

} // namespace drystone
