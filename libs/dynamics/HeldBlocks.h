// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Steps with fewer bodies than blocks: those that provably rest are held with the ground, those that
/// provably move as one are one body, `selection automatic`.
#pragma once

#include "dynamics/Step.h"

namespace drystone
{

/// Solves the step with the blocks that hardly move held as one body with the ground, and blocks that hardly
/// move against each other as one body each, and proves that this is a solution of the whole. With the
/// displacements y of all blocks that follow (BlockGroups.h) and c_O the forces of the points between bodies,
/// the balance of each body as a whole is that of its blocks summed up, and what these lack,
///
///     f - Mbar y - A_O c_O,
///
/// is left to the points within the bodies. These are closed and neither open nor slide, as bodies are rigid:
/// z = g - A'y = 0, or g > 0 where they carry nothing. Together with forces c_I in their cones that balance
/// what is lacking, A_I c_I = f - Mbar y - A_O c_O, it is by the associative law a solution of the program of
/// all blocks, since each of the conditions of optimality belongs to a point of one kind or the other; and y
/// is unique. Its certificate is the larger of those of the two parts, with the tolerance of every step. For
/// what is held this says that forces at rest exist; for what moves, that they exist in axes that move along
/// with the body, with its inertial forces among the loads. c_I is found from the forces of the last step
/// (HoldingForces.h). Points of bodies, and of what is held, keep the gaps that they had, which are within
/// the error that each step is allowed in them.
///
/// Which blocks are held, or are one, is a guess, from their velocities, that the proof does not depend on
/// (GroupChoice.h). c_O is not unique, and of those that what is held could bear as ground most are more than
/// it can bear as blocks. So blocks about those that move are simulated with them, as a buffer, and those of
/// them that the solution leaves at rest are held after it (BodiesStep.h): c_O is then what moves and its
/// surroundings have agreed upon. Where it is not proved at some points it is tried again with bodies parted
/// there and blocks about them awake. Bonds between blocks that are held or one do not matter where friction
/// alone carries c_I. Where points collide, with restitution, the step and its other parts are solved with
/// all blocks: which of them take part in an impact follows from forces, too. By Coulomb's law a step without
/// an impact is known by the closing velocities of all points that it closes, whatever their forces; by the
/// associative law, where sliding joints open and close in every step, any point that closes and carries a
/// force counts. After steps in a row in which it has gained little not every step is tried. \return whether
/// `solved.result` is the step; otherwise it is to be solved with all blocks
template<int Dim>
bool solveAwake(Step<Dim>& step);

/// Has the step say that all blocks were simulated, each as a body: a solution with fewer is not taken.
template<int Dim>
void forgetBodies(Step<Dim>& step);

/// Why steps in which anything moves are taken with all blocks as bodies of their own; empty: they need not
/// be. Points that give way do so at rest too. With theta below 1 plastic impacts are instants of their own:
/// which points take part in one follows from the forces of the step, of which there are many, and other ones
/// come of fewer bodies. By Coulomb's law c_I and y (see solveAwake) are a solution, too, but not the only
/// one: a block that the pressure of a head joint could hold rests or moves. Steps in which nothing slides
/// are taken by the associative law, in space and in columns (StickingStep.h). \param flowRule that the steps
/// are solved by
template<int Dim>
std::string_view whyAllBlocks(const DynamicCase<Dim>& scene, FlowRule flowRule);

} // namespace drystone
