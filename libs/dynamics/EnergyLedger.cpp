// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sums of energy over the steps of a motion.
#include "dynamics/EnergyLedger.h"

#include "assembly/TurnedLoad.h"
#include "dynamics/DynamicCase.h"

namespace drystone
{

template<int Dim>
double kineticEnergy(const DynamicCase<Dim>& scene, const DynamicState<Dim>& state)
{
    return 0.5 * squareOf(massAt(scene, state.placements), state.velocity);
}

template<int Dim>
double potentialEnergy(const DynamicCase<Dim>& scene, const std::vector<Placement<Dim>>& placements)
{
    double energy = 0;
    for (std::size_t block = 0; block < placements.size(); ++block)
    {
        if (scene.free[block] >= 0)
        {
            const auto load = scene.deadLoad.rows.template segment<freedomCount<Dim>>(
                freedomCount<Dim> * scene.free[block]);
            double work = load.template head<Dim>().dot(placements[block].translation)
                          + workOfTurning<Dim>(scene.deadLoad, scene.free[block], placements[block]);
            if constexpr (Dim == 2) // a constant moment in space has no potential
            {
                work += scene.deadLoad.firstMoments.size() == 0 ? load[2] * placements[block].rotation : 0;
            }
            energy -= work;
        }
    }
    return energy;
}

template<int Dim>
void keepLedger(EnergyLedger& ledger, const DynamicCase<Dim>& scene, const StepEnergy& step,
                const DynamicState<Dim>& state)
{
    ledger.externalWork += step.externalWork;
    ledger.frictionLoss += step.frictionLoss;
    ledger.impactLoss += step.normalLoss;
    ledger.algorithmicLoss += step.algorithmicLoss;
    ledger.elastic += step.elasticChange;
    ledger.dampingLoss += step.dampingLoss;
    ledger.kinetic = kineticEnergy(scene, state);
    ledger.potential = potentialEnergy(scene, state.placements);
}

template double kineticEnergy(const DynamicCase<2>& scene, const DynamicState<2>& state);
template double potentialEnergy(const DynamicCase<2>& scene, const std::vector<Placement<2>>& placements);
template void keepLedger(EnergyLedger& ledger, const DynamicCase<2>& scene, const StepEnergy& step,
                         const DynamicState<2>& state);
template double kineticEnergy(const DynamicCase<3>& scene, const DynamicState<3>& state);
template double potentialEnergy(const DynamicCase<3>& scene, const std::vector<Placement<3>>& placements);
template void keepLedger(EnergyLedger& ledger, const DynamicCase<3>& scene, const StepEnergy& step,
                         const DynamicState<3>& state);

} // namespace drystone
