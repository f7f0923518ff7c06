// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Fingerprints of the input: what counts as a change of it, and how one is reported.
#include "dictionary/Fingerprint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include <unistd.h>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

std::uint64_t of(const std::string& text, const std::vector<std::string>& leftOut = {})
{
    return fingerprint(Dictionary::readString(text), leftOut);
}

TEST(Fingerprint, IsFnv1a)
{
    // The test vectors of RFC 9923 and of its authors.
    EXPECT_EQ(fingerprint(""), 0xcbf29ce484222325u);
    EXPECT_EQ(fingerprint("a"), 0xaf63dc4c8601ec8cu);
    EXPECT_EQ(fingerprint("foobar"), 0x85944171f73967e8u);
}

TEST(Fingerprint, OfADictionaryIsOfWhatItSays)
{
    const std::uint64_t plain = of("friction { type Coulomb; mu 0.6; }");
    EXPECT_EQ(
        of("FoamFile { class dictionary; }\n// of dry stone\nfriction\n{\n    type Coulomb; /* tilted */\n"
           "    mu 0.60;\n}\n"),
        plain);
    EXPECT_EQ(of("friction { type Coulomb; mu #calc \"0.3 + 0.3\"; }"), plain);
    for (const char* other : {"friction { type Coulomb; mu 0.61; }", "friction { type coulomb; mu 0.6; }",
                              "friction { type Coulomb; } mu 0.6;", "friction { type Coulomb; mu -0.6; }",
                              "\"friction\" { type Coulomb; mu 0.6; }", ""})
    {
        EXPECT_NE(of(other), plain) << other;
    }
    EXPECT_NE(of("a (1 2) ;"), of("a (12);"));
    EXPECT_EQ(of("a 1; writeProgram always;", {"writeProgram"}), of("a 1;"));
    EXPECT_EQ(of("a 0;"), of("a -0;"));
}

std::uint64_t ofTokens(const std::string& text)
{
    return fingerprintOfTokens({"g", text});
}

TEST(Fingerprint, OfTokensIsOfWhatIsWritten)
{
    const std::string text = "a 1;\nb { c ($a 2); }\n#ifeq $a 1\nd 1;\n#else\nd 2;\n#endif\n";
    const std::uint64_t plain = ofTokens(text);
    for (const char* same :
         {"// of stone\na 1;\n\nb\n{\n    c /* \" */ ( $a 2 );\n}\n#ifeq $a 1 // or so\n"
          "d 1;\n#else\nd 2;\n#endif",
          "FoamFile { class dictionary; }\r\na 1;\r\nb { c ($a 2); }\n#ifeq $a 1\nd 1;\n#else\n"
          "d 2;\n#endif\n"})
    {
        EXPECT_EQ(ofTokens(same), plain) << same;
    }
    // What a variable of a study would make of these differs, although they say the same as they stand.
    for (const char* other :
         {"a 1;\nb { c (1 2); }\n#ifeq $a 1\nd 1;\n#else\nd 2;\n#endif\n", "a 1;\nb { c ($a 2); }\nd 1;\n",
          "a 1;\nb { c ($a 2); }\n#ifeq $a 1\nd 1;\n#else\nd 3;\n#endif\n",
          "a 1;\nb { c ($a 2); }\n#ifeq $a 1\nd 1;\nd 2;\n#endif\n",
          "a 1;\na 1;\nb { c ($a 2); }\n#ifeq $a 1\nd 1;\n#else\nd 2;\n#endif\n"})
    {
        EXPECT_NE(ofTokens(other), plain) << other;
    }
    EXPECT_NE(ofTokens("a (1 2);"), ofTokens("a (12);"));
    EXPECT_NE(ofTokens("a b;"), ofTokens("a \"b\";"));
    EXPECT_NE(ofTokens("a \"//b\";"), ofTokens("a \"\";"));
    EXPECT_NE(ofTokens("a #calc { 1 // 2 };"), ofTokens("a #calc { 1 };"));
    EXPECT_NE(ofTokens("a { b 1; } c 1;"), ofTokens("a { b 1; c 1; }"));
    // No dictionary: by its bytes.
    EXPECT_EQ(ofTokens("a { "), fingerprint("a { "));
}

TEST(Fingerprint, OfInputFilesTellsWhichHaveChanged)
{
    const fs::path folder = fs::temp_directory_path() / ("drystone_input_" + std::to_string(getpid()));
    fs::create_directories(folder);
    const auto write = [&folder](const char* name, const char* text)
    { std::ofstream(folder / name) << text; };
    write("ground", "acceleration { type record; file record.csv; }");
    write("record.csv", "0 0\n1 2\n");
    const std::vector<std::string> names{"ground", "loads", "g"};
    write("g", "value (0 -9.81);");
    const std::vector<InputFile> before = inputFiles(folder, names);
    ASSERT_EQ(before.size(), 4U);
    EXPECT_EQ(before[1].content, 0U);
    EXPECT_TRUE(changesOfInput(before, inputFiles(folder, names)).empty());

    write("record.csv", "0 0\n1 3\n");
    write("loads", "dead { type gravity; }");
    fs::remove(folder / "g");
    EXPECT_EQ(textOf(changesOfInput(before, inputFiles(folder, names))),
              "g is gone, loads is new, record.csv has changed");
    // As kept in a file and read back; what is of another form is left aside.
    std::vector<std::string> texts = textsOf(before);
    EXPECT_THAT(texts.front(), testing::MatchesRegex("[0-9a-f]{16} ground"));
    texts.insert(texts.end(), {"", "0123456789abcdef", "xyz g", "0123456789abcdeg g"});
    EXPECT_TRUE(changesOfInput(before, inputFilesIn(texts)).empty());
    EXPECT_EQ(inputFilesIn(texts).size(), 4U);
    fs::remove_all(folder);
}

} // namespace
} // namespace drystone
