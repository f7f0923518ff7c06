// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Entries and dictionaries as containers, and how they are written.
#include "dictionary/Dictionary.h"

#include "dictionary/DictionaryGrammar.h"
#include "dictionary/DictionaryPattern.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <iterator>

namespace drystone
{

// ----------------------------------------------------------------------------------------------------------
// Entry

Entry::Entry(std::string entryKeyword, std::vector<Token> entryTokens,
             std::shared_ptr<SourceText> entrySource, SourceLocation entryLocation)
    : key(std::move(entryKeyword)),
      value(std::move(entryTokens)),
      source(std::move(entrySource)),
      where(std::move(entryLocation))
{
}

Entry::Entry(std::string entryKeyword, Dictionary entryDictionary, SourceLocation entryLocation)
    : key(std::move(entryKeyword)), where(std::move(entryLocation))
{
    body.push_back(std::move(entryDictionary));
}

Entry::~Entry() = default;
Entry::Entry(const Entry&) = default;
Entry::Entry(Entry&&) noexcept = default;
Entry& Entry::operator=(const Entry&) = default;
Entry& Entry::operator=(Entry&&) noexcept = default;

const Dictionary& Entry::dictionary() const
{
    if (body.empty())
    {
        throw FatalIOError(
            fmt::format("{} is a value, but a sub-dictionary is wanted here: write `{} {{ ... }}`.", key,
                        key),
            where);
    }
    markUsed();
    return body.front();
}

Dictionary& Entry::dictionary()
{
    std::as_const(*this).dictionary();
    return body.front();
}

SourceLocation Entry::locationOf(const Token& token) const
{
    return {token.file ? token.file->name : where.file, where.entry, token.line};
}

namespace
{

/// Numbers of a binary list as text: the fewest digits that read back as the same numbers.
std::string numbersText(std::string_view bytes)
{
    std::string text;
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(double))
    {
        double number = 0;
        std::memcpy(&number, bytes.data() + at, sizeof(double));
        fmt::format_to(std::back_inserter(text), "{}{}", at > 0 ? " " : "", number);
    }
    return text;
}

/// A dictionary that is printed has no lists of bytes any more.
bool isFormatOfBinaryFile(const Entry& entry)
{
    return entry.location().entry == "FoamFile/format" && entry.valueText() == "binary";
}

std::string tokenText(const Token& token)
{
    switch (token.kind)
    {
    case TokenKind::string:
        return fmt::format("\"{}\"", token.text);
    case TokenKind::verbatim:
        return fmt::format("#{{{}#}}", token.text);
    case TokenKind::bytes:
        return numbersText(token.text);
    default:
        return std::string(token.text);
    }
}

/// Whether a blank stands between two tokens: none inside brackets, none before a separator.
bool isBlankBetween(const Token& left, const Token& right)
{
    if (left.is('(') || left.is('[') || right.is(')') || right.is(']') || right.is(';'))
    {
        return false;
    }
    return !((right.is('(') || right.is('{')) && left.kind == TokenKind::number);
}

bool startsOnNewLine(const std::string& text)
{
    return text.empty() || text.back() == '\n';
}

/// A list written without a key; its entry has a name of its own.
bool isBareList(const Entry& entry)
{
    return entry.keyword().starts_with("#list");
}

} // namespace

std::string Entry::keywordText() const
{
    return keyIsPattern ? fmt::format("\"{}\"", key) : key;
}

std::string Entry::valueText() const
{
    std::string text;
    for (std::size_t i = 0; i < value.size(); ++i)
    {
        if (i > 0 && isBlankBetween(value[i - 1], value[i]))
        {
            text += ' ';
        }
        text += tokenText(value[i]);
    }
    return text;
}

