// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analysis in the contact forces, as solvers of second-order cones take it.
#pragma once

#include "conic/ConeProgram.h"

#include <array>
#include <optional>
#include <vector>

namespace drystone
{

/// Entries of a sparse matrix.
struct Triplets
{
    std::vector<std::array<double, 3>> entries; ///< row and column from 0, value

    void add(Eigen::Index row, Eigen::Index column, double value);
};

/// minimise cost' x subject to equality x = load, limits x + s = bounds, s in rays and then cones of one
/// size: x = (c, alpha), -alpha the cost, A c - alpha L = f, -T <= c_n <= N, (C + mu c_n, c_t) in
/// second-order cones. Loads and strengths are divided by the largest load.
struct ForceProgram
{
    int unknowns = 0;
    int equations = 0;
    int rays = 0;
    int cones = 0;
    int coneSize = 0;
    std::vector<double> cost;
    std::vector<double> load;
    std::vector<double> bounds;
    Triplets equality;
    Triplets limits;
    double scale = 1; ///< the largest load [N]
};

/// \return nothing for a program that is no limit analysis
template<int Rows, int Forces>
std::optional<ForceProgram> forceProgram(const ConeProgram<Rows, Forces>& program);

/// The solution of the limit analysis from x and the multipliers of the equations, whose sign and scale are
/// those that make the work of L 1.
template<int Rows, int Forces>
ConeSolution solutionOf(const ConeProgram<Rows, Forces>& program, const ForceProgram& form,
                        const std::vector<double>& unknowns, const std::vector<double>& multipliers);

} // namespace drystone
