// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Steps of tests of effects.
#pragma once

#include "dynamics/Advance.h"

#include <gtest/gtest.h>

namespace drystone::test
{

/// Takes steps, each of which has to be solved. \param timeStep [s]
inline void run(const DynamicCase<2>& scene, Motion<2>& motion, double timeStep, int steps)
{
    for (int step = 0; step < steps; ++step)
    {
        ASSERT_TRUE(advance(scene, motion, timeStep))
            << "step " << step << ": residuals " << motion.attempt.primalResidual << " "
            << motion.attempt.dualResidual << " " << motion.attempt.dualityGap << " after "
            << motion.attempt.iterations << " iterations of " << motion.attempt.programs << " programs";
    }
}

} // namespace drystone::test
