// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Dictionaries inside lists of tokens: `( { a 1; } name { b 2; } )`.
#include "dictionary/Dictionary.h"
#include "dictionary/EntryPath.h"
#include "dictionary/RepeatedKey.h"

#include <fmt/format.h>

#include <functional>
#include <map>
#include <string_view>
#include <vector>

namespace drystone
{
namespace
{

/// Whether a token stands in its file as it is, and is not of a macro, which others may override.
bool isWritten(const Token& token)
{
    const std::less<> isBefore; // of any pointers, those of another text included
    return token.file && !isBefore(token.text.data(), token.file->text.data())
           && isBefore(token.text.data(), token.file->text.data() + token.file->text.size());
}

/// The tokens of a value up to its `;`, which is taken too. \param before the keyword, for the message
std::vector<Token> valueTokens(TokenCursor& cursor, const TokenCursor& before, std::string_view keyword)
{
    std::vector<Token> tokens;
    int open = 0;
    while (open > 0 || !cursor.isNext(';'))
    {
        if (cursor.atEnd() || (open == 0 && cursor.isNext('}')))
        {
            before.fail(fmt::format("A `;` is missing after the value of {}.", keyword));
        }
        const Token& token = cursor.take();
        if (token.is('(') || token.is('[') || token.is('{'))
        {
            ++open;
        }
        else if (token.is(')') || token.is(']') || token.is('}'))
        {
            --open;
        }
        tokens.push_back(token);
    }
    cursor.take();
    return tokens;
}

/// The keys that are written between one pair of brackets, of which each is to stand there once.
class WrittenKeys
{
public:
    /// Warns of a key that is given twice. \param repetition what the later value does to the earlier one
    void add(const Token& key, Repetition repetition, const SourceLocation& location)
    {
        if (!isWritten(key))
        {
            return;
        }
        const auto [earlier, isFirst] = first.try_emplace(key.text, &key);
        if (!isFirst)
        {
            // Input modes, which may require it outside of lists, there are none here.
            printWarningOnce(repeatedKeyText(key.text, earlier->second->line, repetition) + ".", location);
        }
    }

private:
    std::map<std::string_view, const Token*> first; ///< of each key
};

Dictionary readBraced(TokenCursor& cursor, const std::shared_ptr<SourceText>& source, SourceLocation location,
                      int depth)
{
    if (depth > deepestNesting)
    {
        cursor.fail(fmt::format("Dictionaries are nested more than {} deep.", deepestNesting));
    }
    Dictionary dictionary(location);
    WrittenKeys written;
    cursor.expect('{', "a dictionary `{ ... }`");
    while (!cursor.isNext('}'))
    {
        if (cursor.isNext(';'))
        {
            cursor.take();
            continue;
        }
        if (cursor.atEnd() || cursor.peek().kind == TokenKind::punctuation)
        {
            cursor.failExpected("a keyword");
        }
        const TokenCursor before = cursor;
        const Token& key = cursor.take();
        const std::string keyword(key.text);
        const SourceLocation entryLocation{key.file->name, joined(location.entry, keyword), key.line};
        const bool isDictionary = cursor.isNext('{');
        written.add(key, isDictionary ? Repetition::merges : Repetition::replaces, entryLocation);
        Entry entry =
            isDictionary ? Entry(keyword, readBraced(cursor, source, entryLocation, depth + 1), entryLocation)
                         : Entry(keyword, valueTokens(cursor, before, key.text), source, entryLocation);
        entry.setPattern(key.kind == TokenKind::string);
        dictionary.merge(std::move(entry));
    }
    cursor.take();
    return dictionary;
}

} // namespace

void read(TokenCursor& cursor, Dictionary& value)
{
    SourceLocation location = cursor.entry().location();
    // `name { ... }` in a list: the name belongs to the path.
    if (!cursor.atEnd() && !cursor.isNext('{')
        && (cursor.peek().kind == TokenKind::word || cursor.peek().kind == TokenKind::string))
    {
        location.entry = joined(location.entry, std::string(cursor.take().text));
    }
    if (!cursor.atEnd())
    {
        location.line = cursor.peek().line;
        if (cursor.peek().file)
        {
            location.file = cursor.peek().file->name;
        }
    }
    value = readBraced(cursor, cursor.entry().sourceText(), std::move(location), 0);
}

} // namespace drystone
