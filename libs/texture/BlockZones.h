// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The zones of a blockTextureDict: groups of blocks that materials, joints and loads refer to by name.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Registry.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace drystone
{

/// Blocks by index.
struct ListedBlocks
{
    std::vector<int> blocks;
};
void declare(Options& options, ListedBlocks& listed);

/// Blocks whose mass centre lies in a box, its faces included.
template<int Dim>
struct BlocksInBox
{
    std::pair<Vector<Dim>, Vector<Dim>> box{Vector<Dim>::Zero(), Vector<Dim>::Zero()}; ///< corners [m]
};
template<int Dim>
void declare(Options& options, BlocksInBox<Dim>& inBox);

/// Adds a zone of the given name to a structure. \throws FatalIOError for a block that there is not, a zone
/// without blocks, or a name that is taken
template<int Dim>
using ZoneMaker = std::function<void(Assembly<Dim>& assembly, const std::string& name)>;

/// The zones that `zones { name { type ...; } }` chooses from.
template<int Dim>
const Registry<ZoneMaker<Dim>>& zoneTypes();

} // namespace drystone
