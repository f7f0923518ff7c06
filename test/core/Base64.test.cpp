// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Base 64.
#include "core/Base64.h"

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

TEST(Base64, HasTheVectorsOfItsStandard)
{
    // The vectors of RFC 4648, section 10.
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foob"), "Zm9vYg==");
    EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
    EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(Base64, GivesItsBytesBack)
{
    std::string bytes;
    for (int i = 0; i < 300; ++i)
    {
        EXPECT_EQ(bytesOfBase64(base64(bytes)), bytes);
        bytes.push_back(static_cast<char>(37 * i));
    }
}

TEST(Base64, OfOtherCharactersOrLengthsIsNone)
{
    for (const char* text : {"A", "AA", "AAA", "AA=A", "A===", "====", "AA\nA", "AA-A", "Zg==Zg=="})
    {
        EXPECT_FALSE(bytesOfBase64(text)) << text;
    }
    EXPECT_EQ(bytesOfBase64(""), "");
}

} // namespace
} // namespace drystone