std::string toText(const Entry& entry, int indentation)
{
    const std::string indent(static_cast<std::size_t>(indentation), ' ');
    if (isBareList(entry))
    {
        return indent + entry.valueText() + "\n";
    }
    const std::string keyword = entry.keywordText();
    if (isFormatOfBinaryFile(entry))
    {
        return fmt::format("{}{:<15} ascii;\n", indent, keyword);
    }
    if (entry.isDictionary())
    {
        std::string text = indent + keyword + "\n" + indent + "{\n";
        for (const Entry& inner : entry.dictionary().entries())
        {
            text += toText(inner, indentation + 4);
        }
        return text + indent + "}\n";
    }
    if (entry.isPattern() || !keyword.starts_with('#'))
    {
        return fmt::format("{}{:<15} {};\n", indent, keyword, entry.valueText());
    }
    return fmt::format("{}{} {}\n", indent, keyword, entry.valueText());
}

std::string toText(const Dictionary& dictionary, int indentation)
{
    std::string text;
    for (const Entry& entry : dictionary.entries())
    {
        if (entry.isDictionary() && !text.empty() && startsOnNewLine(text))
        {
            text += '\n';
        }
        text += toText(entry, indentation);
    }
    return text;
}

std::string headerText(std::string_view object, std::string_view location, std::string_view className)
{
    std::string text = fmt::format("FoamFile\n{{\n    version     2.0;\n    format      ascii;\n"
                                   "    class       {};\n",
                                   className);
    if (!location.empty())
    {
        text += fmt::format("    location    \"{}\";\n", location);
    }
    return text + fmt::format("    object      {};\n}}\n", object);
}

// -----------------------------------------------------------------------------------------------------
// Dictionary

Dictionary::Dictionary() = default;
Dictionary::Dictionary(SourceLocation dictionaryLocation) : where(std::move(dictionaryLocation)) {}
Dictionary::~Dictionary() = default;
Dictionary::Dictionary(const Dictionary&) = default;
Dictionary::Dictionary(Dictionary&&) noexcept = default;
Dictionary& Dictionary::operator=(const Dictionary&) = default;
Dictionary& Dictionary::operator=(Dictionary&&) noexcept = default;

std::vector<std::string> Dictionary::keywords() const
{
    std::vector<std::string> words;
    words.reserve(content.size());
    for (const Entry& entry : content)
    {
        words.push_back(entry.keyword());
    }
    return words;
}

const Entry* Dictionary::findExact(std::string_view key) const
{
    const auto place = index.find(std::string(key));
    return place == index.end() ? nullptr : &content[place->second];
}

Entry* Dictionary::findExact(std::string_view key)
{
    return const_cast<Entry*>(std::as_const(*this).findExact(key));
}

const Entry* Dictionary::find(std::string_view key) const
{
    if (const Entry* entry = findExact(key))
    {
        return entry;
    }
    const std::string name(key);
    for (auto pattern = patterns.rbegin(); pattern != patterns.rend(); ++pattern)
    {
        if (pattern->second(name))
        {
            return &content[pattern->first];
        }
    }
    return nullptr;
}

namespace
{

[[noreturn]] void failMissing(const Dictionary& dictionary, std::string_view what, std::string_view key)
{
    std::string message = fmt::format("The {} {} is missing.", what, key);
    const std::vector<std::string> keywords = dictionary.keywords();
    const std::string nearest = nearestWord(key, keywords);
    if (!nearest.empty())
    {
        message += fmt::format(" Did you mean {}?", nearest);
    }
    else if (!keywords.empty() && keywords.size() <= 20)
    {
        message += fmt::format(" There are: {}.", fmt::join(keywords, " "));
    }
    throw FatalIOError(message, dictionary.location());
}

} // namespace

const Entry& Dictionary::lookup(std::string_view key) const
{
    if (const Entry* entry = find(key))
    {
        return *entry;
    }
    failMissing(*this, "entry", key);
}

const Dictionary* Dictionary::findDict(std::string_view key) const
{
    const Entry* entry = find(key);
    return entry ? &entry->dictionary() : nullptr;
}

const Dictionary& Dictionary::subDict(std::string_view key) const
{
    if (const Entry* entry = find(key))
    {
        return entry->dictionary();
    }
    failMissing(*this, "sub-dictionary", key);
}

