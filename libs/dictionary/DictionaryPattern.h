// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Regular expressions as keys and names: POSIX extended, the whole word to be matched.
#pragma once

#include "core/Error.h"

#include <functional>
#include <string>
#include <vector>

namespace drystone
{

/// \param pattern as it stands between the quotes
/// \param location where it stands, for the message
/// \throws FatalIOError when it is not a regular expression, or an unreasonably large one
std::function<bool(const std::string&)> patternMatcher(const std::string& pattern,
                                                       const SourceLocation& location);

/// The first name of a pattern of nothing but names, as `pillars|parapet`, that is none of `names`: mistyped,
/// it matches nothing while the others do. Empty where there is none, or the pattern is another one.
std::string alternativeWithoutName(const std::string& pattern, const std::vector<std::string>& names);

} // namespace drystone
