// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What keeps a text from being JSON, and where.
#include "core/Json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace drystone;
using testing::HasSubstr;
using testing::Not;

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

TEST(Json, WhatOtherProgramsAndDownloadsDoHasARemedy)
{
    EXPECT_THAT(faultOf("{\"a\": [1,", 1), HasSubstr("ends before it is complete"));
    EXPECT_THAT(faultOf("{\"a\": [1, \"b", 1), HasSubstr("ends before it is complete"));
    EXPECT_THAT(faultOf("{\"a\": 1}}", 1), Not(HasSubstr("complete")));
    EXPECT_THAT(faultOf("{\"a\": NaN}", 1), HasSubstr("NaN and Infinity are no numbers"));
    EXPECT_THAT(faultOf("{\"a\": nan}", 1), HasSubstr("NaN and Infinity are no numbers"));
    EXPECT_THAT(faultOf("{\"a\": -Infinity}", 1), HasSubstr("NaN and Infinity are no numbers"));
    EXPECT_THAT(faultOf("{\"a\": \"Gew\xf6lbe\"}", 1), HasSubstr("not in UTF-8"));
}

// Python takes the last of them, find() the first.
TEST(Json, AKeyThatIsGivenTwiceInAnObjectIsAFault)
{
    EXPECT_EQ(faultOf("[{\"a\": 1, \"b\": {\"a\": 2}}, {\"a\": 3}]", 0), "none");
    EXPECT_EQ(faultOf("{\"a\": 1,\n \"a\": 2}", 0), "a is given twice in the outermost object");
    EXPECT_EQ(faultOf("{\"n\": {\"b\": [1, {\"x\": 2, \"x\": 2}]}}", 0), "x is given twice in n/b/1");
}

TEST(Json, ATextIsWrittenAsItIsReadAgain)
{
    EXPECT_EQ(jsonText("north"), "\"north\"");
    for (const std::string text : {"left\\new", "a \"quoted\" name", "tab\tand\nline", "Gew\u00f6lbe"})
    {
        EXPECT_EQ(*parseJson(jsonText(text)).asText(), text);
    }
    EXPECT_EQ(jsonText("Gew\xf6lbe"), "\"Gew\ufffdlbe\"");
}