const Entry* Dictionary::findPath(std::string_view path) const
{
    const Dictionary* dictionary = this;
    while (true)
    {
        const std::size_t slash = path.find('/');
        if (slash == 0)
        {
            path.remove_prefix(1);
            continue;
        }
        const Entry* entry = dictionary->find(path.substr(0, slash));
        if (!entry || slash == std::string_view::npos || slash + 1 == path.size())
        {
            return entry;
        }
        if (!entry->isDictionary())
        {
            return nullptr;
        }
        dictionary = &entry->dictionary();
        path.remove_prefix(slash + 1);
    }
}

const Entry& Dictionary::lookupPath(std::string_view path) const
{
    if (const Entry* entry = findPath(path))
    {
        return *entry;
    }
    // A point may be in a keyword, alpha.water, or between two.
    std::string slashed(path);
    std::replace(slashed.begin(), slashed.end(), '.', '/');
    if (const Entry* entry = findPath(slashed))
    {
        return *entry;
    }
    // Blame the first keyword that is not there.
    const Dictionary* dictionary = this;
    std::string_view rest = slashed;
    while (true)
    {
        rest.remove_prefix(std::min(rest.find_first_not_of('/'), rest.size()));
        const std::size_t slash = std::min(rest.find('/'), rest.size());
        const Entry* entry = dictionary->find(rest.substr(0, slash));
        if (!entry || slash == rest.size())
        {
            return dictionary->lookup(rest.substr(0, slash));
        }
        dictionary = &entry->dictionary();
        rest.remove_prefix(slash);
    }
}

SourceLocation Dictionary::locationOf(std::string_view key) const
{
    const Entry* entry = find(key);
    return entry ? entry->location() : where;
}

void Dictionary::merge(Entry entry)
{
    if (Entry* existing = findExact(entry.keyword()))
    {
        if (existing->isDictionary() && entry.isDictionary())
        {
            existing->dictionary().merge(entry.dictionary());
        }
        else
        {
            const bool patternsChange = existing->isPattern() || entry.isPattern();
            *existing = std::move(entry);
            if (patternsChange)
            {
                rebuildIndex();
            }
        }
        return;
    }
    const std::size_t place = content.size();
    index.emplace(entry.keyword(), place);
    if (entry.isPattern())
    {
        patterns.emplace_back(place, patternMatcher(entry.keyword(), entry.location()));
    }
    content.push_back(std::move(entry));
}

void Dictionary::merge(const Dictionary& other)
{
    for (const Entry& entry : other.entries())
    {
        merge(entry);
    }
}

void Dictionary::set(const std::string& key, std::string_view value)
{
    auto source = std::make_shared<SourceText>();
    source->files.push_back({where.file.empty() ? key : where.file, std::string(value)});
    std::vector<Token> tokens = parseTokens(source->files.back());
    for (Token& token : tokens)
    { // messages point at where this dictionary begins
        token.line = where.line;
    }
    SourceLocation location = where;
    location.entry += (location.entry.empty() ? "" : "/") + key;
    merge(Entry(key, std::move(tokens), std::move(source), std::move(location)));
}

bool Dictionary::remove(std::string_view key)
{
    const auto place = index.find(std::string(key));
    if (place == index.end())
    {
        return false;
    }
    content.erase(content.begin() + static_cast<std::ptrdiff_t>(place->second));
    rebuildIndex();
    return true;
}

void Dictionary::clear()
{
    content.clear();
    index.clear();
    patterns.clear();
}

void Dictionary::rebuildIndex()
{
    index.clear();
    patterns.clear();
    for (std::size_t i = 0; i < content.size(); ++i)
    {
        index.emplace(content[i].keyword(), i);
        if (content[i].isPattern())
        {
            patterns.emplace_back(i, patternMatcher(content[i].keyword(), content[i].location()));
        }
    }
}

} // namespace drystone
