// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// From statements to a dictionary: entries and how they merge, directives and conditions.
#include "dictionary/Dictionary.h"

#include "dictionary/DictionaryGrammar.h"
#include "dictionary/DictionaryPattern.h"
#include "dictionary/DictionaryScanner.h"
#include "dictionary/FilesInMemory.h"
#include "dictionary/IncludedFiles.h"
#include "dictionary/MacroExpansion.h"
#include "dictionary/MacroNames.h"
#include "dictionary/RepeatedKey.h"
#include "dictionary/ValueExpansion.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>

namespace drystone
{

namespace
{

enum class InputMode
{
    merge,
    overwrite,
    protect,
    warn,
    error
};

int depthOf(const Dictionary& dictionary)
{
    int depth = 0;
    for (const Entry& entry : dictionary.entries())
    {
        if (entry.isDictionary())
        {
            depth = std::max(depth, depthOf(entry.dictionary()));
        }
    }
    return depth + 1;
}

std::size_t tokenCountOf(const Dictionary& dictionary)
{
    std::size_t count = 0;
    for (const Entry& entry : dictionary.entries())
    {
        count += 1 + (entry.isDictionary() ? tokenCountOf(entry.dictionary()) : entry.tokens().size());
    }
    return count;
}

class Reader
{
public:
    explicit Reader(Expansion wantedExpansion) : expansion(wantedExpansion) {}

    Dictionary readFile(const std::filesystem::path& path)
    {
        const SourceFile& file = load(reading, path, {});
        reading.caseDirectory = caseOf(path);
        reading.openFiles.push_back(path);
        return readRoot(file);
    }

    /// Of all files that were read so far, those that were included among them.
    std::set<std::string> sourceNames() const
    {
        std::set<std::string> names;
        for (const SourceFile& file : reading.source->files)
        {
            names.insert(std::filesystem::path(file.name).lexically_normal().string());
        }
        return names;
    }

    Dictionary readText(std::string_view text, const std::string& name)
    {
        reading.source->files.push_back({name, withLineFeeds(std::string(text))});
        reading.openFiles.emplace_back(name);
        return readRoot(reading.source->files.back());
    }

private:
    // ------------------------------------------------------------------------------------------------
    // statements

    Dictionary readRoot(const SourceFile& file)
    {
        Dictionary root(SourceLocation{file.name, "", 1});
        reading.scopes.push_back(&root);
        carryOut(parseStatements(file));
        return root;
    }

    Dictionary& current() { return *reading.scopes.back(); }

    void carryOut(const std::vector<Statement>& statements)
    {
        std::map<std::string_view, const Statement*> first; // of each keyword between these brackets
        for (const Statement& statement : statements)
        {
            if (isKeyed(statement) && expansion == Expansion::all && !isModeGiven)
            {
                const auto [earlier, isFirst] = first.try_emplace(statement.keyword.text, &statement);
                if (!isFirst)
                {
                    warnOfRepetition(*earlier->second, statement);
                }
            }
            carryOut(statement);
        }
    }

    void warnOfRepetition(const Statement& earlier, const Statement& statement)
    {
        const bool areDictionaries =
            earlier.kind == Statement::Kind::dictionary && statement.kind == Statement::Kind::dictionary;
        printWarningOnce(repeatedKeyText(statement.keyword.text, earlier.keyword.line,
                                         areDictionaries ? Repetition::merges : Repetition::replaces)
                             + ", or write `#inputMode merge` before them.",
                         locationOf(reading, statement.keyword));
    }

    void carryOut(const Statement& statement)
    {
        switch (statement.kind)
        {
        case Statement::Kind::entry:
        case Statement::Kind::dictionary:
            addKeyed(statement, std::string(statement.keyword.text));
            break;
        case Statement::Kind::list:
            addList(statement);
            break;
        case Statement::Kind::macro:
            if (expansion == Expansion::none)
            {
                add(Entry(std::string(statement.keyword.text), {}, reading.source,
                          locationOf(reading, statement.keyword)));
            }
            else
            {
                mergeMacro(statement.keyword);
            }
            break;
        case Statement::Kind::directive:
            if (expansion == Expansion::none)
            {
                add(Entry(std::string(statement.keyword.text), statement.value, reading.source,
                          locationOf(reading, statement.keyword)));
            }
            else
            {
                direct(statement);
            }
            break;
        case Statement::Kind::condition:
            if (expansion == Expansion::none)
            {
                carryOut(statement.body);
                carryOut(statement.otherwise);
            }
            else
            {
                const bool holds = isTrue(reading, statement);
                refuseOtherConditions(holds ? statement.otherwise : statement.body);
                carryOut(holds ? statement.body : statement.otherwise);
            }
            break;
        }
    }

