// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Text that XML and HTML take as it is meant.
#include "core/MarkupText.h"

#include <gtest/gtest.h>

using namespace drystone;

namespace
{

TEST(MarkupText, HasEntitiesForReservedCharacters)
{
    EXPECT_EQ(markupText("a < b & \"c\">"), "a &lt; b &amp; &quot;c&quot;&gt;");
}

TEST(MarkupText, LeavesOutControlCharactersThatXmlDoesNotHave)
{
    EXPECT_EQ(markupText("a\x01\tb\nc\x1b"), "a\tb\nc");
}

} // namespace
