// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The grammar of dictionaries, written with PEGTL: rules first, then what each rule leaves behind, then the
/// messages for text that no rule takes.
///
/// Rules look ahead rather than go back, so that what a rule leaves behind never has to be taken away again.
#include "dictionary/DictionaryGrammar.h"

#include "dictionary/Dictionary.h"
#include "dictionary/DictionaryScanner.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <tao/pegtl.hpp>

namespace drystone
{

namespace
{

// --------------------------------------------------------------------------------------------------------
// grammar

namespace grammar
{
using namespace tao::pegtl;

/// A rule that is a function of the text ahead, which gives the length of what it takes.
template<std::size_t (*lengthOf)(const char*, const char*)>
struct scanned
{
    using rule_t = scanned;
    using subs_t = empty_list;
    template<typename ParseInput>
    static bool match(ParseInput& in)
    {
        if (in.empty())
        {
            return false;
        }
        const std::size_t length = lengthOf(in.current(), in.end());
        if (length > 0)
        {
            in.bump(length);
        }
        return length > 0;
    }
};

/// `List<scalar> 3(`, the bytes of three numbers and `)`, in a file whose header says `format binary;`. What
/// it leaves behind, and how long it is, the builder knows.
struct binaryList
{
    using rule_t = binaryList;
    using subs_t = empty_list;
    template<apply_mode, rewind_mode, template<typename...> class, template<typename...> class,
             typename ParseInput, typename State>
    static bool match(ParseInput& in, State& builder)
    {
        const std::size_t length = builder.addBinaryList(in.current(), in.end());
        in.bump(length);
        return length > 0;
    }
};

// clang-format off
struct lineComment : seq<two<'/'>, until<eolf>> {};
// sor goes back to where the comment begins, which is what a message is to name.
struct commentEnd : sor<until<string<'*', '/'>>, failure> {};
struct comment : if_must<string<'/', '*'>, commentEnd> {};
// The byte order mark that some editors leave, also within files that were put together of several.
struct byteOrderMark : string<'\xEF', '\xBB', '\xBF'> {};
struct skip : star<sor<plus<space>, lineComment, comment, byteOrderMark>> {};
struct skipInLine : star<sor<plus<one<' ', '\t', '\r'>>, comment, byteOrderMark>> {};

struct word : scanned<startedWord> {};
struct number : scanned<numberLength> {};
struct macro : scanned<markedMacro> {};
struct directive : scanned<markedDirective> {};
struct stringEnd : scanned<quotedText> {};
struct quoted : if_must<one<'"'>, stringEnd> {};
struct verbatimEnd : until<string<'#', '}'>> {};
struct verbatim : if_must<string<'#', '{'>, verbatimEnd> {};
struct punctuation : sor<one<':', ',', '=', '+', '-', '*'>, seq<one<'/'>, not_at<one<'/', '*'>>>> {};
struct separator : one<';'> {};

struct listOpen : one<'('> {};
struct listClose : one<')'> {};
struct squareOpen : one<'['> {};
struct squareClose : one<']'> {};
struct braceOpen : one<'{'> {};
struct braceClose : one<'}'> {};

// Arithmetic in braces is not made of tokens: #eval { $length/2 }
struct arithmeticName : sor<string<'#', 'e', 'v', 'a', 'l'>, string<'#', 'c', 'a', 'l', 'c'>> {};
struct arithmeticStart : at<arithmeticName, skip, one<'{'>> {};
struct arithmeticDirective : arithmeticName {};
struct arithmeticText : scanned<bracedText> {};
struct arithmetic : seq<arithmeticStart, arithmeticDirective, skip, if_must<one<'{'>, arithmeticText>> {};

struct item;
struct items : seq<skip, star<item, skip>> {};
struct braceItems : seq<skip, star<sor<item, separator>, skip>> {};
struct list : if_must<listOpen, items, listClose> {};
struct square : if_must<squareOpen, items, squareClose> {};
struct braces : if_must<braceOpen, braceItems, braceClose> {};
struct item : sor<binaryList, number, word, list, square, braces, macro, quoted, verbatim, arithmetic, directive, punctuation> {};

struct body;
struct blockOpen : one<'{'> {};
struct blockClose : one<'}'> {};
struct block : if_must<blockOpen, body, blockClose> {};
struct valueStart : success {};
struct valueEnd : success {};
struct semicolon : one<';'> {};
struct value : seq<valueStart, items, valueEnd, must<semicolon>> {};

struct keyNumber : number {};
struct keyWord : word {};
struct keyQuoted : quoted {};
struct keyed : seq<sor<keyNumber, keyWord, keyQuoted>, skip, sor<block, value>> {};

// A list without a key, which data files consist of: 8 ( (0 0) (1 0) ... )
struct bareListStart : at<sor<one<'('>, seq<number, skip, one<'('>>>> {};
struct bareListBegin : success {};
struct bareListEnd : success {};
struct bareList : seq<bareListStart, bareListBegin, opt<number>, skip, list, bareListEnd> {};

struct keyMacro : macro {};
struct macroEnd : success {};
struct macroStatement : seq<keyMacro, skip, sor<block, seq<macroEnd, opt<one<';'>>>>> {};

template<char... letters>
struct directiveWord : seq<string<'#', letters...>, not_at<alnum>> {};
struct keyCondition : sor<directiveWord<'i', 'f', 'e', 'q'>, directiveWord<'i', 'f'>> {};
struct otherwise : directiveWord<'e', 'l', 's', 'e'> {};
struct conditionEnd : directiveWord<'e', 'n', 'd', 'i', 'f'> {};
struct condition : seq<keyCondition, skipInLine, star<item, skipInLine>, body, opt<otherwise, body>, must<conditionEnd>> {};

struct keyDirective : directive {};
struct directiveEnd : success {};
struct directiveStatement : seq<not_at<sor<otherwise, conditionEnd>>, keyDirective, skip, opt<item>, directiveEnd> {};

struct statement : sor<one<';'>, bareList, keyed, macroStatement, condition, directiveStatement> {};
struct body : seq<skip, star<statement, skip>> {};
struct end : eof {};
struct file : seq<body, must<end>> {};
struct header : seq<skip, at<string<'F', 'o', 'a', 'm', 'F', 'i', 'l', 'e'>>, keyed> {};
struct tokens : seq<braceItems, must<end>> {};
// clang-format on
} // namespace grammar

// ------------------------------------------------------------------------------------------------ what rules
// leave

/// Takes what the rules find and arranges it as statements.
class Builder
{
public:
    explicit Builder(const SourceFile& sourceFile)
        : file(sourceFile), text(sourceFile.text), countedTo(text.data())
    {
    }

