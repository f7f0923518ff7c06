// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Replaces macros from the inside out; texts made on the way are parsed as if they stood at the macro.
#include "dictionary/MacroExpansion.h"

#include "dictionary/DictionaryGrammar.h"
#include "dictionary/Expression.h"
#include "dictionary/MacroNames.h"

#include <cctype>
#include <cstdlib>
#include <stdexcept>

namespace drystone
{
namespace
{

/// Tokens that macros and includes may add.
constexpr std::size_t mostExpandedTokens = 10'000'000;
/// `${${...}}` inside each other.
constexpr int deepestMacro = 20;

std::string textOfMacro(const DictionaryReading& reading, std::string_view macro,
                        const SourceLocation& location, int depth)
{
    const std::string name = nameOf(reading, macro, location, depth);
    const auto [plainName, fallback] = withFallback(name);
    const Entry* entry = lookUp(plainName, reading.scopes);
    if (!entry)
    {
        if (const char* variable = std::getenv(plainName.c_str()))
        {
            return variable;
        }
        if (fallback)
        {
            return *fallback;
        }
        failUndefined(reading.scopes, plainName, location);
    }
    entry->markUsed();
    if (entry->isDictionary())
    {
        throw FatalIOError(fmt::format("${} is a dictionary, but a value is wanted here.", plainName),
                           location);
    }
    const std::vector<Token>& tokens = entry->tokens();
    if (tokens.size() == 1 && tokens.front().kind == TokenKind::string)
    {
        return std::string(tokens.front().text);
    }
    return entry->valueText();
}

/// Tokens of a text made while reading, which count as standing where `origin` stands.
void appendText(DictionaryReading& reading, const std::string& text, const Token& origin,
                std::vector<Token>& into)
{
    reading.source->files.push_back({origin.file->name, text});
    std::vector<Token> tokens = parseTokens(reading.source->files.back());
    countExpanded(reading, tokens.size(), locationOf(reading, origin));
    for (Token& token : tokens)
    {
        token.line = origin.line;
        token.file = origin.file;
        into.push_back(token);
    }
}

/// Past the name of the macro whose `$` is at a place; the place after that where no name follows.
std::size_t endOfMacro(std::string_view text, std::size_t dollar, const SourceLocation& location)
{
    std::size_t end = dollar + 1;
    if (end < text.size() && text[end] == '{')
    {
        int open = 0;
        for (; end < text.size(); ++end)
        {
            if (text[end] == '{')
            {
                ++open;
            }
            else if (text[end] == '}' && --open == 0)
            {
                return end + 1;
            }
        }
        throw FatalIOError("The `${` here is not closed: write `${name}`.", location);
    }
    while (end < text.size()
           && (std::isalnum(static_cast<unsigned char>(text[end])) != 0 || text[end] == '_'
               || text[end] == '.' || text[end] == ':'))
    {
        ++end;
    }
    return end;
}

} // namespace

std::string nameOf(const DictionaryReading& reading, std::string_view text, const SourceLocation& location,
                   int depth)
{
    if (depth > deepestMacro)
    {
        throw FatalIOError(fmt::format("Macros are nested more than {} deep.", deepestMacro), location);
    }
    text.remove_prefix(1);
    if (!text.starts_with('{'))
    {
        return std::string(text);
    }
    return substituted(reading, text.substr(1, text.size() - 2), location, depth + 1);
}

std::string substituted(const DictionaryReading& reading, std::string_view text,
                        const SourceLocation& location, int depth)
{
    std::string result;
    for (std::size_t i = 0; i < text.size();)
    {
        if (text[i] != '$')
        {
            result += text[i++];
            continue;
        }
        const std::size_t end = endOfMacro(text, i, location);
        if (end == i + 1)
        {
            throw FatalIOError("A `$` is to be followed by the name of an entry: `$name` or `${name}`.",
                               location);
        }
        result += textOfMacro(reading, text.substr(i, end - i), location, depth);
        if (result.size() > 1'000'000)
        {
            throw FatalIOError("The macros of this text make it too long.", location);
        }
        i = end;
    }
    return result;
}

void countExpanded(DictionaryReading& reading, std::size_t count, const SourceLocation& location)
{
    reading.expandedTokens += count;
    if (reading.expandedTokens > mostExpandedTokens)
    {
        throw FatalIOError("The macros of this dictionary make it too large. Does an entry double itself?",
                           location);
    }
}

void expandMacro(DictionaryReading& reading, const Token& macro, std::vector<Token>& into, char bracket)
{
    const SourceLocation location = locationOf(reading, macro);
    const auto [name, fallback] = withFallback(nameOf(reading, macro.text, location));
    const Entry* entry = lookUp(name, reading.scopes);
    if (!entry)
    {
        const char* variable = std::getenv(name.c_str());
        if (!variable && !fallback)
        {
            failUndefined(reading.scopes, name, location);
        }
        appendText(reading, variable ? variable : *fallback, macro, into);
        return;
    }
    entry->markUsed();
    if (entry->isDictionary())
    {
        // Its entries can only stand where entries can, as in `( { $defaults; mu 0.5; } )`.
        if (bracket != '{')
        {
            throw FatalIOError(
                fmt::format("${} is a dictionary, but a value is wanted here. To copy its entries "
                            "into another dictionary, write `name {{ ${}; }}`.",
                            name, name),
                location);
        }
        appendText(reading, toText(entry->dictionary()), macro, into);
        return;
    }
    countExpanded(reading, entry->tokens().size(), location);
    into.insert(into.end(), entry->tokens().begin(), entry->tokens().end());
}

void appendResult(DictionaryReading& reading, const Token& directive, const Token& argument,
                  std::vector<Token>& into)
{
    const SourceLocation location = locationOf(reading, directive);
    if (argument.kind != TokenKind::string && argument.kind != TokenKind::verbatim)
    {
        failArgument(reading, directive, "an expression between quotes: #calc \"2*$length\"");
    }
    const std::string expression = substituted(reading, argument.text, location);
    try
    {
        appendText(reading, fmt::format("{}", evaluateExpression(expression)), directive, into);
    }
    catch (const std::invalid_argument& error)
    {
        throw FatalIOError(
            fmt::format("The arithmetic `{}` cannot be done: {}. It may hold numbers, macros, + - * "
                        "/ ^ ( ), comparisons and functions as sin, sqrt, pow, min, max, degToRad.",
                        expression.substr(0, 200), error.what()),
            location);
    }
}

} // namespace drystone
