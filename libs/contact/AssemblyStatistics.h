// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How many blocks, joints and contact points an assembly has.
#pragma once

#include "assembly/Assembly.h"
#include "contact/ContactPoint.h"

#include <vector>

namespace drystone
{

/// Counts of an assembly.
template<int Dim>
struct AssemblyStatistics
{
    int blocks = 0;
    int freeBlocks = 0;
    int supports = 0;
    int vertices = 0;
    int concaveBlocks = 0;
    int joints = 0;
    int contactPoints = 0;
    Vector<Dim> lower = Vector<Dim>::Zero(); ///< corner of the box round the free blocks [m]
    Vector<Dim> upper = Vector<Dim>::Zero(); ///< [m]
};

/// Counts an assembly, joints and contact points included.
template<int Dim>
AssemblyStatistics<Dim> countAssembly(const Assembly<Dim>& assembly);

/// The same where its contact points have been found. \param points as findContactPoints gives them
template<int Dim>
AssemblyStatistics<Dim> countAssembly(const Assembly<Dim>& assembly,
                                      const std::vector<ContactPoint<Dim>>& points);

} // namespace drystone
