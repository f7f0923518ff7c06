// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Faces that almost meet: too far from each other, or too deep in each other, for a joint, and too near to
/// be meant as none.
#pragma once

#include "contact/CheckLimits.h"
#include "contact/Facing.h"
#include "contact/space/FacingPatches.h"

#include <filesystem>

namespace drystone
{

/// The larger distance of the two faces at the corners of a piece or patch, or depth in each other [m].
double openness(const FacingPiece& piece);
double openness(const FacingPatch& patch);

/// Whether the faces of a piece are apart, rather than in each other.
bool isApart(const FacingPiece& piece);
bool isApart(const FacingPatch& patch);

/// Where they are: a corner of the piece [m].
inline const Vector<2>& placeOf(const FacingPiece& piece)
{
    return piece.from;
}
inline const Vector<3>& placeOf(const FacingPatch& patch)
{
    return patch.corners.front();
}

/// Faces within CheckLimits::gap of each other that are no joint: openness above CheckLimits::jointTolerance,
/// in space above usualToleranceAlongAxes or usualObliqueTolerance too, since joints are not moved.
std::vector<FacingPiece> findAlmostJoints(const Assembly<2>& assembly, const CheckLimits& limits = {});
std::vector<FacingPatch> findAlmostJoints(const Assembly<3>& assembly, const CheckLimits& limits = {});

/// `block 3`, or `block 57 (support ground)`.
template<int Dim>
std::string blockName(const Assembly<Dim>& assembly, int block);

/// Who says within what distance faces are a joint, Assembly::jointTolerance.
enum class ToleranceOrigin
{
    stated,  ///< the user: faces that are farther apart are so on purpose
    ofDigits ///< the digits of an imported file: nobody has stated that they are
};

/// What to say of faces that almost meet: how many, the pair that is farthest from meeting, and the repair.
/// Those that are farther apart than the tolerance are left out where it is stated, and named where there are
/// no others and it is of digits. Empty when there are none. Where joints are stated instead of found:
/// misplacedJointsText.
template<int Dim>
std::string almostJointsText(const Assembly<Dim>& assembly,
                             ToleranceOrigin tolerance = ToleranceOrigin::stated);

/// How many pairs of faces almost meet and are farther apart than a stated Assembly::jointTolerance; 0 where
/// none is stated.
template<int Dim>
int facesApartOnPurpose(const Assembly<Dim>& assembly);

/// For computations, which would otherwise go on without the joints.
/// \throws FatalIOError with almostJointsText, at the second block
template<int Dim>
void refuseAlmostJoints(const Assembly<Dim>& assembly, const std::filesystem::path& caseDirectory);

} // namespace drystone
