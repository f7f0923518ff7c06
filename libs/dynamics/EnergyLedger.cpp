// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sums of energy over the steps of a motion.
#include "dynamics/EnergyLedger.h"

#include "dynamics/DynamicCase.h"

namespace drystone
{

double kineticEnergy(const DynamicCase& scene, const Eigen::VectorXd& velocity)
{
    return 0.5 * scene.mass.dot(velocity.cwiseAbs2());
}

double potentialEnergy(const DynamicCase& scene, const std::vector<Placement<2>>& placements)
{
    double energy = 0;
    for (std::size_t block = 0; block < placements.size(); ++block)
    {
        if (scene.free[block] >= 0)
        {
            const auto load = scene.deadLoad.segment<3>(3 * scene.free[block]);
            energy -=
                load.head<2>().dot(placements[block].translation) + load[2] * placements[block].rotation;
        }
    }
    return energy;
}

void keepLedger(EnergyLedger& ledger, const DynamicCase& scene, const StepEnergy& step,
                const Eigen::VectorXd& velocity, const std::vector<Placement<2>>& placements)
{
    ledger.externalWork += step.externalWork;
    ledger.frictionLoss += step.frictionLoss;
    ledger.impactLoss += step.normalLoss;
    ledger.algorithmicLoss += step.algorithmicLoss;
    ledger.elastic += step.elasticChange;
    ledger.dampingLoss += step.dampingLoss;
    ledger.kinetic = kineticEnergy(scene, velocity);
    ledger.potential = potentialEnergy(scene, placements);
}

} // namespace drystone
