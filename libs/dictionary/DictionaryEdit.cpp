// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Edits of a dictionary's text by the places of its statements.
#include "dictionary/DictionaryEdit.h"

#include "core/WholeFile.h"
#include "dictionary/Dictionary.h"
#include "dictionary/DictionaryGrammar.h"
#include "dictionary/DictionaryScanner.h"
#include "dictionary/GivenEntry.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace drystone
{

namespace
{

/// A directive with nothing after it would take the next statement for its argument: one that is added, say.
void refuseBareDirectives(const std::vector<Statement>& statements, const std::string& file)
{
    for (const Statement& statement : statements)
    {
        if (statement.kind == Statement::Kind::directive && statement.value.empty())
        {
            throw FatalIOError(
                fmt::format("{} has no argument. Give it one, or remove it.", statement.keyword.text),
                SourceLocation{file, "", statement.keyword.line});
        }
        refuseBareDirectives(statement.body, file);
        refuseBareDirectives(statement.otherwise, file);
    }
}

/// The text of a file and the statements it consists of.
struct Edited
{
    Edited(const std::string& text, const std::filesystem::path& path)
        : file{path.lexically_normal().string(), text}, statements(parseStatements(file))
    {
        refuseBareDirectives(statements, file.name);
    }
    Edited(const Edited&) = delete;

    SourceFile file;
    std::vector<Statement> statements;
};

/// All statements of a path that count, in the order of the text: those of a sub-dictionary that a value of
/// the same name replaces further down do not.
/// \param level of the path that `statements` are at
std::vector<const Statement*> find(const std::vector<Statement>& statements,
                                   const std::vector<std::string>& keywords, std::size_t level = 0)
{
    // A sub-dictionary that is given twice is one, with both bodies.
    std::vector<const std::vector<Statement>*> bodies{&statements};
    for (;; ++level)
    {
        std::vector<const Statement*> found;
        std::vector<const std::vector<Statement>*> inner;
        for (const std::vector<Statement>* body : bodies)
        {
            for (const Statement& statement : *body)
            {
                if (!isKeyed(statement) || statement.keyword.text != keywords[level])
                {
                    continue;
                }
                found.push_back(&statement);
                if (statement.kind == Statement::Kind::dictionary)
                {
                    inner.push_back(&statement.body);
                }
                else
                {
                    inner.clear();
                }
            }
        }
        if (level + 1 == keywords.size())
        {
            return found;
        }
        bodies = std::move(inner);
    }
}

/// Which statement of a path, or which value in place of one of its sub-dictionaries, is in a branch of a
/// condition, so that changing the entry may change nothing.
const Statement* findInCondition(const std::vector<Statement>& statements,
                                 const std::vector<std::string>& keywords, std::size_t level)
{
    for (const Statement& statement : statements)
    {
        if (statement.kind == Statement::Kind::condition)
        {
            for (const auto* branch : {&statement.body, &statement.otherwise})
            {
                for (auto end = keywords.begin() + level + 1; end <= keywords.end(); ++end)
                {
                    const std::vector<const Statement*> found = find(*branch, {keywords.begin(), end}, level);
                    if (!found.empty()
                        && (end == keywords.end() || found.back()->kind == Statement::Kind::entry))
                    {
                        return found.back();
                    }
                }
                if (const Statement* deeper = findInCondition(*branch, keywords, level))
                {
                    return deeper;
                }
            }
        }
        else if (statement.kind == Statement::Kind::dictionary && statement.keyword.text == keywords[level]
                 && level + 1 < keywords.size())
        {
            if (const Statement* deeper = findInCondition(statement.body, keywords, level + 1))
            {
                return deeper;
            }
        }
    }
    return nullptr;
}

void refuseConditions(const Edited& edited, const std::vector<std::string>& keywords, std::string_view path)
{
    if (const Statement* statement = findInCondition(edited.statements, keywords, 0))
    {
        throw FatalIOError(
            fmt::format("{} depends on a condition (#if or #ifeq), so it is not edited. Edit the file "
                        "by hand.",
                        path),
            SourceLocation{edited.file.name, std::string(path), statement->keyword.line});
    }
}

/// Blanks in front of the line that a place is in.
std::string indentationAt(const std::string& text, std::size_t place)
{
    const std::size_t lineBegin = text.rfind('\n', place == 0 ? 0 : place - 1);
    const std::size_t begin = lineBegin == std::string::npos ? 0 : lineBegin + 1;
    const std::size_t end = std::min(text.find_first_not_of(" \t", begin), text.size());
    return text.substr(begin, end - begin);
}

/// Where the line ends, its `\n` included, on which nothing but comments stands from a place on. A comment of
/// several lines belongs to the line it begins on: what is added after that line must not be part of it.
std::size_t lineEndAfterComments(const std::string& text, std::size_t place)
{
    while (place < text.size() && text[place] != '\n')
    {
        if (text.compare(place, 2, "/*") == 0)
        {
            place = text.find("*/", place + 2) + 2; // the text has been parsed: its comments are closed
        }
        else if (text.compare(place, 2, "//") == 0)
        {
            place = std::min(text.find('\n', place), text.size());
        }
        else
        {
            ++place;
        }
    }
    return place == text.size() ? place : place + 1;
}

/// A point may be in a keyword, alpha.water, or stand between two, limitAnalysis.tolerance: the latter when
/// no entry has such a name and what is in front of the last point is a sub-dictionary.
std::string withSlashes(const Dictionary& dictionary, std::string_view path)
{
    std::string slashed(path);
    std::replace(slashed.begin(), slashed.end(), '.', '/');
    const std::size_t last = slashed.rfind('/');
    if (last == std::string::npos || dictionary.findPath(path))
    {
        return std::string(path);
    }
    const Entry* parent = dictionary.findPath(slashed.substr(0, last));
    return parent && parent->isDictionary() ? slashed : std::string(path);
}

std::string entryText(const std::string& keyword, const std::string& value, const std::string& indentation)
{
    if (isDictionaryText(value))
    {
        return fmt::format("{}{}\n{}{}\n", indentation, keyword, indentation, value);
    }
    return fmt::format("{}{:<15} {};\n", indentation, keyword, value);
}

/// Lines that end as those of a text do, which may be a file of Windows.
std::string linesAsIn(const std::string& text, const std::string& lines)
{
    const std::size_t end = text.find('\n');
    if (end == std::string::npos || end == 0 || text[end - 1] != '\r')
    {
        return lines;
    }
    std::string result;
    for (const char c : lines)
    {
        if (c == '\n' && !result.ends_with('\r'))
        {
            result += '\r';
        }
        result += c;
    }
    return result;
}

/// Replace what a statement says, from the first byte of its value to the last.
std::string replaced(const std::string& text, const Statement& statement, const std::string& value)
{
    std::string result = text;
    const auto needsBlank = [&text](std::size_t at)
    { return at > 0 && std::isspace(static_cast<unsigned char>(text[at - 1])) == 0; };
    const bool wasDictionary = statement.kind == Statement::Kind::dictionary;
    if (wasDictionary)
    {
        // valueBegin is after `{`, end after `}`.
        const std::size_t begin = statement.valueBegin - 1;
        return result.replace(
            begin, statement.end - begin,
            isDictionaryText(value) ? value : fmt::format("{}{};", needsBlank(begin) ? " " : "", value));
    }
    std::size_t begin = statement.valueBegin;
    std::size_t end = statement.valueBegin;
    if (!statement.value.empty())
    {
        // Comments before and after the value stay. A quoted token's text is without its quotes.
        const auto quotes = [](const Token& token) -> std::size_t {
            return token.kind == TokenKind::string ? 1 : token.kind == TokenKind::verbatim ? 2 : 0;
        };
        const char* base = statement.keyword.file->text.data();
        const Token& first = statement.value.front();
        const Token& last = statement.value.back();
        begin = static_cast<std::size_t>(first.text.data() - base) - quotes(first);
        end = static_cast<std::size_t>(last.text.data() - base) + last.text.size() + quotes(last);
    }
    if (isDictionaryText(value))
    {
        end = statement.end;
    }
    // A comment or byte order mark that followed a `)` would become part of a word.
    const bool standsApart = end == text.size() || text[end] == ';'
                             || std::isspace(static_cast<unsigned char>(text[end])) != 0
                             || isDictionaryText(value);
    return result.replace(begin, end - begin,
                          fmt::format("{}{}{}", needsBlank(begin) ? " " : "", value, standsApart ? "" : " "));
}

/// A new entry after the last statement of a file, before what comments may close it.
std::string withEntryAtEnd(const std::string& text, const std::vector<Statement>& statements,
                           const std::string& name, const std::string& value)
{
    const std::size_t end =
        statements.empty() ? text.size() : lineEndAfterComments(text, statements.back().end);
    std::string result = text;
    const std::string added =
        fmt::format("{}{}", end > 0 && text[end - 1] != '\n' ? "\n" : "", entryText(name, value, ""));
    return result.insert(end, linesAsIn(text, added));
}

/// A new entry at the end of a sub-dictionary.
std::string withEntryInside(const std::string& text, const Statement& parent, const std::string& name,
                            const std::string& value)
{
    const std::size_t closing = parent.valueEnd;
    std::string result = text;
    const bool onOneLine = text.find('\n', parent.valueBegin) == std::string::npos
                           || text.find('\n', parent.valueBegin) > closing;
    if (onOneLine && !isDictionaryText(value))
    {
        const bool blankBefore = closing > 0 && text[closing - 1] == ' ';
        return result.insert(closing, fmt::format("{}{} {}; ", blankBefore ? "" : " ", name, value));
    }
    const std::string outer = indentationAt(text, parent.begin);
    const std::string inner =
        parent.body.empty() || onOneLine ? outer + "    " : indentationAt(text, parent.body.back().begin);
    // In front of the line of the `}`, or of the `}` itself when it does not begin its line.
    const std::size_t lineBegin = text.rfind('\n', closing) + 1;
    const bool opensLine = text.find_first_not_of(" \t", lineBegin) == closing;
    if (opensLine)
    {
        return result.insert(lineBegin, linesAsIn(text, entryText(name, value, inner)));
    }
    const std::string added = fmt::format("\n{}{}", entryText(name, value, inner), outer);
    return result.insert(closing, linesAsIn(text, added));
}

} // namespace

std::string withEntrySet(const std::string& given, const std::filesystem::path& file, std::string_view path,
                         std::string_view value)
{
    const std::string text = withLineFeeds(given);
    const Edited edited(text, file);
    const std::vector<std::string> keywords = keywordsOf(path);
    if (keywords.empty())
    {
        throw FatalError("The entry to be set has no name.");
    }
    const std::string newValue = checkedValue(value, path);
    refuseConditions(edited, keywords, path);
    const std::vector<const Statement*> found = find(edited.statements, keywords);
    if (!found.empty())
    {
        return replaced(text, *found.back(), newValue); // of several, the last one counts
    }

    const std::string name = checkedName(givenNames(path).back());
    if (keywords.size() == 1)
    {
        return withEntryAtEnd(text, edited.statements, name, newValue);
    }

    const std::vector<const Statement*> parents =
        find(edited.statements, {keywords.begin(), keywords.end() - 1});
    if (parents.empty() || parents.back()->kind != Statement::Kind::dictionary)
    {
        throw FatalIOError(fmt::format("There is no sub-dictionary {} to add {} to. Add it first.",
                                       fmt::join(keywords.begin(), keywords.end() - 1, "/"), keywords.back()),
                           SourceLocation{edited.file.name, "", 0});
    }
    return withEntryInside(text, *parents.back(), name, newValue);
}

std::string withEntryRemoved(const std::string& given, const std::filesystem::path& file,
                             std::string_view path)
{
    const std::string text = withLineFeeds(given);
    const Edited edited(text, file);
    const std::vector<std::string> keywords = keywordsOf(path);
    if (keywords.empty())
    {
        throw FatalError("The entry to be removed has no name.");
    }
    refuseConditions(edited, keywords, path);
    const std::vector<const Statement*> found = find(edited.statements, keywords);
    std::string result = text;
    for (auto statement = found.rbegin(); statement != found.rend(); ++statement)
    {
        std::size_t begin = (*statement)->begin;
        std::size_t end = (*statement)->end;
        // A line of its own goes as a whole; with something else on it, only the blanks after the entry.
        const std::size_t lineBegin = begin == 0 ? 0 : text.rfind('\n', begin - 1) + 1;
        const std::size_t next = std::min(text.find_first_not_of(" \t", end), text.size());
        const bool beginsLine = text.find_first_not_of(" \t", lineBegin) == begin;
        const std::size_t lineEnd = text.compare(next, 2, "\r\n") == 0 ? next + 1 : next;
        if (beginsLine && (lineEnd == text.size() || text[lineEnd] == '\n'))
        {
            begin = lineBegin;
            end = lineEnd == text.size() ? lineEnd : lineEnd + 1;
        }
        else
        {
            end = next;
        }
        result.erase(begin, end - begin);
    }
    return result;
}

namespace
{

/// The dictionary with the files that it includes; nothing where one of them cannot be read.
std::optional<Dictionary> withIncludedFiles(const std::filesystem::path& file)
{
    try
    {
        return Dictionary::readFile(file);
    }
    catch (const FatalError&)
    {
        return std::nullopt;
    }
}

/// What has to be set for an entry whose sub-dictionary comes from an included file: that sub-dictionary with
/// the entry alone, which is merged with the other. For others the path and the value as they are.
std::pair<std::string, std::string> nearestEntry(const Dictionary& asWritten,
                                                 const std::filesystem::path& file, std::string_view path,
                                                 std::string_view value)
{
    std::vector<std::string> keywords = givenNames(path);
    std::string set(value);
    const auto parentOf = [&keywords]
    { return fmt::format("{}", fmt::join(keywords.begin(), keywords.end() - 1, "/")); };
    if (keywords.size() < 2 || asWritten.findPath(parentOf()))
    {
        return {std::string(path), set};
    }
    const std::optional<Dictionary> whole = withIncludedFiles(file);
    while (whole && keywords.size() > 1 && !asWritten.findPath(parentOf()))
    {
        const Entry* included = whole->findPath(parentOf());
        if (!included || !included->isDictionary())
        {
            break;
        }
        set = fmt::format("{{ {} {} }}", keywords.back(),
                          isDictionaryText(set) ? set : fmt::format("{};", checkedValue(set, path)));
        keywords.pop_back();
    }
    return {fmt::format("{}", fmt::join(keywords, "/")), set};
}

/// An entry that is not there is no fault, but may be a typing error, or somewhere else.
void warnOfAbsent(const std::filesystem::path& file, const std::string& path)
{
    const std::optional<Dictionary> whole = withIncludedFiles(file);
    if (const Entry* included = whole ? whole->findPath(path) : nullptr)
    {
        printWarning(fmt::format("{} comes from another file, which {} includes, and stays. Remove it there.",
                                 path, file.filename().string()),
                     included->location());
        return;
    }
    printWarning(fmt::format("There is no entry {}: nothing is removed.", path),
                 {file.lexically_normal().string(), "", 0});
}

} // namespace

void editFile(const std::filesystem::path& file, std::string_view givenPath, EntryEdit edit,
              std::string_view value)
{
    const Dictionary asWritten = Dictionary::readFile(file, Expansion::none);
    const std::string named = withSlashes(asWritten, withoutQuotes(givenPath));
    const Entry* present = asWritten.findPath(named);
    const bool isPattern = givenPath.find('"') != givenPath.npos; // which may be added as it is given
    const std::string path = present || !isPattern ? named : std::string(givenPath);
    if (edit == EntryEdit::add && present)
    {
        printWarning(fmt::format("{} is there already and stays as it is. Setting it would change it.", path),
                     present->location());
        return;
    }
    std::ifstream stream(file, std::ios::binary);
    const std::string text = withLineFeeds({std::istreambuf_iterator<char>(stream), {}});
    // A link stays one: what it leads to may be shared by several cases.
    const std::filesystem::path target = std::filesystem::canonical(file);
    if (edit == EntryEdit::remove)
    {
        const std::string left = withEntryRemoved(text, file, path);
        if (left == text)
        {
            warnOfAbsent(file, path);
            return;
        }
        writeWholeFile(target, left);
        return;
    }
    const auto [set, itsValue] = nearestEntry(asWritten, file, path, value);
    writeWholeFile(target, withEntrySet(text, file, set, itsValue));
}

} // namespace drystone
