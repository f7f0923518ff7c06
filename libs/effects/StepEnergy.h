// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where the energy of one time step goes: the ledger to which effects add their lines.
#pragma once

namespace drystone
{

/// In joules; kinetic energy changes by loadWork - normalLoss - frictionLoss - algorithmicLoss, before
/// effects take their parts out of these.
struct StepEnergy
{
    double loadWork = 0;     ///< f' y
    double normalLoss = 0;   ///< of the normal forces: closing of gaps; negative where sliding opens a joint
    double frictionLoss = 0; ///< of the shear forces
    double algorithmicLoss = 0; ///< (theta - 1/2) |v1 - v0|_M^2, in which impacts on closed contacts are lost
    double elasticChange = 0;   ///< what effects have stored
    double dampingLoss = 0;     ///< of effects
    double externalWork = 0;    ///< of all loads but the dead ones, and of supports
};

} // namespace drystone
