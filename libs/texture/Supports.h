// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What holds a structure: fixed ground blocks under it, or some of its own blocks fixed.
#pragma once

#include "assembly/Assembly.h"
#include "core/Registry.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// Fixed ground whose top is y = 0, in blocks side by side from the left end of the structure to its right
/// end.
struct Ground
{
    std::optional<double> segment = {}; ///< length of one ground block [m]; absent: a single block
    std::optional<double> depth = {};   ///< of the ground blocks [m]; absent: a tenth of the larger of the
                                        ///< structure's width and height
    std::optional<double> margin = {};  ///< by how far the ground goes on past each end [m]; absent: three
                                       ///< times the larger of the structure's width and height, so that what
                                       ///< slides or falls has a ground to land on
};

/// In a dictionary `segment` and `margin` are in units of the texture (1 m where it has none), `depth` in
/// metres.
void declare(Options& options, Ground& ground);

/// Adds the ground's blocks behind those of the structure, and the support itself. Supports that the texture
/// brought along give way to it if they lie under y = 0, as the abutments of a semicircular arch do.
void addGround(Assembly<2>& assembly, const std::string& name, const Ground& ground);

/// Fixes blocks of the structure by index.
struct FixedBlocks
{
    std::vector<int> blocks;
};

void declare(Options& options, FixedBlocks& fixed);

/// Adds a support of the given name to a structure. \param unit what lengths in units refer to [m]
/// \throws FatalIOError when the support does not suit the structure
using SupportMaker = std::function<void(Assembly<2>& assembly, const std::string& name, double unit)>;

/// The supports that `supports { name { type ...; } }` chooses from.
const Registry<SupportMaker>& supportTypes();

} // namespace drystone
