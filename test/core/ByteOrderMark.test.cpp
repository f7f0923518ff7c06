// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The mark in front of texts of Windows.
#include "core/ByteOrderMark.h"

#include <gtest/gtest.h>

#include <sstream>

namespace drystone
{
namespace
{

TEST(ByteOrderMark, IsSkippedAtTheBeginningAlone)
{
    EXPECT_EQ(withoutByteOrderMark("\xEF\xBB\xBF"
                                   "a\xEF\xBB\xBF"),
              "a\xEF\xBB\xBF");
    EXPECT_EQ(withoutByteOrderMark("a"), "a");
    EXPECT_EQ(withoutByteOrderMark(""), "");
    const auto rest = [](const std::string& text)
    {
        std::istringstream stream(text);
        skipByteOrderMark(stream);
        std::ostringstream read;
        read << stream.rdbuf();
        return read.str();
    };
    EXPECT_EQ(rest("\xEF\xBB\xBF# a"), "# a");
    for (const char* text : {"# a", "a", "ab", "\xEF\xBB",
                             "\xEF\xBB"
                             "a"})
    {
        EXPECT_EQ(rest(text), text);
    }
}

} // namespace
} // namespace drystone
