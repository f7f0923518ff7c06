// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Dictionaries: the grammar, macros and directives, typed reading, and messages.
#include "dictionary/Dictionary.h"

#include "../ReportOf.h"
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <unistd.h>

namespace drystone
{
namespace
{

const char* const blockTexture = R"(
FoamFile { version 2.0; format ascii; class dictionary; object blockTextureDict; }
dimensions 2;
texture
{
    type        runningBond;
    unit        (0.4 0.175);   // length of a full block, height of a course [m]
    thickness   1;             /* out of plane */
    courses     6;
    openings    ( { from (1.5 3); to (2.5 8); } );
}
supports { ground { type ground; segment 0.5; } }
)";

TEST(Dictionary, ReadsTheBlockTextureOfTheContract)
{
    const Dictionary dictionary = Dictionary::readString(blockTexture, "system/blockTextureDict");
    EXPECT_EQ(dictionary.get<int>("dimensions"), 2);
    const Dictionary& texture = dictionary.subDict("texture");
    EXPECT_EQ(texture.get<std::string>("type"), "runningBond");
    EXPECT_EQ((texture.get<std::array<double, 2>>("unit")), (std::array{0.4, 0.175}));
    EXPECT_EQ(texture.getOrDefault<double>("thickness", 2), 1);
    EXPECT_EQ(texture.getOrDefault<double>("absent", 2), 2);
    const auto openings = texture.get<std::vector<Dictionary>>("openings");
    ASSERT_EQ(openings.size(), 1U);
    EXPECT_EQ((openings[0].get<std::array<double, 2>>("to")), (std::array{2.5, 8.0}));
    EXPECT_EQ(texture.lookup("courses").location().line, 9);
    EXPECT_EQ(texture.lookup("courses").location().entry, "texture/courses");
}

std::string reportOfReading(const std::string& text)
{
    return reportOf([&text] { Dictionary::readString(text, "system/some"); });
}

template<class Value>
std::string reportOfValue(const std::string& value)
{
    return reportOf([&value] { Dictionary::readString("key " + value + ";", "some").get<Value>("key"); });
}

/// The value of an entry as text, after everything has been expanded.
std::string expanded(const std::string& text, const std::string& path)
{
    const Dictionary dictionary = Dictionary::readString(text);
    const Entry* entry = dictionary.findPath(path);
    return entry ? entry->valueText() : "absent";
}

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A directory of the test's own, gone with it.
class DictionaryFiles : public testing::Test
{
protected:
    DictionaryFiles()
        : root(std::filesystem::path(testing::TempDir())
               / ("dictionaryFiles." + std::to_string(::getpid()) + "."
                  + testing::UnitTest::GetInstance()->current_test_info()->name()))
    {
        std::filesystem::create_directories(root / "system");
    }
    ~DictionaryFiles() override { std::filesystem::remove_all(root); }

    std::filesystem::path write(const std::string& name, const std::string& text) const
    {
        std::ofstream(root / name, std::ios::binary) << text;
        return root / name;
    }

