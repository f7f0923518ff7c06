// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Copies of a case, in which studies run it.
#include "ensembles/CaseCopy.h"

#include "core/WholeFile.h"

#include <gtest/gtest.h>

#include <unistd.h>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

TEST(CaseCopy, CopiesOfWriteProtectedFilesAreTheStudysToWrite)
{
    const fs::path folder =
        fs::path(testing::TempDir()) / ("drystone-caseRuns-" + std::to_string(::getpid()));
    const fs::path original = folder / "case/constant";
    writeWholeFile(original / "plain", "a 1;\n");
    writeWholeFile(original / "including", "#include \"../../shared\"\na 1;\n");
    const auto readOnly = fs::perms::owner_read | fs::perms::owner_exec;
    for (const char* name : {"plain", "including"})
    {
        fs::permissions(original / name, readOnly);
    }
    copyCase(folder / "case", folder / "copy");
    for (const char* name : {"plain", "including"})
    {
        EXPECT_EQ(fs::status(folder / "copy/constant" / name).permissions(),
                  readOnly | fs::perms::owner_write)
            << name;
    }
    EXPECT_NE(contentOfFile(folder / "copy/constant/including"), contentOfFile(original / "including"));
    fs::remove_all(folder);
}

} // namespace
} // namespace drystone
