// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Declared settings: reading, checks and messages, and the texts that are made from declarations.
#include "../ReportOf.h"
#include "dictionary/Registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <variant>

namespace drystone
{
namespace
{

enum class FirstCourse
{
    half,
    full
};

constexpr std::array<std::pair<std::string_view, FirstCourse>, 2> namesOf(FirstCourse)
{
    return {{{"half", FirstCourse::half}, {"full", FirstCourse::full}}};
}

struct Opening
{
    std::array<double, 2> from{};
    std::array<double, 2> to{};
};

void declare(Options& options, Opening& opening)
{
    options.required("from", opening.from, "lower left corner").example("(1.5 3)");
    options.required("to", opening.to, "upper right corner").example("(2.5 8)");
}

struct RunningBond
{
    std::array<double, 2> unit{0.4, 0.2};
    double thickness = 1;
    int courses = 1;
    FirstCourse firstCourse = FirstCourse::half;
    std::vector<Opening> openings;
};

void declare(Options& options, RunningBond& bond)
{
    options.required("unit", bond.unit, "length of a full block, height of a course")
        .unit("m")
        .above(0)
        .example("(0.4 0.175)");
    options.optional("thickness", bond.thickness, "out of plane").unit("m").above(0);
    options.required("courses", bond.courses, "number of courses").atLeast(1);
    options.optional("firstCourse", bond.firstCourse, "how the bottom course starts and ends");
    options.optional("openings", bond.openings, "doors and windows");
    options.check("openings",
                  [&bond]() -> std::string {
                      return bond.openings.size() > 2 ? "There are more than two openings. Remove some." : "";
                  });
}

struct Arch
{
    double radius = 1;
    std::optional<double> rise;
};

void declare(Options& options, Arch& arch)
{
    options.optional("radius", arch.radius, "of the centreline").unit("m").above(0);
    options.optional("rise", arch.rise, "of the crown").unit("m");
}

using Texture = std::variant<std::monostate, RunningBond, Arch>;

const Registry<Texture>& textureTypes()
{
    static const Registry<Texture> registry{
        "texture",
        {model<Texture, RunningBond>("runningBond", "blocks of one size",
                                     [](RunningBond bond) { return bond; }),
         model<Texture, Arch>("arch", "a circular arch", [](const Arch& arch) { return arch; })}};
    return registry;
}

struct Support
{
    double segment = 0;
};

void declare(Options& options, Support& support)
{
    options.optional("segment", support.segment, "length of a piece").unit("m").atLeast(0);
}

struct BlockTextureDict
{
    int dimensions = 2;
    Texture texture;
    std::vector<Named<Support>> supports;
};

void declare(Options& options, BlockTextureDict& settings)
{
    options.optional("dimensions", settings.dimensions, "of space").atLeast(2).atMost(3);
    options.required("texture", settings.texture, textureTypes(), "how blocks are laid");
    options.optional("supports", settings.supports, "what holds the structure");
}

std::string reportOfTexture(const std::string& text)
{
    return reportOf(
        [&] { readOptions<BlockTextureDict>(Dictionary::readString(text, "system/blockTextureDict")); });
}

TEST(Options, ReadAModelWithItsDefaultsListsAndNamedDictionaries)
{
    const auto settings = readOptions<BlockTextureDict>(Dictionary::readString(R"(
        FoamFile { class dictionary; }
        width 0.4;
        texture
        {
            type runningBond; unit ($width 0.175); courses 6; firstCourse full;
            openings ( { from (1.5 3); to (2.5 8); } { from (0 0); to (1 1 0); } );
        }
        supports { ground { segment 0.5; } left { } }
    )"));
    const auto& bond = std::get<RunningBond>(settings.texture);
    EXPECT_EQ(bond.unit, (std::array{0.4, 0.175}));
    EXPECT_EQ(bond.thickness, 1);
    EXPECT_EQ(bond.firstCourse, FirstCourse::full);
    ASSERT_EQ(bond.openings.size(), 2U);
    EXPECT_EQ(bond.openings[1].to, (std::array{1.0, 1.0}));
    ASSERT_EQ(settings.supports.size(), 2U);
    EXPECT_EQ(settings.supports[0].first, "ground");
    EXPECT_EQ(settings.supports[0].second.segment, 0.5);
    EXPECT_EQ(settings.supports[1].second.segment, 0);
}

TEST(Options, AnUnusualValueIsTakenAsItIsWithOneWarning)
{
    struct Material
    {
        double density = 0;
        std::vector<double> mu;
        void declareIn(Options& options)
        {
            options.required("density", density, "of blocks")
                .unit("kg/m3")
                .usual(300, 8000, "brick has 1800");
            options.optional("mu", mu, "friction").usual(0, 10);
            options.question("mu",
                             [this]() -> std::string
                             { return mu.size() > 1 ? "That are many coefficients. Usual is one." : ""; });
        }
    };
    const auto warningsOf = [](const std::string& text)
    {
        Material material;
        Options options;
        material.declareIn(options);
        testing::internal::CaptureStderr();
        options.readFrom(Dictionary::readString(text, "constant/material"));
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_EQ(warningsOf("density 300;"), "");
    EXPECT_EQ(warningsOf("density 8000; mu (10);"), "");
    EXPECT_EQ(
        warningsOf("\ndensity 2.2;"),
        "--> DRYSTONE Warning :\ndensity = 2.2 [kg/m3] is unusual: usual is from 300 to 8000; brick has "
        "1800. It is used as it stands.\n\nfile: constant/material/density at line 2.\n\n");
    EXPECT_EQ(warningsOf("\ndensity 2.2;"), ""); // read again, said once
    EXPECT_EQ(warningsOf("density 2000; mu (0.5\n 0.6);"),
              "--> DRYSTONE Warning :\nThat are many coefficients. Usual is one.\n\nfile: "
              "constant/material/mu at line 1.\n\n");
    EXPECT_THAT(warningsOf("density 2000; mu (\n31);"), testing::HasSubstr("mu at line 2."));

    Material material;
    Options options;
    material.declareIn(options);
    EXPECT_THAT(helpText(options.descriptions()),
                testing::HasSubstr("of blocks [kg/m3], usually from 300 to 8000; required"));
}

TEST(Options, AnUnknownTypeIsReportedAsTheContractHasIt)
{
    EXPECT_EQ(reportOfTexture("\n\n\ntexture\n{\n\n\n\n\n\n\n    type runingBond;\n}\n"),
              "--> DRYSTONE FATAL IO ERROR:\n"
              "Unknown texture type runingBond. Did you mean runningBond?\n"
              "\n"
              "Valid texture types: arch runningBond\n"
              "\n"
              "file: system/blockTextureDict/texture/type at line 12.\n"
              "\n"
              "DRYSTONE exiting\n");
}

TEST(Options, AllFaultsOfADictionaryAreReportedEachWithItsPlace)
{
    using testing::HasSubstr;
    const std::string report =
        reportOfTexture("texture { type runningBond;\ncolour red;\ncourse 6; unit (0.4\n-1);\n"
                        "firstCourse quarter; }");
    const std::string expected[] = {"--> DRYSTONE FATAL IO ERROR:\nUnknown key colour.",
                                    "texture/colour at line 2.",
                                    "Unknown key course. Did you mean courses?",
                                    "texture/course at line 3.",
                                    "unit = -1 [m] is out of range: it must be above 0.",
                                    "texture/unit at line 4.",
                                    "Unknown firstCourse quarter.",
                                    "texture/firstCourse at line 5.\n\nDRYSTONE exiting"};
    std::size_t from = 0;
    for (const std::string& part : expected)
    {
        const std::size_t at = report.find(part, from);
        ASSERT_NE(at, std::string::npos) << part << "\nin\n" << report;
        from = at;
    }
    EXPECT_EQ(report.find("is missing"), std::string::npos) << "courses is misspelt, not missing\n" << report;
}

TEST(Options, FaultsAreNamedWithTheirPlaceAndRepair)
{
    using testing::HasSubstr;
    const std::string start = "texture { type runningBond;\n";
    EXPECT_THAT(reportOfTexture(start + "unit (0.4 0.2);\ncourses 6; thicknes 1; }"),
                AllOf(HasSubstr("Unknown key thicknes. Did you mean thickness?"),
                      HasSubstr("Valid keys: courses firstCourse openings thickness type unit"),
                      HasSubstr("file: system/blockTextureDict/texture/thicknes at line 3.")));
    EXPECT_THAT(
        reportOfTexture(start + "courses 6; }"),
        AllOf(HasSubstr("The entry unit is missing: length of a full block, height of a course [m]. Write "
                        "for example `unit (0.4 0.175);`"),
              HasSubstr("file: system/blockTextureDict/texture at line 1.")));
    EXPECT_THAT(reportOfTexture(start + "courses 6; unit (0.4\n-1); }"),
                AllOf(HasSubstr("unit = -1 [m] is out of range: it must be above 0."),
                      HasSubstr("texture/unit at line 3.")));
    EXPECT_THAT(reportOfTexture(start + "courses 6; unit (0.4 nan); }"), HasSubstr("Only finite numbers"));
    EXPECT_THAT(reportOfTexture(start + "courses 6.5; unit (0.4 1); }"),
                HasSubstr("an integer is expected but `6.5`"));
    EXPECT_THAT(reportOfTexture(start + "courses 6; unit 0.4; }"), HasSubstr("a vector of 2 numbers"));
    EXPECT_THAT(
        reportOfTexture(start + "courses 6; unit (1 1); thickness [1 0 0 0 0 0 0] 1; }"),
        HasSubstr("has the dimensions [1 0 0 0 0 0 0], but [0 1 0 0 0 0 0] are those of its unit, m"));
    EXPECT_EQ(reportOfTexture(start + "courses 6; unit (1 1); thickness [0 1 0 0 0 0 0] 1; }"), "no error");
    EXPECT_EQ(reportOfTexture(start + "courses 6; unit (1 1); thickness thickness [m] 1; }"), "no error");
    EXPECT_THAT(reportOfTexture(start + "courses 6; unit (1 1); firstCourse quarter; }"),
                HasSubstr("Valid firstCourses: full half"));
    EXPECT_THAT(reportOfTexture(start + "courses 6; unit (1 1)\nthickness 2; }"),
                AllOf(HasSubstr("Is a `;` missing at the end of line 2?"), HasSubstr("unit at line 2.")));
    EXPECT_THAT(
        reportOfTexture(start + "courses 6; unit (1 1); openings ( { from (0 0); too (1 1); } ); }"),
        AllOf(HasSubstr("Unknown key too. Did you mean to?"), HasSubstr("texture/openings/too at line 2.")));
    EXPECT_THAT(reportOfTexture(start + "courses 6; unit (1 1);\nopenings 3{ {from (0 0); to (1 1);} }; }"),
                AllOf(HasSubstr("more than two openings"), HasSubstr("texture/openings at line 3.")));
    EXPECT_THAT(reportOfTexture("texture { type arch; } dimensions 4;"), HasSubstr("must be from 2 to 3"));
    EXPECT_THAT(
        reportOfTexture("texture { radius 1; }"),
        HasSubstr(
            "The entry type is missing: it chooses the texture.\n\nValid texture types: arch runningBond"));
    EXPECT_THAT(reportOfTexture("texture\n{\n    tpye arch;\n}"),
                AllOf(HasSubstr("it chooses the texture. Did you mean type with tpye at line 3?\n\nValid"),
                      HasSubstr("texture at line 1.")));
    EXPECT_THAT(reportOfTexture("dimensions 2;"),
                HasSubstr("The sub-dictionary texture is missing: how blocks are laid."));
    EXPECT_THAT(reportOfTexture("texture arch;"),
                HasSubstr("texture is a value, but a sub-dictionary is wanted here"));
    EXPECT_THAT(reportOfTexture("texture { type arch; } 2 ((0 0) (1 1))"),
                HasSubstr("a list without a keyword"));
}

struct SolutionOfOne
{
    double tolerance = 1e-9;
};

void declare(Options& options, SolutionOfOne& solution)
{
    options.optional("tolerance", solution.tolerance, "of the certificate").above(0);
    options.readElsewhere({"contactDynamics", "limitAnalysis"});
}

TEST(Options, KeysOfOtherReadersAreNotUnknownButMisspeltOnesAre)
{
    EXPECT_EQ(readOptions<SolutionOfOne>(Dictionary::readString("contactDynamics { anything 1; }")).tolerance,
              1e-9);
    EXPECT_THROW(readOptions<SolutionOfOne>(Dictionary::readString("contactDynamic { anything 1; }")),
                 FatalIOError);
}

struct BlockStart
{
    std::array<double, 2> velocity{};
};

void declare(Options& options, BlockStart& start)
{
    options.optional("velocity", start.velocity, "at the start").unit("m/s");
}

struct Motion
{
    std::vector<std::pair<NamePattern, BlockStart>> blocks;
};

void declare(Options& options, Motion& motion)
{
    options.each(motion.blocks, "of the block with this index");
}

TEST(Options, NamesOfUsersMayBeQuotedPatterns)
{
    const auto motion = readOptions<Motion>(Dictionary::readString(
        "FoamFile { object motion; } 0 { velocity (1 0); } \"1[0-9]\" { velocity (2 0 0); }"));
    ASSERT_EQ(motion.blocks.size(), 2U);
    EXPECT_TRUE(motion.blocks[0].first.matches("0"));
    EXPECT_FALSE(motion.blocks[0].first.matches("00"));
    EXPECT_TRUE(motion.blocks[1].first.matches("17"));
    EXPECT_FALSE(motion.blocks[1].first.matches("170"));
    EXPECT_EQ(motion.blocks[1].second.velocity[0], 2);
}

TEST(Options, AnAnnotatedDictionaryReadsBackAsTheDefaults)
{
    const std::string text = annotatedDictionary("blockTextureDict", "Blocks of a structure.",
                                                 describeOptions<BlockTextureDict>());
    EXPECT_THAT(text,
                testing::HasSubstr("// length of a full block, height of a course [m], above 0; required\n"
                                   "    unit            (0.4 0.175);\n"));
    EXPECT_THAT(text,
                testing::HasSubstr("// out of plane [m], above 0; default 1\n    thickness       1;\n"));
    EXPECT_THAT(text, testing::HasSubstr("// or\n// texture\n// {\n//     // a circular arch\n"));
    const auto settings = readOptions<BlockTextureDict>(Dictionary::readString(text));
    EXPECT_EQ(std::get<RunningBond>(settings.texture).thickness, 1);
    const std::string help = helpText(describeOptions<BlockTextureDict>());
    EXPECT_THAT(help, testing::HasSubstr("thickness"));
}

} // namespace
} // namespace drystone
