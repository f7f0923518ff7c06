// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analysis in the form that the linear programming solvers share.
#include "LinearProgram.h"

namespace drystone
{

LinearProgram linearProgram(const PlaneConeProgram& program)
{
    LinearProgram linear;
    linear.rows = 3 * program.bodies;
    linear.hasMultiplier = program.hasMultiplier();
    linear.scale = std::max(1e-300, program.load.lpNorm<Eigen::Infinity>());
    for (int point = 0; point < program.points(); ++point)
    {
        const auto& columns = program.contacts[static_cast<std::size_t>(point)];
        const double mu = program.friction[static_cast<std::size_t>(point)];
        for (const double shear : {mu, -mu})
        {
            const Eigen::Vector2d edge(1, shear);
            std::vector<LinearProgram::Entry> column;
            for (const auto& [body, part] :
                 {std::pair(columns.first, columns.onFirst), std::pair(columns.second, columns.onSecond)})
            {
                const Eigen::Vector3d force = part * edge;
                for (int row = 0; body >= 0 && row < 3; ++row)
                {
                    if (force[row] != 0)
                    {
                        column.push_back({3 * body + row, force[row]});
                    }
                }
            }
            linear.columns.push_back(std::move(column));
            linear.costs.push_back(program.gap.size() > 0 ? edge.dot(program.gap.segment<2>(2 * point)) : 0);
        }
    }
    std::vector<LinearProgram::Entry> alpha;
    for (int row = 0; row < linear.rows; ++row)
    {
        if (program.hasMultiplier() && program.liveLoad[row] != 0)
        {
            alpha.push_back({row, -program.liveLoad[row] / linear.scale});
        }
        linear.right.push_back(program.load[row] / linear.scale);
    }
    if (program.hasMultiplier())
    {
        linear.columns.push_back(std::move(alpha));
        linear.costs.push_back(-1);
    }
    return linear;
}

ConeSolution solutionOf(const PlaneConeProgram& program, const LinearProgram& linear,
                        const std::vector<double>& columns, const std::vector<double>& y)
{
    ConeSolution solution;
    solution.contactForce.resize(2 * program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        const auto first = 2 * static_cast<std::size_t>(point);
        const double mu = program.friction[static_cast<std::size_t>(point)];
        solution.contactForce[2 * point] = linear.scale * (columns[first] + columns[first + 1]);
        solution.contactForce[2 * point + 1] = linear.scale * mu * (columns[first] - columns[first + 1]);
    }
    solution.displacement = Eigen::Map<const Eigen::VectorXd>(y.data(), linear.rows);
    if (linear.hasMultiplier)
    {
        solution.multiplier = columns.back();
        solution.displacement /= linear.scale; // rows are over `scale`: L' y = 1 with L, not with L / scale
    }
    return solution;
}

const PlaneConeProgram* asLinear(const AnyConeProgram& program)
{
    const auto* plane = std::get_if<PlaneConeProgram>(&program);
    return plane && plane->hasMultiplier() != (plane->gap.size() > 0) && !plane->hasInertia()
                   && !plane->hasStrength()
               ? plane
               : nullptr;
}

} // namespace drystone
