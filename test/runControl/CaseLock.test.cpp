// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One run at a time in a case.
#include "runControl/CaseLock.h"

#include "../ReportOf.h"
#include "core/Error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include <unistd.h>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

class LockedCase : public testing::Test
{
protected:
    void SetUp() override { fs::create_directories(folder / "other"); }
    void TearDown() override { fs::remove_all(folder); }

    const fs::path folder = fs::temp_directory_path() / ("drystone-caseLock-" + std::to_string(::getpid()));
};

TEST_F(LockedCase, ASecondRunIsRefusedUntilTheFirstHasEnded)
{
    std::optional<CaseLock> first;
    first.emplace(folder, "limitAnalysis", "Wait.");
    EXPECT_THAT(reportOf([&] { const CaseLock second(folder, "contactDynamics", "Wait for it."); }),
                testing::AllOf(testing::HasSubstr(folder.string()),
                               testing::HasSubstr("contactDynamics would mix"),
                               testing::HasSubstr("Wait for it.\n\nDRYSTONE exiting")));
    first.reset();
    EXPECT_NO_THROW(CaseLock(folder, "contactDynamics", "Wait for it."));
}

TEST_F(LockedCase, AnotherCaseIsFreeAlsoOneWithin)
{
    const CaseLock first(folder, "limitAnalysis", "");
    EXPECT_NO_THROW(CaseLock(folder / "other", "limitAnalysis", ""));
}

TEST_F(LockedCase, LeavesNoFileBehind)
{
    {
        const CaseLock lock(folder / "other", "limitAnalysis", "");
        EXPECT_TRUE(fs::is_empty(folder / "other"));
    }
    EXPECT_TRUE(fs::is_empty(folder / "other"));
}

TEST_F(LockedCase, WithoutADirectoryThereIsNoLockAndTheRunGoesOn)
{
    EXPECT_NO_THROW(CaseLock(folder / "absent", "limitAnalysis", ""));
}

} // namespace
} // namespace drystone
