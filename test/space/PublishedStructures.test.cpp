// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Assemblies that others published, imported: their multipliers by the interfaces in the file and by the
/// contacts that are found from the blocks. Multipliers were computed by another program, with the interfaces
/// (COMPAS assemblies).
#include "../MadeStructure.h"
#include "SpaceStructures.h"
#include "contact/JointClosure.h"
#include "dictionary/Dictionary.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

/// Next to the tutorial that imports them, or next to the project.
fs::path pathOf(const std::string& file)
{
    for (const char* folder :
         {"tutorials/limitAnalysis/space/importedAssemblies/structures", "../shared/structures"})
    {
        const fs::path path = fs::path(DRYSTONE_SOURCE_DIR) / folder / file;
        if (fs::exists(path))
        {
            return path;
        }
    }
    return {};
}

struct Published
{
    std::string file;
    std::string texture; ///< keys in addition to `file`
    std::string supports;
    double mu;
    int joints;
    int points; ///< 0: not compared
    std::vector<std::pair<Vector<3>, double>> multipliers;
    double gate;
};

void PrintTo(const Published& published, std::ostream* stream)
{
    *stream << published.file << " " << published.texture;
}

const std::string marked = "base { type import; }";
const std::string contacts = "interfaces contacts;";
const std::string found = "interfaces ignored;";
const double diagonal = std::sqrt(0.5);

std::vector<Published> allPublished()
{
    const auto along = [](double x, double y, double xy)
    {
        return std::vector<std::pair<Vector<3>, double>>{
            {{1, 0, 0}, x}, {{0, 1, 0}, y}, {{diagonal, diagonal, 0}, xy}};
    };
    const auto wall = along(0.7, 0.6686016, 0.6423387);
    const auto arch = along(0.2984043, 0.1637978, 0.2272116);
    const auto vault = along(0.4395122, 0.4395229, 0.4574416);
    return {
        {"wall_assembly.json", contacts, marked, 0.7, 80, 480, wall, 1e-6},
        {"wall_assembly.json", "", marked, 0.7, 80, 480, wall, 1e-6},
        {"wall_assembly.json", found, marked, 0.7, 80, 0, wall, 1e-4},
        {"wall_assembly.json", contacts, marked, 0.3, 80, 480, along(0.3, 0.3, 0.3), 1e-6},
        {"arch_assembly.json", contacts, marked, 0.5, 29, 116, arch, 1e-6},
        {"arch_assembly.json", found, marked, 0.5, 29, 0, arch, 1e-4},
        {"crossvault_assembly.json", contacts, marked, 0.7, 488, 2033, vault, 1e-6},
        // Its blocks are in each other by up to 0.67 mm along two seams, and its faces uneven by 0.025 mm.
        {"crossvault_assembly.json", "tolerance 0.001; interfaces ignored;", marked, 0.7, 488, 0, vault,
         1e-4},
        {"wall.obj",
         "",
         "ground { type ground; }",
         0.5,
         65,
         260,
         {{{1, 0, 0}, 0.5}, {{0, 1, 0}, 0.285714286}},
         1e-8},
    };
}

class PublishedStructure : public testing::TestWithParam<Published>
{
};

TEST_P(PublishedStructure, HasItsMultipliers)
{
    const Published& published = GetParam();
    const fs::path path = pathOf(published.file);
    if (path.empty())
    {
        GTEST_SKIP() << published.file << " is not here: see the README of importedAssemblies";
    }
    Assembly<3> assembly = madeStructure<3>(Dictionary::readString(
        fmt::format("dimensions 3; texture {{ type import; file \"{}\"; {} }} supports {{ {} }}",
                    fs::absolute(path).string(), published.texture, published.supports),
        "test"));
    closeJoints(assembly);
    const std::vector<ContactPoint<3>> points = findContactPoints(assembly);
    ASSERT_FALSE(points.empty());
    EXPECT_EQ(points.back().joint + 1, published.joints);
    if (published.points > 0)
    {
        EXPECT_EQ(static_cast<int>(points.size()), published.points);
    }
    for (const auto& [direction, alpha] : published.multipliers)
    {
        const LimitAnalysis result =
            test::collapse(assembly, points, published.mu, test::pushed(assembly, direction));
        EXPECT_EQ(result.status, CollapseStatus::optimal);
        EXPECT_NEAR(result.alpha, alpha, published.gate) << direction.transpose();
        EXPECT_LE(result.certificate.worst(), 1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(Files, PublishedStructure, testing::ValuesIn(allPublished()));

} // namespace
} // namespace drystone
