// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Text broken into lines.
#include "core/Paragraph.h"

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

TEST(Paragraph, BreaksAtBlanksAndKeepsLines)
{
    EXPECT_EQ(paragraph("", 10), "");
    EXPECT_EQ(paragraph("one two", 10), "one two\n");
    EXPECT_EQ(paragraph("one two three", 7), "one two\nthree\n");
    EXPECT_EQ(paragraph("one two three", 8), "one two\nthree\n");
    EXPECT_EQ(paragraph("one\ntwo", 10), "one\ntwo\n");
}

TEST(Paragraph, GivesALongWordALineOfItsOwn)
{
    EXPECT_EQ(paragraph("an unbreakable word", 6), "an\nunbreakable\nword\n");
}

TEST(Paragraph, HangsTheDescriptionBesideTheTerm)
{
    EXPECT_EQ(hangingParagraph("  -case", "the directory of it", 8, 18),
              "  -case the\n        directory\n        of it\n");
    EXPECT_EQ(hangingParagraph("averylongterm", "text", 4, 20), "averylongterm\n    text\n");
    EXPECT_EQ(hangingParagraph("alone", "", 4, 20), "alone\n");
}

} // namespace
} // namespace drystone
