// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// From statements to a dictionary: macros, directives, includes, arithmetic and the merging of entries.
#include "dictionary/Dictionary.h"

#include "core/WholeFile.h"
#include "dictionary/DictionaryGrammar.h"
#include "dictionary/DictionaryPattern.h"
#include "dictionary/EntryPath.h"
#include "dictionary/Expression.h"
#include "dictionary/FilesInMemory.h"
#include "dictionary/MacroNames.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <set>

namespace drystone
{

namespace
{

/// Files that one dictionary may include, directly or not.
constexpr std::size_t mostFiles = 10'000;
/// Files that may be inside each other.
constexpr std::size_t deepestInclude = 50;
/// Tokens that macros and includes may add: entries which double each other would fill any memory.
constexpr std::size_t mostExpandedTokens = 10'000'000;
/// `${${...}}` inside each other.
constexpr int deepestMacro = 20;

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

/// The case that a file belongs to: what holds its system/ or constant/, or else its own directory.
std::filesystem::path caseOf(const std::filesystem::path& file)
{
    std::filesystem::path directory = file.parent_path();
    for (int level = 0; level < 4 && !directory.empty(); ++level)
    {
        const std::filesystem::path name = directory.filename();
        if (name == "system" || name == "constant")
        {
            return directory.parent_path().empty() ? "." : directory.parent_path();
        }
        directory = directory.parent_path();
    }
    return file.parent_path().empty() ? "." : file.parent_path();
}

std::string contentOf(const std::filesystem::path& file, const SourceLocation& whence)
{
    if (const FilesInMemory* files = FilesInMemory::current())
    {
        if (const std::string* text = files->textOf(file))
        {
            return *text;
        }
    }
    const auto fail = [&](const std::string& message) -> FatalIOError {
        return FatalIOError(message, whence.file.empty() ? SourceLocation{file.string(), "", 0} : whence);
    };
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status))
    {
        throw fail(fmt::format("The file {} does not exist.\n\nCheck its name, and whether this is the case "
                               "directory: another one is named with -case DIR.",
                               file.string()));
    }
    if (std::filesystem::is_directory(status))
    {
        throw fail(fmt::format("{} is a directory, but a file is wanted here.", file.string()));
    }
    if (!std::filesystem::is_regular_file(status))
    {
        throw fail(fmt::format("{} is not an ordinary file.", file.string()));
    }
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
    {
        throw fail(fmt::format("The file {} cannot be opened. Do you have the permission to read it?",
                               file.string()));
    }
    std::string text;
    text.resize(std::filesystem::file_size(file));
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (stream.bad())
    {
        throw fail(fmt::format("The file {} cannot be read.", file.string()));
    }
    return text;
}

class Reader
{
public:
    explicit Reader(Expansion wantedExpansion) : expansion(wantedExpansion) {}

    Dictionary readFile(const std::filesystem::path& path)
    {
        const SourceFile& file = load(path, {});
        caseDirectory = caseOf(path);
        openFiles.push_back(path);
        return readRoot(file);
    }

    /// Of all files that were read so far, those that were included among them.
    std::set<std::string> sourceNames() const
    {
        std::set<std::string> names;
        for (const SourceFile& file : source->files)
        {
            names.insert(std::filesystem::path(file.name).lexically_normal().string());
        }
        return names;
    }

    Dictionary readText(std::string_view text, const std::string& name)
    {
        source->files.push_back({name, std::string(text)});
        openFiles.emplace_back(name);
        return readRoot(source->files.back());
    }

private:
    // ------------------------------------------------------------------------------------------------
    // statements

    Dictionary readRoot(const SourceFile& file)
    {
        Dictionary root(SourceLocation{file.name, "", 1});
        scopes.push_back(&root);
        carryOut(parseStatements(file));
        return root;
    }

    Dictionary& current() { return *scopes.back(); }

    SourceLocation locationOf(const Token& token) const
    {
        std::string name(token.text);
        return {token.file->name, joined(scopes.back()->location().entry, name), token.line};
    }

