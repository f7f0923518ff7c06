// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which blocks are ground: in pictures and frames it is there to stand on, and leaves the view as it is.
#pragma once

#include "assembly/Assembly.h"

namespace drystone
{

/// Whether a block is fixed by a support of type `ground`. Its extent is arbitrary, as that of other supports
/// is not.
template<int Dim>
bool isGround(const Assembly<Dim>& assembly, const Block<Dim>& block)
{
    return block.support >= 0 && assembly.supports[static_cast<std::size_t>(block.support)].type == "ground";
}

} // namespace drystone
