// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Cuts words of files, and takes out what a terminal would act on.
#include "core/ShownWord.h"

#include <algorithm>

namespace drystone
{

std::string shown(std::string_view word)
{
    constexpr std::size_t longest = 40;
    std::string text(word.substr(0, longest));
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c == 127; }, '?'); // and all beyond ASCII
    return text + (word.size() > longest ? "..." : "");
}

} // namespace drystone
