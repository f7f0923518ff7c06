// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Words that are the same in small letters and in capitals.
#pragma once

#include <string>
#include <string_view>

namespace drystone
{

/// The text with its capitals A to Z as small letters: two texts compared so may differ in these.
std::string lowerCase(std::string_view text);

} // namespace drystone
