// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks that meet each other in an impact, and what becomes of their energy: each group of them for itself.
/// Internal to Impact.
#pragma once

#include "dynamics/Impact.h"

namespace drystone
{

/// Points and bodies of blocks that meet each other, numbered.
struct ImpactGroups
{
    std::vector<int> ofBody;  ///< -1: meets nothing
    std::vector<int> ofPoint; ///< one a point that meets
    int count = 0;
};

/// A way for the impact to go.
struct ImpactOutcome
{
    Eigen::VectorXd velocity; ///< v+
    Eigen::VectorXd force;    ///< impulses over the time step [N]
    Eigen::VectorXd share;    ///< k of each group
    Eigen::VectorXd gain;     ///< energy created in each group [J]
};

/// Blocks that meet at points of the impact, directly or by way of others, are one group.
template<int Dim>
ImpactGroups impactGroups(const ImpactProblem<Dim>& problem);

/// What each group's kinetic energy grows by beyond the work of the supports [J].
template<int Dim>
Eigen::VectorXd gainOf(const ImpactProblem<Dim>& problem, const ImpactGroups& groups,
                       const Eigen::VectorXd& velocity, const Eigen::VectorXd& force);

/// Of each group the last point of the segment from `low` to `high` that creates no energy.
template<int Dim>
Eigen::VectorXd rootsBetween(const ImpactProblem<Dim>& problem, const ImpactGroups& groups,
                             const ImpactOutcome& low, const ImpactOutcome& high);

/// Takes over what another outcome has for some groups.
template<int Dim>
void takeGroups(ImpactOutcome& outcome, const ImpactOutcome& other, const ImpactGroups& groups,
                const std::vector<char>& which);

/// The outcome at a part of the way from one to another, another part for each group.
template<int Dim>
ImpactOutcome outcomeBetween(const ImpactProblem<Dim>& problem, const ImpactGroups& groups,
                             const ImpactOutcome& low, const ImpactOutcome& high,
                             const Eigen::VectorXd& part);

} // namespace drystone
