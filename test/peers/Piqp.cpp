// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// PIQP (Schwan, Jiang, Kuhn & Jones 2023) through its headers. Debian has no package of it:
/// CMAKE_PREFIX_PATH says where they are installed.
#include "LinearProgram.h"

#if __has_include(<piqp/piqp.hpp>)
#include <piqp/piqp.hpp>

#include <limits>

namespace drystone
{
namespace
{

using Sparse = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
using Entries = std::vector<Eigen::Triplet<double>>;

Sparse sparseOf(Eigen::Index rows, Eigen::Index columns, const Entries& entries)
{
    Sparse matrix(rows, columns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    matrix.makeCompressed();
    return matrix;
}

/// minimise 1/2 x'P x + cost'x subject to A x = b, x >= lower. Of a step x = (y, s): 1/2 y'Mbar y + g'c with
/// Mbar y + B s = f, everything over the scale of the loads; else x = s and alpha.
struct QuadraticProgram
{
    Sparse quadratic;
    Sparse equality;
    Eigen::VectorXd cost;
    Eigen::VectorXd lower;
    Eigen::VectorXd right;
    Eigen::Index displacements = 0; ///< rows of y among x
};

QuadraticProgram quadraticProgram(const PlaneConeProgram& program, const LinearProgram& linear)
{
    QuadraticProgram form;
    const bool isStep = program.hasInertia();
    form.displacements = isStep ? linear.rows : 0;
    const Eigen::Index unknowns = form.displacements + static_cast<Eigen::Index>(linear.columns.size());
    Entries quadratic;
    Entries equality;
    for (int body = 0; isStep && body < program.bodies; ++body)
    {
        const Eigen::Matrix3d& inertia = program.inertia[static_cast<std::size_t>(body)];
        for (int row = 0; row < 3; ++row)
        {
            for (int column = 0; column < 3; ++column)
            {
                if (inertia(row, column) != 0)
                {
                    quadratic.emplace_back(3 * body + row, 3 * body + column, inertia(row, column));
                }
            }
        }
    }
    equality = quadratic;
    form.cost = Eigen::VectorXd::Zero(unknowns);
    form.lower = Eigen::VectorXd::Zero(unknowns);
    const double infinite = std::numeric_limits<double>::infinity();
    form.lower.head(form.displacements).setConstant(-infinite);
    for (std::size_t column = 0; column < linear.columns.size(); ++column)
    {
        const auto index = static_cast<int>(form.displacements + static_cast<Eigen::Index>(column));
        for (const LinearProgram::Entry& entry : linear.columns[column])
        {
            equality.emplace_back(entry.row, index, entry.value);
        }
        form.cost[index] = linear.costs[column] / (isStep ? linear.scale : 1);
    }
    if (linear.hasMultiplier)
    {
        form.lower[unknowns - 1] = -infinite;
    }
    form.right = Eigen::Map<const Eigen::VectorXd>(linear.right.data(), linear.rows);
    form.quadratic = sparseOf(unknowns, unknowns, quadratic);
    form.equality = sparseOf(linear.rows, unknowns, equality);
    return form;
}

std::optional<PeerAnswer> solve(const AnyConeProgram& any, double tolerance)
{
    const auto* program = std::get_if<PlaneConeProgram>(&any);
    if (!program || program->hasStrength() || program->hasCompliance()
        || (!program->hasInertia() && !asLinear(any)))
    {
        return {};
    }
    const LinearProgram linear = linearProgram(*program);
    const QuadraticProgram form = quadraticProgram(*program, linear);
    PeerAnswer answer;
    const double start = cpuSeconds();
    piqp::SparseSolver<double, int> solver;
    solver.settings().eps_abs = tolerance;
    solver.settings().eps_duality_gap_abs = tolerance;
    solver.setup(form.quadratic, form.cost, form.equality, form.right, piqp::nullopt, piqp::nullopt,
                 piqp::nullopt, form.lower, piqp::nullopt);
    solver.solve();
    answer.seconds = cpuSeconds() - start;
    const Eigen::VectorXd& x = solver.result().x;
    const Eigen::VectorXd multipliers = -solver.result().y; // of A x - b = 0
    answer.solution = solutionOf(*program, linear, {x.data() + form.displacements, x.data() + x.size()},
                                 {multipliers.data(), multipliers.data() + multipliers.size()});
    if (program->hasInertia())
    {
        answer.solution.displacement = linear.scale * x.head(form.displacements);
    }
    answer.solution.iterations = static_cast<int>(solver.result().info.iter);
    return answer;
}

} // namespace

std::optional<Peer> piqp()
{
    return Peer{"PIQP", ContactLaw::associative, solve};
}

} // namespace drystone
#else
namespace drystone
{

std::optional<Peer> piqp()
{
    return {};
}

} // namespace drystone
#endif
