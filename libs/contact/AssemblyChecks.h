// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Whether an assembly is fit to be computed with: what `checkBlocks` prints.
#pragma once

#include "contact/AssemblyReport.h"
#include "contact/Overlaps.h"

namespace drystone
{

enum class CheckExtent
{
    standard,
    all ///< also short joints, and corners and edges that bear on another block without a joint
};

/// Runs the checks, in the order in which they are printed. Outlines must be simple and counter-clockwise,
/// polyhedra solids, as readAssembly makes sure.
template<int Dim>
AssemblyReport<Dim> checkAssembly(const Assembly<Dim>& assembly, CheckExtent extent = CheckExtent::standard,
                                  const CheckLimits& limits = {});

} // namespace drystone
