// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Steps by Coulomb's law in which nothing slides: they are the same by the associative law, which is cheaper
/// and lets blocks be held, and be one; `selection automatic`.
#pragma once

#include "dynamics/Step.h"

namespace drystone
{

/// Whether steps of the case may be solved by the associative law first. With theta below 1 or elastic joints
/// the motion depends on forces that are not unique, which the two laws choose differently. In an impact it
/// does as well: where points collide (Collide.cpp) the step is taken again by Coulomb's law with all blocks.
template<int Dim>
bool mayStick(const DynamicCase<Dim>& scene);

/// Likewise of one step, whose program is assembled. In space all; in the plane Coulomb's law costs no more
/// for all blocks, and with fewer the two find different motions more often, where friction wedges a block
/// between others: one wall of a thousand is off by some micrometres. So there, what blocks give each other
/// has to follow from their motion alone, as in columns and towers: their pairs close no ring, through the
/// ground neither, and points of a pair press in about the same direction.
template<int Dim>
bool mayStick(const Step<Dim>& step);

/// Whether the solution of the step by the associative law is one by Coulomb's. They differ in the flow of
/// points that carry a force and slide: those open by mu |u_t| with the associative law, and stay closed with
/// Coulomb's. Where u_t = 0 at all of them, in the program that the step ends with, to a small part of the
/// error allowed in gaps, forces in the cones, balance and closed points are the conditions of both. What the
/// finite rotations of the blocks add to u_t is of second order, and the same with both. Coulomb's law may
/// have other solutions, though, where forces are near the surface of their cones: these are to be inside by
/// the margin of system/schemes/effects, and inside those of friction, so that bonds are not needed.
template<int Dim>
bool sticks(const Step<Dim>& step);

/// Whether points that carry a force hardly slide in a solution by Coulomb's law, so that the next step may
/// stick.
template<int Dim>
bool hardlySlides(const Step<Dim>& step);

} // namespace drystone
