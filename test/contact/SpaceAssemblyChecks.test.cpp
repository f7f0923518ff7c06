// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Every check of checkBlocks has a case in space that fails it, and only it where that is possible.
#include "contact/AlmostJoints.h"
#include "contact/AssemblyChecks.h"
#include "contact/ContactState.h"
#include "contact/JointClosure.h"
#include "contact/PointAreas.h"
#include "contact/SupportPaths.h"
#include "contact/space/StatedJointChecks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

using namespace drystone;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace
{

Assembly<3> onGround(const std::vector<Polyhedron>& shapes)
{
    Assembly<3> assembly;
    for (const Polyhedron& shape : shapes)
    {
        assembly.blocks.push_back({shape});
    }
    assembly.blocks.push_back({makeBox({-10, -10, -1}, {10, 10, 0}), 0});
    assembly.supports = {{"ground", "ground"}};
    closeJoints(assembly);
    return assembly;
}

std::vector<std::string> failed(const Assembly<3>& assembly, CheckExtent extent = CheckExtent::standard)
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

const Polyhedron cube = makeBox({0, 0, 0}, {1, 1, 1});

// Nothing else compares joints that are stated with the blocks: of other places, or lacking, they make
// another structure.
TEST(SpaceAssemblyChecks, StatedJointsLieOnTheFacesOfBothBlocksAndAreComplete)
{
    Assembly<3> sound = onGround({cube, makeBox({0, 0, 1}, {1, 1, 2})});
    const Vector<3> up(0, 0, 1);
    sound.statedJoints = {{0, 1, -up, {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}},
                          {0, 2, up, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}};
    EXPECT_THAT(failed(sound, CheckExtent::all), IsEmpty());
    EXPECT_EQ(almostJointsText(sound), "");

    Assembly<3> wide = sound;
    for (Vector<3>& point : wide.statedJoints[1].points)
    {
        point.x() = 3 * point.x() - 1;
    }
    EXPECT_THAT(failed(wide, CheckExtent::all), ElementsAre("statedJoints"));
    EXPECT_THAT(almostJointsText(wide),
                AllOf(HasSubstr("between blocks 0 and 2"), HasSubstr("1 m off the surface of block 0"),
                      HasSubstr("state `interfaces ignored;`")));

    Assembly<3> inside = sound;
    for (Vector<3>& point : inside.statedJoints[0].points)
    {
        point.z() = 1.5;
    }
    EXPECT_THAT(failed(inside), ElementsAre("statedJoints"));

    Assembly<3> lacking = sound;
    lacking.statedJoints.erase(lacking.statedJoints.begin() + 1);
    EXPECT_THAT(failed(lacking), testing::Contains("statedJoints"));
    EXPECT_EQ(almostJointsText(lacking), "");
    EXPECT_THAT(facesWithoutStatedJointText(lacking), HasSubstr("Blocks 0 and 2 share a face"));
    EXPECT_EQ(facesWithoutStatedJointText(onGround({cube})), "");
}

TEST(SpaceAssemblyChecks, SoundBlocksPass)
{
    const Assembly<3> assembly = onGround({cube, makeBox({0.5, 0, 1}, {1.5, 1, 2})});
    EXPECT_THAT(failed(assembly, CheckExtent::all), IsEmpty());
    const AssemblyStatistics<3> statistics = countAssembly(assembly);
    EXPECT_EQ(statistics.freeBlocks, 2);
    EXPECT_EQ(statistics.joints, 2);
    EXPECT_EQ(statistics.contactPoints, 8);
    EXPECT_THAT(printedReport(assembly, checkAssembly(assembly)), HasSubstr("(0 0 0) (1.5 1 2) m"));
}

TEST(SpaceAssemblyChecks, OverlapsAndDuplicatesAreFound)
{
    const Assembly<3> overlapping = onGround({cube, makeBox({0.9, 0, 0}, {1.9, 1, 1})});
    EXPECT_THAT(failed(overlapping), ElementsAre("overlaps"));
    const std::vector<Overlap<3>> overlaps = findOverlaps(overlapping);
    ASSERT_EQ(overlaps.size(), 1U);
    EXPECT_NEAR(overlaps.front().common, 0.1, 1e-12);
    EXPECT_THAT(failed(onGround({cube, cube})), ElementsAre("duplicates"));
    // Sunk into the ground.
    EXPECT_THAT(failed(onGround({makeBox({0, 0, -0.05}, {1, 1, 1})})), ElementsAre("overlaps", "supports"));
}

TEST(SpaceAssemblyChecks, FacesThatAlmostMeetAreAGapUnlessThatIsStated)
{
    Assembly<3> assembly = onGround({makeBox({0, 0, 0.003}, {1, 1, 1})});
    EXPECT_THAT(failed(assembly), ElementsAre("gaps", "supports"));
    EXPECT_THAT(almostJointsText(assembly), HasSubstr("block 0 and block 1 (support ground) almost meet"));
    assembly.jointTolerance = 1e-3;
    closeJoints(assembly);
    EXPECT_EQ(facesApartOnPurpose(assembly), 1);
    assembly.jointTolerance = 5e-3;
    closeJoints(assembly);
    EXPECT_THAT(failed(assembly), IsEmpty());
    EXPECT_EQ(findContactPoints(assembly).size(), 4U);
}

TEST(SpaceAssemblyChecks, SliversAreFound)
{
    EXPECT_THAT(failed(onGround({cube, makeBox({2, 0, 0}, {3, 1, 0.0005})})), ElementsAre("slivers"));
}

TEST(SpaceAssemblyChecks, AnEdgeDeepInANeighbourIsAnOverlapHoweverLittleTheyHaveInCommon)
{
    const auto withEdgeAt = [](double height)
    {
        return onGround(
            {cube, makePrism({{0.2, 0, height + 0.5}, {0.8, 0, height + 0.5}, {0.5, 0, height}},
                             {{0.2, 1, height + 0.5}, {0.8, 1, height + 0.5}, {0.5, 1, height}})});
    };
    EXPECT_THAT(failed(withEdgeAt(1 - 1e-3)), testing::Contains("overlaps"));
    EXPECT_THAT(failed(withEdgeAt(1)), testing::Not(testing::Contains("overlaps")));
}

TEST(SpaceAssemblyChecks, BlocksThatTouchAlongAnEdgeAreNotHeld)
{
    const Assembly<3> assembly = onGround({cube, makeBox({1, 0, 1}, {2, 1, 2})});
    EXPECT_THAT(failed(assembly, CheckExtent::all), ElementsAre("supports", "edgeTouches"));
    EXPECT_THAT(blocksWithoutSupport(assembly, findContactPoints(assembly)), ElementsAre(1));
    EXPECT_THAT(instabilityCause(assembly, findContactPoints(assembly)),
                HasSubstr("block 1 touches block 0 along an edge or at a corner only"));
}

TEST(SpaceAssemblyChecks, BlocksWhoseEdgesMeetAsInABondPassEdgeTouches)
{
    // A brick on one of three that meets the other two along edges, as these meet each other.
    const Assembly<3> assembly = onGround({cube, makeBox({1, 0, 0}, {2, 1, 1}), makeBox({0, 1, 0}, {1, 2, 1}),
                                           makeBox({0.5, 1, 1}, {1.5, 2, 2})});
    const AssemblyReport<3> report = checkAssembly(assembly, CheckExtent::all);
    EXPECT_EQ(failedChecks(report), 0);
    EXPECT_THAT(printedReport(assembly, report),
                AllOf(HasSubstr("without a joint: 3, all of them where edges of both meet, as in a bond OK."),
                      HasSubstr("Assembly OK.")));
}

TEST(SpaceAssemblyChecks, ABlockOnItsEdgeFailsEdgeTouchesWhateverElseHoldsIt)
{
    // A prism on its edge beside a cube that holds it.
    const Polyhedron prism = makePrism({{1, 0, 1}, {2, 0, 1}, {1, 0, 0}}, {{1, 1, 1}, {2, 1, 1}, {1, 1, 0}});
    const Assembly<3> beside = onGround({cube, prism});
    EXPECT_THAT(failed(beside, CheckExtent::all), ElementsAre("edgeTouches"));
    EXPECT_THAT(printedReport(beside, checkAssembly(beside, CheckExtent::all)),
                AllOf(HasSubstr("without a joint: 1, edgeTouches failed"),
                      HasSubstr("block 1 touches block 2 (support ground)")));
    EXPECT_THAT(instabilityCause(beside, findContactPoints(beside)),
                HasSubstr("no force acts where block 1 touches block 2 (support ground) along an edge"));
    const Assembly<3> bond = onGround({cube, makeBox({1, 0, 0}, {2, 1, 1}), makeBox({0, 1, 0}, {1, 2, 1})});
    EXPECT_EQ(instabilityCause(bond, findContactPoints(bond)), "");
}

TEST(SpaceAssemblyChecks, ABlockOnARidgeAsWideAsItselfFailsEdgeTouches)
{
    // The ends of the ridge lie on edges of the beam, or one of them does and the ridge goes on.
    for (const double width : {1.0, 1.5})
    {
        const Polyhedron ridge =
            makePrism({{4, 0, 0}, {3, 0, 0}, {3.5, 0, 1}}, {{4, width, 0}, {3, width, 0}, {3.5, width, 1}});
        const Assembly<3> assembly = onGround({cube, ridge, makeBox({0.5, 0, 1}, {5, 1, 1.5})});
        EXPECT_THAT(failed(assembly, CheckExtent::all), ElementsAre("edgeTouches")) << width;
        EXPECT_THAT(instabilityCause(assembly, findContactPoints(assembly)),
                    HasSubstr("block 1 touches block 2"));
    }
}

// The place was the middle between the blocks, in nothing.
TEST(SpaceAssemblyChecks, EdgesThatCrossTouchWhereTheyCross)
{
    const std::vector<Vector<3>> end{{0, 0, 0}, {0, 1, 1}, {0, 0, 2}, {0, -1, 1}};
    std::vector<Vector<3>> along = end;
    for (Vector<3>& corner : along)
    {
        corner.x() += 10;
    }
    Polyhedron bar = makePrism(end, along);
    Polyhedron across = bar;
    for (Vector<3>& corner : bar.vertices)
    {
        corner.x() -= 7;
    }
    for (Vector<3>& corner : across.vertices)
    {
        corner = Vector<3>(corner.y(), 2 - corner.x(), corner.z() - 2);
    }
    Assembly<3> assembly;
    assembly.blocks = {{std::move(bar)}, {std::move(across), 0}};
    assembly.supports = {{"ground", "ground"}};
    EXPECT_THAT(printedReport(assembly, checkAssembly(assembly, CheckExtent::all)),
                HasSubstr("block 0 touches block 1 (support ground) at (0 0 0) without a joint"));
}

TEST(SpaceAssemblyChecks, SmallJointsAreFound)
{
    const Assembly<3> assembly = onGround({cube, makeBox({0.9995, 0.9995, 1}, {1.9995, 1.9995, 2})});
    EXPECT_THAT(failed(assembly, CheckExtent::all), ElementsAre("smallJoints"));
}

TEST(SpaceAssemblyChecks, ConcaveBlocksMayHoldOthersInTheirNotch)
{
    const Polyhedron corner = makePrism({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}},
                                        {{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}});
    const Assembly<3> assembly = onGround({corner, makeBox({1, 1, 0}, {2, 2, 1})});
    EXPECT_THAT(failed(assembly, CheckExtent::all), IsEmpty());
    EXPECT_EQ(countAssembly(assembly).concaveBlocks, 1);
}

