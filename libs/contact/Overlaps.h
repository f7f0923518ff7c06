// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Blocks that share space: what computations refuse and checks report. In this library because joints are
/// closed first, and what lies within their tolerance is no overlap.
#pragma once

#include "assembly/Assembly.h"
#include "contact/CheckLimits.h"

#include <vector>

namespace drystone
{

/// Two blocks that share space.
template<int Dim>
struct Overlap
{
    int block = -1;
    int neighbour = -1;  ///< block < neighbour
    double common = 0;   ///< area of the common part [m2], in space its volume [m3]
    double fraction = 0; ///< of the smaller block's
};

/// Pairs of blocks that share more than the joint tolerance explains, the same block twice among them.
template<int Dim>
std::vector<Overlap<Dim>> findOverlaps(const Assembly<Dim>& assembly, const CheckLimits& limits = {});

/// These pairs, and how much the others share at most.
template<int Dim>
struct OverlapSearch
{
    std::vector<Overlap<Dim>> faults; ///< see findOverlaps
    double largest = 0; ///< of all pairs but a block that is there twice, relative to the smaller block
};
template<int Dim>
OverlapSearch<Dim> searchOverlaps(const Assembly<Dim>& assembly, const CheckLimits& limits);

} // namespace drystone
