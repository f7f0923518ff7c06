// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What is a case directory, and what is said of one that is none.
#include "runControl/Case.h"

#include "../ReportOf.h"
#include "core/Error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

std::string refusalOf(const fs::path& directory)
{
    return reportOf([&] { requireCase(directory); });
}

TEST(Case, ThatMayNotBeReadIsSaidToBeSo)
{
    const fs::path folder = fs::path(testing::TempDir()) / ("drystone-case-" + std::to_string(::getpid()));
    fs::create_directories(folder / "case/system");
    fs::create_directories(folder / "empty");
    fs::permissions(folder, fs::perms::all);
    EXPECT_EQ(refusalOf(folder / "case"), "no error");
    EXPECT_THAT(refusalOf(folder / "empty"), testing::HasSubstr("is not a case directory"));
    EXPECT_THAT(refusalOf(folder / "absent"), testing::HasSubstr("is not a case directory"));

    fs::permissions(folder / "case", fs::perms::none);
    const bool isRoot = ::geteuid() == 0; // who may read everything
    if (isRoot)
    {
        ASSERT_EQ(::seteuid(65534), 0);
    }
    const std::string refusal = refusalOf(folder / "case");
    if (isRoot)
    {
        ASSERT_EQ(::seteuid(0), 0);
    }
    EXPECT_THAT(refusal,
                testing::HasSubstr((folder / "case").string() + " cannot be read: Permission denied"));
    EXPECT_THAT(refusal, testing::HasSubstr("chmod u+rx"));
    fs::permissions(folder / "case", fs::perms::owner_all);
    fs::remove_all(folder);
}

} // namespace
} // namespace drystone