    /// What is not carried out is not read either, but for `#elif` and the like, which are meant to part it.
    void refuseOtherConditions(const std::vector<Statement>& skipped) const
    {
        for (const Statement& statement : skipped)
        {
            if (statement.kind == Statement::Kind::directive && statement.keyword.text.starts_with("#el"))
            {
                throw FatalIOError(
                    fmt::format("{} is no directive here. Write `#else`, and in what follows it another "
                                "`#if ... #endif`.",
                                statement.keyword.text),
                    locationOf(reading, statement.keyword));
            }
        }
    }

    void addKeyed(const Statement& statement, std::string keyword)
    {
        SourceLocation location = locationOf(reading, statement.keyword);
        // `$name { ... }` takes its keyword from an entry.
        if (statement.keyword.kind == TokenKind::macro && expansion == Expansion::all)
        {
            std::vector<Token> tokens;
            expandMacro(reading, statement.keyword, tokens);
            if (tokens.size() != 1 || tokens.front().text.empty())
            {
                throw FatalIOError(
                    fmt::format("{} is used as a keyword, so its value must be one word.", keyword),
                    location);
            }
            keyword = std::string(tokens.front().text);
            location.entry = joined(current().location().entry, keyword);
        }
        const bool isPattern = statement.keyword.kind == TokenKind::string;
        if (statement.kind == Statement::Kind::dictionary)
        {
            Dictionary dictionary(location);
            if (reading.scopes.size() > static_cast<std::size_t>(deepestNesting))
            {
                throw FatalIOError(fmt::format("Dictionaries are nested more than {} deep.", deepestNesting),
                                   location);
            }
            reading.scopes.push_back(&dictionary);
            carryOut(statement.body);
            reading.scopes.pop_back();
            Entry entry(std::move(keyword), std::move(dictionary), std::move(location));
            entry.setPattern(isPattern);
            add(std::move(entry));
            return;
        }
        std::vector<Token> tokens;
        if (expansion == Expansion::none || statement.isLiteral)
        {
            tokens = statement.value;
        }
        else
        {
            expandValue(reading, statement.value, tokens);
        }
        Entry entry(std::move(keyword), std::move(tokens), reading.source, std::move(location));
        entry.setPattern(isPattern);
        add(std::move(entry));
    }

    void addList(const Statement& statement)
    {
        // No keyword can look like this one.
        std::string keyword = "#list" + std::to_string(current().entries().size());
        std::vector<Token> tokens;
        if (expansion == Expansion::none || statement.isLiteral)
        {
            tokens = statement.value;
        }
        else
        {
            expandValue(reading, statement.value, tokens);
        }
        SourceLocation location = current().location();
        location.file = tokens.front().file->name;
        location.line = tokens.front().line;
        add(Entry(std::move(keyword), std::move(tokens), reading.source, std::move(location)));
    }

    void add(Entry entry)
    {
        Dictionary& dictionary = current();
        if (entry.isPattern())
        {
            patternMatcher(entry.keyword(),
                           entry.location()); // refused here rather than when it is looked for
        }
        if (Entry* existing = dictionary.findExact(entry.keyword()))
        {
            switch (mode)
            {
            case InputMode::merge:
                break;
            case InputMode::overwrite:
                if (existing->isDictionary())
                {
                    existing->dictionary().clear();
                }
                break;
            case InputMode::protect:
                return;
            case InputMode::warn:
                printWarning(fmt::format("{} is given twice, first at line {}; the first is kept.",
                                         entry.keyword(), existing->location().line),
                             entry.location());
                return;
            case InputMode::error:
                throw FatalIOError(fmt::format("{} is given twice, first at line {}. Remove one of them.",
                                               entry.keyword(), existing->location().line),
                                   entry.location());
            }
        }
        dictionary.merge(std::move(entry));
    }

    // ----------------------------------------------------------------------------------------------------
    // macros

