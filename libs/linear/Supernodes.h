// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which columns of a factor are eliminated together: those with nearly the same rows.
#pragma once

#include "linear/BlockPattern.h"

#include <vector>

namespace drystone
{

/// Bodies whose columns are eliminated together.
struct Supernode
{
    int firstBody;
    int lastBody;     ///< one past
    int bodies;       ///< in the first column of L, its own included
    double zeros = 0; ///< blocks of L that are there for being together only
};

/// The supernodes of a factor, in the order of their bodies. \param factor the pattern of L \param
/// rowsOfBlock of each of its blocks
std::vector<Supernode> supernodes(const BlockPattern& factor, int rowsOfBlock);

} // namespace drystone
