// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Files read and written whole.
#include "core/WholeFile.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace drystone
{
namespace
{

TEST(WholeFile, IsReadAsItWasWritten)
{
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("drystone-wholeFile-" + std::to_string(::getpid()));
    const std::string bytes("a\0\r\n\xff", 5);
    writeWholeFile(folder / "deep" / "file", bytes);
    EXPECT_EQ(contentOfFile(folder / "deep" / "file"), bytes);
    EXPECT_EQ(contentOfFile(folder / "absent"), "");
    EXPECT_EQ(contentOfFile(folder), "");
    std::filesystem::remove_all(folder);
}

TEST(SharedFolder, IsAFolderOrEmpty)
{
    const std::filesystem::path folder = sharedFolder();
    EXPECT_TRUE(folder.empty() || std::filesystem::is_directory(folder));
    EXPECT_TRUE(folder.empty() || folder.filename() == "drystone");
}

} // namespace
} // namespace drystone
