// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Dictionaries inside lists of tokens: `( { a 1; } name { b 2; } )`.
#include "dictionary/Dictionary.h"
#include "dictionary/EntryPath.h"
#include "dictionary/RepeatedKey.h"

#include <fmt/format.h>

#include <functional>
#include <map>

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

Dictionary readBraced(TokenCursor& cursor, const std::shared_ptr<SourceText>& source, SourceLocation location,
                      int depth)
{
    if (depth > deepestNesting)
    {
        cursor.fail(fmt::format("Dictionaries are nested more than {} deep.", deepestNesting));
    }
    Dictionary dictionary(location);
    std::map<std::string_view, const Token*> first; // of each key that is written between these brackets
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
        const SourceLocation entryLocation{key.file->name, joined(location.entry, std::string(key.text)),
                                           key.line};
        if (isWritten(key))
        {
            const auto [earlier, isFirst] = first.try_emplace(key.text, &key);
            if (!isFirst)
            {
                // Input modes, which may ask for it outside of lists, there are none here.
                printWarningOnce(repeatedKeyText(key.text, earlier->second->line, cursor.isNext('{')) + ".",
                                 entryLocation);
            }
        }
        if (cursor.isNext('{'))
        {
            Entry entry(std::string(key.text), readBraced(cursor, source, entryLocation, depth + 1),
                        entryLocation);
            entry.setPattern(key.kind == TokenKind::string);
            dictionary.merge(std::move(entry));
            continue;
        }
        std::vector<Token> tokens;
        int open = 0;
        while (open > 0 || !cursor.isNext(';'))
        {
            if (cursor.atEnd() || (open == 0 && cursor.isNext('}')))
            {
                before.fail(fmt::format("A `;` is missing after the value of {}.", key.text));
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
        Entry entry(std::string(key.text), std::move(tokens), source, entryLocation);
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
