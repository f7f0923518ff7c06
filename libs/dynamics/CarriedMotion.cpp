// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The step of one block of the support, taken to each mass centre by the arm between the two.
#include "dynamics/CarriedMotion.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// A block of the support that carries all; -1: none.
template<int Dim>
int carryingBlock(const Step<Dim>& step)
{
    const std::vector<int>& free = step.scene.free;
    const auto fixed = std::find(free.begin(), free.end(), -1);
    return step.supports.empty() || step.scene.assembly.supports.size() != 1 || fixed == free.end()
               ? -1
               : static_cast<int>(fixed - free.begin());
}

/// Calls a function for each body with the arm to its mass centre from that of a block, where they are [m].
template<int Dim, class Function>
void forEachArm(const Step<Dim>& step, int from, const Function& function)
{
    const DynamicCase<Dim>& scene = step.scene;
    const auto centreOf = [&](std::size_t block) -> Vector<Dim>
    { return scene.blocks[block].centroid + step.motion.state.placements[block].translation; };
    const Vector<Dim> origin = centreOf(static_cast<std::size_t>(from));
    for (std::size_t block = 0; block < scene.free.size(); ++block)
    {
        if (scene.free[block] >= 0)
        {
            function(freedomCount<Dim> * static_cast<Eigen::Index>(scene.free[block]),
                     Vector<Dim>(centreOf(block) - origin));
        }
    }
}

} // namespace

template<int Dim>
Eigen::VectorXd carriedDisplacement(const Step<Dim>& step)
{
    const int fixed = carryingBlock(step);
    if (fixed < 0)
    {
        return {};
    }
    Eigen::VectorXd displacement(freedomCount<Dim> * step.program.bodies);
    forEachArm(step, fixed,
               [&](Eigen::Index row, const Vector<Dim>& arm)
               {
                   SupportStep<Dim> own = step.supports[static_cast<std::size_t>(fixed)];
                   own.arm += arm;
                   displacement.segment<freedomCount<Dim>>(row) = displacementAfter(own);
               });
    return displacement;
}

template<int Dim>
Eigen::VectorXd carriedVelocity(const Step<Dim>& step, double from, double to)
{
    const int fixed = carryingBlock(step);
    if (fixed < 0)
    {
        return {};
    }
    const BlockVector<Dim> ofSupport =
        velocitiesOfAllBlocks(step.scene, step.motion.state, from, to)[static_cast<std::size_t>(fixed)];
    const Turn<Dim> spin = turnOf<Dim>(ofSupport.template tail<rotationCount<Dim>>());
    Eigen::VectorXd velocity(freedomCount<Dim> * step.program.bodies);
    forEachArm(step, fixed,
               [&](Eigen::Index row, const Vector<Dim>& arm)
               {
                   velocity.segment<freedomCount<Dim>>(row)
                       << ofSupport.template head<Dim>() + velocityOfArm(spin, arm),
                       rowsOf(spin);
               });
    return velocity;
}

template Eigen::VectorXd carriedDisplacement(const Step<2>& step);
template Eigen::VectorXd carriedVelocity(const Step<2>& step, double from, double to);
template Eigen::VectorXd carriedDisplacement(const Step<3>& step);
template Eigen::VectorXd carriedVelocity(const Step<3>& step, double from, double to);

} // namespace drystone
