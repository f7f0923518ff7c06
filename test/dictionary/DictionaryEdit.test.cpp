// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Edits of a dictionary's text keep everything but the entry.
#include "dictionary/DictionaryEdit.h"
#include "core/WholeFile.h"
#include "dictionary/CopiedIncludes.h"
#include "dictionary/Dictionary.h"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <unistd.h>

namespace drystone
{
namespace
{

const std::string text = R"(// a header
mu          0.65;   // of the joints
#include "common"
wall
{
    unit    (0.4 0.175);  /* block */
    name    "a wall";
    door { from (1 2); /* kept */ to (3 4); }
}
mu          $other;
// the end
)";

/// What is in `after` and not in `before`, as lines "-old" and "+new".
std::string difference(const std::string& before, const std::string& after)
{
    const auto linesOf = [](const std::string& whole)
    {
        std::vector<std::string> lines;
        std::istringstream stream(whole);
        for (std::string line; std::getline(stream, line);)
        {
            lines.push_back(line);
        }
        return lines;
    };
    const auto a = linesOf(before);
    const auto b = linesOf(after);
    std::size_t same = 0;
    while (same < std::min(a.size(), b.size()) && a[same] == b[same])
    {
        ++same;
    }
    std::size_t sameAtEnd = 0;
    while (sameAtEnd < std::min(a.size(), b.size()) - same
           && a[a.size() - 1 - sameAtEnd] == b[b.size() - 1 - sameAtEnd])
    {
        ++sameAtEnd;
    }
    std::string result;
    for (std::size_t i = same; i + sameAtEnd < a.size(); ++i)
    {
        result.append("-").append(a[i]).append("\n");
    }
    for (std::size_t i = same; i + sameAtEnd < b.size(); ++i)
    {
        result.append("+").append(b[i]).append("\n");
    }
    return result;
}

std::string changes(const std::string& path, const std::string& value)
{
    return difference(text, withEntrySet(text, "file", path, value));
}

TEST(DictionaryEdit, SettingChangesTheValueAndNothingElse)
{
    EXPECT_EQ(changes("wall/unit", "(1 2)"), "-    unit    (0.4 0.175);  /* block */\n"
                                             "+    unit    (1 2);  /* block */\n");
    EXPECT_EQ(changes("wall/name", "other"), "-    name    \"a wall\";\n+    name    other;\n");
    EXPECT_EQ(changes("wall/door/to", "(5 6)"), "-    door { from (1 2); /* kept */ to (3 4); }\n"
                                                "+    door { from (1 2); /* kept */ to (5 6); }\n");
    EXPECT_EQ(changes("mu", "0.5"), "-mu          $other;\n+mu          0.5;\n") << "the last of two counts";
    EXPECT_EQ(changes("wall/unit", "{ x 1; }"), "-    unit    (0.4 0.175);  /* block */\n"
                                                "+    unit    { x 1; }  /* block */\n");
    EXPECT_EQ(changes("wall/door", "none"),
              "-    door { from (1 2); /* kept */ to (3 4); }\n+    door none;\n");
}

TEST(DictionaryEdit, AnAbsentEntryIsAddedWhereItBelongs)
{
    EXPECT_EQ(changes("new", "1"), "+new             1;\n");
    EXPECT_EQ(changes("wall/new", "1"), "+    new             1;\n");
    EXPECT_EQ(changes("wall/door/new", "1"), "-    door { from (1 2); /* kept */ to (3 4); }\n"
                                             "+    door { from (1 2); /* kept */ to (3 4); new 1; }\n");
    EXPECT_EQ(withEntrySet("", "file", "a", "1"), "a               1;\n");
    EXPECT_EQ(withEntrySet("a 1;", "file", "b", "2"), "a 1;\nb               2;\n");
    EXPECT_EQ(withEntrySet("a {\n}\n", "file", "a/b", "2"), "a {\n    b               2;\n}\n");
    EXPECT_THROW(withEntrySet(text, "file", "nowhere/new", "1"), FatalIOError);
}

TEST(DictionaryEdit, AnEntryIsNotAddedToACommentThatFollowsTheLastOne)
{
    EXPECT_EQ(withEntrySet("a 1; /* a note\n of two lines */\n", "file", "b", "2"),
              "a 1; /* a note\n of two lines */\nb               2;\n");
    EXPECT_EQ(withEntrySet("a 1; /* one */ /* two\n*/ // three /*\n// four\n", "file", "b", "2"),
              "a 1; /* one */ /* two\n*/ // three /*\nb               2;\n// four\n");
    EXPECT_EQ(withEntrySet("a 1; /* a\n */", "file", "b", "2"), "a 1; /* a\n */\nb               2;\n");
}

TEST(DictionaryEdit, ASubDictionaryThatAValueReplacesIsNotEdited)
{
    EXPECT_THROW(withEntrySet("s { a 1; }\ns 2;\n", "file", "s/a", "3"), FatalIOError);
    EXPECT_THROW(withEntrySet("s { a 1; }\ns 2;\n", "file", "s/b", "3"), FatalIOError);
    EXPECT_EQ(withEntrySet("s { a 1; }\ns 2;\ns { b 3; }\n", "file", "s/a", "4"),
              "s { a 1; }\ns 2;\ns { b 3; a 4; }\n");
    EXPECT_THROW(withEntrySet("r { s { a 1; } }\nr { s 2; }\n", "file", "r/s/a", "3"), FatalIOError)
        << "r is one dictionary, given in two pieces";
}

TEST(DictionaryEdit, RemovingTakesTheEntryAndItsLine)
{
    const auto removed = [](const std::string& path)
    { return difference(text, withEntryRemoved(text, "file", path)); };
    EXPECT_EQ(removed("wall/name"), "-    name    \"a wall\";\n");
    EXPECT_EQ(removed("wall/door/to"), "-    door { from (1 2); /* kept */ to (3 4); }\n"
                                       "+    door { from (1 2); /* kept */ }\n");
    EXPECT_EQ(removed("absent"), "");
    const std::string without = withEntryRemoved(text, "file", "mu");
    EXPECT_EQ(without.find("mu"), std::string::npos) << "both are gone";
    EXPECT_NE(without.find("// of the joints"), std::string::npos) << "comments stay";
}

TEST(DictionaryEdit, PointsBetweenKeywordsAreSlashesWhereNoNameHasThem)
{
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("drystone-edit-points-" + std::to_string(::getpid()));
    const auto edited = [&](const std::string& path, EntryEdit edit)
    {
        writeWholeFile(file, "a.b 1;\ns { c 1; }\n");
        editFile(file, path, edit, "2");
        std::ifstream stream(file);
        const std::string result{std::istreambuf_iterator<char>(stream), {}};
        std::filesystem::remove(file);
        return result;
    };
    EXPECT_EQ(edited("s.c", EntryEdit::set), "a.b 1;\ns { c 2; }\n");
    EXPECT_EQ(edited("s.d", EntryEdit::add), "a.b 1;\ns { c 1; d 2; }\n");
    EXPECT_EQ(edited("s.c", EntryEdit::remove), "a.b 1;\ns { }\n");
    EXPECT_EQ(edited("a.b", EntryEdit::set), "a.b 2;\ns { c 1; }\n");
    EXPECT_EQ(edited("alpha.water", EntryEdit::set), "a.b 1;\ns { c 1; }\nalpha.water     2;\n");
}

TEST(DictionaryEdit, WhatIsNotOneValueIsRefused)
{
    for (const char* value : {"1; evil 2", "(1 2", "1 }", "{ a 1;", "{ a 1; } b 2", "\"open", "/* open"})
    {
        EXPECT_THROW(withEntrySet(text, "file", "mu", value), FatalIOError) << value;
    }
    EXPECT_THROW(withEntrySet("a {", "file", "a", "1"), FatalIOError);
    EXPECT_THROW(withEntrySet("#if $x\na 1;\n#endif\n", "file", "a", "2"), FatalIOError);
    EXPECT_THROW(withEntrySet("b { #ifeq $x 1\na 1;\n#endif\n}", "file", "b/a", "2"), FatalIOError);
    EXPECT_THROW(withEntrySet("b { a 1; }\n#if $x\nb 1;\n#endif\n", "file", "b/a", "2"), FatalIOError);
}

TEST(DictionaryEdit, ACommentThatWouldHideWhatFollowsIsRefused)
{
    const std::string list = "a 1;\nb { c 2; }\n";
    for (const char* value :
         {"2000 // brick", "2000 //", "// brick", "2000 /* x */ // y", "{ d 1; } // brick", "//"})
    {
        for (const char* path : {"a", "b", "b/c", "b/new", "new"})
        {
            EXPECT_THROW(withEntrySet(list, "file", path, value), FatalIOError) << path << " " << value;
        }
    }
    EXPECT_EQ(withEntrySet(list, "file", "a", "2000 /* brick // red */"),
              "a 2000 /* brick // red */;\nb { c 2; }\n");
    EXPECT_EQ(withEntrySet(list, "file", "a", "(1 // one\n 2)"), "a (1 // one\n 2);\nb { c 2; }\n");
    EXPECT_EQ(withEntrySet(list, "file", "a", "\"http://x\""), "a \"http://x\";\nb { c 2; }\n");
}

TEST(DictionaryEdit, LinesEndAsThoseOfTheFile)
{
    EXPECT_EQ(withEntrySet("a 1; // one\rb { c 2; }\r", "file", "b/c", "3"), "a 1; // one\nb { c 3; }\n");
    const std::string windows = "a 1;\r\nb\r\n{\r\n    c 2;\r\n}\r\n";
    EXPECT_EQ(withEntrySet(windows, "file", "b/d", "3"),
              "a 1;\r\nb\r\n{\r\n    c 2;\r\n    d               3;\r\n}\r\n");
    EXPECT_EQ(withEntrySet(windows, "file", "d", "3"), windows + "d               3;\r\n");
    EXPECT_EQ(withEntrySet(windows, "file", "d", "{ e 1; }"), windows + "d\r\n{ e 1; }\r\n");
    EXPECT_EQ(withEntryRemoved(windows, "file", "b/c"), "a 1;\r\nb\r\n{\r\n}\r\n");
}

TEST(DictionaryEdit, ADirectiveWithoutArgumentIsRefusedForItWouldTakeAnEntryThatIsAdded)
{
    EXPECT_THROW(withEntrySet("#calc", "file", "a", "1"), FatalIOError);
    EXPECT_THROW(withEntrySet("b { #include }", "file", "b/a", "1"), FatalIOError);
    EXPECT_THROW(withEntryRemoved("a 1;\n#remove", "file", "a"), FatalIOError);
}

TEST(DictionaryEdit, AValueStaysApartFromWhatFollowsIt)
{
    EXPECT_EQ(withEntrySet("a (1 2)/* kept */;\n", "file", "a", "b"), "a b /* kept */;\n");
    EXPECT_EQ(withEntrySet("a (1 2)\xEF\xBB\xBF;\n", "file", "a", "2"), "a 2 \xEF\xBB\xBF;\n");
    EXPECT_EQ(withEntrySet("s { a (1 2); }\n", "file", "s/a", "2"), "s { a 2; }\n");
}

TEST(DictionaryEdit, ADictionaryThatFollowsItsKeyCloselyBecomesAValueApartFromIt)
{
    EXPECT_EQ(withEntrySet("a{ b 1; }\n", "file", "a", "2"), "a 2;\n");
}

class FileEdit : public testing::Test
{
protected:
    void SetUp() override
    {
        std::filesystem::create_directories(folder);
        write("shared", "common 42;\nsub { a 1; inner { b 2; } }\n");
        write("mine", "#include \"shared\"\nown 1;\n");
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    void write(const std::string& name, const std::string& content) const
    {
        std::ofstream(folder / name) << content;
    }
    std::string valueOf(const std::string& name, const std::string& path) const
    {
        return Dictionary::readFile(folder / name).lookupPath(path).valueText();
    }

    std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / fmt::format("drystoneFileEdit{}", getpid());
};

TEST_F(FileEdit, OfALinkChangesTheFileItLeadsTo)
{
    std::filesystem::create_symlink("mine", folder / "link");
    editFile(folder / "link", "own", EntryEdit::set, "2");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(valueOf("mine", "own"), "2");
}

TEST_F(FileEdit, OfAnIncludedEntryOverridesIt)
{
    editFile(folder / "mine", "sub/a", EntryEdit::set, "77");
    editFile(folder / "mine", "sub/inner/c", EntryEdit::set, "{ d 5; }");
    EXPECT_EQ(valueOf("mine", "sub/a"), "77");
    EXPECT_EQ(valueOf("mine", "sub/inner/b"), "2");
    EXPECT_EQ(valueOf("mine", "sub/inner/c/d"), "5");
    EXPECT_EQ(valueOf("shared", "sub/a"), "1");
    EXPECT_THROW(editFile(folder / "mine", "nowhere/a", EntryEdit::set, "77"), FatalIOError);
}

TEST(DictionaryEdit, FilesThatLeadOutOfACaseBecomeAbsolute)
{
    const std::string content = "#include \"../system/a\"\n#include \"../../shared/mu\" // ../x\nb { c 1;\n"
                                "#includeIfPresent \"../../other\"\n}\n#include \"a\"\n";
    EXPECT_EQ(withFilesFromOutside(content, "/home/me/case/constant/contactProperties", "/home/me/case"),
              "#include \"../system/a\"\n#include \"/home/me/shared/mu\" // ../x\nb { c 1;\n"
              "#includeIfPresent \"/home/me/other\"\n}\n#include \"a\"\n");
    // Files that entries name count from the case, wherever the dictionary is.
    EXPECT_EQ(withFilesFromOutside("texture { file \"../shared/tower 1.obj\"; of { file \"../b.dxf\"; } }\n"
                                   "a { file \"constant/../x\"; other \"../y\"; file2 ../z; }\n",
                                   "/home/me/case/system/blockTextureDict", "/home/me/case"),
              "texture { file \"/home/me/shared/tower 1.obj\"; of { file \"/home/me/b.dxf\"; } }\n"
              "a { file \"constant/../x\"; other \"../y\"; file2 ../z; }\n");
    EXPECT_EQ(withFilesFromOutside("not { #include \"../../x\"", "/c/constant/a", "/c"),
              "not { #include \"../../x\"");
}

TEST(DictionaryEdit, OnlyNamesOfEntriesAreAdded)
{
    for (const char* name : {"a b", "x }", "#include", "#calc", "$a", "x{", "\"q", "x\"", "/*x", ":x",
                             "\"[bad\"", "x;y", "(x)", "// x"})
    {
        for (const std::string& folder : {std::string(), std::string("wall/")})
        {
            if (name[0] == '/' || name == std::string("x }"))
            {
                EXPECT_THROW(withEntrySet(text, "file", folder + name, "3"), FatalError) << folder << name;
                continue;
            }
            EXPECT_THROW(withEntrySet(text, "file", folder + name, "3"), FatalIOError) << folder << name;
        }
    }
    for (const char* name : {"a", "a.b", "a:b", "\"re.*\"", "\"a|b\""})
    {
        const std::string edited = withEntrySet(text, "file", std::string("wall/") + name, "3");
        EXPECT_THAT(edited, testing::HasSubstr(name));
        EXPECT_NO_THROW(Dictionary::readString(edited, "text", Expansion::none)) << name;
    }
}

TEST(DictionaryEdit, PatternsAreNamedWithTheirQuotesOrWithout)
{
    const std::string patterns = "\"re.*\" { x 1; }\nc 2;\n";
    for (const char* path : {"\"re.*\"/x", "re.*/x"})
    {
        EXPECT_EQ(withEntrySet(patterns, "file", path, "5"), "\"re.*\" { x 5; }\nc 2;\n") << path;
    }
    for (const char* path : {"\"re.*\"", "re.*"})
    {
        EXPECT_EQ(withEntryRemoved(patterns, "file", path), "c 2;\n") << path;
    }
}

TEST_F(FileEdit, RemovingWhatIsNotInTheFileIsWarnedOf)
{
    for (const auto& [path, expected] : {std::pair{"common", "comes from another file"},
                                         {"sub/a", "comes from another file"},
                                         {"nowhere", "There is no entry nowhere"}})
    {
        testing::internal::CaptureStderr();
        editFile(folder / "mine", path, EntryEdit::remove, "");
        EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::HasSubstr(expected)) << path;
    }
    EXPECT_EQ(valueOf("mine", "common"), "42");
}

} // namespace
} // namespace drystone
