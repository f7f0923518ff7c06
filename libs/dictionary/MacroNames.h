// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the names of macros stand for, seen from the dictionaries around them.
#pragma once

#include "dictionary/Dictionary.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drystone
{

/// The entry that a name stands for: a, a.b, .a (here), ..a (one level up), :a.b and /a/b (from the top),
/// ../a. \param visible scopes that it is seen from, the innermost last \return null where there is none;
/// owned by its dictionary
const Entry* lookUp(std::string_view name, std::vector<Dictionary*> visible);

/// `name:-value` as in a shell: the value when there is no such entry.
std::pair<std::string, std::optional<std::string>> withFallback(const std::string& name);

/// \throws FatalIOError: there is no entry of this name, and which is nearest
[[noreturn]] void failUndefined(const std::vector<Dictionary*>& scopes, const std::string& name,
                                const SourceLocation& location);

} // namespace drystone
