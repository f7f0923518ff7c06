// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Hinges and sliding joints in a picture of space that is painted from back to front.
#pragma once

#include "assembly/Assembly.h"
#include "io/Canvas.h"
#include "io/JointMarks.h"
#include "io/space/View.h"

#include <vector>

namespace drystone
{

/// Marks that wait for the later one of their two blocks: what hides them is painted after it.
struct MarksToPaint
{
    const Assembly<3>& assembly;
    const std::vector<JointMark>& marks;
    std::vector<std::vector<std::size_t>> ofBlock; ///< indices into marks
    std::vector<char> isPainted;                   ///< each block
};
MarksToPaint marksToPaint(const Assembly<3>& assembly, const std::vector<JointMark>& marks);

/// Paints the marks that end with a block, which has just been painted, as far as they are on faces of it
/// that look at the viewer. \param shape of the block where it is now
void paintMarks(Canvas& drawing, MarksToPaint& marks, int block, const Polyhedron& shape,
                const std::vector<Placement<3>>& placements, const View& view);

} // namespace drystone
