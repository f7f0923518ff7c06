// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What random assemblies of the plane and of space are drawn with.
#pragma once

#include "assembly/BlockShape.h"
#include "assembly/Loads.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace drystone
{

/// The same numbers on all machines: it draws from std::mt19937_64 alone.
class Random
{
public:
    explicit Random(unsigned seed) : engine(seed) {}

    /// Evenly from low to high; std::uniform_real_distribution differs among libraries.
    double between(double low, double high)
    {
        return low + (high - low) * std::ldexp(static_cast<double>(engine() >> 11), -53);
    }
    int upTo(int most) { return std::min(most, static_cast<int>(between(0, most + 1.0))); }
    bool happens(double chance) { return between(0, 1) < chance; }
    /// Evenly over the sphere (Archimedes).
    Vector<3> direction()
    {
        const double z = between(-1, 1);
        const double angle = between(0, 2 * std::numbers::pi);
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }

private:
    std::mt19937_64 engine;
};

/// With the chance given the weight of all blocks turned, else a force at a corner of one of them.
/// \param dead load of the free blocks \param free see freeIndices
template<int Dim>
Eigen::VectorXd randomLiveLoad(const Assembly<Dim>& assembly, const std::vector<double>& masses,
                               const std::vector<int>& free, const Eigen::VectorXd& dead,
                               const Vector<Dim>& gravity, const Vector<Dim>& direction,
                               double chanceOfInertia, Random& random)
{
    if (random.happens(chanceOfInertia))
    {
        return inertialLoad(assembly, masses, gravity, direction);
    }
    std::vector<int> candidates;
    for (std::size_t block = 0; block < free.size(); ++block)
    {
        if (free[block] >= 0)
        {
            candidates.push_back(static_cast<int>(block));
        }
    }
    const int block =
        candidates[static_cast<std::size_t>(random.upTo(static_cast<int>(candidates.size()) - 1))];
    return pointLoad(assembly, block, cornersOf(assembly.blocks[static_cast<std::size_t>(block)])[0],
                     dead.template lpNorm<Eigen::Infinity>() * direction)
        .rows;
}

} // namespace drystone
