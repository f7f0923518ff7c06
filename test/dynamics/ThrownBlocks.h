// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks that are thrown at each other in steps of half of their size, in the plane and in space.
#pragma once

#include "contact/Penetration.h"
#include "dynamics/Advance.h"

#include <gtest/gtest.h>

namespace drystone
{

/// Nothing but contact acts: momenta stay, energy does not grow, and blocks enter each other by no more than
/// a step may leave. \param velocity of the free blocks at first \param deepest in mean block sizes \return
/// how many steps were shortened
template<int Dim>
int throwAtEachOther(const DynamicCase<Dim>& scene, const Eigen::VectorXd& velocity, double deepest)
{
    constexpr double timeStep = 5e-3;
    Motion<Dim> motion = startMotion(scene, stateAtRest(scene.assembly));
    motion.state.velocity = velocity;
    const auto momentum = [&scene](const Eigen::VectorXd& of)
    {
        Vector<Dim> sum = Vector<Dim>::Zero();
        for (Eigen::Index row = 0; row < of.size(); row += freedomCount<Dim>)
        {
            sum += scene.mass[row] * of.template segment<Dim>(row);
        }
        return sum;
    };
    const double energy = kineticEnergy(scene, motion.state);
    int shortened = 0;
    for (double time = 0; time < 0.05;)
    {
        const ShortenedStep step = advanceOrShorten(scene, motion, timeStep);
        EXPECT_TRUE(step.isSolved) << "at " << time;
        if (!step.isSolved)
        {
            break;
        }
        time += step.timeStep;
        shortened += step.timeStep < timeStep;
        EXPECT_LE(penetration(scene.assembly, motion.state.placements).depth, deepest * scene.blockSize)
            << "at " << time;
    }
    EXPECT_LE((momentum(motion.state.velocity) - momentum(velocity)).norm(),
              1e-6 * scene.mass[0] * velocity.template head<Dim>().norm());
    EXPECT_LE(kineticEnergy(scene, motion.state), energy * (1 + 1e-9));
    return shortened;
}

} // namespace drystone
