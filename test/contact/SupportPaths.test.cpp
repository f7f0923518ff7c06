// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Why a structure cannot stand, where its joints tell.
#include "contact/SupportPaths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace drystone;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

namespace
{

Block<2> box(double left, double bottom, double right, double top, int support = -1)
{
    return {{{left, bottom}, {right, bottom}, {right, top}, {left, top}}, 1, support};
}

Assembly<2> onGround(std::vector<Block<2>> blocks)
{
    Assembly<2> assembly;
    assembly.supports = {{"ground", "ground"}};
    assembly.blocks = {box(-5, -1, 5, 0, 0)};
    assembly.blocks.insert(assembly.blocks.end(), blocks.begin(), blocks.end());
    return assembly;
}

std::string cause(const Assembly<2>& assembly)
{
    return instabilityCause(assembly, findContactPoints(assembly));
}

TEST(SupportPaths, OfAStructureThatIsHeldSayNothing)
{
    EXPECT_EQ(cause(onGround({box(0, 0, 1, 1), box(0.9, 1, 5, 2)})), ""); // falls, but by equilibrium
}

TEST(SupportPaths, NameBlocksThatNothingHolds)
{
    const Assembly<2> assembly = onGround({box(0, 0, 1, 1), box(0, 2, 1, 3), box(0, 3, 1, 4)});
    EXPECT_EQ(blocksWithoutSupport(assembly, findContactPoints(assembly)), (std::vector<int>{2, 3}));
    EXPECT_THAT(cause(assembly), AllOf(HasSubstr("2 blocks with no path to a support"), HasSubstr(": 2 3."),
                                       Not(HasSubstr("corner"))));
}

TEST(SupportPaths, SayWhereABlockOnlyTouchesAtACorner)
{
    const Assembly<2> assembly =
        onGround({box(0, 0, 1, 1), {{{2, 0}, {3, 1}, {2, 2}, {1, 1}}, 1, -1}, box(-3, 1, 0, 2)});
    EXPECT_THAT(cause(assembly),
                AllOf(HasSubstr("2 blocks with no path"), HasSubstr(": 2 3."),
                      HasSubstr("block 2 touches block 0 (support ground) at a corner only")));
}

TEST(SupportPaths, SayWhereABlockThatIsHeldStandsOnACornerToo)
{
    // A beam on a block at its left end, and on the tip of a triangle at its right.
    const Assembly<2> assembly =
        onGround({box(0, 0, 1, 1), {{{3, 0}, {4, 0}, {3.5, 1}}, 1, -1}, box(0.5, 1, 4.5, 1.5)});
    EXPECT_THAT(cause(assembly),
                AllOf(HasSubstr("no force acts where block 2 touches block 3 at a corner only"),
                      HasSubstr("checkBlocks -allChecks")));
}

TEST(SupportPaths, FindACornerThatStandsWithoutAJointWhetherTheStructureStandsOrNot)
{
    // A beam whose middle stands on a block, and its end on the tip of a triangle too.
    const Assembly<2> standing =
        onGround({box(0, 0, 1, 1), {{{1.2, 0}, {1.8, 0}, {1.5, 1}}, 1, -1}, box(-1, 1, 2, 1.5)});
    EXPECT_THAT(touchWithoutJoint(standing, findContactPoints(standing)),
                HasSubstr("block 2 touches block 3 at a corner only: a joint needs a face"));
    const Assembly<2> wall = onGround({box(0, 0, 1, 1), box(1, 0, 2, 1), box(0.5, 1, 1.5, 2)});
    EXPECT_EQ(touchWithoutJoint(wall, findContactPoints(wall)), "");
}

TEST(SupportPaths, SayWhereNoBlockIsFixed)
{
    Assembly<2> assembly;
    assembly.blocks = {box(0, 0, 1, 1), box(0, 1, 1, 2)};
    EXPECT_THAT(cause(assembly), AllOf(HasSubstr("no block is fixed"), HasSubstr("supports { ground")));
}

} // namespace
