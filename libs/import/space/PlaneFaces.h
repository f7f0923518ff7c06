// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Coordinates that their author rounded, moved so that corners which neighbours share are one and faces are
/// plane again.
#pragma once

#include "geometry/space/Polyhedron.h"

#include <string>
#include <vector>

namespace drystone
{

/// What was moved.
struct PlaneFaces
{
    int joined = 0;        ///< corners that became one with a neighbour's
    int moved = 0;         ///< corners that are not where they were written
    double farthest = 0;   ///< [m]
    double unevenness = 0; ///< farthest that a corner was from the plane of its face before [m]
};

/// Whether blocks share corners.
enum class Corners
{
    own,   ///< each block has its own
    joined ///< those of different blocks within the tolerance of each other are one
};

/// Makes all faces plane that are so to the tolerance, and joins corners before: planes are fitted to the
/// corners of each face, and corners moved to where the planes of their faces meet, in turn until nothing
/// moves. Corners of faces that are plane already, and not joined, stay as they are to the last bit. No
/// corner moves by more than three times the tolerance: what cannot be made plane so is left alone. Time of
/// order n. \param tolerance [m]
PlaneFaces makePlane(std::vector<Polyhedron>& blocks, double tolerance, Corners cornersOfBlocks);

} // namespace drystone
