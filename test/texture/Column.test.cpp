// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Columns and what lies on them.
#include "../MadeStructure.h"

#include <gtest/gtest.h>

#include <string>

using namespace drystone;

namespace
{

TEST(Column, AnArchitraveLiesOnAllColumnsInWhateverOrderTheyAreGiven)
{
    const auto beam = [](const std::string& places)
    {
        return madeStructure<3>(
                   Dictionary::readString(
                       "dimensions 3; texture { type column; radius 0.3; drums 2; drumHeight 0.5; at ("
                       + places + "); architrave { width 0.6; height 0.5; overhang 0.4; } }"))
            .blocks[6]
            .shape;
    };
    const Polyhedron inOrder = beam("(-1.2 0) (0 0) (1.2 0)");
    EXPECT_NEAR(volumeProperties(inOrder).volume, 3.2 * 0.6 * 0.5, 1e-12);
    for (const std::string places : {"(-1.2 0) (1.2 0) (0 0)", "(0 0) (1.2 0) (-1.2 0)",
                                     "(0 0) (-1.2 0) (1.2 0)", "(1.2 0) (0 0) (-1.2 0)"})
    {
        EXPECT_EQ(beam(places), inOrder) << places;
    }
}

} // namespace
