// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Plane limit analysis and settlement as linear programs in the standard form that simplex codes take.
#pragma once

#include "Peers.h"

namespace drystone
{

/// maximise alpha over s >= 0 and alpha subject to B s - alpha L = f, where the columns of B are the two
/// edges of each friction cone, A (1, mu) and A (1, -mu); of a settlement, minimise g's subject to B s = f.
/// Loads are over the largest entry of f, so that absolute tolerances mean something; the multipliers of the
/// rows are y, as they are.
struct LinearProgram
{
    struct Entry
    {
        int row;
        double value;
    };
    int rows = 0;
    std::vector<std::vector<Entry>> columns; ///< two a contact point, then that of alpha, if there is one
    std::vector<double> costs;               ///< of the columns: what is minimised
    bool hasMultiplier = true;               ///< the last column is alpha, of any sign
    std::vector<double> right;               ///< f / scale
    double scale = 1;
};

LinearProgram linearProgram(const PlaneConeProgram& program);

/// \param columns values of the columns of the linear program \param y multipliers of its rows
ConeSolution solutionOf(const PlaneConeProgram& program, const LinearProgram& linear,
                        const std::vector<double>& columns, const std::vector<double>& y);

/// Whether a program is one that a simplex code can solve: plane limit analysis or settlement with cones.
const PlaneConeProgram* asLinear(const AnyConeProgram& program);

} // namespace drystone
