// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Stacks of open statements and brackets, from which messages know what was left open and where.
#include "dictionary/StatementBuilder.h"

#include "dictionary/Dictionary.h"
#include "dictionary/DictionaryScanner.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fmt/format.h>

namespace drystone
{
namespace
{

/// Where a blank of Unicode is that looks like one of the keyboard, as texts of pages and of word processors
/// have them, or of no width at all; npos where there is none. In a quoted string it may stay.
std::size_t foreignBlank(std::string_view text)
{
    for (std::size_t at = text.find_first_of("\xC2\xE2\xE3"); at != std::string_view::npos;
         at = text.find_first_of("\xC2\xE2\xE3", at + 1))
    {
        const std::string_view ahead = text.substr(at);
        const bool isOfGeneralPunctuation =
            ahead.starts_with("\xE2\x80") && ahead.size() > 2
            && (static_cast<unsigned char>(ahead[2]) <= 0x8F || ahead[2] == '\xAF');
        if (ahead.starts_with("\xC2\xA0") || isOfGeneralPunctuation || ahead.starts_with("\xE3\x80\x80"))
        {
            return at;
        }
    }
    return std::string_view::npos;
}

} // namespace

Token StatementBuilder::token(TokenKind kind, const char* begin, const char* end)
{
    return {std::string_view(begin, static_cast<std::size_t>(end - begin)), &file, lineOf(begin), kind};
}

void StatementBuilder::requireBlanks(const Token& word)
{
    if (word.kind != TokenKind::word)
    {
        return;
    }
    const std::size_t at = foreignBlank(word.text);
    if (at != std::string_view::npos)
    {
        throw error(
            fmt::format("In `{}` there is a blank that is none of the keyboard's, {}, such as a no-break "
                        "space of a text that was copied. Type an ordinary blank there.",
                        word.text,
                        at == 0 ? "at its beginning" : fmt::format("after `{}`", word.text.substr(0, at))),
            word.line);
    }
}

void StatementBuilder::add(const Token& added)
{
    if (added.kind == TokenKind::word && added.text.size() > longestWord)
    {
        throw error("A word of more than " + std::to_string(longestWord)
                        + " letters. Is this a text file? Strings go between quotes.",
                    added.line);
    }
    requireBlanks(added);
    if (open.empty())
    {
        looseTokens.push_back(added);
        return;
    }
    Statement& statement = open.back();
    if (added.kind == TokenKind::macro || added.kind == TokenKind::directive)
    {
        statement.isLiteral = false;
    }
    statement.value.push_back(added);
}

std::size_t StatementBuilder::addBinaryList(const char* begin, const char* end)
{
    static constexpr std::string_view type = "List<scalar>";
    const std::string_view ahead(begin, static_cast<std::size_t>(end - begin));
    if (!isBinary || !ahead.starts_with(type))
    {
        return 0;
    }
    const auto skipSpaces = [end](const char* at) { return std::find_if_not(at, end, isSpace); };
    const char* count = skipSpaces(begin + type.size());
    const char* countEnd = std::find_if_not(count, end, isDigit);
    const char* bracket = skipSpaces(countEnd);
    std::size_t numbers = 0;
    const auto [read, failure] = std::from_chars(count, countEnd, numbers);
    if (failure != std::errc() || read == count || bracket == end || *bracket != '(')
    {
        throw error("A binary list is written `List<scalar> N(`, the bytes of N numbers and `)`.",
                    lineOf(begin));
    }
    const char* bytes = bracket + 1;
    const auto left = static_cast<std::size_t>(end - bytes);
    if (left / sizeof(double) < numbers || left - numbers * sizeof(double) == 0)
    {
        throw error("The file ends within a list of " + std::to_string(numbers) + " numbers.", lineOf(begin));
    }
    const char* close = bytes + numbers * sizeof(double);
    if (*close != ')')
    {
        throw error("The bytes of a list of " + std::to_string(numbers)
                        + " numbers are not followed by `)`. Was the file changed by a text editor?",
                    lineOf(begin));
    }
    add(token(TokenKind::word, begin, begin + type.size()));
    add(token(TokenKind::number, count, countEnd));
    add(token(TokenKind::punctuation, bracket, bytes));
    add(token(TokenKind::bytes, bytes, close));
    add(token(TokenKind::punctuation, close, close + 1));
    return static_cast<std::size_t>(close + 1 - begin);
}

void StatementBuilder::begin(Statement::Kind kind, const Token& keyword, const char* at)
{
    if (keyword.text.size() > longestWord)
    {
        throw error("A keyword of more than " + std::to_string(longestWord)
                        + " letters. Is this a text file?",
                    keyword.line);
    }
    requireBlanks(keyword);
    Statement statement;
    statement.kind = kind;
    statement.keyword = keyword;
    statement.begin = offset(at);
    open.push_back(std::move(statement));
}

void StatementBuilder::end(const char* at)
{
    Statement finished = std::move(open.back());
    open.pop_back();
    finished.end = offset(at);
    if (open.empty())
    {
        statements.push_back(std::move(finished));
    }
    else
    {
        Statement& parent = open.back();
        const bool inOtherwise = !otherwiseOf.empty() && otherwiseOf.back() == open.size();
        (inOtherwise ? parent.otherwise : parent.body).push_back(std::move(finished));
    }
}

void StatementBuilder::openBracket(const char* at)
{
    brackets.push_back({*at, lineOf(at)});
    enter(brackets.back().line);
}

void StatementBuilder::closeBracket()
{
    brackets.pop_back();
    --depth;
}

void StatementBuilder::openCondition(int line)
{
    brackets.push_back({'#', line});
    enter(line);
}

void StatementBuilder::closeCondition()
{
    if (!otherwiseOf.empty() && otherwiseOf.back() == open.size())
    {
        otherwiseOf.pop_back();
    }
    closeBracket();
}

int StatementBuilder::lineOf(const char* at)
{
    if (at < countedTo)
    {
        countedTo = text.data();
        countedLines = 1;
    }
    countedLines += static_cast<int>(std::count(countedTo, at, '\n'));
    countedTo = at;
    return countedLines;
}

FatalIOError StatementBuilder::error(const std::string& message, int line) const
{
    std::string path;
    for (const Statement& statement : open)
    {
        if (statement.kind == Statement::Kind::condition || statement.keyword.text.empty())
        {
            continue;
        }
        if (!path.empty())
        {
            path += '/';
        }
        path += statement.keyword.text.substr(0, 80);
    }
    return FatalIOError(message, SourceLocation{file.name, path, line});
}

std::string StatementBuilder::found(const char* at) const
{
    const char* end = text.data() + text.size();
    if (at == end)
    {
        return "the end of the file";
    }
    std::size_t length = wordLength(at, end);
    length = std::clamp<std::size_t>(length, 1, 40);
    return fmt::format("`{}`", std::string_view(at, length));
}

void StatementBuilder::failMissingSemicolon(const char* at)
{
    const Statement& statement = open.back();
    const std::string key(statement.keyword.text);
    if (at != text.data() + text.size() && (*at == ')' || *at == ']'))
    {
        throw error(
            "There is a `" + std::string(1, *at)
                + "` without the bracket that would open it. Remove it, or add the one that is missing.",
            lineOf(at));
    }
    if (at == text.data() + text.size() || *at == '}')
    {
        // A value that goes on in another line with a word, outside brackets: there an entry was meant to
        // begin, and it is its end that comes as a surprise.
        int depthOfBrackets = 0;
        for (std::size_t i = 0; i < statement.value.size(); ++i)
        {
            const Token& token = statement.value[i];
            const int lineBefore = i > 0 ? statement.value[i - 1].line : statement.keyword.line;
            if (i > 0 && depthOfBrackets == 0 && token.kind == TokenKind::word && token.line > lineBefore)
            {
                throw error(
                    fmt::format("The value of {} goes on with `{}` at line {}. Is a `;` missing at the "
                                "end of line {}?",
                                key, token.text.substr(0, 80), token.line, lineBefore),
                    lineBefore);
            }
            depthOfBrackets += token.is('(') || token.is('[') || token.is('{') ? 1 : 0;
            depthOfBrackets -= token.is(')') || token.is(']') || token.is('}') ? 1 : 0;
        }
        const int line = statement.value.empty() ? statement.keyword.line : statement.value.back().line;
        throw error("A `;` is missing after the value of " + key + ": " + found(at)
                        + " came first. Write `;` at the end of line " + std::to_string(line) + ".",
                    line);
    }
    failUnexpected(at);
}

void StatementBuilder::failUnclosed(char closing, const char* at)
{
    const Bracket opened = brackets.back();
    const bool atEnd = at == text.data() + text.size();
    if (!atEnd && !std::strchr(")]};#", *at))
    {
        failUnexpected(at);
    }
    if (!atEnd && *at == '#' && opened.character != '#')
    {
        throw error("Unexpected " + found(at) + " where the bracket of line " + std::to_string(opened.line)
                        + " is still open. A condition and what it governs are to hold whole entries.",
                    lineOf(at));
    }
    const std::string openedText =
        opened.character == '#' ? "condition" : fmt::format("`{}`", opened.character);
    const std::string closingText = closing == '#' ? "`#endif`" : fmt::format("`{}`", closing);
    throw error("The " + openedText + " of line " + std::to_string(opened.line) + " is not closed: "
                    + found(at) + " came at line " + std::to_string(lineOf(at)) + " before the " + closingText
                    + ". Write " + closingText + " where it belongs, or remove what is too much.",
                opened.line);
}

void StatementBuilder::failUnexpected(const char* at)
{
    const int line = lineOf(at);
    const char* end = text.data() + text.size();
    if (at != end)
    {
        if (*at == '}')
        {
            throw error("There is a `}` without a `{`. Remove it, or add the `{` that is missing.", line);
        }
        if (*at == ')' || *at == ']')
        {
            throw error("There is a `" + std::string(1, *at)
                            + "` without the bracket that would open it. Remove it, or add the one that "
                              "is missing.",
                        line);
        }
        if (*at == '{')
        {
            throw error("There is a `{` without a keyword before it. Write `name { ... }`.", line);
        }
        if (*at == '#')
        {
            throw error("There is " + found(at) + " without a condition that it belongs to.", line);
        }
        if (*at == '$')
        {
            throw error("A `$` is to be followed by the name of an entry: `$name` or `${name}`.", line);
        }
    }
    throw error("Unexpected " + found(at)
                    + ". An entry is written `key value;` or `key { ... }`, with quotes "
                      "around a value of other characters than letters, digits and _.",
                line);
}

void StatementBuilder::enter(int line)
{
    if (++depth > deepestNesting)
    {
        throw error("Brackets are nested more than " + std::to_string(deepestNesting)
                        + " deep. Is a closing bracket missing?",
                    line);
    }
}

} // namespace drystone
