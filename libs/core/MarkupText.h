// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Text within XML and HTML, which frames, pictures and reports are written in.
#pragma once

#include <string>
#include <string_view>

namespace drystone
{

/// Text as content of an element or value of an attribute: reserved characters as entities, and without the
/// control characters that XML 1.0 does not have.
std::string markupText(std::string_view text);

} // namespace drystone
