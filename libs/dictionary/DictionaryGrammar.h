// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The grammar of dictionaries: from the text of a file to its statements, before any of them is carried out.
#pragma once

#include "core/Error.h"
#include "dictionary/SourceText.h"

#include <cstddef>
#include <vector>

namespace drystone
{

/// One statement of a dictionary as it is written.
struct Statement
{
    enum class Kind
    {
        entry,      ///< key value;
        dictionary, ///< key { body }
        list,       ///< ( ... ) or N( ... ) without a key, as in data files
        macro,      ///< $name;
        directive,  ///< #name argument
        condition   ///< #if, #ifeq: value holds what is tested, body one branch, otherwise the other
    };
    Kind kind = Kind::entry;
    Token keyword;
    std::vector<Token> value;
    bool isLiteral = true; ///< the value holds no macro and no directive
    std::vector<Statement> body;
    std::vector<Statement> otherwise;

    // Places in the file's text, in bytes, for edits that keep the layout.
    std::size_t begin = 0;      ///< first byte of the keyword
    std::size_t end = 0;        ///< one past the last byte: after `;` or `}`
    std::size_t valueBegin = 0; ///< of the value, or after `{`
    std::size_t valueEnd = 0;   ///< of the value, or of `}`
};

/// The statements of a file.
/// \param file must outlive what is returned
/// \throws FatalIOError with the line where the text is not a dictionary
std::vector<Statement> parseStatements(const SourceFile& file);

/// The tokens of a file that stands for a value.
/// \throws FatalIOError as above
std::vector<Token> parseTokens(const SourceFile& file);

/// Whether a statement gives a keyword a value or a sub-dictionary.
inline bool isKeyed(const Statement& statement)
{
    return statement.kind == Statement::Kind::entry || statement.kind == Statement::Kind::dictionary;
}

} // namespace drystone
