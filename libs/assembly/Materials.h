// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the blocks are made of, and gravity: constant/materialProperties and constant/g.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace drystone
{

/// constant/materialProperties. Exactly one of the two is given.
struct MaterialProperties
{
    std::optional<double> density;    ///< [kg/m3]
    std::optional<double> unitWeight; ///< [N/m3], under the gravity of constant/g
};

void declare(Options& options, MaterialProperties& material);

/// constant/g.
struct Gravity
{
    Vector<2> value{0, -9.81}; ///< [m/s2]
};

void declare(Options& options, Gravity& gravity);

/// Gravity of a case [m/s2]. \throws FatalError or FatalIOError when constant/g is missing or faulty
Vector<2> readGravity(const std::filesystem::path& caseDirectory);

/// Density of each block of a case [kg/m3], fixed ones included. Times BlockMass::volume it is the mass,
/// times BlockMass::inertia the moment of inertia. \throws FatalError or FatalIOError when
/// constant/materialProperties is missing or faulty, or gives a unit weight where there is no gravity
std::vector<double> readDensities(const std::filesystem::path& caseDirectory, const Assembly<2>& assembly,
                                  const Vector<2>& gravity);

/// Mass of each block [kg].
std::vector<double> massesOf(const std::vector<BlockMass<2>>& blocks, const std::vector<double>& densities);

} // namespace drystone
