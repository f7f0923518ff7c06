// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A structure that gets the contact properties that its case has now is the one that the case is read as.
#include "statics/LimitAnalysisCase.h"

#include "assembly/AssemblyFile.h"
#include "core/Error.h"
#include "core/WholeFile.h"
#include "runControl/CaseFiles.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <unistd.h>

namespace drystone
{
namespace
{

namespace fs = std::filesystem;

/// Two blocks of 1 x 1 m on each other, on the ground, pushed to the side.
class ContactReadAnew : public testing::Test
{
protected:
    void SetUp() override
    {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        directory = fs::temp_directory_path() / fmt::format("drystone-{}-{}", ::getpid(), test->name());
        Assembly<2> assembly;
        assembly.blocks = {{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1, -1},
                           {{{0, 1}, {1, 1}, {1, 2}, {0, 2}}, 1, -1},
                           {{{-1, -1}, {2, -1}, {2, 0}, {-1, 0}}, 1, 0}};
        assembly.supports = {{"ground", "ground"}};
        writeWholeFile(assemblyFile(directory), assemblyText(assembly));
        writeWholeFile(directory / "constant/g", "value (0 -10 0);");
        writeWholeFile(directory / "constant/materialProperties", "density 1000;");
        writeWholeFile(directory / "constant/loads",
                       "dead { type gravity; } live { type inertial; direction (1 0); }");
        setContact("friction { type Coulomb; mu 0.4; }");
    }
    void TearDown() override { fs::remove_all(directory); }

    void setContact(const std::string& text)
    {
        writeWholeFile(directory / "constant/contactProperties", text);
    }

    fs::path directory;
};

TEST_F(ContactReadAnew, HasFrictionsAndStrengthsOfTheCase)
{
    LimitAnalysisCase<2> structure = readLimitAnalysisCase<2>(directory);
    for (const std::string contact :
         {"friction { type Coulomb; mu 0.7; }",
          "friction { type Coulomb; mu 0.7; } cohesion { strength 1e4; }",
          "friction { type Coulomb; mu 0.3; } joints { 0-ground { friction { mu 0.2; } } }"})
    {
        setContact(contact);
        ASSERT_TRUE(readContactAnew(structure, directory));
        const LimitAnalysisCase<2> fresh = readLimitAnalysisCase<2>(directory);
        EXPECT_EQ(structure.friction, fresh.friction);
        EXPECT_EQ(structure.program.friction, fresh.program.friction);
        ASSERT_EQ(structure.program.strength.size(), fresh.program.strength.size());
        for (std::size_t point = 0; point < fresh.program.strength.size(); ++point)
        {
            EXPECT_EQ(structure.program.strength[point].cohesion, fresh.program.strength[point].cohesion);
        }
        EXPECT_EQ(structure.program.load, fresh.program.load);
        EXPECT_EQ(structure.program.gap, fresh.program.gap);
    }
}

TEST_F(ContactReadAnew, IsRefusedWherePointsAreOthers)
{
    LimitAnalysisCase<2> structure = readLimitAnalysisCase<2>(directory);
    setContact("friction { type Coulomb; mu 0.4; } pointsPerJoint 3;");
    EXPECT_FALSE(readContactAnew(structure, directory));
}

TEST_F(ContactReadAnew, HasFaultsOfTheFile)
{
    LimitAnalysisCase<2> structure = readLimitAnalysisCase<2>(directory);
    setContact("friction { type Coulomb; mu -0.4; }");
    EXPECT_THROW(readContactAnew(structure, directory), FatalIOError);
}

} // namespace
} // namespace drystone
