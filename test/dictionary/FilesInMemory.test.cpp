// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Files that are read from memory, alone and through #include.
#include "dictionary/FilesInMemory.h"
#include "core/Error.h"

#include <gtest/gtest.h>

#include <fstream>

using namespace drystone;

namespace
{

std::filesystem::path folderOf(const std::string& test)
{
    const auto folder = std::filesystem::temp_directory_path() / ("drystoneFilesInMemory" + test);
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
}

void write(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream(file) << text;
}

} // namespace

TEST(FilesInMemory, TakeThePlaceOfThoseOnTheDisk)
{
    const auto folder = folderOf("Place");
    write(folder / "a", "x 1;");
    {
        FilesInMemory files;
        EXPECT_EQ(Dictionary::readFile(folder / "a").get<int>("x"), 1);
        files.set(folder / "." / "a", "x 2;");
        EXPECT_EQ(Dictionary::readFile(folder / "a").get<int>("x"), 2);
        EXPECT_EQ(Dictionary::readFile(folder / "a", Expansion::none).get<int>("x"), 2);
        EXPECT_FALSE(isInMemory(folder / "new"));
        files.set(folder / "new", "y 3;");
        EXPECT_TRUE(isInMemory(folder / "new"));
        EXPECT_EQ(Dictionary::readFileIfPresent(folder / "new").get<int>("y"), 3);
        {
            const FilesOnDisk disk;
            EXPECT_EQ(Dictionary::readFile(folder / "a").get<int>("x"), 1);
            EXPECT_FALSE(isInMemory(folder / "new"));
        }
        EXPECT_EQ(Dictionary::readFile(folder / "a").get<int>("x"), 2);
    }
    EXPECT_EQ(Dictionary::readFile(folder / "a").get<int>("x"), 1);
    EXPECT_TRUE(Dictionary::readFileIfPresent(folder / "new").empty());
}

TEST(FilesInMemory, AreIncludedByOthersAlsoAfterTheseWereRead)
{
    const auto folder = folderOf("Include");
    write(folder / "inner", "x 1;");
    write(folder / "outer", "#include \"inner\"\ny $x;");
    FilesInMemory files;
    EXPECT_EQ(Dictionary::readFile(folder / "outer").get<int>("y"), 1);
    files.set(folder / "inner", "x 2;");
    EXPECT_EQ(Dictionary::readFile(folder / "outer").get<int>("y"), 2);
}

TEST(FilesInMemory, HaveFaultsLikeOthers)
{
    const auto folder = folderOf("Fault");
    FilesInMemory files;
    files.set(folder / "a", "x 1;\ny {");
    EXPECT_THROW(Dictionary::readFile(folder / "a"), FatalIOError);
    EXPECT_THROW(Dictionary::readFile(folder / "b"), FatalIOError);
}

TEST(FilesInMemory, NeedNotBeOnTheDiskOnceTheyWereRead)
{
    const auto folder = folderOf("Read");
    write(folder / "a", "x 1;");
    FilesInMemory files;
    EXPECT_FALSE(isInMemory(folder / "a"));
    EXPECT_EQ(Dictionary::readFile(folder / "a").get<int>("x"), 1);
    EXPECT_TRUE(isInMemory(folder / "a"));
    std::filesystem::remove(folder / "a");
    EXPECT_EQ(Dictionary::readFile(folder / "a").get<int>("x"), 1);
}

TEST(FilesInMemory, KnowWhichOfThemOthersWereReadFrom)
{
    const auto folder = folderOf("Included");
    write(folder / "inner", "x 1;");
    write(folder / "outer", "#include \"inner\"\ny $x;");
    write(folder / "other", "z 1;");
    FilesInMemory files;
    EXPECT_FALSE(files.isIncluded(folder / "inner"));
    Dictionary::readFile(folder / "inner");
    Dictionary::readFile(folder / "other");
    EXPECT_FALSE(files.isIncluded(folder / "inner"));
    Dictionary::readFile(folder / "outer");
    EXPECT_TRUE(files.isIncluded(folder / "." / "inner"));
    EXPECT_FALSE(files.isIncluded(folder / "outer"));
    EXPECT_FALSE(files.isIncluded(folder / "other"));
}
