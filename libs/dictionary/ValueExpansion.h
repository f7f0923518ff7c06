// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Values with all that stands for others in them: macros, #calc, included files; and conditions.
#pragma once

#include "dictionary/DictionaryGrammar.h"
#include "dictionary/DictionaryReading.h"

#include <vector>

namespace drystone
{

/// Appends the tokens of a value, each macro and directive in it replaced by what it stands for.
/// \throws FatalIOError for a macro without entry, a file that is not there, a directive that is none
void expandValue(DictionaryReading& reading, const std::vector<Token>& tokens, std::vector<Token>& into);

/// Of #if and #ifeq. \throws FatalIOError for what is no condition
bool isTrue(DictionaryReading& reading, const Statement& statement);

/// \throws FatalIOError with what may be meant
[[noreturn]] void failUnknownDirective(const DictionaryReading& reading, const Token& directive);

} // namespace drystone
