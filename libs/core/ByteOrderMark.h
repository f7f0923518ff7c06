// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The mark that editors of Windows put in front of a text in UTF-8, which says nothing of the text: in this
/// library because readers of several libraries skip it.
#pragma once

#include <istream>
#include <string_view>

namespace drystone
{

inline constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";

/// The text behind the mark, if it begins with one.
std::string_view withoutByteOrderMark(std::string_view text);

/// Goes on behind the mark, if the stream begins with one. It must be at its beginning.
void skipByteOrderMark(std::istream& stream);

} // namespace drystone
