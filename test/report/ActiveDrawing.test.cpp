// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Drawings with scripts and events, in any writing, and drawings that only mention them.
#include "report/ActiveDrawing.h"

#include <gtest/gtest.h>

using namespace drystone;

TEST(ActiveDrawing, HasScriptsOrEventsInAnyWriting)
{
    for (const char* inside : {"<script>a()</script>", "<SCRIPT href='x'/>", "<foreignObject/>",
                               "<a href=\"JavaScript:a()\"/>", "<rect onload=\"a()\"/>",
                               "<rect\tOnClick = 'a()'/>", "<rect x='1'onclick='a()'/>", "<rect/onend=a>"})
    {
        EXPECT_TRUE(isActive("<svg>" + std::string(inside) + "</svg>")) << inside;
    }
}

TEST(ActiveDrawing, IsNoneThatOnlyMentionsThem)
{
    for (const char* inside : {"<text>onload = 1</text>", "<text>a script</text>",
                               "<rect font='Monotone=1'/>", "<polygon points='1,2 3,4'/>", ""})
    {
        EXPECT_FALSE(isActive("<svg>" + std::string(inside) + "</svg>")) << inside;
    }
}
