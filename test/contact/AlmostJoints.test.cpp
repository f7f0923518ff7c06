// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Faces that almost meet are refused, with the pair and the repair.
#include "contact/AlmostJoints.h"

#include "../ReportOf.h"
#include "contact/ClosedAssembly.h"
#include "core/Error.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

using namespace drystone;
using testing::AllOf;
using testing::HasSubstr;

namespace
{

class AlmostJoints : public testing::Test
{
protected:
    void SetUp() override
    {
        directory =
            std::filesystem::path(testing::TempDir())
            / ("almost-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::create_directories(directory / "constant/assembly");
    }
    void TearDown() override { std::filesystem::remove_all(directory); }

    /// What is said of a block whose lower corners are so high over the ground.
    std::string report(double left, double right, const std::string& entries = "")
    {
        std::ofstream(directory / "constant/assembly/blocks")
            << "dimensions 2; thickness 1; " << entries
            << "supports { ground { type ground; blocks (0); } }\noutlines\n(\n((-1 -1) (2 -1) (2 0) (-1 "
               "0))\n"
            << fmt::format("((0 {}) (1 {}) (1 1) (0 1))\n);", left, right);
        return reportOf(
            [&]
            {
                const Assembly<2> assembly = readAssembly<2>(directory);
                refuseOverlaps(assembly, directory);
                refuseAlmostJoints(assembly, directory);
            });
    }

    std::filesystem::path directory;
};

TEST_F(AlmostJoints, AreRefusedWhetherApartInEachOtherOrInclined)
{
    for (const double size : {2e-6, 1e-5, 1e-4, 1e-3})
    {
        EXPECT_THAT(report(size, size), AllOf(HasSubstr("block 0 (support ground) and block 1 almost meet"),
                                              HasSubstr(fmt::format("{:.3g} m apart", size)),
                                              HasSubstr("jointTolerance"), HasSubstr("line 5.")));
        EXPECT_THAT(report(-size, -size),
                    testing::AnyOf(HasSubstr("Blocks 0 and 1 overlap"), HasSubstr("m in each other")));
        EXPECT_THAT(report(0, size), HasSubstr("m apart"));
        EXPECT_THAT(report(-size, 0), testing::AnyOf(HasSubstr("overlap"), HasSubstr("m in each other")));
    }
    // Between the tolerance of joints and the area that is called an overlap.
    EXPECT_THAT(report(-1.5e-6, -1.5e-6), HasSubstr("m in each other"));
}

TEST_F(AlmostJoints, AreNoneWhereFacesMeetOrBlocksAreApart)
{
    EXPECT_EQ(report(0, 0), "no error");
    EXPECT_EQ(report(5e-7, 5e-7), "no error"); // within the tolerance, and closed
    EXPECT_EQ(report(-5e-7, 5e-7), "no error");
    EXPECT_EQ(report(0.1, 0.1), "no error");
}

TEST_F(AlmostJoints, AreJointsOrApartOnPurposeByAStatedTolerance)
{
    EXPECT_EQ(report(1e-4, 1e-4, "jointTolerance 2e-4;"), "no error");
    EXPECT_EQ(readAssembly<2>(directory).closure.joints, 1);
    EXPECT_EQ(report(1e-4, 1e-4, "jointTolerance 5e-5;"), "no error");
    EXPECT_EQ(readAssembly<2>(directory).closure.joints, 0);
    EXPECT_EQ(facesApartOnPurpose(readAssembly<2>(directory)), 1);
    EXPECT_THAT(almostJointsText(readAssembly<2>(directory), ToleranceOrigin::ofDigits),
                AllOf(HasSubstr("almost meet"), HasSubstr("0.0001 m apart"),
                      HasSubstr("closed up to 5e-05 m"),
                      HasSubstr("are to touch, state `jointTolerance 0.0002;`"),
                      HasSubstr("on purpose, `jointTolerance 5e-05;`")));
    EXPECT_EQ(report(0, 0, "jointTolerance 5e-5;"), "no error");
    EXPECT_EQ(almostJointsText(readAssembly<2>(directory), ToleranceOrigin::ofDigits), "");
    EXPECT_THAT(report(0, 0, "jointTolerance 1;"), HasSubstr("jointTolerance 1 is out of range"));
    EXPECT_THAT(report(0, 0, "jointTolerance -1e-4;"), HasSubstr("out of range"));
}

TEST_F(AlmostJoints, AreNotOuterFacesOfThinBlocksOnEachOther)
{
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {{{{-1, -1}, {9, -1}, {9, 0}, {-1, 0}}, 1, 0},
                       {{{0, 0}, {1, 0}, {1, 0.001}, {0, 0.001}}, 1, -1},
                       {{{0, 0.001}, {1, 0.001}, {1, 0.002}, {0, 0.002}}, 1, -1},
                       {{{2, 0}, {5, 0}, {5, 3}, {2, 3}}, 1, -1}};
    for (const FacingPiece& piece : findAlmostJoints(assembly))
    {
        EXPECT_TRUE(isApart(piece)) << piece.block << ' ' << piece.neighbour;
    }
}

} // namespace