    /// `$name;` as a statement: the entries of that dictionary.
    void mergeMacro(const Token& macro)
    {
        const SourceLocation location = locationOf(reading, macro);
        const std::string name = nameOf(reading, macro.text, location);
        const Entry* entry = lookUp(name, reading.scopes);
        if (!entry)
        {
            failUndefined(reading.scopes, name, location);
        }
        entry->markUsed();
        if (!entry->isDictionary())
        {
            throw FatalIOError(
                fmt::format("${} as a whole entry must stand for a dictionary, but {} is a value. Is "
                            "`keyword ${};` meant?",
                            name, name, name),
                location);
        }
        const Dictionary copied = entry->dictionary();
        countExpanded(reading, tokenCountOf(copied), location);
        if (static_cast<int>(reading.scopes.size()) + depthOf(copied) > deepestNesting + 1)
        {
            throw FatalIOError(fmt::format("Macros nest dictionaries more than {} deep.", deepestNesting),
                               location);
        }
        for (const Entry& inner : copied.entries())
        {
            add(inner);
        }
    }

    // ------------------------------------------------------------------------------------------------
    // directives

    void direct(const Statement& statement)
    {
        const Token& directive = statement.keyword;
        const std::string_view name = directive.text;
        if (isInclude(directive))
        {
            if (statement.value.size() != 1 || statement.value.front().kind != TokenKind::string)
            {
                failArgument(reading, directive, "the name of a file: #include \"name\"");
            }
            if (const auto path = included(reading, directive, statement.value.front()))
            {
                const SourceFile& file = load(reading, *path, locationOf(reading, directive));
                reading.openFiles.push_back(*path);
                for (const Statement& inner : parseStatements(file))
                {
                    // The header is of the file that it stands in.
                    if (inner.keyword.text != "FoamFile")
                    {
                        carryOut(inner);
                    }
                }
                reading.openFiles.pop_back();
            }
        }
        else if (name == "#remove")
        {
            removeEntries(statement);
        }
        else if (name == "#inputMode")
        {
            setInputMode(statement);
        }
        else if (name == "#message" || name == "#printMessage")
        {
            return;
        }
        else
        {
            failUnknownDirective(reading, directive);
        }
    }

    void removeEntries(const Statement& statement)
    {
        bool any = false;
        for (const Token& token : statement.value)
        {
            if (token.is('(') || token.is(')'))
            {
                continue;
            }
            any = true;
            const std::string name(token.text);
            if (token.kind != TokenKind::string)
            {
                current().remove(name);
                continue;
            }
            const auto matches = patternMatcher(name, locationOf(reading, statement.keyword));
            for (const std::string& keyword : current().keywords())
            {
                if (keyword == name || matches(keyword))
                {
                    current().remove(keyword);
                }
            }
        }
        if (!any)
        {
            failArgument(reading, statement.keyword,
                         "the entries that are to go: #remove name, or #remove (a \"b.*\")");
        }
    }

    void setInputMode(const Statement& statement)
    {
        const std::string word(statement.value.empty() ? "" : statement.value.front().text);
        isModeGiven = true;
        if (word == "merge" || word == "default")
        {
            mode = InputMode::merge;
        }
        else if (word == "overwrite")
        {
            mode = InputMode::overwrite;
        }
        else if (word == "protect")
        {
            mode = InputMode::protect;
        }
        else if (word == "warn")
        {
            mode = InputMode::warn;
        }
        else if (word == "error")
        {
            mode = InputMode::error;
        }
        else
        {
            throw FatalIOError(
                unknownWordMessage("inputMode", word,
                                   {"default", "error", "merge", "overwrite", "protect", "warn"}),
                locationOf(reading, statement.keyword));
        }
    }

    Expansion expansion;
    DictionaryReading reading;
    InputMode mode = InputMode::merge;
    bool isModeGiven = false;
};

} // namespace

Dictionary Dictionary::readFile(const std::filesystem::path& file, Expansion expansion)
{
    FilesInMemory* files = expansion == Expansion::all ? FilesInMemory::current() : nullptr;
    if (!files)
    {
        return Reader(expansion).readFile(file);
    }
    if (const Dictionary* known = files->find(file))
    {
        return *known;
    }
    Reader reader(expansion);
    Dictionary dictionary = reader.readFile(file);
    files->keep(file, dictionary, reader.sourceNames());
    return dictionary;
}

Dictionary Dictionary::readFileIfPresent(const std::filesystem::path& file, Expansion expansion)
{
    std::error_code error;
    if (!isInMemory(file) && !std::filesystem::exists(file, error) && !error)
    {
        return Dictionary(SourceLocation{file.lexically_normal().string(), "", 0});
    }
    return readFile(file, expansion);
}

Dictionary Dictionary::readString(std::string_view text, const std::string& name, Expansion expansion)
{
    return Reader(expansion).readText(text, name);
}

} // namespace drystone
