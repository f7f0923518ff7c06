// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Bytes within texts, as pictures of a page and buffers of glTF are: of no model, hence in core.
#pragma once

#include <string>
#include <string_view>

namespace drystone
{

/// The bytes in base 64 with padding (RFC 4648, section 4), without line breaks.
std::string base64(std::string_view bytes);

} // namespace drystone
