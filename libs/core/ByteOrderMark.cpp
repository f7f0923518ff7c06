// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Skips the mark of texts in UTF-8.
#include "core/ByteOrderMark.h"

#include <array>

namespace drystone
{

std::string_view withoutByteOrderMark(std::string_view text)
{
    return text.substr(text.starts_with(byteOrderMark) ? byteOrderMark.size() : 0);
}

void skipByteOrderMark(std::istream& stream)
{
    std::array<char, byteOrderMark.size()> first{};
    if (!stream.read(first.data(), first.size())
        || std::string_view(first.data(), first.size()) != byteOrderMark)
    {
        stream.clear();
        stream.seekg(0);
    }
}

} // namespace drystone
