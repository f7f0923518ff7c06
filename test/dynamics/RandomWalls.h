// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Random walls and towers of the plane and of space, with random sets of effects, for tests of what steps
/// leave out.
#pragma once

#include "SceneGravity.h"

#include "dynamics/DynamicCase.h"
#include "effects/GroundMotion.h"
#include "effects/JointBonds.h"
#include "effects/MassDamping.h"
#include "timeSeries/GroundAcceleration.h"

#include <random>

namespace drystone::randomWalls
{

inline double between(std::mt19937& random, double least, double largest)
{
    return std::uniform_real_distribution<double>(least, largest)(random);
}

inline bool chance(std::mt19937& random, double share)
{
    return between(random, 0, 1) < share;
}

/// From x = left to right, z = bottom to top; in space through the depth.
template<int Dim>
Block<Dim> box(double left, double right, double bottom, double top, double depth)
{
    Block<Dim> block;
    block.support = -1;
    if constexpr (Dim == 2)
    {
        block.outline = {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
        block.thickness = depth;
    }
    else
    {
        block.shape = makeBox({left, 0, bottom}, {right, depth, top});
    }
    return block;
}

/// Nothing but the ground, below z = 0.
template<int Dim>
Assembly<Dim> ground(double depth)
{
    Assembly<Dim> assembly;
    assembly.supports.push_back({"ground", "ground"});
    assembly.blocks.push_back(box<Dim>(-5, 10, -1, 0, depth));
    assembly.blocks.back().support = 0;
    return assembly;
}

/// Two to five courses of one to four blocks each, some of them a little shorter than the one below, and
/// perhaps a slender stack on top.
template<int Dim>
Assembly<Dim> wall(std::mt19937& random)
{
    const double depth = between(random, 0.2, 0.6);
    Assembly<Dim> assembly = ground<Dim>(depth);
    double left = 0;
    double right = between(random, 0.6, 2);
    double bottom = 0;
    const int courses = std::uniform_int_distribution<int>(2, 5)(random);
    for (int course = 0; course < courses; ++course)
    {
        const double top = bottom + between(random, 0.15, 0.4);
        const int blocks = std::uniform_int_distribution<int>(1, 4)(random);
        std::vector<double> joints{left, right};
        for (int joint = 1; joint < blocks; ++joint)
        {
            joints.push_back(left + (right - left) * (joint + between(random, -0.3, 0.3)) / blocks);
        }
        std::sort(joints.begin(), joints.end());
        for (std::size_t i = 0; i + 1 < joints.size(); ++i)
        {
            assembly.blocks.push_back(box<Dim>(joints[i], joints[i + 1], bottom, top, depth));
        }
        bottom = top;
        const double step = chance(random, 0.3) ? 0.1 * (right - left) : 0;
        left += step;
        right -= step;
    }
    if (chance(random, 0.5)) // a pinnacle, which rocks while the wall below may rest
    {
        const double width = between(random, 0.05, 0.15);
        const double at = between(random, left, right - width);
        const int stones = std::uniform_int_distribution<int>(1, 3)(random);
        for (int stone = 0; stone < stones; ++stone)
        {
            const double top = bottom + between(random, 0.1, 0.3);
            assembly.blocks.push_back(box<Dim>(at, at + width, bottom, top, depth));
            bottom = top;
        }
    }
    return assembly;
}

/// One tower or two apart, of one to fourteen blocks each, each block wider or narrower than the one below
/// and perhaps beside its middle.
template<int Dim>
Assembly<Dim> towers(std::mt19937& random)
{
    const double depth = between(random, 0.2, 0.6);
    Assembly<Dim> assembly = ground<Dim>(depth);
    const int count = chance(random, 0.3) ? 2 : 1;
    for (int tower = 0; tower < count; ++tower)
    {
        double left = 4.0 * tower;
        double width = between(random, 0.2, 0.6);
        double bottom = 0;
        const int stones = std::uniform_int_distribution<int>(1, 14)(random);
        for (int stone = 0; stone < stones; ++stone)
        {
            const double top = bottom + between(random, 0.1, 0.4);
            assembly.blocks.push_back(box<Dim>(left, left + width, bottom, top, depth));
            bottom = top;
            if (chance(random, 0.4))
            {
                const double next = width * between(random, 0.75, 1.15);
                left += (width - next) * between(random, 0.2, 0.8);
                width = next;
            }
        }
    }
    return assembly;
}

/// A structure of the above under its weight, with friction of either flow rule and perhaps damping, a sine
/// of the ground along x, in part vertical, too, and in the plane perhaps restitution, bonds or the
/// trapezoidal rule.
template<int Dim>
DynamicCase<Dim> scene(std::mt19937& random, Assembly<Dim> (*structure)(std::mt19937&) = wall<Dim>)
{
    DynamicCase<Dim> scene;
    Assembly<Dim> assembly = structure(random);
    const std::vector<double> densities(assembly.blocks.size(), 2000);
    setStructure(scene, std::move(assembly), densities);
    setGravity(scene, -g * Vector<Dim>::Unit(Dim - 1));
    scene.contact.friction = CoulombFriction{
        between(random, 0.3, 0.8), chance(random, 0.5) ? FlowRule::nonAssociative : FlowRule::associative};
    if (Dim == 2 && chance(random, 0.25))
    {
        scene.contact.restitution = Restitution{between(random, 0.05, 0.5)};
    }
    if (Dim == 2 && chance(random, 0.25))
    {
        const double cohesion = between(random, 100, 2000);
        scene.contact.cohesion = JointStrength{cohesion};
        scene.contact.tension = JointStrength{cohesion * between(random, 0.2, 1)}; // below cohesion over mu
        scene.effects.push_back(std::make_shared<JointBonds<Dim>>(jointBonds(scene.contact, scene.assembly)));
    }
    if (chance(random, 0.3))
    {
        scene.effects.push_back(std::make_shared<MassDamping<Dim>>(Damping{between(random, 0.05, 1)}));
    }
    if (Dim == 2 && chance(random, 0.25))
    {
        scene.schemes.timeIntegration.theta = between(random, 0.5, 1);
    }
    GroundMotion ofGround;
    GroundMotion::Component horizontal;
    horizontal.acceleration =
        std::make_shared<SinePulse>(PulseShape{between(random, 0.1, 1) * g * (chance(random, 0.5) ? 1 : -1),
                                               between(random, 0.1, 0.4), 0},
                                    4);
    ofGround.components.push_back(horizontal);
    if (chance(random, 0.4))
    {
        GroundMotion::Component vertical;
        vertical.direction = Eigen::Vector3d::Unit(Dim - 1);
        vertical.acceleration = std::make_shared<SinePulse>(
            PulseShape{between(random, 0.1, 0.4) * g, between(random, 0.1, 0.4), 0}, 4);
        ofGround.components.push_back(vertical);
    }
    setGroundMotion<Dim>(scene.effects, std::move(ofGround));
    return scene;
}

} // namespace drystone::randomWalls
