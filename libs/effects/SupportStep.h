// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How fixed blocks go with supports that an effect moves: what a step does with it.
#pragma once

#include "contact/Equilibrium.h"
#include "effects/MassMatrix.h"
#include "geometry/Rotation.h"

#include <vector>

namespace drystone
{

/// How a block goes with its support over a time; all zero where the support stands still.
template<int Dim>
struct SupportStep
{
    Vector<Dim> translation = Vector<Dim>::Zero(); ///< of the support's centre [m]
    Turn<Dim> rotation = noTurn<Dim>();            ///< [rad]
    Vector<Dim> arm = Vector<Dim>::Zero(); ///< from that centre to the block's mass centre at the start [m]
};

/// Whether the block stays where it is.
template<int Dim>
bool isStill(const SupportStep<Dim>& step);

/// The displacement (ux uy rz), in space (ux uy uz rx ry rz), of the block's mass centre after a share of the
/// time: to the last digits [m and rad].
template<int Dim>
BlockVector<Dim> displacementAfter(const SupportStep<Dim>& step, double share = 1);

/// Moves blocks by a share of the way that they go with their supports. \param steps one a block; or empty
template<int Dim>
void moveWithSupports(std::vector<Placement<Dim>>& placements, const std::vector<SupportStep<Dim>>& steps,
                      double share = 1);

/// By how much points close and slide because supports move, Dim a point [m]; empty where none does.
template<int Dim>
Eigen::VectorXd closingBySupports(const std::vector<ContactPoint<Dim>>& points,
                                  const std::vector<ContactColumns<Dim>>& columns,
                                  const std::vector<SupportStep<Dim>>& supports);

/// The same as if they went on for the time of the step at the velocities with which they begin it, which are
/// those of one body for all blocks of a support: what an impact there needs. By chords of their turn they
/// come nearer to each other, and squeeze what stands between them. \param columns at the start
template<int Dim>
Eigen::VectorXd closingAtTheStart(const std::vector<ContactPoint<Dim>>& points,
                                  const std::vector<ContactColumns<Dim>>& columns,
                                  const std::vector<SupportStep<Dim>>& supports);

} // namespace drystone
