// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One byte at a time, unsigned, as std::tolower needs it.
#include "core/LowerCase.h"

#include <algorithm>
#include <cctype>

namespace drystone
{

std::string lowerCase(std::string_view text)
{
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return result;
}

} // namespace drystone
