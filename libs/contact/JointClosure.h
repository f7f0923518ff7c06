// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Closing of joints whose faces do not quite meet because coordinates were rounded.
#pragma once

#include "assembly/Assembly.h"
#include "contact/Facing.h"

namespace drystone
{

/// How near faces must be to be meant as a joint [m].
struct JointTolerance
{
    double distance = 0; ///< of faces parallel to an axis, in space to two: 1e-6 of the mean block size
    double oblique = 0;  ///< of other faces: 1.5 units of the last digit of the coordinates, in space 1.8,
                         ///< where that is more
    double rounding = 0; ///< this unit, see writtenRounding
};

/// The tolerance of an assembly; where the user states one, it is that of all faces.
///
/// Rounding moves a corner by up to half a unit along each axis, hence across a line by up to 0.71 units, and
/// two lines by up to 1.41 units from each other; across a plane by 0.87, and two planes by 1.73. It is not
/// followed beyond 1e-3 of the mean block size: such coordinates are too coarse for the blocks.
template<int Dim>
JointTolerance jointTolerance(const Assembly<Dim>& assembly);

/// Moves corners so that the faces of joints meet exactly, where they are apart or in each other by no more
/// than the tolerance: corners within the tolerance of each other become one, and the faces that meet along a
/// line are put on the straight line that fits their corners best. Corners of joints that meet already stay
/// as they are, to the last bit. No corner moves by more than some five times the tolerance; what cannot be
/// closed so is left alone, for checkAssembly to find.
///
/// Fills in Assembly::closure. Time of order n log n in the number of edges.
///
/// In space no corner is moved, since three planes and more that meet at a corner leave it no room: faces
/// within the tolerance are joints where they are, their contact points halfway between them, and
/// Assembly::closure counts those that do not meet.
void closeJoints(Assembly<2>& assembly);
void closeJoints(Assembly<3>& assembly);

/// How near the faces of a joint are, once closeJoints has seen the assembly: in the plane they meet, in
/// space they are as near as Assembly::closure says. What is shorter, or narrower, than joints are closed up
/// to is no joint.
FacingTolerance closedFacing(const Assembly<2>& assembly);
FacingTolerance closedFacing(const Assembly<3>& assembly);

/// How near two faces must be to be a joint [m], where both are along the axes of the coordinates
/// (FacingPiece::isOblique, FacingPatch::isOblique).
template<int Dim>
double usualToleranceAlongAxes(const Assembly<Dim>& assembly);

/// The same of two faces one of which is oblique [m].
template<int Dim>
double usualObliqueTolerance(const Assembly<Dim>& assembly);

/// Says on the log which joints were closed: `Joints: 82 closed whose faces were up to 1.1e-06 m from
/// meeting, ...`, in space which were taken as they are, and how many faces almost meet and are apart on
/// purpose; nothing where there are none.
template<int Dim>
void printClosure(const Assembly<Dim>& assembly);

} // namespace drystone
