// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A list of outlines as a user writes them.
#pragma once

#include "dictionary/Dictionary.h"
#include "geometry/Polygon.h"

#include <vector>

namespace drystone
{

/// `( ((x y) (x y) ...) ... )` in metres: simple polygons in either orientation, turned counter-clockwise
/// when they are read; the first corner stays the first.
struct Outlines
{
    std::vector<Polygon> polygons;
    std::vector<SourceLocation> places; ///< of each polygon
};

/// \throws FatalIOError with the outline's line when it is not a simple polygon (see outlineFault)
void read(TokenCursor& cursor, Outlines& outlines);

} // namespace drystone
