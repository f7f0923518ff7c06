// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Faces that almost meet: too far from each other, or too deep in each other, for a joint, and too near to
/// be meant as none.
#pragma once

#include "contact/AssemblyChecks.h"
#include "contact/Facing.h"

#include <filesystem>

namespace drystone
{

/// The larger distance of the two faces at the ends of a piece, or depth in each other [m].
double openness(const FacingPiece& piece);

/// Whether the faces of a piece are apart, rather than in each other.
bool isApart(const FacingPiece& piece);

/// Faces within CheckLimits::gap of each other that are no joint: openness above CheckLimits::jointTolerance.
std::vector<FacingPiece> findAlmostJoints(const Assembly<2>& assembly, const CheckLimits& limits = {});

/// `block 3`, or `block 57 (support ground)`.
std::string blockName(const Assembly<2>& assembly, int block);

/// What to say of faces that almost meet: how many, the pair that is farthest from meeting, and the repair.
/// Faces that are farther apart than a stated Assembly::jointTolerance are apart on purpose and left out.
/// Empty when there are none.
std::string almostJointsText(const Assembly<2>& assembly);

/// How many pairs of faces almost meet and are farther apart than a stated Assembly::jointTolerance; 0 where
/// none is stated.
int facesApartOnPurpose(const Assembly<2>& assembly);

/// For computations, which would otherwise go on without the joints.
/// \throws FatalIOError with almostJointsText, at the outline of the second block
void refuseAlmostJoints(const Assembly<2>& assembly, const std::filesystem::path& caseDirectory);

} // namespace drystone
