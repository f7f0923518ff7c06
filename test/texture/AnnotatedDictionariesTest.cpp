// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The annotated dictionaries in etc/ say what the declared options say, and can be used as they stand.
#include "assembly/ContactProperties.h"
#include "assembly/Loads.h"
#include "assembly/Materials.h"
#include "texture/Texture.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace drystone;

namespace
{

struct AnnotatedDictionary
{
    std::string file; ///< in a case
    std::string doc;
    std::vector<OptionDescription> options;
};

std::vector<AnnotatedDictionary> annotatedDictionaries()
{
    return {
        {"system/blockTextureDict",
         "The blocks of a structure and what supports them, read by blockTexture.\nLengths are in metres, or "
         "in units "
         "where that is said: lengths of a full block.",
         describeOptions<BlockTexture>()},
        {"constant/g", "Gravity.", describeOptions<Gravity>()},
        {"constant/materialProperties", "What the blocks are made of. Give density or unitWeight.",
         describeOptions<MaterialProperties>()},
        {"constant/contactProperties",
         "What happens at the contacts: an effect without an entry is not simulated, and costs nothing.",
         describeOptions<ContactProperties>()},
        {"constant/loads", "Loads on the blocks.", describeOptions<LoadCases>()},
    };
}

TEST(AnnotatedDictionaries, AreWhatTheDeclaredOptionsSay)
{
    for (const AnnotatedDictionary& dictionary : annotatedDictionaries())
    {
        const std::filesystem::path shipped =
            std::filesystem::path(DRYSTONE_SOURCE_DIR) / "etc/dictionaries" / dictionary.file;
        const std::string text =
            annotatedDictionary(shipped.filename().string(), dictionary.doc, dictionary.options);
        std::ifstream stream(shipped);
        std::stringstream content;
        content << stream.rdbuf();
        if (content.str() != text)
        {
            const std::filesystem::path renewed =
                std::filesystem::path(DRYSTONE_BINARY_DIR) / "etc/dictionaries" / dictionary.file;
            std::filesystem::create_directories(renewed.parent_path());
            std::ofstream(renewed) << text;
            ADD_FAILURE() << shipped << " is out of date. Copy " << renewed << " over it.";
        }
    }
}

// All but constant/materialProperties, where density or unitWeight is to be chosen.
TEST(AnnotatedDictionaries, CanBeUsedAsTheyStand)
{
    const std::filesystem::path folder = std::filesystem::path(DRYSTONE_SOURCE_DIR) / "etc/dictionaries";
    const Assembly<2> assembly = makeStructure(Dictionary::readFile(folder / "system/blockTextureDict"));
    EXPECT_GT(assembly.blocks.size(), 0U);
    const Vector<2> gravity = readGravity(folder);
    EXPECT_TRUE(readContactProperties(folder).friction);
    const std::vector<double> masses(assembly.blocks.size(), 1);
    EXPECT_GT(readLoads(folder, {assembly, masses, gravity}, LiveLoad::required).live.norm(), 0);
}

} // namespace
