// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where the energy of the blocks is and where it has gone.
#pragma once

#include "assembly/Assembly.h"

#include <vector>

namespace drystone
{

template<int Dim>
struct DynamicCase;
template<int Dim>
struct DynamicState;
struct StepEnergy;

/// In joules. Losses and work are sums since the ledger was opened, at the start of the first run; a restart
/// goes on with them.
struct EnergyLedger
{
    double opening = 0;   ///< kinetic and potential energy when the ledger was opened
    double kinetic = 0;   ///< relative to the moving ground
    double potential = 0; ///< of the dead load, zero as built
    double externalWork =
        0; ///< done by everything else from outside: live loads, the motion of the ground, supports
    double frictionLoss = 0;    ///< in sliding
    double impactLoss = 0;      ///< in impacts
    double algorithmicLoss = 0; ///< of the time integration
    double elastic = 0;         ///< stored in contact points that give way
    double dampingLoss = 0;
};

/// What the ledger leaves unexplained [J]: kinetic + potential + elastic + losses - (opening + external
/// work), zero but for rounding and the tolerance of the solver.
inline double imbalance(const EnergyLedger& ledger)
{
    const double losses =
        ledger.frictionLoss + ledger.impactLoss + ledger.algorithmicLoss + ledger.dampingLoss;
    return ledger.kinetic + ledger.potential + ledger.elastic + losses - ledger.opening - ledger.externalWork;
}

/// Of the free blocks [J].
template<int Dim>
double kineticEnergy(const DynamicCase<Dim>& scene, const DynamicState<Dim>& state);

/// Of the dead load, whose forces keep their directions and stay at their points of the blocks [J]. With
/// small displacements its moments stay as built, too, which in space have no potential.
template<int Dim>
double potentialEnergy(const DynamicCase<Dim>& scene, const std::vector<Placement<Dim>>& placements);

/// Adds a step. \param state at its end
template<int Dim>
void keepLedger(EnergyLedger& ledger, const DynamicCase<Dim>& scene, const StepEnergy& step,
                const DynamicState<Dim>& state);

} // namespace drystone
