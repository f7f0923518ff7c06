// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Every check of checkBlocks has a case that fails it, and only it where that is possible.
#include "../Polygons.h"

#include "contact/AssemblyChecks.h"
#include "texture/Arch.h"
#include "texture/RunningBond.h"
#include "texture/Supports.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace drystone;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace
{

using test::rectangle;

/// Free blocks on a ground that is fixed under y = 0.
Assembly<2> onGround(std::vector<Polygon> outlines)
{
    Assembly<2> assembly;
    for (Polygon& outline : outlines)
    {
        assembly.blocks.push_back({std::move(outline)});
    }
    addGround(assembly, "ground", {});
    return assembly;
}

std::vector<std::string> failed(const Assembly<2>& assembly, CheckExtent extent = CheckExtent::standard)
{
    std::vector<std::string> names;
    for (const CheckResult& check : checkAssembly(assembly, extent).checks)
    {
        if (check.failures > 0)
        {
            names.push_back(check.name);
        }
    }
    return names;
}

TEST(AssemblyChecks, AWallAndAnArchAreSound)
{
    RunningBond bond;
    bond.openings = {{{1.5, 1}, {2.5, 4}}};
    Assembly<2> wall = makeAssembly(bond);
    addGround(wall, "ground", {0.2});
    EXPECT_THAT(failed(wall, CheckExtent::all), IsEmpty());
    EXPECT_THAT(failed(makeAssembly(Arch{}), CheckExtent::all), IsEmpty());
    const std::string report = printedReport(wall, checkAssembly(wall));
    EXPECT_TRUE(report.ends_with("\nAssembly OK.")) << report;
}

TEST(AssemblyChecks, ABlockFarSmallerThanTheRestFailsVolumes)
{
    EXPECT_THAT(failed(onGround({rectangle(0, 0, 1, 1), rectangle(2, 0, 2 + 1e-6, 1e-6)})),
                testing::Contains("volumes"));
}

TEST(AssemblyChecks, AStructureWithoutFreeBlocksFailsVolumes)
{
    EXPECT_THAT(failed({{{rectangle(0, 0, 1, 1), 1, 0}}, {{"ground", "blocks"}}}), ElementsAre("volumes"));
}

TEST(AssemblyChecks, ANeedleFailsInertiaAndSlivers)
{
    EXPECT_THAT(failed(onGround({rectangle(0, 0, 1, 1), rectangle(2, 0, 3, 5e-6)})),
                ElementsAre("inertia", "slivers"));
}

TEST(AssemblyChecks, TheSameBlockTwiceFailsDuplicatesAndNotOverlaps)
{
    EXPECT_THAT(failed(onGround({rectangle(0, 0, 1, 1), rectangle(0, 0, 1, 1)})), ElementsAre("duplicates"));
}

TEST(AssemblyChecks, ATipDeepInANeighbourIsAnOverlapHoweverLittleTheyHaveInCommon)
{
    const auto withTipAt = [](double height)
    {
        return onGround({rectangle(0, 0, 1, 1),
                         {{0.5, height}, {0.9, height + 0.6}, {0.5, height + 1.2}, {0.1, height + 0.6}}});
    };
    EXPECT_THAT(failed(withTipAt(1 - 9e-4)), testing::Contains("overlaps"));
    EXPECT_THAT(failed(withTipAt(1 - 2e-6)), testing::Not(testing::Contains("overlaps")));
    EXPECT_THAT(failed(withTipAt(1)), testing::Not(testing::Contains("overlaps")));
}

TEST(AssemblyChecks, BlocksThatOverlapByAMillimetreFailOverlaps)
{
    EXPECT_THAT(failed(onGround({rectangle(0, 0, 0.4, 0.2), rectangle(0.399, 0, 0.8, 0.2)})),
                ElementsAre("overlaps"));
}

TEST(AssemblyChecks, ABlockInsideAnotherFailsOverlaps)
{
    EXPECT_THAT(failed(onGround({rectangle(0, 0, 3, 3), rectangle(1, 0, 2, 1)})), ElementsAre("overlaps"));
}

TEST(AssemblyChecks, ABlockThatSitsInAConcaveOneDoesNotOverlap)
{
    EXPECT_THAT(failed(onGround({{{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
                                 rectangle(1, 1, 2, 2)}),
                       CheckExtent::all),
                IsEmpty());
}

TEST(AssemblyChecks, FacesThatNearlyTouchFailGaps)
{
    EXPECT_THAT(failed(onGround({rectangle(0, 0, 1, 1), rectangle(1.0001, 0, 2, 1)})), ElementsAre("gaps"));
}

TEST(AssemblyChecks, AFaceOutOfParallelFailsGaps)
{
    EXPECT_THAT(failed(onGround({rectangle(0, 0, 1, 1), {{1, 0}, {2, 0}, {2, 1}, {1 + 1e-3, 1}}})),
                ElementsAre("gaps"));
}

TEST(AssemblyChecks, AThinBlockFailsSlivers)
{
    EXPECT_THAT(failed(onGround({rectangle(0, 0, 1, 1), rectangle(2, 0, 2.001, 1)})), ElementsAre("slivers"));
}

TEST(AssemblyChecks, ASharpCornerFailsSlivers)
{
    EXPECT_THAT(failed(onGround({{{0, 0}, {1, 0}, {1, 1}, {0.5, 1}, {0.5, 0.2}, {0.499, 1}, {0, 1}},
                                 {{1, 0}, {3, 0}, {2, 1}, {1, 0.005}}})),
                ElementsAre("slivers"));
}

TEST(AssemblyChecks, AShortEdgeFailsSlivers)
{
    EXPECT_THAT(failed(onGround({{{0, 0}, {1, 0}, {1, 1}, {1 - 1e-5, 1 + 1e-5}, {0, 1}}})),
                ElementsAre("slivers"));
}

TEST(AssemblyChecks, AFloatingBlockAndItsNeighbourFailSupports)
{
    const Assembly<2> assembly =
        onGround({rectangle(0, 0, 1, 1), rectangle(0, 2, 1, 3), rectangle(1, 2, 2, 3)});
    const AssemblyReport<2> report = checkAssembly(assembly);
    EXPECT_THAT(failed(assembly), ElementsAre("supports"));
    EXPECT_EQ(report.checks.back().failures, 2);
    EXPECT_THAT(printedReport(assembly, report), HasSubstr("block 1 at (0.5 2.5) has no path to a support"));
    EXPECT_TRUE(printedReport(assembly, report).ends_with("\nFailed 1 checks."));
}

TEST(AssemblyChecks, AShortJointFailsShortJointsOfAllChecksAlone)
{
    const Assembly<2> assembly = onGround({rectangle(0, 0, 1, 1), rectangle(1 - 1e-4, 1, 2, 2)});
    EXPECT_THAT(failed(assembly), IsEmpty());
    EXPECT_THAT(failed(assembly, CheckExtent::all), ElementsAre("shortJoints"));
}

TEST(AssemblyChecks, ABlockOnItsCornerFailsCornerTouchesOfAllChecks)
{
    const Assembly<2> assembly = onGround({rectangle(0, 0, 1, 1), {{3, 0}, {4, 1}, {3, 2}, {2, 1}}});
    EXPECT_THAT(failed(assembly), ElementsAre("supports"));
    EXPECT_THAT(failed(assembly, CheckExtent::all), ElementsAre("supports", "cornerTouches"));
}

TEST(AssemblyChecks, ABlockOnTheCornerOfAnotherFailsCornerTouchesOfAllChecks)
{
    const Assembly<2> assembly = onGround({rectangle(0, 0, 1, 1), {{1, 1}, {2, 2}, {1, 3}, {0, 2}}});
    EXPECT_THAT(failed(assembly, CheckExtent::all), ElementsAre("supports", "cornerTouches"));
    EXPECT_THAT(printedReport(assembly, checkAssembly(assembly, CheckExtent::all)),
                HasSubstr("touch at (1 1), corner to corner"));
    // Across a crossing of joints all stand.
    const Assembly<2> stack = onGround(
        {rectangle(0, 0, 1, 1), rectangle(1, 0, 2, 1), rectangle(0, 1, 1, 2), rectangle(1, 1, 2, 2)});
    EXPECT_THAT(failed(stack, CheckExtent::all), IsEmpty());
}

TEST(AssemblyChecks, TheUnitOfLengthDoesNotMatter)
{
    for (const double unit : {1e-6, 1.0, 1e6})
    {
        EXPECT_THAT(failed(onGround({rectangle(0, 0, unit, unit), rectangle(unit, 0, 2 * unit, unit)})),
                    IsEmpty());
        EXPECT_THAT(
            failed(onGround({rectangle(0, 0, unit, unit), rectangle(0.999 * unit, 0, 2 * unit, unit)})),
            ElementsAre("overlaps"));
    }
}

TEST(AssemblyChecks, AnEmptyAssemblyIsNotSound)
{
    EXPECT_THAT(failed({}), ElementsAre("volumes"));
}

} // namespace