    void carryOut(const std::vector<Statement>& statements)
    {
        for (const Statement& statement : statements)
        {
            carryOut(statement);
        }
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
                add(Entry(std::string(statement.keyword.text), {}, source, locationOf(statement.keyword)));
            }
            else
            {
                mergeMacro(statement.keyword);
            }
            break;
        case Statement::Kind::directive:
            if (expansion == Expansion::none)
            {
                add(Entry(std::string(statement.keyword.text), statement.value, source,
                          locationOf(statement.keyword)));
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
                carryOut(isTrue(statement) ? statement.body : statement.otherwise);
            }
            break;
        }
    }

    void addKeyed(const Statement& statement, std::string keyword)
    {
        SourceLocation location = locationOf(statement.keyword);
        // `$name { ... }` takes its keyword from an entry.
        if (statement.keyword.kind == TokenKind::macro && expansion == Expansion::all)
        {
            std::vector<Token> tokens;
            expandMacro(statement.keyword, tokens);
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
            if (scopes.size() > static_cast<std::size_t>(deepestNesting))
            {
                throw FatalIOError(fmt::format("Dictionaries are nested more than {} deep.", deepestNesting),
                                   location);
            }
            scopes.push_back(&dictionary);
            carryOut(statement.body);
            scopes.pop_back();
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
            expand(statement.value, tokens);
        }
        Entry entry(std::move(keyword), std::move(tokens), source, std::move(location));
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
            expand(statement.value, tokens);
        }
        SourceLocation location = current().location();
        location.file = tokens.front().file->name;
        location.line = tokens.front().line;
        add(Entry(std::move(keyword), std::move(tokens), source, std::move(location)));
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

    /// The name in `$name` or `${name}`, with macros inside the braces replaced.
    std::string nameOf(std::string_view text, const SourceLocation& location, int depth = 0)
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
        return substituted(text.substr(1, text.size() - 2), location, depth + 1);
    }

    /// A text in which every `$name` and `${name}` is replaced by the value of its entry.
    std::string substituted(std::string_view text, const SourceLocation& location, int depth = 0)
    {
        std::string result;
        for (std::size_t i = 0; i < text.size();)
        {
            if (text[i] != '$')
            {
                result += text[i++];
                continue;
            }
            std::size_t end = i + 1;
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
                        ++end;
                        break;
                    }
                }
                if (open != 0)
                {
                    throw FatalIOError("The `${` here is not closed: write `${name}`.", location);
                }
            }
            else
            {
                while (end < text.size()
                       && (std::isalnum(static_cast<unsigned char>(text[end])) != 0 || text[end] == '_'
                           || text[end] == '.' || text[end] == ':'))
                {
                    ++end;
                }
            }
            if (end == i + 1)
            {
                throw FatalIOError("A `$` is to be followed by the name of an entry: `$name` or `${name}`.",
                                   location);
            }
            result += textOfMacro(text.substr(i, end - i), location, depth);
            if (result.size() > 1'000'000)
            {
                throw FatalIOError("The macros of this text make it too long.", location);
            }
            i = end;
        }
        return result;
    }

    std::string textOfMacro(std::string_view macro, const SourceLocation& location, int depth)
    {
        const std::string name = nameOf(macro, location, depth);
        const auto [plainName, fallback] = withFallback(name);
        const Entry* entry = lookUp(plainName, scopes, true);
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
            failUndefined(scopes, plainName, location);
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

    /// `$name;` as a statement: the entries of that dictionary.
    void mergeMacro(const Token& macro)
    {
        const SourceLocation location = locationOf(macro);
        const std::string name = nameOf(macro.text, location);
        const Entry* entry = lookUp(name, scopes, true);
        if (!entry)
        {
            failUndefined(scopes, name, location);
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
        countExpanded(tokenCountOf(copied), location);
        if (static_cast<int>(scopes.size()) + depthOf(copied) > deepestNesting + 1)
        {
            throw FatalIOError(fmt::format("Macros nest dictionaries more than {} deep.", deepestNesting),
                               location);
        }
        for (const Entry& inner : copied.entries())
        {
            add(inner);
        }
    }

    void countExpanded(std::size_t count, const SourceLocation& location)
    {
        expandedTokens += count;
        if (expandedTokens > mostExpandedTokens)
        {
            throw FatalIOError(
                "The macros of this dictionary make it too large. Does an entry double itself?", location);
        }
    }

    /// \param bracket the innermost one that is open around the macro, `;` when there is none
    void expandMacro(const Token& macro, std::vector<Token>& into, char bracket = ';')
    {
        const SourceLocation location = locationOf(macro);
        const auto [name, fallback] = withFallback(nameOf(macro.text, location));
        const Entry* entry = lookUp(name, scopes, true);
        if (!entry)
        {
            const char* variable = std::getenv(name.c_str());
            if (!variable && !fallback)
            {
                failUndefined(scopes, name, location);
            }
            appendText(variable ? variable : *fallback, macro, into);
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
            appendText(toText(entry->dictionary()), macro, into);
            return;
        }
        countExpanded(entry->tokens().size(), location);
        into.insert(into.end(), entry->tokens().begin(), entry->tokens().end());
    }

    /// Tokens of a text made while reading, which count as standing where `origin` stands.
    void appendText(const std::string& text, const Token& origin, std::vector<Token>& into)
    {
        source->files.push_back({origin.file->name, text});
        std::vector<Token> tokens = parseTokens(source->files.back());
        countExpanded(tokens.size(), locationOf(origin));
        for (Token& token : tokens)
        {
            token.line = origin.line;
            token.file = origin.file;
            into.push_back(token);
        }
    }

    // ------------------------------------------------------------------------------------------------
    // directives

    void expand(const std::vector<Token>& tokens, std::vector<Token>& into)
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
                expandMacro(token, into, brackets.back());
            }
            else if (token.kind != TokenKind::directive)
            {
                into.push_back(token);
            }
            else if (token.text == "#calc" || token.text == "#eval")
            {
                if (i + 1 == tokens.size())
                {
                    failArgument(token, "an expression: #calc \"2*$length\"");
                }
                appendResult(token, tokens[++i], into);
            }
            else if (isInclude(token))
            {
                if (i + 1 == tokens.size() || tokens[i + 1].kind != TokenKind::string)
                {
                    failArgument(token, "the name of a file: #include \"name\"");
                }
                const Token& name = tokens[++i];
                if (const auto path = included(token, name))
                {
                    const SourceFile& file = load(*path, locationOf(token));
                    openFiles.push_back(*path);
                    const std::vector<Token> content = parseTokens(file);
                    countExpanded(content.size(), locationOf(token));
                    expand(content, into);
                    openFiles.pop_back();
                }
            }
            else
            {
                failUnknownDirective(token);
            }
        }
    }

    void appendResult(const Token& directive, const Token& argument, std::vector<Token>& into)
    {
        const SourceLocation location = locationOf(directive);
        if (argument.kind != TokenKind::string && argument.kind != TokenKind::verbatim)
        {
            failArgument(directive, "an expression between quotes: #calc \"2*$length\"");
        }
        const std::string expression = substituted(argument.text, location);
        try
        {
            appendText(fmt::format("{}", evaluateExpression(expression)), directive, into);
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

    void direct(const Statement& statement)
    {
        const Token& directive = statement.keyword;
        const std::string_view name = directive.text;
        if (isInclude(directive))
        {
            if (statement.value.size() != 1 || statement.value.front().kind != TokenKind::string)
            {
                failArgument(directive, "the name of a file: #include \"name\"");
            }
            if (const auto path = included(directive, statement.value.front()))
            {
                const SourceFile& file = load(*path, locationOf(directive));
                openFiles.push_back(*path);
                for (const Statement& inner : parseStatements(file))
                {
                    // The header is of the file that it stands in.
                    if (inner.keyword.text != "FoamFile")
                    {
                        carryOut(inner);
                    }
                }
                openFiles.pop_back();
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
            failUnknownDirective(directive);
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
            const auto matches = patternMatcher(name, locationOf(statement.keyword));
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
            failArgument(statement.keyword,
                         "the entries that are to go: #remove name, or #remove (a \"b.*\")");
        }
    }

    void setInputMode(const Statement& statement)
    {
        const std::string word(statement.value.empty() ? "" : statement.value.front().text);
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
                locationOf(statement.keyword));
        }
    }

    bool isTrue(const Statement& statement)
    {
        std::vector<Token> tokens;
        expand(statement.value, tokens);
        const SourceLocation location = locationOf(statement.keyword);
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
        Entry condition("#if", std::move(tokens), source, location);
        if (condition.tokens().size() == 1 && condition.tokens().front().kind == TokenKind::number)
        {
            return condition.as<double>() != 0;
        }
        return condition.as<bool>();
    }

    // --------------------------------------------------------------------------------------------------
    // includes

    static bool isInclude(const Token& directive)
    {
        return directive.text == "#include" || directive.text == "#includeIfPresent"
               || directive.text == "#sinclude" || directive.text == "#includeEtc"
               || directive.text == "#sincludeEtc";
    }

    /// The file that a directive names; nothing when it need not be there and is not.
    std::optional<std::filesystem::path> included(const Token& directive, const Token& argument)
    {
        const SourceLocation location = locationOf(directive);
        std::string name(argument.text);
        const auto replaceStart = [&name](std::string_view start, const std::filesystem::path& by)
        {
            if (name.starts_with(start))
            {
                name = (by / name.substr(std::min(name.size(), start.size()))).string();
            }
        };
        replaceStart("<case>/", caseDirectory);
        replaceStart("<system>/", caseDirectory / "system");
        replaceStart("<constant>/", caseDirectory / "constant");
        replaceStart("<etc>/", etcDirectory());
        name = substituted(name, location);
        if (name.empty())
        {
            failArgument(directive, "the name of a file: #include \"name\"");
        }
        std::filesystem::path path = name;
        const bool isEtc = directive.text.ends_with("Etc");
        if (path.is_relative())
        {
            path = (isEtc ? etcDirectory() : openFiles.back().parent_path()) / path;
        }
        path = path.lexically_normal();
        std::error_code error;
        if (!std::filesystem::exists(path, error))
        {
            if (directive.text == "#includeIfPresent" || directive.text.starts_with("#sinclude"))
            {
                return std::nullopt;
            }
            throw FatalIOError(fmt::format("The file {} that is to be included does not exist.{}",
                                           path.string(),
                                           isEtc ? "" : " Its name counts from the file that includes it."),
                               location);
        }
        if (openFiles.size() >= deepestInclude)
        {
            throw FatalIOError(fmt::format("Files include each other more than {} deep.", deepestInclude),
                               location);
        }
        const std::filesystem::path real = std::filesystem::weakly_canonical(path, error);
        for (const std::filesystem::path& open : openFiles)
        {
            if (std::filesystem::weakly_canonical(open, error) == real)
            {
                throw FatalIOError(
                    fmt::format("The files include each other in a loop: {} is being read already. "
                                "Remove one of the #include.",
                                path.string()),
                    location);
            }
        }
        return path;
    }

    const SourceFile& load(const std::filesystem::path& path, const SourceLocation& whence)
    {
        if (++filesRead > mostFiles)
        {
            throw FatalIOError(fmt::format("More than {} files are included.", mostFiles), whence);
        }
        source->files.push_back({path.lexically_normal().string(), contentOf(path, whence)});
        return source->files.back();
    }

    // --------------------------------------------------------------------------------------------------
    // messages

    [[noreturn]] void failArgument(const Token& directive, std::string_view expected)
    {
        throw FatalIOError(fmt::format("{} is to be followed by {}.", directive.text, expected),
                           locationOf(directive));
    }

    [[noreturn]] void failUnknownDirective(const Token& directive)
    {
        if (directive.text == "#codeStream" || directive.text == "#includeFunc"
            || directive.text == "#system")
        {
            throw FatalIOError(
                fmt::format("{} is not supported: dictionaries of Drystone never run code.", directive.text),
                locationOf(directive));
        }
        throw FatalIOError(
            unknownWordMessage("directive", directive.text,
                               {"#calc", "#else", "#endif", "#eval", "#if", "#ifeq", "#include",
                                "#includeEtc", "#includeIfPresent", "#inputMode", "#remove"}),
            locationOf(directive));
    }

    Expansion expansion;
    std::shared_ptr<SourceText> source = std::make_shared<SourceText>();
    std::vector<Dictionary*> scopes;
    std::vector<std::filesystem::path> openFiles;
    std::filesystem::path caseDirectory = ".";
    InputMode mode = InputMode::merge;
    std::size_t filesRead = 0;
    std::size_t expandedTokens = 0;
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

std::filesystem::path etcDirectory()
{
    if (const char* directory = std::getenv("DRYSTONE_ETC"))
    {
        return directory;
    }
    // An installed application has it beside its folder.
    std::error_code unknown;
    const std::filesystem::path installed = sharedFolder() / "etc";
    return std::filesystem::is_directory(installed, unknown) ? installed : DRYSTONE_ETC_DIRECTORY;
}

} // namespace drystone
