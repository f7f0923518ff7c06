// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The search for edges that almost meet.
#include "contact/AlmostJoints.h"

#include "contact/Penetration.h"

#include <algorithm>
#include <cmath>

namespace drystone
{

double openness(const FacingPiece& piece)
{
    return std::max(std::abs(piece.gapAtFrom), std::abs(piece.gapAtTo));
}

bool isApart(const FacingPiece& piece)
{
    return piece.gapAtFrom + piece.gapAtTo > 0;
}

std::vector<FacingPiece> findAlmostJoints(const Assembly<2>& assembly, const CheckLimits& limits)
{
    const double size = meanBlockSize(assembly);
    const double jointTolerance = limits.jointTolerance * size;
    FacingTolerance tolerance = facingTolerance(limits.gap * size, jointTolerance);
    tolerance.angle = limits.gapAngle;
    std::vector<FacingPiece> pieces = findFacingPieces(assembly, tolerance);
    std::erase_if(pieces,
                  [&](const FacingPiece& piece)
                  {
                      // Outer faces of thin blocks that lie on each other have passed each other, too.
                      return openness(piece) <= jointTolerance
                             || (!isApart(piece)
                                 && overlapDepth(assembly.blocks[piece.block].outline,
                                                 assembly.blocks[piece.neighbour].outline)
                                        <= jointTolerance / 2);
                  });
    return pieces;
}

} // namespace drystone
