// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Files read and written whole.
#include "core/WholeFile.h"

#include "../ReportOf.h"
#include "core/Error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>
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

class ReplacedFile : public testing::Test
{
protected:
    void SetUp() override
    {
        writeWholeFile(file, "old");
        std::filesystem::permissions(folder, std::filesystem::perms::all);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    void setMode(mode_t mode) const { ASSERT_EQ(::chmod(file.c_str(), mode), 0); }
    struct stat status() const
    {
        struct stat result = {};
        EXPECT_EQ(::stat(file.c_str(), &result), 0);
        return result;
    }

    std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / ("drystone-replacedFile-" + std::to_string(::getpid()));
    std::filesystem::path file = folder / "file";
};

TEST_F(ReplacedFile, KeepsItsModeWhateverTheMaskOfNewFiles)
{
    const mode_t mask = ::umask(077);
    for (const mode_t mode : {0600, 0640, 0644, 0664, 0755})
    {
        setMode(mode);
        writeWholeFile(file, "new");
        EXPECT_EQ(status().st_mode & 07777, mode);
    }
    ::umask(mask);
    EXPECT_EQ(contentOfFile(file), "new");
}

TEST_F(ReplacedFile, KeepsItsOwnerWhereItCanBeGiven)
{
    if (::geteuid() != 0)
    {
        GTEST_SKIP() << "only root can give files to others";
    }
    ASSERT_EQ(::chown(file.c_str(), 65534, 65534), 0);
    setMode(0640);
    writeWholeFile(file, "new");
    EXPECT_EQ(status().st_uid, 65534U);
    EXPECT_EQ(status().st_gid, 65534U);
    EXPECT_EQ(status().st_mode & 07777, 0640U);
}

TEST_F(ReplacedFile, OpensNothingToAnotherGroupThatItsOwnDidNotHave)
{
    if (::geteuid() != 0)
    {
        GTEST_SKIP() << "only root can become another user";
    }
    setMode(0662);
    ASSERT_EQ(::setegid(65534), 0);
    ASSERT_EQ(::seteuid(65534), 0);
    writeWholeFile(file, "new");
    ASSERT_EQ(::seteuid(0), 0);
    ASSERT_EQ(::setegid(0), 0);
    EXPECT_EQ(status().st_gid, 65534U);
    EXPECT_EQ(status().st_mode & 07777, 0622U);
}

TEST_F(ReplacedFile, ThatIsWriteProtectedIsRefusedAndStands)
{
    setMode(0444);
    const bool isRoot = ::geteuid() == 0; // who may write everything
    if (isRoot)
    {
        ASSERT_EQ(::chown(file.c_str(), 65534, 65534), 0);
        ASSERT_EQ(::seteuid(65534), 0);
    }
    const std::string report = reportOf([&] { writeWholeFile(file, "new"); });
    EXPECT_THAT(report, testing::HasSubstr(file.string() + ": it is write-protected"));
    EXPECT_THAT(report, testing::HasSubstr("chmod u+w"));
    if (isRoot)
    {
        ASSERT_EQ(::seteuid(0), 0);
    }
    EXPECT_EQ(contentOfFile(file), "old");
    EXPECT_EQ(status().st_mode & 07777, 0444U);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

TEST(SharedFolder, IsAFolderOrEmpty)
{
    const std::filesystem::path folder = sharedFolder();
    EXPECT_TRUE(folder.empty() || std::filesystem::is_directory(folder));
    EXPECT_TRUE(folder.empty() || folder.filename() == "drystone");
}

} // namespace
} // namespace drystone
