// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Rubble of any seed: all stones are there, each of them a solid, or it is said which are not.
#include "texture/space/Rubble.h"
#include "../MadeStructure.h"
#include "contact/AssemblyChecks.h"
#include "contact/ContactPoint.h"
#include "geometry/PolygonShape.h"
#include "geometry/space/PolyhedronFault.h"
#include "texture/plane/PlaneRubble.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <tuple>

using namespace drystone;
using testing::AllOf;
using testing::HasSubstr;

namespace
{

void expectSolids(const Rubble& rubble)
{
    const std::string name = fmt::format("stones {}; seed {}; relaxations {}; leastEdge {}", rubble.stones,
                                         rubble.seed, rubble.relaxations, rubble.leastEdge);
    const Assembly<3> wall = makeAssembly(rubble);
    EXPECT_EQ(wall.blocks.size(), static_cast<std::size_t>(rubble.stones)) << name;
    EXPECT_EQ(faultOfStones(rubble, wall), "") << name;
    EXPECT_TRUE(findOverlaps(wall).empty()) << name;
    double volume = 0;
    for (const Block<3>& block : wall.blocks)
    {
        volume += volumeProperties(block.shape).volume;
    }
    EXPECT_NEAR(volume, rubble.size.prod(), 1e-12) << name;
}

// Corners that moved past faces, in one or two of a hundred walls.
TEST(Rubble, StonesAreSolidsWhereCornersOfShortEdgesWouldPassThroughFaces)
{
    for (const auto& [stones, seed, relaxations, leastEdge] : {std::tuple(100, 8, 2, 0.1),
                                                               {300, 5, 2, 0.1},
                                                               {300, 54, 2, 0.1},
                                                               {100, 4, 0, 0.1},
                                                               {300, 1, 0, 0.1},
                                                               {300, 3, 0, 0.1},
                                                               {100, 22, 2, 0.3},
                                                               {100, 23, 2, 0.3},
                                                               {100, 236, 2, 0.3},
                                                               {300, 233, 2, 0.1},
                                                               {100, 59, 2, 0.3}})
    {
        expectSolids({{2, 0.5, 2}, stones, seed, relaxations, leastEdge});
    }
}

// Faces between cells whose points are nearly at the same distance from a place.
TEST(Rubble, StonesAreSolidsWhereFacesOfCellsHaveNoArea)
{
    for (const auto& [seed, relaxations] : {std::pair(31, 2), {44, 2}, {32, 0}})
    {
        expectSolids({{2, 0.5, 2}, 300, seed, relaxations, 0});
    }
}

// Of stones of a millimetre joints were lost and others lay in each other.
TEST(Rubble, IsTheSameAtAnyScale)
{
    const Rubble rubble{{2, 0.5, 2}, 60, 1, 2, 0.1};
    const Assembly<3> wall = makeAssembly(rubble);
    for (const double scale : {1e-4, 1e-3, 1e3})
    {
        Rubble scaled = rubble;
        scaled.size *= scale;
        const Assembly<3> other = makeAssembly(scaled);
        EXPECT_EQ(findContactPoints(other).size(), findContactPoints(wall).size()) << scale;
        EXPECT_TRUE(findOverlaps(other).empty()) << scale;
        double volume = 0;
        for (const Block<3>& block : other.blocks)
        {
            volume += volumeProperties(block.shape).volume;
        }
        EXPECT_NEAR(volume / scaled.size.prod(), 1, 1e-9) << scale;
    }
}

TEST(Rubble, AStoneThatIsNoSolidIsReportedWithWhatToChange)
{
    const Rubble rubble{{1, 1, 1}, 1, 17, 2, 0.1};
    Assembly<3> wall = makeAssembly(rubble);
    wall.blocks[0].shape.faces.pop_back();
    EXPECT_THAT(faultOfStones(rubble, wall),
                AllOf(HasSubstr("Stone 0 of the seed 17 is no solid"), HasSubstr("not closed"),
                      HasSubstr("Another \"seed\""), HasSubstr("\"leastEdge\" than 0.1")));
}

TEST(Rubble, StonesOfThePlaneThatShortJointsTakeAwayAreWarnedOf)
{
    const auto warning = [](const std::string& settings)
    {
        testing::internal::CaptureStderr();
        madeStructure<2>(
            Dictionary::readString("texture\n{ type rubble; " + settings + " }", "system/blockTextureDict"));
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_THAT(warning("size (3 2); stones 2000; relaxations 0; leastJoint 0.3;"),
                AllOf(HasSubstr("1986 of 2000 stones are left"),
                      HasSubstr("and the other 14 had no face any more: ("), HasSubstr(") and 6 more [m]."),
                      HasSubstr("blocks are numbered without them"), HasSubstr("Reduce leastJoint"),
                      HasSubstr("texture/stones at line 2")));
    EXPECT_EQ(warning("size (3 2); stones 2000; relaxations 0; leastJoint 0;"), "");
}

TEST(Rubble, StonesThatShortJointsTakeAwayAreNamedByTheirPlaces)
{
    PlaneRubble rubble{{3, 2}, 1, 300, 1, 0, 0.3};
    while (makeAssembly(rubble).blocks.size() == 300u)
    {
        ++rubble.seed;
    }
    const Assembly<2> wall = makeAssembly(rubble);
    const std::string loss = lossOfStones(rubble, wall);
    rubble.leastJoint = 0;
    const Assembly<2> whole = makeAssembly(rubble); // has the stones with all their joints
    ASSERT_EQ(whole.blocks.size(), 300u);
    std::size_t named = 0;
    for (const Block<2>& block : whole.blocks)
    {
        const Vector<2> place = areaProperties(block.outline).centroid;
        if (loss.find(fmt::format("({:.4g} {:.4g})", place.x(), place.y())) != std::string::npos)
        {
            ++named;
            EXPECT_LT(areaProperties(block.outline).area, 0.5 * 6 / 300); // of a mean stone
        }
    }
    EXPECT_EQ(named, 300 - wall.blocks.size());
    EXPECT_EQ(lossOfStones(rubble, whole), "");
}

TEST(Rubble, StonesOfThePlaneAreNotFlat)
{
    for (const int seed : {23, 25, 157})
    {
        const Assembly<2> wall = makeAssembly(PlaneRubble{{3, 2}, 1, 300, seed, 0, 0.3});
        double area = 0;
        for (const Block<2>& block : wall.blocks)
        {
            EXPECT_EQ(outlineFault(block.outline), "") << "seed " << seed;
            area += areaProperties(block.outline).area;
        }
        EXPECT_NEAR(area, 6, 1e-12) << "seed " << seed;
    }
}

} // namespace