    std::vector<Statement> statements;
    std::vector<Token> looseTokens; ///< of a text that stands for a value
    bool isBinary = false;          ///< the header says that lists of numbers are given as bytes

    Token token(TokenKind kind, const char* begin, const char* end)
    {
        return {std::string_view(begin, static_cast<std::size_t>(end - begin)), &file, lineOf(begin), kind};
    }

    void add(const Token& added)
    {
        if (added.kind == TokenKind::word && added.text.size() > longestWord)
        {
            throw error("A word of more than " + std::to_string(longestWord)
                            + " letters. Is this a text file? Strings go between quotes.",
                        added.line);
        }
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

    /// Adds the tokens of a binary list, if there is one here. \return its length in bytes, or 0
    std::size_t addBinaryList(const char* begin, const char* end)
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
            throw error("The file ends within a list of " + std::to_string(numbers) + " numbers.",
                        lineOf(begin));
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

    void begin(Statement::Kind kind, const Token& keyword, const char* at)
    {
        if (keyword.text.size() > longestWord)
        {
            throw error("A keyword of more than " + std::to_string(longestWord)
                            + " letters. Is this a text file?",
                        keyword.line);
        }
        Statement statement;
        statement.kind = kind;
        statement.keyword = keyword;
        statement.begin = offset(at);
        open.push_back(std::move(statement));
    }

    void end(const char* at)
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

    Statement& current() { return open.back(); }

    void openBracket(const char* at)
    {
        brackets.push_back({*at, lineOf(at)});
        enter(brackets.back().line);
    }
    void closeBracket()
    {
        brackets.pop_back();
        --depth;
    }
    void openCondition(int line)
    {
        brackets.push_back({'#', line});
        enter(line);
    }
    void openOtherwise() { otherwiseOf.push_back(open.size()); }
    void closeCondition()
    {
        if (!otherwiseOf.empty() && otherwiseOf.back() == open.size())
        {
            otherwiseOf.pop_back();
        }
        closeBracket();
    }

    std::size_t offset(const char* at) const { return static_cast<std::size_t>(at - text.data()); }

    /// Lines are counted once, from the last place asked for.
    int lineOf(const char* at)
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

    FatalIOError error(const std::string& message, int line) const
    {
        std::string path;
        for (const Statement& statement : open)
        {
            if (statement.kind == Statement::Kind::condition || statement.keyword.text.empty())
            {
                continue;
            }
            path += (path.empty() ? "" : "/") + std::string(statement.keyword.text.substr(0, 80));
        }
        return FatalIOError(message, SourceLocation{file.name, path, line});
    }

    /// What stands where no rule fits, as a user would call it.
    std::string found(const char* at) const
    {
        const char* end = text.data() + text.size();
        if (at == end)
        {
            return "the end of the file";
        }
        std::size_t length = wordLength(at, end);
        length = std::clamp<std::size_t>(length, 1, 40);
        return "`" + std::string(at, length) + "`";
    }

    [[noreturn]] void failMissingSemicolon(const char* at)
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
            const int line = statement.value.empty() ? statement.keyword.line : statement.value.back().line;
            throw error("A `;` is missing after the value of " + key + ": " + found(at)
                            + " came first. Write `;` at the end of line " + std::to_string(line) + ".",
                        line);
        }
        failUnexpected(at);
    }

