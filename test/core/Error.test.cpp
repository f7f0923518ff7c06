// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Errors: what ends a program, and what its user reads.
#include "core/Error.h"

#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <new>

namespace drystone
{
namespace
{

using testing::HasSubstr;

TEST(UnknownWord, InTheQuotesOfATextProcessorIsStillRecognised)
{
    EXPECT_THAT(unknownWordMessage("quantity", "t", {"s"}), HasSubstr("Valid quantities: s"));
    EXPECT_THAT(unknownWordMessage("key", "t", {"s"}), HasSubstr("Valid keys: s"));
    EXPECT_THAT(unknownWordMessage("profile", "\u201ccircular\u201d", {"circular", "pointed"}),
                HasSubstr("Did you mean circular?"));
}

TEST(RunGuarded, TurnsEveryExceptionIntoAnExitStatus)
{
    testing::internal::CaptureStderr();
    EXPECT_EQ(runGuarded([] { return 7; }), 7);
    EXPECT_EQ(runGuarded([]() -> int { throw FatalError("It broke."); }), 1);
    EXPECT_EQ(runGuarded([]() -> int { throw FatalError("Not converged.", 2); }), 2);
    EXPECT_EQ(runGuarded([]() -> int { throw FatalIOError("Wrong.", {"system/x", "a/b", 3}); }), 1);
    EXPECT_EQ(runGuarded([]() -> int { throw std::bad_alloc(); }), 1);
    EXPECT_EQ(runGuarded([]() -> int { throw 3; }), 1);
    EXPECT_EQ(runGuarded([]() -> int { return std::filesystem::file_size("/nowhere/at/all") > 0 ? 0 : 0; }),
              1);
    const std::string printed = testing::internal::GetCapturedStderr();
    EXPECT_THAT(printed, testing::StartsWith("--> DRYSTONE FATAL ERROR:\nIt broke.\n\nDRYSTONE exiting\n"));
    EXPECT_THAT(printed,
                HasSubstr("--> DRYSTONE FATAL IO ERROR:\nWrong.\n\nfile: system/x/a/b at line 3.\n\nDRYSTONE "
                          "exiting\n"));
    EXPECT_THAT(printed, HasSubstr("not enough memory"));
    EXPECT_THAT(printed, HasSubstr("path: /nowhere/at/all"));
}

} // namespace
} // namespace drystone
