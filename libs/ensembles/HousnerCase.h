// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The one block of a case as Housner's equation has it, and what that gives: a reference of accuracyCost.
#pragma once

#include "ensembles/AccuracyRun.h"
#include "ensembles/Intensity.h"
#include "ensembles/References.h"
#include "quantities/Criterion.h"

#include <memory>

namespace drystone
{

/// The block of a case to which Housner's equation applies: one free rectangle on a fixed ground, whose only
/// rebound is that of the impact and which does not slide, at rest or turned about the corner it stands on.
struct HousnerCase
{
    RockingBlock block;
    RockingState start;
    int index = 0; ///< of the block
};
/// \throws FatalError naming the property of the case that does not agree with Housner's equation
HousnerCase housnerCase(const AccuracyCase<2>& study);

/// The motion of the ground of a case, along x. \throws FatalError where it is along another direction too
std::unique_ptr<GroundAcceleration> housnerGround(const AccuracyCase<2>& study);

/// The threshold of overturning, between the lowest and the highest intensity of a plan. \param unit of the
/// intensities [m/s2] \throws FatalError naming what of the case does not agree with Housner's equation
double housnerThreshold(const AccuracyCase<2>& study, const IntensityPlan& plan,
                        const Criterion<2>& criterion, double unit);

} // namespace drystone
