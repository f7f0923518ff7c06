// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What acts on the blocks in a step.
#include "dynamics/Step.h"

#include "dynamics/Deletion.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// Largest acceleration that the loads alone give a block [m/s2].
double largestAcceleration(const DynamicCase& scene, const Eigen::VectorXd& load)
{
    double largest = 0;
    for (Eigen::Index row = 0; row < load.size(); row += 3)
    {
        largest = std::max(largest, load.segment<2>(row).norm() / scene.mass[row]);
    }
    return largest;
}

} // namespace

Step::Step(const DynamicCase& dynamicCase, Motion& current, double length, const ImpactChoice& choice)
    : scene(dynamicCase),
      motion(current),
      impacts(choice),
      scheme{scene.schemes.timeIntegration.theta, length}
{
    settings.flowRule = scene.flowRule();
    settings.blockSize = scene.blockSize;
    settings.contactTolerance = scene.schemes.contactTolerance * scene.blockSize;
    settings.solver = scene.solution;
    settings.work = &motion.work;
    motion.attempt = {};

    const double start = motion.state.time;
    load = loadUnder(scene, meanGroundAcceleration(scene.groundMotion, start, start + length));
    unloadDeleted(scene, motion, load);
    acceleration = largestAcceleration(scene, load);
    supports = supportSteps(scene.supportMotions, scene.assembly, scene.blocks, motion.state.placements,
                            start, start + length);
}

} // namespace drystone
