// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Joints that constant/assembly/blocks states, apart from the shapes of the blocks: what Polyhedra.h is of
/// those.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Dictionary.h"

#include <vector>

namespace drystone
{

/// `( { blocks (0 1); normal (x y z); points ((x y z) ...); } ... )`, points in metres.
struct StatedJoints
{
    std::vector<StatedJoint<3>> joints;
};

/// \throws FatalIOError with the joint's line where the normal has no direction or there is no point
void read(TokenCursor& cursor, StatedJoints& stated);

/// \throws FatalIOError where a stated joint has other blocks than two of the assembly, the first of which
/// has the lower index. \param place of the joints in the file
void requireBlocks(const Assembly<3>& assembly, const SourceLocation& place);

/// The joints of one pair of blocks after each other, as those that are found, pairs in rising order: solvers
/// sum up what the points of a pair do once for each pair.
void sortByPair(std::vector<StatedJoint<3>>& joints);

} // namespace drystone
