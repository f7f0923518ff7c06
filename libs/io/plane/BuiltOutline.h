// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The outline of a structure as it was built, for pictures.
#pragma once

#include "assembly/Assembly.h"

#include <vector>

namespace drystone
{

/// A part of an edge.
struct OutlinePiece
{
    Vector<2> from;
    Vector<2> to;
};

/// Edges of free blocks as built that belong to one block only: the outline of the structure and those of its
/// openings. Edges are compared by the line they cover, because blocks of a masonry bond share only parts of
/// edges. \param tolerance by which edges that are one may be apart [m]
std::vector<OutlinePiece> builtOutline(const Assembly<2>& assembly, double tolerance);

} // namespace drystone