    [[noreturn]] void failUnclosed(char closing, const char* at)
    {
        const Bracket opened = brackets.back();
        const bool atEnd = at == text.data() + text.size();
        if (!atEnd && !std::strchr(")]};#", *at))
        {
            failUnexpected(at);
        }
        if (!atEnd && *at == '#' && opened.character != '#')
        {
            throw error("Unexpected " + found(at) + " where the bracket of line "
                            + std::to_string(opened.line)
                            + " is still open. A condition and what it governs are to hold whole entries.",
                        lineOf(at));
        }
        const std::string openedText =
            opened.character == '#' ? "condition" : "`" + std::string(1, opened.character) + "`";
        const std::string closingText = closing == '#' ? "`#endif`" : "`" + std::string(1, closing) + "`";
        throw error("The " + openedText + " of line " + std::to_string(opened.line)
                        + " is not closed: " + found(at) + " came at line " + std::to_string(lineOf(at))
                        + " before the " + closingText + ". Write " + closingText
                        + " where it belongs, or remove what is too much.",
                    opened.line);
    }

    [[noreturn]] void failUnexpected(const char* at)
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

private:
    struct Bracket
    {
        char character;
        int line;
    };
    void enter(int line)
    {
        if (++depth > deepestNesting)
        {
            throw error("Brackets are nested more than " + std::to_string(deepestNesting)
                            + " deep. Is a closing bracket missing?",
                        line);
        }
    }

    const SourceFile& file;
    std::string_view text;
    std::vector<Statement> open;
    std::vector<Bracket> brackets;
    std::vector<std::size_t> otherwiseOf; ///< sizes of `open` whose statement is past its #else
    int depth = 0;
    const char* countedTo;
    int countedLines = 1;
};

template<typename Rule>
struct Action : tao::pegtl::nothing<Rule>
{
};

template<TokenKind kind, int before = 0, int after = 0>
struct AddToken
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, Builder& builder)
    {
        builder.add(builder.token(kind, in.begin() + before, in.end() - after));
    }
};

// clang-format off
template<> struct Action<grammar::word> : AddToken<TokenKind::word> {};
template<> struct Action<grammar::number> : AddToken<TokenKind::number> {};
template<> struct Action<grammar::macro> : AddToken<TokenKind::macro> {};
template<> struct Action<grammar::directive> : AddToken<TokenKind::directive> {};
template<> struct Action<grammar::arithmeticDirective> : AddToken<TokenKind::directive> {};
template<> struct Action<grammar::arithmeticText> : AddToken<TokenKind::verbatim, 0, 1> {};
template<> struct Action<grammar::quoted> : AddToken<TokenKind::string, 1, 1> {};
template<> struct Action<grammar::verbatim> : AddToken<TokenKind::verbatim, 2, 2> {};
template<> struct Action<grammar::punctuation> : AddToken<TokenKind::punctuation> {};
template<> struct Action<grammar::separator> : AddToken<TokenKind::punctuation> {};
// clang-format on