TEST(SpaceJointLaws, AreasOfPointsHaveTheAreaAndTheCentroidOfTheirPatch)
{
    // The third is an L, whose centroid lies outside it, the fourth a comb.
    for (const Polyhedron& shape :
         {makeBox({1, 2, 0}, {4, 4, 1}),
          makePrism({{0, 0, 0}, {3, 0, 0}, {4, 1, 0}, {1, 3, 0}},
                    {{0, 0, 1}, {3, 0, 1}, {4, 1, 1}, {1, 3, 1}}),
          makePrism({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}},
                    {{0, 0, 1}, {4, 0, 1}, {4, 1, 1}, {1, 1, 1}, {1, 4, 1}, {0, 4, 1}}),
          makePrism(
              {{0, 0, 0}, {5, 0, 0}, {5, 4, 0}, {4, 4, 0}, {3.5, 1, 0}, {2, 1, 0}, {1, 4, 0}, {0, 4, 0}},
              {{0, 0, 1}, {5, 0, 1}, {5, 4, 1}, {4, 4, 1}, {3.5, 1, 1}, {2, 1, 1}, {1, 4, 1}, {0, 4, 1}})})
    {
        const Assembly<3> assembly = onGround({shape});
        const std::vector<ContactPoint<3>> points = findContactPoints(assembly);
        const std::vector<double> areas = pointAreas(assembly, points);
        const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
        EXPECT_NEAR(area, volumeProperties(shape).volume, 1e-12); // it is 1 m high
        Vector<3> centroid = Vector<3>::Zero();
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            EXPECT_GT(areas[i], 0);
            centroid += areas[i] / area * points[i].position;
        }
        EXPECT_LE((centroid.head<2>() - volumeProperties(shape).centroid.head<2>()).norm(), 1e-12);
    }
}

TEST(SpaceContactState, ShearIsTheLengthOfItsTwoComponents)
{
    const std::vector<Vector<3>> forces = pointForces<3>(
        Eigen::VectorXd::Map(std::vector<double>{10, 3, 4, 10, 0, 0, 0, 0, 0, 10, 3, 3.9}.data(), 12));
    EXPECT_THAT(contactStates(forces, std::vector<double>(4, 0.5)),
                ElementsAre(ContactState::sliding, ContactState::sticking, ContactState::open,
                            ContactState::sticking));
}

} // namespace
