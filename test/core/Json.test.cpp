// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What keeps a text from being JSON, and where.
#include "core/Json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace drystone;
using testing::HasSubstr;

namespace
{

std::string faultOf(const std::string& text, int line)
{
    try
    {
        parseJson(text);
    }
    catch (const JsonFault& fault)
    {
        EXPECT_EQ(fault.line, line) << text;
        return fault.what();
    }
    return "none";
}

} // namespace

// Files of other programs often have all of it on one line.
TEST(Json, AFaultIsNamedByItsLineAndCharacter)
{
    EXPECT_EQ(faultOf("{\"a\": [1, 2]}", 0), "none");
    // nan begins as null does.
    EXPECT_THAT(faultOf("{\"a\": [1, nan]}", 1), HasSubstr("no JSON here (character 12 of the line)"));
    EXPECT_THAT(faultOf("{\"a\":\n [1, nan]}", 2), HasSubstr("no JSON here (character 7 of the line)"));
    EXPECT_THAT(faultOf("[1, 1e999]", 1), HasSubstr("too large"));
    EXPECT_THAT(faultOf("{\"a\": [1,", 1), HasSubstr("no JSON here (character 9 of the line)"));
}