struct OpenBracket
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, Builder& builder)
    {
        builder.openBracket(in.begin());
        builder.add(builder.token(TokenKind::punctuation, in.begin(), in.end()));
    }
};

struct CloseBracket
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, Builder& builder)
    {
        builder.closeBracket();
        builder.add(builder.token(TokenKind::punctuation, in.begin(), in.end()));
    }
};

// clang-format off
template<> struct Action<grammar::listOpen> : OpenBracket {};
template<> struct Action<grammar::squareOpen> : OpenBracket {};
template<> struct Action<grammar::braceOpen> : OpenBracket {};
template<> struct Action<grammar::listClose> : CloseBracket {};
template<> struct Action<grammar::squareClose> : CloseBracket {};
template<> struct Action<grammar::braceClose> : CloseBracket {};
// clang-format on

template<TokenKind kind, Statement::Kind statementKind, int quotes = 0>
struct BeginStatement
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, Builder& builder)
    {
        builder.begin(statementKind, builder.token(kind, in.begin() + quotes, in.end() - quotes), in.begin());
    }
};

// clang-format off
template<> struct Action<grammar::keyNumber> : BeginStatement<TokenKind::number, Statement::Kind::entry> {};
template<> struct Action<grammar::keyWord> : BeginStatement<TokenKind::word, Statement::Kind::entry> {};
template<> struct Action<grammar::keyQuoted> : BeginStatement<TokenKind::string, Statement::Kind::entry, 1> {};
template<> struct Action<grammar::keyMacro> : BeginStatement<TokenKind::macro, Statement::Kind::macro> {};
template<> struct Action<grammar::keyDirective> : BeginStatement<TokenKind::directive, Statement::Kind::directive> {};
// clang-format on

template<>
struct Action<grammar::keyCondition>
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, Builder& builder)
    {
        const Token keyword = builder.token(TokenKind::directive, in.begin(), in.end());
        builder.begin(Statement::Kind::condition, keyword, in.begin());
        builder.openCondition(keyword.line);
    }
};

template<>
struct Action<grammar::otherwise>
{
    static void apply0(Builder& builder) { builder.openOtherwise(); }
};

template<>
struct Action<grammar::bareListBegin>
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, Builder& builder)
    {
        builder.begin(Statement::Kind::list, builder.token(TokenKind::word, in.begin(), in.begin()),
                      in.begin());
    }
};

template<>
struct Action<grammar::blockOpen>
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, Builder& builder)
    {
        builder.openBracket(in.begin());
        builder.current().kind = Statement::Kind::dictionary;
        builder.current().valueBegin = builder.offset(in.end());
    }
};

template<>
struct Action<grammar::blockClose>
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, Builder& builder)
    {
        builder.closeBracket();
        builder.current().valueEnd = builder.offset(in.begin());
        builder.end(in.end());
    }
};

template<>
struct Action<grammar::valueStart>
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, Builder& builder)
    {
        builder.current().valueBegin = builder.offset(in.begin());
    }
};

template<>
struct Action<grammar::valueEnd>
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, Builder& builder)
    {
        builder.current().valueEnd = builder.offset(in.begin());
    }
};

struct EndStatement
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, Builder& builder)
    {
        builder.end(in.end());
    }
};

// clang-format off
template<> struct Action<grammar::semicolon> : EndStatement {};
template<> struct Action<grammar::bareListEnd> : EndStatement {};
template<> struct Action<grammar::macroEnd> : EndStatement {};
template<> struct Action<grammar::directiveEnd> : EndStatement {};
// clang-format on

template<>
struct Action<grammar::conditionEnd>
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, Builder& builder)
    {
        builder.closeCondition();
        builder.end(in.end());
    }
};

// -------------------------------------------------------------------------------------------------------
// messages