    std::filesystem::path root;
};

// ----------------------------------------------------------------------------------------------------------
// values

TEST(Dictionary, ValuesOfEveryTypeAreRead)
{
    const Dictionary dictionary = Dictionary::readString(R"(
        number -1.5e-3; plus +2; point .5; integer 12; on on; off no; word div(phi,U); string "a \"b\" c";
        list (1 2 3); counted 3(1 2 3); uniform 4{0.5}; nested ((1 2) (3 4 5) ()); empty ();
        vectors 2 ((0 0) (1 2)); table ((0 1) (0.5 2)); words (left "the right"); field List<scalar> 2(7 8);
    )");
    EXPECT_EQ(dictionary.get<double>("number"), -1.5e-3);
    EXPECT_EQ(dictionary.get<double>("plus"), 2);
    EXPECT_EQ(dictionary.get<double>("point"), 0.5);
    EXPECT_EQ(dictionary.get<double>("integer"), 12);
    EXPECT_EQ(dictionary.get<int>("integer"), 12);
    EXPECT_TRUE(dictionary.get<bool>("on"));
    EXPECT_FALSE(dictionary.get<bool>("off"));
    EXPECT_EQ(dictionary.get<std::string>("word"), "div(phi,U)");
    EXPECT_EQ(dictionary.get<std::string>("string"), "a \"b\" c");
    EXPECT_THAT(dictionary.get<std::vector<int>>("list"), ElementsAre(1, 2, 3));
    EXPECT_THAT(dictionary.get<std::vector<double>>("counted"), ElementsAre(1, 2, 3));
    EXPECT_THAT(dictionary.get<std::vector<double>>("uniform"), ElementsAre(0.5, 0.5, 0.5, 0.5));
    EXPECT_EQ(dictionary.get<std::vector<std::vector<double>>>("nested").at(1).size(), 3U);
    EXPECT_TRUE(dictionary.get<std::vector<double>>("empty").empty());
    EXPECT_EQ((dictionary.get<std::vector<std::array<double, 2>>>("vectors").at(1)), (std::array{1.0, 2.0}));
    EXPECT_EQ((dictionary.get<std::vector<std::pair<double, double>>>("table").at(1).second), 2);
    EXPECT_THAT(dictionary.get<std::vector<std::string>>("words"), ElementsAre("left", "the right"));
    EXPECT_THAT(dictionary.get<std::vector<double>>("field"), ElementsAre(7, 8));
}

TEST(Dictionary, VectorsMayHaveTwoOrThreeComponents)
{
    const Dictionary dictionary = Dictionary::readString("two (1 2); three (1 2 0); out (1 2 3);");
    EXPECT_EQ((dictionary.get<std::array<double, 2>>("three")), (std::array{1.0, 2.0}));
    EXPECT_EQ((dictionary.get<std::array<double, 3>>("two")), (std::array{1.0, 2.0, 0.0}));
    EXPECT_THAT(reportOf([&] { dictionary.get<std::array<double, 2>>("out"); }),
                HasSubstr("The third component of out must be 0"));
}

TEST(Dictionary, CharactersThatOnlyLookLikeThoseOfTheKeyboardAreNamed)
{
    const auto message = [](const std::string& text)
    { return reportOf([&text] { Dictionary::readString(text, "some").get<double>("mu"); }); };
    for (const std::string blank : {"\u00A0", "\u2009", "\u202F", "\u200B", "\u3000"})
    {
        EXPECT_THAT(
            message("a 1;\nmu" + blank + "0.65;"),
            AllOf(HasSubstr("Type an ordinary blank there"), HasSubstr("after `mu`"), HasSubstr("line 2")));
        EXPECT_THAT(message("mu " + blank + "0.65;"), HasSubstr("at its beginning"));
        EXPECT_THAT(message("mu 0.65" + blank + ";"), HasSubstr("after `0.65`"));
        EXPECT_EQ(Dictionary::readString("mu 0.65; // of\u00A0stone", "some").get<double>("mu"), 0.65);
        EXPECT_EQ(Dictionary::readString("name \"a" + blank + "b\";", "some").get<std::string>("name"),
                  "a" + blank + "b");
    }
    EXPECT_EQ(Dictionary::readString("gr\u00F6\u00DFe\u20AC 2;", "some").get<double>("gr\u00F6\u00DFe\u20AC"),
              2);
    for (const std::string minus : {"\u2212", "\u2013"})
    {
        EXPECT_THAT(reportOfValue<double>(minus + "9.81"), HasSubstr("type `-` instead"));
    }
}

TEST(Dictionary, WrongValuesAreRefusedWithTheReason)
{
    EXPECT_THAT(reportOfValue<double>("abc"), HasSubstr("a number is expected but `abc` is found"));
    EXPECT_THAT(reportOfValue<double>(""), HasSubstr("key has no value"));
    EXPECT_THAT(reportOfValue<double>("nan"), HasSubstr("Only finite numbers"));
    EXPECT_THAT(reportOfValue<double>("-inf"), HasSubstr("Only finite numbers"));
    EXPECT_THAT(reportOfValue<double>("1e999"), HasSubstr("too large"));
    EXPECT_EQ(Dictionary::readString("k 1e-400;").get<double>("k"), 0);
    EXPECT_THAT(reportOfValue<double>("1 2"), HasSubstr("should end before `2`. Is a `;` missing"));
    EXPECT_THAT(reportOfValue<double>("0,6"), HasSubstr("0.6, not 0,6"));
    EXPECT_THAT(reportOfValue<double>("= 0.6"), HasSubstr("`key value;`, without `=`"));
    EXPECT_THAT(reportOfValue<double>("5 kN"), HasSubstr("5 kN is 5000"));
    EXPECT_THAT(reportOfValue<double>("5kN"), HasSubstr("5 kN is 5000"));
    EXPECT_THAT(reportOfValue<double>("5 N/m2"), HasSubstr("SI units"));
    EXPECT_THAT(reportOfValue<double>("65%"), HasSubstr("65% is 0.65"));
    EXPECT_THAT(reportOfValue<double>("65 %"), HasSubstr("65% is 0.65"));
    EXPECT_THAT(reportOfValue<double>("5 knots"), HasSubstr("Is a `;` missing"));
    EXPECT_THAT(reportOfValue<double>("12abc"), HasSubstr("`12abc`"));
    EXPECT_THAT(reportOfValue<int>("99999999999"), HasSubstr("out of range"));
    EXPECT_THAT(reportOfValue<int>("1.5"), HasSubstr("an integer"));
    EXPECT_THAT(reportOfValue<bool>("perhaps"), HasSubstr("on off yes no"));
    EXPECT_THAT(reportOfValue<std::vector<double>>("3(1 2)"),
                HasSubstr("says that it has 3 values, but has 2"));
    EXPECT_THAT(reportOfValue<std::vector<double>>("-3{1}"), HasSubstr("cannot have -3 values"));
    EXPECT_THAT(reportOfValue<std::vector<double>>("1000000000000{1}"), HasSubstr("too long"));
    EXPECT_THAT(reportOfValue<std::vector<double>>("(1,5 2)"), HasSubstr("number"));
    EXPECT_THAT((reportOfValue<std::array<double, 2>>("(1)")),
                HasSubstr("has 1 numbers, but 2 are expected"));
    EXPECT_THAT(reportOfValue<std::string>("constant/record"), HasSubstr("between quotes"));
    EXPECT_THAT(reportOfValue<double>("{ a 1; }"), HasSubstr("is a sub-dictionary, but a value is wanted"));
    EXPECT_THAT(
        reportOf([] { Dictionary::readString("length 5\ncourses 6;", "some").get<double>("length"); }),
        AllOf(HasSubstr("Is a `;` missing at the end of line 1?"),
              HasSubstr("file: some/length at line 1.")));
    EXPECT_THAT(reportOf([] { Dictionary::readString("alpha 1; beta 2;", "some").get<double>("gamma"); }),
                HasSubstr("is missing"));
    EXPECT_THAT(reportOf([] { Dictionary::readString("alpha 1; beta 2;", "some").get<double>("betta"); }),
                HasSubstr("Did you mean beta?"));
}

TEST(Dictionary, UnitsAreMultipliedAndDivided)
{
    EXPECT_EQ(dimensionsOf("kg/m3"), (Dimensions{1, -3, 0, 0, 0, 0, 0}));
    EXPECT_EQ(dimensionsOf("N/m3"), (Dimensions{1, -2, -2, 0, 0, 0, 0}));
    EXPECT_EQ(dimensionsOf("m/s2"), (Dimensions{0, 1, -2, 0, 0, 0, 0}));
    EXPECT_EQ(dimensionsOf("Nm"), (Dimensions{1, 2, -2, 0, 0, 0, 0}));
    EXPECT_EQ(dimensionsOf("kg m^-3"), dimensionsOf("kg/m3"));
    EXPECT_EQ(dimensionsOf("-"), (Dimensions{}));
    EXPECT_EQ(dimensionsOf("rad/s"), dimensionsOf("1/s"));
    EXPECT_THROW(dimensionsOf("furlong"), std::invalid_argument);
}

TEST(Dictionary, AMillionNumbersAreReadInASecond)
{
    std::string text = "blocks (";
    for (int i = 0; i < 125'000; ++i)
    {
        text += "((0.1 0.25) (1.5e-3 2.5) (3.14159 -4.5) (5.125 6.0625))\n";
    }
    text += ");";
    const auto start = std::chrono::steady_clock::now();
    const auto polygons =
        Dictionary::readString(text).get<std::vector<std::vector<std::array<double, 2>>>>("blocks");
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    ASSERT_EQ(polygons.size(), 125'000U);
    EXPECT_EQ(polygons.back().at(3)[1], 6.0625);
    RecordProperty("secondsForAMillionNumbers", std::to_string(elapsed.count()));
    // Sanitizers and debug builds are several times slower.
    EXPECT_LT(elapsed.count(), 10) << "a release build takes about 0.2 s";
}

// ------------------------------------------------------------------------------------------------------
// dictionaries

TEST(Dictionary, ExactKeysComeBeforePatternsAndTheLastPatternWins)
{
    const Dictionary dictionary = Dictionary::readString("\"b.*\" 1; \".*\" 2; block 3; \"(wall|w.*)\" 4;");
    EXPECT_EQ(dictionary.get<int>("block"), 3);
    EXPECT_EQ(dictionary.get<int>("brick"), 2);
    EXPECT_EQ(dictionary.get<int>("wall"), 4);
    EXPECT_EQ(Dictionary::readString("\"(?i)left\" 1;").getOrDefault<int>("LEFT", 0), 1);
    EXPECT_FALSE(Dictionary::readString("\"bl\" 1;").found("block")) << "a pattern matches whole words";
}

TEST(Dictionary, EntriesCanBeSetMergedAndRemoved)
{
    Dictionary dictionary = Dictionary::readString("a 1; \"p.*\" 2; b { c 1; } d 4;");
    dictionary.set("a", "(1 2)");
    EXPECT_THAT(dictionary.get<std::vector<int>>("a"), ElementsAre(1, 2));
    EXPECT_TRUE(dictionary.remove("a"));
    EXPECT_FALSE(dictionary.remove("a"));
    EXPECT_EQ(dictionary.get<int>("pq"), 2);
    dictionary.merge(Dictionary::readString("b { c 5; e 6; }"));
    EXPECT_EQ(dictionary.subDict("b").get<int>("c"), 5);
    EXPECT_THAT(dictionary.keywords(), ElementsAre("p.*", "b", "d"));
    const Dictionary again = Dictionary::readString(toText(dictionary));
    EXPECT_EQ(toText(again), toText(dictionary));
    EXPECT_EQ(again.get<int>("pq"), 2);
}

TEST(Dictionary, ACopyOutlivesWhatItWasReadFrom)
{
    std::vector<Entry> kept;
    {
        const Dictionary dictionary = Dictionary::readString("list (1 2 3);");
        kept.push_back(dictionary.lookup("list"));
    }
    EXPECT_THAT(kept.front().as<std::vector<int>>(), ElementsAre(1, 2, 3));
}

// ------------------------------------------------------------------------------------------------ macros,
// directives

TEST(Dictionary, MacrosFindTheirEntryFromTheInnermostScopeOutwards)
{
    const std::string text =
        "a 1; b { a 2; c { here $a; there $...a; top $:a; up $..a; local ${a}; } } d $b.c.up;"
        "e { $b; a 3; } name a; f ${:${name}}; g ${nothing:-7}; x.y 5; h $x.y;";
    EXPECT_EQ(expanded(text, "b/c/here"), "2");
    EXPECT_EQ(expanded(text, "b/c/there"), "1");
    EXPECT_EQ(expanded(text, "b/c/top"), "1");
    EXPECT_EQ(expanded(text, "b/c/up"), "2");
    EXPECT_EQ(expanded(text, "d"), "2");
    EXPECT_EQ(expanded(text, "e/a"), "3");
    EXPECT_EQ(expanded(text, "e/c/here"), "2");
    EXPECT_EQ(expanded(text, "f"), "1");
    EXPECT_EQ(expanded(text, "g"), "7");
    EXPECT_EQ(expanded(text, "h"), "5");
    EXPECT_THAT(reportOfReading("length 1;\nwidth $lenght;"),
                AllOf(HasSubstr("There is no entry lenght"), HasSubstr("Did you mean $length?"),
                      HasSubstr("at line 2.")));
    EXPECT_THAT(reportOfReading("a 1; $a;"), HasSubstr("must stand for a dictionary"));
    EXPECT_THAT(reportOfReading("a { $a; }"), HasSubstr("There is no entry a "));
}

TEST(Dictionary, WhatIsGivenTwiceInOnePlaceIsWarnedOf)
{
    const auto warned = [](const std::string& text)
    {
        testing::internal::CaptureStderr();
        Dictionary::readString(text, "constant/x");
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_THAT(warned("friction\n{\n    mu 0.65;\n    mu 0.3;\n}"),
                AllOf(HasSubstr("mu is given twice, first at line 3; the last one counts"),
                      HasSubstr("constant/x/friction/mu at line 4")));
    EXPECT_THAT(warned("live { a 1; }\nlive { b 2; }"), HasSubstr("taken together"));
    // Overriding what comes from elsewhere is what merging is for, and it may be requested.
    EXPECT_EQ(warned("base { mu 0.65; }\nfriction { $base; mu 0.3; }"), "");
    EXPECT_EQ(warned("#inputMode merge\nmu 0.65;\nmu 0.3;"), "");
    EXPECT_EQ(warned("a { mu 1; }\nb { mu 1; }"), "");
    EXPECT_EQ(warned("m on; #if $m\na 1;\n#else\na 2;\n#endif"), "");
}

TEST(Dictionary, WhatIsGivenTwiceInADictionaryOfAListIsWarnedOf)
{
    const auto warned = [](const std::string& text)
    {
        testing::internal::CaptureStderr();
        const Dictionary dictionary = Dictionary::readString(text, "constant/y");
        dictionary.get<std::vector<Dictionary>>("openings");
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_THAT(warned("openings\n(\n    {\n        to 1;\n        to 2;\n    }\n);"),
                AllOf(HasSubstr("to is given twice, first at line 4; the last one counts"),
                      HasSubstr("constant/y/openings/to at line 5")));
    EXPECT_THAT(warned("openings ( { a { b 1; }\na { c 2; } } );"), HasSubstr("taken together"));
    EXPECT_EQ(warned("openings ( { to 1; } { to 1; } );"), "");
    EXPECT_EQ(warned("base { to 1; }\nopenings ( { $base; to 2; } );"), "");
    EXPECT_EQ(warned("base { to 1; } openings ( { a { $base; to 2; } a1 { to 2; } } );"), "");
}

TEST(Dictionary, DirectivesMergeRemoveAndChoose)
{
    EXPECT_EQ(expanded("a 1; #inputMode protect\n a 2;", "a"), "1");
    EXPECT_EQ(expanded("a { b 1; } #inputMode overwrite\n a { c 2; }", "a/b"), "absent");
    EXPECT_THAT(reportOfReading("#inputMode error\na 1;\na 2;"),
                HasSubstr("a is given twice, first at line 2"));
    EXPECT_THAT(reportOfReading("#inputMode eror"), HasSubstr("Did you mean error?"));
    EXPECT_EQ(expanded("a 1; #remove a", "a"), "absent");
    EXPECT_EQ(expanded("alpha 1; beta 2; #remove (\"al.*\" gamma)", "alpha"), "absent");
    EXPECT_EQ(expanded("m fast; #ifeq $m fast\n a 1;\n#else\n a 2;\n#endif", "a"), "1");
    EXPECT_EQ(expanded("m 2.0; #ifeq $m 2\n a 1;\n#else\n a 2;\n#endif", "a"), "1");
    EXPECT_EQ(expanded("m off; #if $m\n a 1;\n#else\n a 2;\n#endif", "a"), "2");
    EXPECT_EQ(expanded("#if on\n b { c 1; }\n #if off\n d 1;\n #else\n d 2;\n #endif\n#endif", "d"), "2");
    EXPECT_THAT(reportOfReading("#if on\na 1;"), HasSubstr("The condition of line 1 is not closed"));
    for (const char* condition : {"on", "off"})
    {
        EXPECT_THAT(reportOfReading(fmt::format("#if {}\na 1;\n#elif on\na 2;\n#endif", condition)),
                    HasSubstr("#elif"));
    }
    EXPECT_THAT(reportOfReading("a 1;\n#endif"), HasSubstr("without a condition"));
    EXPECT_THAT(reportOfReading("#includ \"x\""), HasSubstr("Did you mean #include?"));
    EXPECT_THAT(reportOfReading("#calc \"2*3\";"),
                HasSubstr("#calc cannot stand here: it is the value of an"));
    EXPECT_THAT(reportOfReading("a 1\n#remove b;"),
                HasSubstr("#remove cannot stand here: it stands where an"));
    EXPECT_THAT(reportOfReading("a #codeStream { code #{ #}; };"), HasSubstr("never run code"));
    EXPECT_THAT(reportOfReading("#system \"touch /tmp/x\""), HasSubstr("never run code"));
}

TEST(Dictionary, ArithmeticIsCalculatedNotCompiled)
{
    EXPECT_EQ(expanded("x 3; y #calc \"2*$x + 1\";", "y"), "7");
    EXPECT_EQ(expanded("x 3; y #eval{ $x^2 };", "y"), "9");
    EXPECT_EQ(expanded("x 3; y #eval #{ pow(${x}, 2) #};", "y"), "9");
    EXPECT_EQ(expanded("y #eval{ sin(degToRad(30)) };", "y"), "0.49999999999999994");
    EXPECT_EQ(expanded("y #eval{ min(1, 2) + max(3, 4) };", "y"), "5");
    EXPECT_EQ(expanded("y #eval{ 1 < 2 ? 10 : 20 };", "y"), "10");
    EXPECT_EQ(expanded("y #eval{ cos(pi()) };", "y"), "-1");
    EXPECT_EQ(expanded("y (#eval{ 1 + 1 } 3);", "y"), "(2 3)");
    EXPECT_THAT(reportOfReading("y #eval{ 1/0 };"), HasSubstr("not a finite number"));
    EXPECT_THAT(reportOfReading("y #eval{ 1 + };"), HasSubstr("cannot be done"));
    EXPECT_THAT(reportOfReading("y #eval{ system(1) };"), HasSubstr("cannot be done"));
    EXPECT_THAT(reportOfReading("y #calc 3;"), HasSubstr("#calc is to be followed by"));
    EXPECT_THAT(reportOfReading("y #eval{ " + std::string(5000, '(') + " };"),
                HasSubstr("brackets are open"));
}

TEST_F(DictionaryFiles, IncludesCountFromTheFileThatIncludesAndKeepTheirPlaces)
{
    write("system/common", "FoamFile { object common; }\nmu 0.65;\nwrong word;\n");
    write("values", "(1 2 3)");
    const auto file =
        write("system/top", "FoamFile { object top; }\n#include \"common\"\n#includeIfPresent \"none\"\n"
                            "inner { #include \"<case>/system/common\" }\nlist #include \"../values\";\n");
    const Dictionary dictionary = Dictionary::readFile(file);
    EXPECT_EQ(dictionary.get<double>("mu"), 0.65);
    EXPECT_EQ(dictionary.subDict("FoamFile").get<std::string>("object"), "top");
    EXPECT_THAT(dictionary.subDict("inner").keywords(), ElementsAre("mu", "wrong"));
    EXPECT_THAT(dictionary.get<std::vector<int>>("list"), ElementsAre(1, 2, 3));
    EXPECT_THAT(reportOf([&] { dictionary.get<double>("wrong"); }),
                HasSubstr("system/common/wrong at line 3."));
}

TEST_F(DictionaryFiles, IncludeLoopsAndMissingFilesAreFound)
{
    const auto a = write("system/a", "x 1;\n#include \"b\"\n");
    write("system/b", "#include \"../system/a\"\n");
    EXPECT_THAT(reportOf([&] { Dictionary::readFile(a); }),
                AllOf(HasSubstr("include each other in a loop"), HasSubstr("system/b/#include at line 1.")));
    const auto self = write("system/self", "#include \"self\"\n");
    EXPECT_THAT(reportOf([&] { Dictionary::readFile(self); }), HasSubstr("in a loop"));
    const auto lost = write("system/lost", "\n#include \"nowhere\"\n");
    EXPECT_THAT(reportOf([&] { Dictionary::readFile(lost); }),
                AllOf(HasSubstr("does not exist"), HasSubstr("lost/#include at line 2.")));
    EXPECT_THAT(reportOf([&] { Dictionary::readFile(root / "absent"); }), HasSubstr("does not exist"));
    EXPECT_THAT(reportOf([&] { Dictionary::readFile(root); }), HasSubstr("is a directory"));
    EXPECT_THAT(reportOf([] { Dictionary::readFile("/dev/zero"); }), HasSubstr("not an ordinary file"));
    EXPECT_TRUE(Dictionary::readFileIfPresent(root / "absent").empty());
}

TEST_F(DictionaryFiles, AnEtcDirectoryOfOnesOwnIsIncludedFrom)
{
    write("defaults", "tolerance 1e-9;");
    ::setenv("DRYSTONE_ETC", root.c_str(), 1);
    const Dictionary dictionary = Dictionary::readString("#includeEtc \"defaults\"");
    ::unsetenv("DRYSTONE_ETC");
    EXPECT_EQ(dictionary.get<double>("tolerance"), 1e-9);
}

// ------------------------------------------------------------------------------------------------------- bad
// and hard

TEST(Dictionary, AMissingSemicolonBeforeASubDictionaryIsNamedWhereItIsMissing)
{
    for (const char* end : {"", "}\n"})
    {
        EXPECT_THAT(
            reportOfReading("a 1;\nb 0.5\n\nc\n{\n    d (1\n 2);\n    e { f 3; }\n}\n" + std::string(end)),
            AllOf(HasSubstr("value of b goes on with `c` at line 4"), HasSubstr("end of line 2?"),
                  HasSubstr("at line 2.")));
    }
}

TEST(Dictionary, WhatHasASlashIsShownInTheQuotesThatItNeeds)
{
    const auto refusal = [](const std::string& text)
    { return reportOf([&] { Dictionary::readString(text).get<std::string>("a"); }); };
    EXPECT_THAT(refusal("a alpha/(mu-mu);"), HasSubstr("\"alpha/(mu-mu)\""));
    EXPECT_THAT(refusal("a constant/r.AT2; b 1;"), HasSubstr("\"constant/r.AT2\""));
}

TEST(Dictionary, BrokenTextIsNamedWithItsLineAndRepair)
{
    EXPECT_THAT(reportOfReading("a 1;\nb { c 2 }\n"),
                AllOf(HasSubstr("A `;` is missing after the value of c"), HasSubstr("end of line 2"),
                      HasSubstr("file: system/some/b/c at line 2.")));
    EXPECT_THAT(reportOfReading("a 1"), HasSubstr("the end of the file came first"));
    EXPECT_THAT(reportOfReading("a 1;\nb {\nc 2;\n"), AllOf(HasSubstr("The `{` of line 2 is not closed"),
                                                            HasSubstr("file: system/some/b at line 2.")));
    EXPECT_THAT(reportOfReading("a 1;\n}\n"), AllOf(HasSubstr("`}` without a `{`"), HasSubstr("at line 2.")));
    EXPECT_THAT(reportOfReading("a (1 2;\nb 3;"),
                HasSubstr("The `(` of line 1 is not closed: `;` came at line 1"));
    EXPECT_THAT(reportOfReading("a 1 2);"), HasSubstr("`)` without the bracket that would open it"));
    EXPECT_THAT(reportOfReading("a [1 2);"), HasSubstr("The `[` of line 1 is not closed"));
    EXPECT_THAT(reportOfReading("{ a 1; }"), HasSubstr("`{` without a keyword"));
    EXPECT_THAT(reportOfReading("a 1;\n/* open\nb 2;"), AllOf(HasSubstr("comment"), HasSubstr("not closed")));
    EXPECT_THAT(reportOfReading("a \"open;\nb 2;"), AllOf(HasSubstr("string"), HasSubstr("at line 1.")));
    EXPECT_THAT(reportOfReading("a #{ open;"), HasSubstr("`#}`"));
    EXPECT_THAT(reportOfReading("a #eval{ 1 + 2;"), HasSubstr("arithmetic is not closed"));
    EXPECT_THAT(reportOfReading("= 1;"), HasSubstr("Unexpected `=`"));
    EXPECT_THAT(reportOfReading("$ 1;"), HasSubstr("followed by the name"));
    EXPECT_THAT(reportOfReading("\"(\" 1;"), HasSubstr("is not a regular expression"));
    EXPECT_THAT(reportOfReading("a 1;\n\"\" { b 1; }"),
                AllOf(HasSubstr("nothing between the quotes"), HasSubstr("at line 2.")));
    EXPECT_THAT(reportOfReading(std::string("a 1;\nb \0 2;", 10)),
                AllOf(HasSubstr("not a text file"), HasSubstr("at line 2.")));
    EXPECT_THAT(reportOfReading("\x7f"
                                "ELF"),
                HasSubstr("not a text file"));
}

TEST(Dictionary, HostileTextsEndInAMessage)
{
    const auto repeated = [](const std::string& text, int count)
    {
        std::string result;
        for (int i = 0; i < count; ++i)
        {
            result += text;
        }
        return result;
    };
    EXPECT_THAT(reportOfReading(repeated("a {", 100'000)), HasSubstr("nested more than"));
    EXPECT_THAT(reportOfReading("a " + repeated("(", 100'000)), HasSubstr("nested more than"));
    EXPECT_THAT(reportOfReading("a " + repeated("[(", 100'000)), HasSubstr("nested more than"));
    EXPECT_THAT(reportOfReading(repeated("#if on\n", 100'000)), HasSubstr("nested more than"));
    EXPECT_THAT(reportOfReading("a b" + repeated("(", 100'000) + ";"), HasSubstr("nested more than"));
    EXPECT_THAT(reportOfReading("a " + std::string(100'000, 'x') + ";"), HasSubstr("4096 letters"));
    EXPECT_THAT(reportOfReading(std::string(100'000, 'x') + " 1;"), HasSubstr("4096 letters"));
    EXPECT_THAT(reportOfReading("a " + repeated("${", 100'000) + ";"), HasSubstr("$"));
    EXPECT_THAT(reportOfReading("\"" + repeated("(a{1000}){1000}", 5) + "\" 1;"), HasSubstr("too large"));
    std::string doubling = "a0 1;";
    std::string deepening = "b0 { c 1; }";
    for (int i = 1; i < 200; ++i)
    {
        doubling += fmt::format("a{} $a{} $a{};", i, i - 1, i - 1);
        deepening += fmt::format("b{} {{ in {{ $:b{}; }} }}", i, i - 1);
    }
    EXPECT_THAT(reportOfReading(doubling), HasSubstr("too large"));
    EXPECT_THAT(reportOfReading(deepening), HasSubstr("deep"));
    // Slow for matchers that go back: it must neither take long nor match.
    const Dictionary slow = Dictionary::readString("\"(a*)*(a*)*(a*)*b\" 1;");
    EXPECT_FALSE(slow.found(std::string(300, 'a')));
}

TEST(Dictionary, EmptyTextsAndCommentsAreEmptyDictionaries)
{
    EXPECT_TRUE(Dictionary::readString("").empty());
    EXPECT_TRUE(Dictionary::readString("// only\n/* comments */ ; ;;").empty());
    EXPECT_TRUE(Dictionary::readString("\xEF\xBB\xBF").empty());
    const std::string ofTwoFiles = "\xEF\xBB\xBF/* first */ a 1;\n\xEF\xBB\xBF"
                                   "b 2;\n\xEF\xBB\xBF";
    EXPECT_EQ(Dictionary::readString(ofTwoFiles).keywords(), (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(Dictionary::readString("a 1;\r\nb 2;\r\n").get<int>("b"), 2);
    // An old Macintosh: comments end, and lines count.
    const Dictionary old = Dictionary::readString("a 1; // one\rb 2;\r");
    EXPECT_EQ(old.get<int>("b"), 2);
    EXPECT_EQ(old.locationOf("b").line, 2);
}

TEST(NearestWord, IsTheLikelyOneOrNone)
{
    EXPECT_EQ(nearestWord("runingBond", {"arch", "courses", "runningBond"}), "runningBond");
    EXPECT_EQ(nearestWord("coarses", {"arch", "courses"}), "courses");
    EXPECT_EQ(nearestWord("ACRH", {"arch", "courses"}), "arch");
    EXPECT_EQ(nearestWord("xyz", {"arch", "courses"}), "");
    EXPECT_EQ(nearestWord("", {"arch"}), "");
    EXPECT_EQ(nearestWord("a", {"b"}), "");
}

const char* const binaryHeader =
    "FoamFile { version 2.0; format binary; arch \"LSB;label=32;scalar=64\"; object state; }\n";

std::string binaryList(const std::vector<double>& values)
{
    return fmt::format("List<scalar> {}(", values.size())
           + std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)) + ")";
}

TEST(BinaryList, HoldsAnyBytesOfFiniteNumbers)
{
    // Their bytes include brackets, quotes, semicolons and line ends.
    const std::vector<double> values{0, -0.0, 1e-308, 4.9e-324, 6.1e-154, 2.0e257, -3.25, 3.1415926535897932};
    const Dictionary dictionary =
        Dictionary::readString(binaryHeader + std::string("time 0.5;\nvelocity ") + binaryList(values)
                               + ";\nempty " + binaryList({}) + ";\nlast 3;\n");
    EXPECT_EQ(dictionary.get<double>("time"), 0.5);
    EXPECT_EQ(dictionary.get<std::vector<double>>("velocity"), values);
    EXPECT_TRUE(dictionary.get<std::vector<double>>("empty").empty());
    EXPECT_EQ(dictionary.get<int>("last"), 3);
    EXPECT_EQ(Dictionary::readString(toText(dictionary)).get<std::vector<double>>("velocity"), values);
}

TEST(BinaryList, DamagedIsRefusedWithItsEntry)
{
    const auto report = [](const std::string& text)
    { return reportOf([&] { Dictionary::readString(text).get<std::vector<double>>("v"); }); };
    const std::string whole = binaryHeader + std::string("v ") + binaryList({1, 2, 3}) + ";\n";
    EXPECT_EQ(report(whole), "no error");
    EXPECT_THAT(report(whole.substr(0, whole.size() - 8)), HasSubstr("ends within a list of 3 numbers"));
    EXPECT_THAT(report(binaryHeader + std::string("v List<scalar> 1(12345678;);")),
                HasSubstr("not followed by `)`"));
    EXPECT_THAT(report(binaryHeader + std::string("v List<scalar> (1 2);")),
                HasSubstr("A binary list is written"));
    EXPECT_THAT(report(binaryHeader + std::string("v List<scalar> 99999999999999999999(")),
                HasSubstr("A binary list is written"));
    EXPECT_THAT(report(binaryHeader + std::string("v List<scalar> 999999999999(")),
                HasSubstr("ends within a list"));
    EXPECT_THAT(report(binaryHeader + std::string("v ")
                       + binaryList({1, std::numeric_limits<double>::quiet_NaN()}) + ";"),
                HasSubstr("not a finite number"));
    EXPECT_THAT(report("FoamFile { format binary; arch \"MSB;label=32;scalar=64\"; }\nv 1;"),
                HasSubstr("another byte order"));
    EXPECT_THAT(report("v " + binaryList({1, 2}) + ";"), HasSubstr("not a text file")); // no header says so
}

} // namespace
} // namespace drystone
