// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Regular expressions as keys and names: POSIX extended, the whole word to be matched.
#pragma once

#include "core/Error.h"

#include <functional>
#include <string>

namespace drystone
{

/// \param pattern as it stands between the quotes
/// \param location where it stands, for the message
/// \throws FatalIOError when it is not a regular expression, or an unreasonably large one
std::function<bool(const std::string&)> patternMatcher(const std::string& pattern,
                                                       const SourceLocation& location);

} // namespace drystone
