// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Bytes within texts, as pictures of a page, buffers of glTF and arrays of frames are: of no model, hence in
/// core.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace drystone
{

/// The bytes in base 64 with padding (RFC 4648, section 4), without line breaks.
std::string base64(std::string_view bytes);

/// The bytes that a text in base 64 with padding stands for; nothing where it is none.
std::optional<std::string> bytesOfBase64(std::string_view text);

} // namespace drystone
