// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the rules of the grammar find, arranged as statements; and the messages for text that no rule takes.
#pragma once

#include "dictionary/DictionaryGrammar.h"

#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// Takes what the rules find, in the order of the text.
class StatementBuilder
{
public:
    explicit StatementBuilder(const SourceFile& sourceFile)
        : file(sourceFile), text(sourceFile.text), countedTo(text.data())
    {
    }

    std::vector<Statement> statements;
    std::vector<Token> looseTokens; ///< of a text that stands for a value
    bool isBinary = false;          ///< the header says that lists of numbers are given as bytes

    Token token(TokenKind kind, const char* begin, const char* end);

    /// To the value of the statement that is open, or to the loose tokens.
    void add(const Token& added);

    /// Adds the tokens of a binary list, if there is one here. \return its length in bytes, or 0
    std::size_t addBinaryList(const char* begin, const char* end);

    /// Statements, one inside the other. \param at first byte of the keyword, one past the last byte
    void begin(Statement::Kind kind, const Token& keyword, const char* at);
    void end(const char* at);
    /// The innermost that is open.
    Statement& current() { return open.back(); }

    /// Brackets and conditions, which are to be closed in turn.
    void openBracket(const char* at);
    void closeBracket();
    void openCondition(int line);
    void openOtherwise() { otherwiseOf.push_back(open.size()); }
    void closeCondition();

    /// Of a place in the text [bytes].
    std::size_t offset(const char* at) const { return static_cast<std::size_t>(at - text.data()); }

    /// Lines are counted once, from the last place requested.
    int lineOf(const char* at);

    /// A message with the statements that are open.
    FatalIOError error(const std::string& message, int line) const;

    /// What stands where no rule fits, as a user would call it.
    std::string found(const char* at) const;

    /// \throws FatalIOError: what is wrong at a place where no rule fits, and how to repair it
    [[noreturn]] void failMissingSemicolon(const char* at);
    [[noreturn]] void failUnclosed(char closing, const char* at);
    [[noreturn]] void failUnexpected(const char* at);

private:
    struct Bracket
    {
        char character;
        int line;
    };
    void enter(int line);
    /// \throws FatalIOError where a word holds a blank that only looks like one of the keyboard
    void requireBlanks(const Token& word);

    const SourceFile& file;
    std::string_view text;
    std::vector<Statement> open;
    std::vector<Bracket> brackets;
    std::vector<std::size_t> otherwiseOf; ///< sizes of `open` whose statement is past its #else
    int depth = 0;
    const char* countedTo;
    int countedLines = 1;
};

} // namespace drystone
