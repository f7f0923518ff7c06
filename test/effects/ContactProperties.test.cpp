// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Materials, contact properties and loads as a case states them: good files, and every fault with its line.
#include "effects/ContactProperties.h"

#include "../ReportOf.h"
#include "assembly/Loads.h"
#include "assembly/Materials.h"
#include "contact/ClosedAssembly.h"
#include "effects/EffectList.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

using namespace drystone;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

namespace
{

class CaseProperties : public testing::Test
{
protected:
    void SetUp() override
    {
        directory = std::filesystem::path(testing::TempDir())
                    / ("case-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::create_directories(directory / "constant/assembly");
    }
    void TearDown() override { std::filesystem::remove_all(directory); }

    void write(const std::string& file, const std::string& text) { std::ofstream(directory / file) << text; }

    std::string contactReport(const std::string& text)
    {
        write("constant/contactProperties", text);
        return reportOf([&] { readContactProperties(directory); });
    }

    std::string loadReport(const std::string& text)
    {
        write("constant/loads", text);
        return reportOf([&] { readLoads<2>(directory, {assembly, masses, {0, -10}}, LiveLoad::required); });
    }

    std::filesystem::path directory;
    Assembly<2> assembly{
        {{{{0, 0}, {1, 0}, {1, 2}, {0, 2}}, 0.5}, {{{-5, -1}, {5, -1}, {5, 0}, {-5, 0}}, 1, 0}},
        {{"ground", "ground"}}};
    std::vector<double> masses{2000, 20000};
};

TEST_F(CaseProperties, GravityMayHaveTwoOrThreeComponentsAndDimensions)
{
    write("constant/g", "value (0 -9.81);");
    EXPECT_EQ(readGravity<2>(directory), Vector<2>(0, -9.81));
    write("constant/g", "dimensions [0 1 -2 0 0 0 0]; value (1 -10 0);");
    EXPECT_EQ(readGravity<2>(directory), Vector<2>(1, -10));
}

TEST_F(CaseProperties, FaultsOfGravityAreNamed)
{
    const auto act = [&] { readGravity<2>(directory); };
    EXPECT_THAT(reportOf(act), HasSubstr("There is no"));
    write("constant/g", "\nvalue (0 -9.81 1);");
    EXPECT_THAT(reportOf(act), HasSubstr("line 2."));
    write("constant/g", "dimensions [0 1 -1 0 0 0 0]; value (0 -9.81 0);");
    EXPECT_THAT(reportOf(act), HasSubstr("constant/g"));
    write("constant/g", "value (0 nan 0);");
    EXPECT_THAT(reportOf(act), HasSubstr("constant/g"));
}

TEST_F(CaseProperties, DensityAndUnitWeightGiveTheSameMass)
{
    write("constant/materialProperties", "density 2000;");
    const std::vector<double> byDensity = readDensities(directory, assembly, {0, -10});
    write("constant/materialProperties", "unitWeight 20000;");
    EXPECT_EQ(readDensities(directory, assembly, {0, -10}), byDensity);
    EXPECT_THAT(massesOf<2>({blockMass(assembly.blocks[0]), blockMass(assembly.blocks[1])}, byDensity),
                ElementsAre(2000, 20000));
}

TEST_F(CaseProperties, FaultsOfMaterialsAreNamed)
{
    const auto act = [&] { readDensities(directory, assembly, {0, -10}); };
    for (const auto& [text, fault] :
         {std::pair("density -1;", "density"), std::pair("", "Give density"),
          std::pair("density 1; unitWeight 1;", "Both density and unitWeight"),
          std::pair("densty 2000;", "density"), std::pair("density heavy;", "heavy")})
    {
        write("constant/materialProperties", text);
        EXPECT_THAT(reportOf(act), AllOf(HasSubstr(fault), HasSubstr("constant/materialProperties"))) << text;
    }
    write("constant/materialProperties", "unitWeight 1000;");
    EXPECT_THAT(reportOf([&] { readDensities(directory, assembly, {0, 0}); }), HasSubstr("gravity is 0"));
}

TEST_F(CaseProperties, FrictionIsReadAndAbsentFrictionIsNone)
{
    write("constant/contactProperties", "friction { type Coulomb; mu 0.65; flowRule nonAssociative; }");
    const ContactProperties properties = readContactProperties(directory);
    ASSERT_TRUE(properties.friction);
    EXPECT_EQ(properties.friction->mu, 0.65);
    EXPECT_EQ(properties.friction->flowRule, FlowRule::nonAssociative);
    EXPECT_THAT(frictionCoefficients(properties, 2), ElementsAre(0.65, 0.65));
    write("constant/contactProperties", "// nothing");
    EXPECT_FALSE(readContactProperties(directory).friction);
    EXPECT_THAT(frictionCoefficients(readContactProperties(directory), 1), ElementsAre(0));
    EXPECT_EQ(contactReport("friction { type Coulomb; mu 0; }"), "no error");
    EXPECT_EQ(contactReport("friction { type Coulomb; mu 1e6; }"), "no error");
    EXPECT_EQ(contactReport("friction { type Coulomb; mu [0 0 0 0 0 0 0] 0.65; }"), "no error");
}

TEST_F(CaseProperties, FaultsOfContactPropertiesAreNamed)
{
    EXPECT_THAT(contactReport("friction { type Coulom; mu 0.65; }"), HasSubstr("Did you mean Coulomb?"));
    EXPECT_THAT(contactReport("friction { mu 0.65; }"), HasSubstr("Coulomb"));
    EXPECT_THAT(contactReport("friction { type Coulomb; }"), HasSubstr("mu"));
    EXPECT_THAT(contactReport("friction\n{\ntype Coulomb;\nmu -0.1;\n}"), HasSubstr("line 4."));
    EXPECT_THAT(contactReport("friction { type Coulomb; mu 2e6; }"), HasSubstr("friction/mu"));
    EXPECT_THAT(contactReport("friction { type Coulomb; mu 0.6; flowRule assoc; }"),
                AllOf(HasSubstr("associative"), HasSubstr("nonAssociative")));
    EXPECT_THAT(contactReport("fricton { type Coulomb; mu 0.6; }"), HasSubstr("friction"));
    EXPECT_THAT(contactReport("\n\nglue { strength 3; }"), AllOf(HasSubstr("glue"), HasSubstr("line 3.")));
}

TEST_F(CaseProperties, CohesionAndTensionInMegapascalAreQuestioned)
{
    const auto warningsOf = [this](const std::string& text)
    {
        testing::internal::CaptureStderr();
        EXPECT_EQ(contactReport("friction { type Coulomb; mu 0.5; }\n" + text), "no error");
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_THAT(warningsOf("cohesion { strength 0.2; }"),
                AllOf(HasSubstr("cohesion { strength 0.2; }"), HasSubstr("`strength 200000;`"),
                      HasSubstr("contactProperties/cohesion at line 2.")));
    EXPECT_THAT(warningsOf("\ntension { strength 0.1; }"), HasSubstr("contactProperties/tension at line 3."));
    EXPECT_THAT(warningsOf("\n\njoints { 0-ground { tension { strength 0.3; } } }"),
                AllOf(HasSubstr("joints/0-ground/tension at line 4."), HasSubstr("`strength 300000;`")));
    EXPECT_EQ(warningsOf("cohesion { strength 0; } tension { strength 0; }"), "");
    EXPECT_EQ(warningsOf("cohesion { strength 60; } tension { strength 40; }"), "");
    EXPECT_EQ(warningsOf("crushing { strength 0.3; }"), ""); // compared with the dead load
}

TEST_F(CaseProperties, AnEffectThatIsNotSimulatedIsRefusedByName)
{
    for (const AbsentEffect& effect : absentEffects())
    {
        const std::string name(effect.name);
        EXPECT_THAT(contactReport(fmt::format("\n{} {{ value 1; }}", name)),
                    AllOf(HasSubstr(fmt::format("does not simulate {}", name)), HasSubstr("line 2.")));
    }
}

TEST_F(CaseProperties, LoadsAreRead)
{
    write("constant/loads", "dead { type gravity; } live { type force; at (0.5 2 0); value (100 0 0); }");
    const CaseLoads<2> loads = readLoads<2>(directory, {assembly, masses, {0, -10}}, LiveLoad::required);
    EXPECT_EQ(loads.dead, Eigen::Vector3d(0, -20000, 0));
    EXPECT_EQ(loads.live, Eigen::Vector3d(100, 0, -100));
}

TEST_F(CaseProperties, WithoutALoadsFileThereIsGravityWhereALiveLoadIsOptional)
{
    const LoadContext<2> context{assembly, masses, {0, -10}};
    EXPECT_EQ(readLoads(directory, context, LiveLoad::optional).dead, Eigen::Vector3d(0, -20000, 0));
    EXPECT_EQ(readLoads(directory, context, LiveLoad::optional).live.size(), 0);
    EXPECT_THAT(reportOf([&] { readLoads(directory, context, LiveLoad::required); }),
                HasSubstr("constant/loads"));
}

TEST_F(CaseProperties, FaultsOfLoadsAreNamed)
{
    const std::string dead = "dead { type gravity; }\n";
    EXPECT_THAT(loadReport(dead), HasSubstr("no live load"));
    EXPECT_THAT(loadReport("live { type gravity; }"), HasSubstr("dead"));
    EXPECT_THAT(loadReport(dead + "live { type inertial; }"), HasSubstr("direction"));
    EXPECT_THAT(loadReport(dead + "live { type inertial; direction (0 0 0); }"),
                HasSubstr("cannot be (0 0 0)"));
    EXPECT_THAT(loadReport(dead + "live { type inertial; direction (0 0 1); }"), HasSubstr("line 2."));
    EXPECT_THAT(loadReport(dead + "live { type inertal; direction (1 0 0); }"),
                AllOf(HasSubstr("Did you mean inertial?"), HasSubstr("constant/loads")));
    EXPECT_THAT(loadReport(dead + "live { type force; at (0.5 3); value (1 0); }"),
                AllOf(HasSubstr("no free block at (0.5 3)"), HasSubstr("line 2.")));
    EXPECT_THAT(loadReport(dead + "live { type supportMovement; support groud; direction (0 -1 0); }"),
                AllOf(HasSubstr("Did you mean ground?"), HasSubstr("line 2.")));
    EXPECT_THAT(loadReport(dead + "live { type supportMovement; support ground; direction (0 0 0); }"),
                HasSubstr("cannot be (0 0 0)"));
    EXPECT_THAT(loadReport("dead { type supportMovement; support ground; direction (0 -1 0); } live { type "
                           "gravity; }"),
                HasSubstr("can only be the live load"));
    EXPECT_THAT(loadReport(dead + "live { type line; from (0 2); to (1.5 2); value (0 -1); }"),
                AllOf(HasSubstr("leaves the free blocks"), HasSubstr("line 2.")));
    EXPECT_THAT(loadReport(dead + "live { type line; from (0 2); to (0 2); value (0 -1); }"),
                HasSubstr("two different ends"));
    EXPECT_THAT(loadReport(dead + "live { type sum; loads { a { type sum; loads { } } } }"),
                HasSubstr("Valid load types"));
    EXPECT_THAT(loadReport(dead + "live { type sum; loads { } }"), HasSubstr("needs loads"));
    EXPECT_THAT(loadReport(dead + "live { type gravity; }\nmultiplier either;"),
                AllOf(HasSubstr("both"), HasSubstr("line 3.")));
}

TEST_F(CaseProperties, LoadsMayBeSumsAndSupportsMayMove)
{
    write("constant/loads",
          "dead { type sum; loads { weight { type gravity; } top { type line; from (0 2); to "
          "(0.5 2); value (0 -100 0); } } }\nlive { type supportMovement; support ground; "
          "direction (0 -3 0); }");
    const CaseLoads<2> loads = readLoads<2>(directory, {assembly, masses, {0, -10}}, LiveLoad::required);
    EXPECT_EQ(loads.dead, Eigen::Vector3d(0, -20050, 12.5));
    EXPECT_EQ(loads.live.size(), 0);
    ASSERT_TRUE(loads.movement);
    EXPECT_EQ(loads.movement->support, 0);
    EXPECT_EQ(loads.movement->direction, Vector<2>(0, -1));
}

TEST_F(CaseProperties, OverlapsAreRefusedAtTheLineOfTheSecondBlock)
{
    const std::string head =
        "dimensions 2; thickness 1; supports {}\noutlines\n(\n((0 0) (1 0) (1 1) (0 1))\n";
    write("constant/assembly/blocks", head + "((1 0) (2 0) (2 1) (1 1))\n);");
    EXPECT_EQ(reportOf([&] { refuseOverlaps(readAssembly<2>(directory), directory); }), "no error");
    write("constant/assembly/blocks", head + "((0.9 0) (2 0) (2 1) (0.9 1))\n);");
    EXPECT_THAT(reportOf([&] { refuseOverlaps(readAssembly<2>(directory), directory); }),
                AllOf(HasSubstr("Blocks 0 and 1 overlap by 0.1 m2"), HasSubstr("line 5.")));
}

} // namespace
