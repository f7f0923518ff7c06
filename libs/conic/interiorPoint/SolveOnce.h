// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One program solved once, from the starts that suit it, to the scaled residuals. Internal to the interior
/// point.
#pragma once

#include "conic/InteriorPoint.h"
#include "conic/form/Form.h"
#include "conic/interiorPoint/Divergence.h"

namespace drystone
{

/// What iterations compute in.
enum class Numbers
{
    standard, ///< doubles
    extended  ///< DoubleDouble
};

/// What a program is solved for, about which multiplier, where that is large, and in which numbers.
struct Aim
{
    Sought sought;
    double multiplier = 0;
    Numbers numbers = Numbers::standard;
};

/// Whether iterations may be done in extended numbers: the settings allow it, and the Schur system of the
/// program and the number of its points are small enough for them to take some seconds at most. Its condition
/// grows with the fourth power of the bodies of a chain, such as the voussoirs of an arch, and without limit
/// towards the optimum; with 106 bits neither counts.
template<int Rows, int Forces>
bool mayBeExtended(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                   const SymbolicAnalysis& symbolic);

/// \param near to begin with, or null; in extended numbers it is not used
/// \return `optimal` means that the scaled residuals met the tolerance, `unbounded` that there may be no
/// largest multiplier
template<int Rows, int Forces>
ConeSolution solveOnce(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                       const Aim& aim, SymbolicAnalysis& symbolic, const ConeSolution* near = nullptr);

} // namespace drystone
