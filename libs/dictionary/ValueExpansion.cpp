// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Goes from token to token, calls itself for included files, and passes on to macros which bracket is open.
#include "dictionary/ValueExpansion.h"

#include "dictionary/IncludedFiles.h"
#include "dictionary/MacroExpansion.h"

#include <algorithm>
#include <cstdlib>
#include <string>

namespace drystone
{

void failUnknownDirective(const DictionaryReading& reading, const Token& directive)
{
    if (directive.text == "#codeStream" || directive.text == "#includeFunc" || directive.text == "#system")
    {
        throw FatalIOError(
            fmt::format("{} is not supported: dictionaries of Drystone never run code.", directive.text),
            locationOf(reading, directive));
    }
    const std::vector<std::string> known = {"#calc",      "#else",       "#endif",
                                            "#eval",      "#if",         "#ifeq",
                                            "#include",   "#includeEtc", "#includeIfPresent",
                                            "#inputMode", "#remove"};
    if (std::find(known.begin(), known.end(), directive.text) != known.end())
    {
        const bool isValue = directive.text == "#calc" || directive.text == "#eval";
        throw FatalIOError(
            fmt::format("{} cannot stand here: {}.", directive.text,
                        isValue ? "it is the value of an entry, as in `width #calc \"2*3\";`"
                                : "it stands where an entry would; a `;` may be missing before it"),
            locationOf(reading, directive));
    }
    throw FatalIOError(unknownWordMessage("directive", directive.text, known),
                       locationOf(reading, directive));
}

void expandValue(DictionaryReading& reading, const std::vector<Token>& tokens, std::vector<Token>& into)
{
    std::string brackets = ";";
    for (std::size_t i = 0; i < tokens.size(); ++i)
    {
        const Token& token = tokens[i];
        if (token.is('(') || token.is('[') || token.is('{'))
        {
            brackets.push_back(token.text.front());
        }
        else if ((token.is(')') || token.is(']') || token.is('}')) && brackets.size() > 1)
        {
            brackets.pop_back();
        }
        if (token.kind == TokenKind::macro)
        {
            expandMacro(reading, token, into, brackets.back());
        }
        else if (token.kind != TokenKind::directive)
        {
            into.push_back(token);
        }
        else if (token.text == "#calc" || token.text == "#eval")
        {
            if (i + 1 == tokens.size())
            {
                failArgument(reading, token, "an expression: #calc \"2*$length\"");
            }
            appendResult(reading, token, tokens[++i], into);
        }
        else if (isInclude(token))
        {
            if (i + 1 == tokens.size() || tokens[i + 1].kind != TokenKind::string)
            {
                failArgument(reading, token, "the name of a file: #include \"name\"");
            }
            const Token& name = tokens[++i];
            if (const auto path = included(reading, token, name))
            {
                const SourceFile& file = load(reading, *path, locationOf(reading, token));
                reading.openFiles.push_back(*path);
                const std::vector<Token> content = parseTokens(file);
                countExpanded(reading, content.size(), locationOf(reading, token));
                expandValue(reading, content, into);
                reading.openFiles.pop_back();
            }
        }
        else
        {
            failUnknownDirective(reading, token);
        }
    }
}

bool isTrue(DictionaryReading& reading, const Statement& statement)
{
    std::vector<Token> tokens;
    expandValue(reading, statement.value, tokens);
    const SourceLocation location = locationOf(reading, statement.keyword);
    if (statement.keyword.text == "#ifeq")
    {
        if (tokens.size() != 2)
        {
            throw FatalIOError(fmt::format("#ifeq compares two words, but {} are given.", tokens.size()),
                               location);
        }
        if (tokens[0].kind == TokenKind::number && tokens[1].kind == TokenKind::number)
        {
            return std::strtod(std::string(tokens[0].text).c_str(), nullptr)
                   == std::strtod(std::string(tokens[1].text).c_str(), nullptr);
        }
        return tokens[0].text == tokens[1].text;
    }
    Entry condition("#if", std::move(tokens), reading.source, location);
    if (condition.tokens().size() == 1 && condition.tokens().front().kind == TokenKind::number)
    {
        return condition.as<double>() != 0;
    }
    return condition.as<bool>();
}

} // namespace drystone
