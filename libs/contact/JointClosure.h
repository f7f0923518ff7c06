// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Closing of joints whose faces do not quite meet because coordinates were rounded.
#pragma once

#include "assembly/Assembly.h"

namespace drystone
{

/// How near faces must be to be meant as a joint [m].
struct JointTolerance
{
    double distance = 0; ///< of faces parallel to an axis: 1e-6 of the mean block size
    double oblique =
        0; ///< of other faces: 1.5 units of the last digit of the coordinates, where that is more
    double rounding = 0; ///< this unit, see writtenRounding
};

/// The tolerance of an assembly; where the user states one, it is that of all faces.
///
/// Rounding moves a corner by up to half a unit along each axis, hence across a line by up to 0.71 units, and
/// two lines by up to 1.41 units from each other. It is not followed beyond 1e-3 of the mean block size: such
/// coordinates are too coarse for the blocks.
JointTolerance jointTolerance(const Assembly<2>& assembly);

/// Moves corners so that the faces of joints meet exactly, where they are apart or in each other by no more
/// than the tolerance: corners within the tolerance of each other become one, and the faces that meet along a
/// line are put on the straight line that fits their corners best. Corners of joints that meet already stay
/// as they are, to the last bit. No corner moves by more than some five times the tolerance; what cannot be
/// closed so is left alone, for checkAssembly to find.
///
/// Fills in Assembly::closure. Time of order n log n in the number of edges.
///
/// In space no corner is moved: faces within the tolerance, 1e-6 of the mean block size or the one that the
/// user states, are joints where they are.
void closeJoints(Assembly<2>& assembly);
void closeJoints(Assembly<3>& assembly);

/// The tolerance that findContactPoints needs, relative to the mean block size, once joints are closed: in
/// the plane their faces meet, in space they may be as far apart as closeJoints allows.
double contactTolerance(const Assembly<2>& assembly);
double contactTolerance(const Assembly<3>& assembly);

/// Says on the log which joints were closed: `Joints: 82 closed whose faces were up to 1.1e-06 m from
/// meeting, ...`, and how many faces almost meet and are apart on purpose; nothing where there are none.
template<int Dim>
void printClosure(const Assembly<Dim>& assembly);

} // namespace drystone
