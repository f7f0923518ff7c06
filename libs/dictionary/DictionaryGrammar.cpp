// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The grammar of dictionaries, written with PEGTL, in this file alone: rules first, then what each rule
/// leaves behind, then the messages for text that no rule takes.
///
/// Rules look ahead rather than go back, so that what a rule leaves behind never has to be taken away again.
#include "dictionary/DictionaryGrammar.h"

#include "dictionary/Dictionary.h"
#include "dictionary/DictionaryScanner.h"
#include "dictionary/StatementBuilder.h"

#include <bit>
#include <tao/pegtl.hpp>

namespace drystone
{

namespace
{

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

template<typename Rule>
struct Action : tao::pegtl::nothing<Rule>
{
};

template<TokenKind kind, int before = 0, int after = 0>
struct AddToken
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, StatementBuilder& builder)
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
    static void apply(const ActionInput& in, StatementBuilder& builder)
    {
        builder.openBracket(in.begin());
        builder.add(builder.token(TokenKind::punctuation, in.begin(), in.end()));
    }
};

struct CloseBracket
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, StatementBuilder& builder)
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
    static void apply(const ActionInput& in, StatementBuilder& builder)
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
    static void apply(const ActionInput& in, StatementBuilder& builder)
    {
        const Token keyword = builder.token(TokenKind::directive, in.begin(), in.end());
        builder.begin(Statement::Kind::condition, keyword, in.begin());
        builder.openCondition(keyword.line);
    }
};

template<>
struct Action<grammar::otherwise>
{
    static void apply0(StatementBuilder& builder) { builder.openOtherwise(); }
};

template<>
struct Action<grammar::bareListBegin>
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, StatementBuilder& builder)
    {
        builder.begin(Statement::Kind::list, builder.token(TokenKind::word, in.begin(), in.begin()),
                      in.begin());
    }
};

template<>
struct Action<grammar::blockOpen>
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, StatementBuilder& builder)
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
    static void apply(const ActionInput& in, StatementBuilder& builder)
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
    static void apply(const ActionInput& in, StatementBuilder& builder)
    {
        builder.current().valueBegin = builder.offset(in.begin());
    }
};

template<>
struct Action<grammar::valueEnd>
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, StatementBuilder& builder)
    {
        builder.current().valueEnd = builder.offset(in.begin());
    }
};

struct EndStatement
{
    template<typename ActionInput>
    static void apply(const ActionInput& in, StatementBuilder& builder)
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
    static void apply(const ActionInput& in, StatementBuilder& builder)
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
    [[noreturn]] static void raise(const ParseInput& in, StatementBuilder& builder)
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

/// Bytes that no text holds; they reveal a binary file before the grammar stumbles over it.
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
bool match(const SourceFile& file, StatementBuilder& builder)
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
    StatementBuilder builder(file);
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
void run(const SourceFile& file, StatementBuilder& builder)
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
    StatementBuilder builder(file);
    run<grammar::file>(file, builder);
    return std::move(builder.statements);
}

std::vector<Token> parseTokens(const SourceFile& file)
{
    StatementBuilder builder(file);
    run<grammar::tokens>(file, builder);
    return std::move(builder.looseTokens);
}

} // namespace drystone
