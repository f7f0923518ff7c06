// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `import` and the supports that it brings, from a dictionary.
#include "ImportTesting.h"
#include "dictionary/Dictionary.h"
#include "texture/Texture.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

using namespace drystone;
using testing::AllOf;
using testing::HasSubstr;

namespace
{

class Imports : public testing::Test
{
protected:
    void SetUp() override
    {
        directory =
            std::filesystem::path(testing::TempDir())
            / ("imports-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::create_directories(directory);
    }
    void TearDown() override { std::filesystem::remove_all(directory); }

    void write(const std::string& file, const std::string& text) const
    {
        std::ofstream(directory / file) << text;
    }

    template<int Dim = 3>
    Assembly<Dim> make(const std::string& texture, const std::string& supports = "") const
    {
        return makeStructure<Dim>(Dictionary::readString("dimensions " + fmt::format("{}", Dim)
                                                             + "; texture { type import; " + texture
                                                             + " } supports { " + supports + " }",
                                                         "test"),
                                  directory);
    }

    std::filesystem::path directory;
};

const std::string wedge = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::string faces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

TEST_F(Imports, AByteOrderMarkHidesNoLine)
{
    const std::string mark = "\xEF\xBB\xBF";
    write("a.obj", mark + wedge + faces);
    EXPECT_EQ(make("file \"a.obj\";").blocks.front().shape.vertices.front(), Vector<3>(0, 0, 0));
    write("named.obj", mark + "o base\n" + wedge + faces);
    EXPECT_EQ(make("file \"named.obj\";").zones.at(0).name, "base");
    write("a.ply",
          mark
              + "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
                "float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 "
                "0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
    EXPECT_EQ(make("file \"a.ply\";").blocks.size(), 1u);
    std::string facets;
    for (const char* corners :
         {"0 0 0 0 1 0 1 0 0", "0 0 0 1 0 0 0 0 1", "1 0 0 0 1 0 0 0 1", "0 1 0 0 0 0 0 0 1"})
    {
        const std::string all(corners);
        facets += fmt::format(
            "facet normal 0 0 0\nouter loop\nvertex {}\nvertex {}\nvertex {}\nendloop\nendfacet\n",
            all.substr(0, 5), all.substr(6, 5), all.substr(12, 5));
    }
    write("a.stl", mark + "solid base\n" + facets + "endsolid base\n");
    EXPECT_EQ(make("file \"a.stl\";").blocks.size(), 1u);
    write("a.svg", mark + "<?xml version=\"1.0\"?><svg><rect width=\"2\" height=\"1\"/></svg>");
    EXPECT_EQ(make<2>("file \"a.svg\";").blocks.size(), 1u);
    write("a.dxf", mark
                       + "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\nstone\n90\n3\n70\n1\n10\n0\n20\n0\n10\n"
                         "2\n20\n0\n10\n0\n20\n1\n0\nENDSEC\n0\nEOF\n");
    EXPECT_EQ(make<2>("file \"a.dxf\";").blocks.size(), 1u);
    write("empty.json", mark + "[]");
    EXPECT_THAT(reportOf([&] { make("file \"empty.json\";"); }), testing::Not(HasSubstr("JSON")));
}

TEST_F(Imports, LayersAreFixedByTheSupportsNameOrByPattern)
{
    write("a.obj", wedge + "o base.1\n" + faces + "o base.2\n" + faces + "o stone.3\n" + faces);
    const auto supportsOf = [&](const std::string& supports)
    {
        std::vector<int> result;
        for (const Block<3>& block : make("file \"a.obj\";", supports).blocks)
        {
            result.push_back(block.support);
        }
        return result;
    };
    EXPECT_EQ(supportsOf("base { type import; }"), (std::vector<int>{0, 0, -1}));
    EXPECT_EQ(supportsOf("feet { type import; layers (\"b.*\"); }"), (std::vector<int>{0, 0, -1}));
    EXPECT_THAT(reportOf([&] { supportsOf("feet { type import; }"); }),
                AllOf(HasSubstr("no layer feet"), HasSubstr("Layers: base stone")));
    EXPECT_THAT(reportOf([&] { supportsOf("feet { type import; layers (stones); }"); }),
                HasSubstr("Did you mean stone?"));
}

// Layers 1 and 2, as CAD programs number them, were one zone `_`, and others became one without a word.
TEST_F(Imports, LayersWhoseNamesAreNoKeysAreZonesOfTheirOwnOrWarnedOf)
{
    const auto zonesOf =
        [&](const std::string& one, const std::string& other, const std::string& support = "")
    {
        const auto square = [](const std::string& layer, int x)
        {
            return fmt::format(
                "0\nLWPOLYLINE\n8\n{0}\n90\n4\n70\n1\n10\n{1}\n20\n0\n10\n{2}\n20\n0\n10\n{2}\n20\n"
                "1\n10\n{1}\n20\n1\n",
                layer, x, x + 1);
        };
        write("a.dxf",
              "0\nSECTION\n2\nENTITIES\n" + square(one, 0) + square(other, 1) + "0\nENDSEC\n0\nEOF\n");
        const Assembly<2> assembly = make<2>("file \"a.dxf\";", support);
        std::string names;
        for (const Zone& zone : assembly.zones)
        {
            names += fmt::format("{}({}) ", zone.name, fmt::join(zone.blocks, " "));
        }
        return names + (assembly.blocks[1].support == 0 ? "1 is fixed" : "");
    };
    testing::internal::CaptureStderr();
    EXPECT_EQ(zonesOf("1", "2-b"), "_1(0) _2-b(1) ");
    EXPECT_EQ(zonesOf("a", "a"), "a(0 1) ");
    EXPECT_EQ(zonesOf("stone", "St 1", "base { type import; layers (\"St 1\"); }"),
              "stone(0) St_1(1) 1 is fixed");
    EXPECT_EQ(zonesOf("1", "2", "base { type import; layers (2); }"), "_1(0) _2(1) 1 is fixed");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    testing::internal::CaptureStderr();
    EXPECT_EQ(zonesOf("St 1", "St_1"), "St_1(0 1) ");
    EXPECT_THAT(testing::internal::GetCapturedStderr(),
                AllOf(HasSubstr("St 1 and St_1 have become one zone, St_1"), HasSubstr("a.dxf")));
}

// Objects of a file that has materials, too, are no layers: that was an unknown layer without a word of why.
TEST_F(Imports, ObjectsBesideMaterialsAreNoLayersAndTheMessageSaysWhatToDo)
{
    write("a.obj", "o base.001\nusemtl stone\n" + wedge + faces);
    EXPECT_THAT(reportOf([&] { make<3>("file \"a.obj\";", "ground { type import; layers (base); }"); }),
                AllOf(HasSubstr("Unknown layer base"), HasSubstr("Valid layers: stone"),
                      HasSubstr("materials, and only where it has none its objects"),
                      HasSubstr("`type blocks;`")));
    EXPECT_EQ(make<3>("file \"a.obj\";", "ground { type import; layers (stone); }").blocks[0].support, 0);
    write("b.obj", "o base.001\n" + wedge + faces);
    EXPECT_EQ(make<3>("file \"b.obj\";", "ground { type import; layers (base); }").blocks[0].support, 0);
}

TEST_F(Imports, TheFormatFollowsFromTheName)
{
    write("a.OBJ", wedge + faces);
    write("b.txt", wedge + faces);
    EXPECT_EQ(make("file \"a.OBJ\";").blocks.size(), 1u);
    EXPECT_EQ(make("file \"b.txt\"; format obj;").blocks.size(), 1u);
    EXPECT_THAT(reportOf([&] { make("file \"b.txt\";"); }),
                AllOf(HasSubstr("ends in `.txt`"), HasSubstr("texture/file")));
    EXPECT_THAT(reportOf([&] { make("file \"c.obj\";"); }), HasSubstr("There is no file"));
    EXPECT_THAT(reportOf([&] { make("file \"a.OBJ\"; format dwg;"); }), HasSubstr("Valid"));
    EXPECT_THAT(reportOf([&] { make<2>("file \"a.OBJ\";"); }), HasSubstr("dimensions 3"));
    EXPECT_THAT(reportOf([&] { make("file \"a.dxf\";"); }), HasSubstr("type extrusion"));
    std::filesystem::create_directory(directory / "d.obj");
    EXPECT_THAT(reportOf([&] { make("file \"d.obj\";"); }), HasSubstr("not an ordinary file"));
    write("e.obj", "");
    EXPECT_THAT(reportOf([&] { make("file \"e.obj\";"); }), HasSubstr("empty"));
}

TEST_F(Imports, ATextInUtf16IsRefusedAsSuch)
{
    for (const int first : {0, 1}) // of the two bytes of a letter the one with its value
    {
        std::string wide = first == 0 ? "\xFF\xFE" : "\xFE\xFF";
        for (const char letter : wedge + faces)
        {
            wide += first == 0 ? std::string{letter, '\0'} : std::string{'\0', letter};
        }
        write("f.obj", wide);
        EXPECT_THAT(reportOf([&] { make("file \"f.obj\";"); }), HasSubstr("save it in UTF-8"));
        write("f.obj", wide.substr(2));
        EXPECT_THAT(reportOf([&] { make("file \"f.obj\";"); }), HasSubstr("save it in UTF-8"));
    }
}

TEST_F(Imports, ADrawingGivenDepthKeepsItsLayersAndSupports)
{
    write("f.svg",
          "<svg><g id=\"base\"><rect x=\"0\" y=\"-1\" width=\"1\" height=\"1\"/></g><rect x=\"0\" y=\"-2\" "
          "width=\"1\" height=\"1\"/></svg>");
    const Assembly<3> assembly = makeStructure<3>(
        Dictionary::readString(
            "dimensions 3; texture { type extrusion; of { type import; file \"f.svg\"; } thickness 0.5; } "
            "supports { base { type import; } }",
            "test"),
        directory);
    ASSERT_EQ(assembly.blocks.size(), 2u);
    EXPECT_EQ(assembly.blocks[0].support, 0);
    EXPECT_EQ(assembly.blocks[1].support, -1);
    EXPECT_NEAR(volumeProperties(assembly.blocks[1].shape).volume, 0.5, 1e-15);
    EXPECT_EQ(make<2>("file \"f.svg\"; thickness 0.3;").blocks[0].thickness, 0.3);
}

} // namespace