/// Turns the failure of a rule that had to succeed into a message.
template<typename Rule>
struct Control : tao::pegtl::normal<Rule>
{
    template<typename ParseInput>
    [[noreturn]] static void raise(const ParseInput& in, Builder& builder)
    {
        const char* at = in.current();
        if constexpr (std::is_same_v<Rule, grammar::semicolon>)
        {
            builder.failMissingSemicolon(at);
        }
        else if constexpr (std::is_same_v<Rule, grammar::listClose>)
        {
            builder.failUnclosed(')', at);
        }
        else if constexpr (std::is_same_v<Rule, grammar::squareClose>)
        {
            builder.failUnclosed(']', at);
        }
        else if constexpr (std::is_same_v<Rule,
                                          grammar::braceClose> || std::is_same_v<Rule, grammar::blockClose>)
        {
            builder.failUnclosed('}', at);
        }
        else if constexpr (std::is_same_v<Rule, grammar::conditionEnd>)
        {
            builder.failUnclosed('#', at);
        }
        else if constexpr (std::is_same_v<Rule, grammar::commentEnd>)
        {
            throw builder.error("The comment that begins here is not closed: write `*/` where it ends.",
                                builder.lineOf(at));
        }
        else if constexpr (std::is_same_v<Rule, grammar::stringEnd>)
        {
            throw builder.error(
                "The string that begins here is not closed on its line: write `\"` where it ends.",
                builder.lineOf(at));
        }
        else if constexpr (std::is_same_v<Rule, grammar::verbatimEnd>)
        {
            throw builder.error("The `#{` that begins here is not closed: write `#}` where it ends.",
                                builder.lineOf(at));
        }
        else if constexpr (std::is_same_v<Rule, grammar::arithmeticText>)
        {
            throw builder.error("The `{` of this arithmetic is not closed: write `}` where it ends.",
                                builder.lineOf(at));
        }
        else
        {
            builder.failUnexpected(at);
        }
    }
};

/// Bytes that no text holds; they tell of a binary file before the grammar stumbles over it.
void refuseBinary(const SourceFile& file)
{
    const std::string& text = file.text;
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        const auto byte = static_cast<unsigned char>(text[i]);
        if ((byte < 0x20 && !isSpace(text[i])) || byte == 0x7f)
        {
            const auto line =
                1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n');
            throw FatalIOError("This is not a text file: it holds a byte of value " + std::to_string(byte)
                                   + ". Give a dictionary in plain text (UTF-8 or ASCII).",
                               SourceLocation{file.name, "", static_cast<int>(line)});
        }
    }
}

template<typename Rule>
bool match(const SourceFile& file, Builder& builder)
{
    const std::string_view text = file.text;
    tao::pegtl::memory_input<tao::pegtl::tracking_mode::lazy> input(text.data(), text.data() + text.size(),
                                                                    file.name);
    return tao::pegtl::parse<Rule, Action, Control>(input, builder);
}

/// The value of an entry of one token, or nothing.
std::string_view valueOf(const std::vector<Statement>& statements, std::string_view key)
{
    for (const Statement& statement : statements)
    {
        if (statement.keyword.text == key && statement.value.size() == 1)
        {
            return statement.value.front().text;
        }
    }
    return {};
}

static_assert(std::endian::native == std::endian::little, "the header of a binary file says LSB");

/// Whether the header of a file says that its lists are binary.
/// \throws FatalIOError where they are those of a machine with another byte order
bool saysBinary(const SourceFile& file)
{
    constexpr std::size_t farthest = 4096; // a header stands at the beginning
    if (std::string_view(file.text).substr(0, farthest).find("binary") == std::string_view::npos)
    {
        return false;
    }
    Builder builder(file);
    if (!match<grammar::header>(file, builder) || builder.statements.empty())
    {
        return false;
    }
    const Statement& header = builder.statements.front();
    if (valueOf(header.body, "format") != "binary")
    {
        return false;
    }
    const std::string_view machine = valueOf(header.body, "arch");
    if (machine.find("LSB") == machine.npos || machine.find("scalar=64") == machine.npos)
    {
        throw FatalIOError(
            "The lists of this binary file are those of a machine with another byte order or another "
            "size of numbers: its header does not say arch \"LSB;label=32;scalar=64\".",
            SourceLocation{file.name, "FoamFile/arch", header.keyword.line});
    }
    return true;
}

template<typename Rule>
void run(const SourceFile& file, Builder& builder)
{
    builder.isBinary = saysBinary(file);
    if (!builder.isBinary)
    {
        refuseBinary(file);
    }
    match<Rule>(file, builder);
}

} // namespace

std::vector<Statement> parseStatements(const SourceFile& file)
{
    Builder builder(file);
    run<grammar::file>(file, builder);
    return std::move(builder.statements);
}

std::vector<Token> parseTokens(const SourceFile& file)
{
    Builder builder(file);
    run<grammar::tokens>(file, builder);
    return std::move(builder.looseTokens);
}

} // namespace drystone
