// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Large structures of which a load reaches a part only: a viaduct, walls, a house of space; for tests of
/// statics and for benchmarks.
#pragma once

#include "../MadeStructure.h"
#include "contact/Equilibrium.h"
#include "statics/LimitAnalysis.h"

#include "../SquareWall.h"

#include <algorithm>
#include <numbers>

namespace drystone
{

constexpr int voussoirsOfSpan = 25;

/// Semicircular arches of 4 m and 25 voussoirs each, on piers of twelve stones; the springings at both ends
/// are fixed. The voussoirs of the first arch come first, from its left, then those of the next ..., then the
/// stones of the piers.
inline Assembly<2> viaduct(int spans)
{
    constexpr double radius = 4;
    constexpr double ring = 0.6;
    constexpr double between = 0.2; // arches
    constexpr int stones = 12;
    constexpr double course = 0.6;
    constexpr double springing = stones * course;
    constexpr double outside = radius + ring / 2;
    constexpr double pitch = 2 * outside + between;
    Assembly<2> assembly;
    assembly.supports.push_back({"ground", "ground"});
    const auto add = [&assembly](std::vector<Vector<2>> outline, int support)
    {
        Block<2> block;
        block.outline = std::move(outline);
        block.thickness = 4;
        block.support = support;
        assembly.blocks.push_back(std::move(block));
    };
    const auto addBox = [&add](double left, double right, double bottom, double top, int support) {
        add({{left, bottom}, {right, bottom}, {right, top}, {left, top}}, support);
    };
    for (int span = 0; span < spans; ++span)
    {
        for (int voussoir = 0; voussoir < voussoirsOfSpan; ++voussoir)
        {
            const auto corner = [&](double r, int joint)
            {
                const double angle = std::numbers::pi * (1 - static_cast<double>(joint) / voussoirsOfSpan);
                return Vector<2>(pitch * span + r * std::cos(angle), springing + r * std::sin(angle));
            };
            constexpr double inside = radius - ring / 2;
            add({corner(inside, voussoir), corner(inside, voussoir + 1), corner(outside, voussoir + 1),
                 corner(outside, voussoir)},
                -1);
        }
    }
    for (int pier = 1; pier < spans; ++pier)
    {
        const double middle = pitch * (pier - 0.5);
        for (int stone = 0; stone < stones; ++stone)
        {
            addBox(middle - between / 2 - ring, middle + between / 2 + ring, course * stone,
                   course * (stone + 1), -1);
        }
    }
    const double end = pitch * (spans - 1) + outside;
    addBox(-outside - 1, -outside + ring, springing - 1, springing, 0);
    addBox(end - ring, end + 1, springing - 1, springing, 0);
    addBox(-outside - 1, end + 1, -1, 0, 0);
    return assembly;
}

/// Two walls of space, toothed into each other.
inline Assembly<3> cornerOfHouse()
{
    return madeStructure<3>(Dictionary::readString(
        "dimensions 3;\n"
        "texture { type walls; unit (0.5 0.25 0.25); bond running; courses 10; walls {\n"
        "front { from (0 0); direction (1 0); length 8; thickness left; }\n"
        "side { from (0 0); direction (0 1); length 6; thickness right; } } }\n"
        "supports { ground { type ground; } }\n"));
}

template<int Dim>
int freeBlocksOf(const Assembly<Dim>& assembly)
{
    return static_cast<int>(std::count_if(assembly.blocks.begin(), assembly.blocks.end(),
                                          [](const Block<Dim>& block) { return block.support < 0; }));
}

/// The program under its own weight, 2000 kg/m3, and 1 kN on one free block. \param block index among those
/// that are free \param direction of the force at its mass centre
template<int Dim>
StaticProgram<Dim> underForce(const Assembly<Dim>& assembly, double mu, int block,
                              const std::type_identity_t<Vector<Dim>>& direction)
{
    const std::vector<BlockMass<Dim>> masses = blockMasses(assembly);
    const std::vector<ContactPoint<Dim>> points = findContactPoints(assembly);
    std::vector<double> weights;
    for (const BlockMass<Dim>& mass : masses)
    {
        weights.push_back(2000 * mass.volume);
    }
    LoadVectors loads;
    loads.dead = gravityLoad<Dim>(assembly, weights, -9.81 * Vector<Dim>::Unit(Dim - 1));
    loads.live = Eigen::VectorXd::Zero(loads.dead.size());
    loads.live.segment<Dim>(freedomCount<Dim> * block) = 1000 * direction;
    return limitAnalysisProgram<Dim>(freeBlocksOf(assembly), equilibriumColumns(assembly, masses, points),
                                     std::vector<double>(points.size(), mu), loads);
}

} // namespace drystone
