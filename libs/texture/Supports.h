// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The supports of a blockTextureDict: fixed ground blocks under the structure, or some of its own blocks
/// fixed.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Registry.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace drystone
{

/// In the plane: fixed ground whose top is y = 0, in blocks side by side from the left end of the structure
/// to its right end.
struct Ground
{
    std::optional<double> segment = {}; ///< length of one ground block [m]; absent: a single block
    std::optional<double> depth = {};   ///< of the ground blocks [m]; absent: a tenth of the larger of the
                                        ///< structure's width and height
    std::optional<double> margin = {};  ///< by how far the ground extends past each end [m]; absent: three
                                        ///< times the larger of the structure's width and height, so that
                                        ///< blocks which slide or fall land on it
};

/// In space: one fixed slab whose top is z = 0.
struct GroundSlab
{
    std::optional<double> depth = {};  ///< [m]; absent: a tenth of the structure's largest extent
    std::optional<double> margin = {}; ///< by how far it extends past the structure on each side [m]; absent:
                                       ///< three times the structure's largest extent
};

void declare(Options& options, GroundSlab& ground);

/// In a dictionary `segment` and `margin` are in units of the texture (1 m where it has none), `depth` in
/// metres.
void declare(Options& options, Ground& ground);

/// Adds the ground's blocks after those of the structure, and the support itself. Supports of the texture
/// itself are replaced by it if they lie under y = 0, as the abutments of a semicircular arch do.
void addGround(Assembly<2>& assembly, const std::string& name, const Ground& ground);
void addGround(Assembly<3>& assembly, const std::string& name, const GroundSlab& ground);

/// Fixes blocks of the structure by index.
struct FixedBlocks
{
    std::vector<int> blocks;
};

void declare(Options& options, FixedBlocks& fixed);

/// Fixes blocks of a structure that is imported.
struct FixedZones
{
    std::vector<NamePattern> layers; ///< names of zones; empty: the zone of the support's own name, or else
                                     ///< what the file marks as supports
};

void declare(Options& options, FixedZones& fixed);

/// In space: fixed boxes in addition to those of the texture, pads and abutments that may settle each on its
/// own.
struct FixedBoxes
{
    std::vector<std::pair<Vector<3>, Vector<3>>> blocks; ///< lower and upper corner of each [m]
};

void declare(Options& options, FixedBoxes& fixed);

/// Adds a support of the given name to a structure. \param unit the length that values in units refer to [m]
/// \throws FatalIOError when the support does not suit the structure
template<int Dim>
using SupportMaker = std::function<void(Assembly<Dim>& assembly, const std::string& name, double unit)>;

/// The supports that `supports { name { type ...; } }` chooses from.
template<int Dim>
const Registry<SupportMaker<Dim>>& supportTypes();
template<>
const Registry<SupportMaker<2>>& supportTypes();
template<>
const Registry<SupportMaker<3>>& supportTypes();

} // namespace drystone
