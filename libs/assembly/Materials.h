// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the blocks are made of, and gravity: constant/materialProperties and constant/g.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"

#include <filesystem>
#include <optional>
#include <type_traits>
#include <vector>

namespace drystone
{

/// What blocks weigh. Exactly one of the two is given.
struct Material
{
    std::optional<double> density;    ///< [kg/m3]
    std::optional<double> unitWeight; ///< [N/m3], under the gravity of constant/g
};

void declare(Options& options, Material& material);

/// constant/materialProperties: of all blocks, and of those in zones of the assembly.
struct MaterialProperties
{
    Material ofAll;
    std::vector<std::pair<NamePattern, Material>> zones; ///< a later one counts where blocks are in several
};

void declare(Options& options, MaterialProperties& material);

/// constant/g. In the plane y is up, in space z.
template<int Dim>
struct Gravity
{
    Vector<Dim> value = -9.81 * Vector<Dim>::Unit(Dim - 1); ///< [m/s2]
};

template<int Dim>
void declare(Options& options, Gravity<Dim>& gravity);

/// Gravity of a case [m/s2]. \throws FatalError or FatalIOError when constant/g is missing or faulty
template<int Dim>
Vector<Dim> readGravity(const std::filesystem::path& caseDirectory);

/// Density of each block of a case [kg/m3], fixed ones included. Times BlockMass::volume it is the mass,
/// times BlockMass::inertia the moment of inertia. \throws FatalError or FatalIOError when
/// constant/materialProperties is missing or faulty, or gives a unit weight where there is no gravity
template<int Dim>
std::vector<double> readDensities(const std::filesystem::path& caseDirectory, const Assembly<Dim>& assembly,
                                  const std::type_identity_t<Vector<Dim>>& gravity);

/// Mass of each block [kg].
template<int Dim>
std::vector<double> massesOf(const std::vector<BlockMass<Dim>>& blocks, const std::vector<double>& densities)
{
    std::vector<double> masses;
    masses.reserve(blocks.size());
    for (std::size_t i = 0; i < blocks.size(); ++i)
    {
        masses.push_back(densities[i] * blocks[i].volume);
    }
    return masses;
}

} // namespace drystone
