// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Straight lines through the faces of joints whose coordinates were rounded, and corners put on them: what
/// closeJoints does in the plane.
#pragma once

#include "assembly/Assembly.h"
#include "contact/Facing.h"

#include <vector>

namespace drystone
{

/// All corners of an assembly in one row, those that coincide as one node.
struct CornerNodes
{
    std::vector<std::size_t> first; ///< block b has the corners first[b] to first[b + 1]
    std::vector<int> ofCorner;      ///< node of each corner
    std::vector<Vector<2>> place;   ///< of each node [m]
};

/// Lines through the faces of joints, and the nodes on them.
struct FaceLines
{
    std::vector<std::vector<int>> nodesOf; ///< of each line; empty: no line
    std::vector<std::vector<int>> linesAt; ///< of each node
};

/// \param reach distance up to which corners of different blocks coincide [m]
CornerNodes findCornerNodes(const Assembly<2>& assembly, double reach);

/// One line for all edges that face each other, and for those of them that go on straight at a node.
FaceLines findFaceLines(const Assembly<2>& assembly, const CornerNodes& nodes,
                        const std::vector<OutlineEdge>& edges, const std::vector<FacingPiece>& pieces,
                        double straight);

/// Takes away lines that their corners are not on, as where faces follow a curve.
void removeCurves(FaceLines& faces, const std::vector<Vector<2>>& place, double tolerance);

/// Moves nodes onto their lines, and lines onto their nodes, until all are where they belong.
void fitLines(const FaceLines& faces, std::vector<Vector<2>>& place, double exact);

} // namespace drystone
