// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Written once for the peers that solve it.
#include "ForceProgram.h"

#include <algorithm>

namespace drystone
{

void Triplets::add(Eigen::Index row, Eigen::Index column, double value)
{
    if (value != 0)
    {
        entries.push_back({static_cast<double>(row), static_cast<double>(column), value});
    }
}

template<int Rows, int Forces>
std::optional<ForceProgram> forceProgram(const ConeProgram<Rows, Forces>& program)
{
    if (program.hasInertia() || program.gap.size() > 0 || program.hasCompliance() || !program.hasMultiplier())
    {
        return {};
    }
    ForceProgram form;
    form.scale = std::max(program.load.template lpNorm<Eigen::Infinity>(),
                          program.liveLoad.template lpNorm<Eigen::Infinity>());
    form.unknowns = Forces * program.points() + 1;
    form.equations = static_cast<int>(program.load.size());
    form.cones = program.points();
    form.coneSize = Forces;
    form.cost.assign(static_cast<std::size_t>(form.unknowns), 0);
    form.cost.back() = -1;
    for (int point = 0; point < program.points(); ++point)
    {
        const auto& columns = program.contacts[static_cast<std::size_t>(point)];
        for (const auto& [body, part] :
             {std::pair(columns.first, &columns.onFirst), std::pair(columns.second, &columns.onSecond)})
        {
            for (int row = 0; body >= 0 && row < Rows; ++row)
            {
                for (int force = 0; force < Forces; ++force)
                {
                    form.equality.add(Rows * body + row, Forces * point + force, (*part)(row, force));
                }
            }
        }
    }
    for (Eigen::Index row = 0; row < form.equations; ++row)
    {
        form.equality.add(row, form.unknowns - 1, -program.liveLoad[row] / form.scale);
        form.load.push_back(program.load[row] / form.scale);
    }
    std::vector<double>& bounds = form.bounds;
    const auto rows = [&bounds] { return static_cast<Eigen::Index>(bounds.size()); };
    for (int point = 0; point < program.points() && program.hasStrength(); ++point)
    {
        const Strength& strength = program.strength[static_cast<std::size_t>(point)];
        form.limits.add(rows(), Forces * point, -1);
        bounds.push_back(strength.tension / form.scale);
        if (strength.isBounded())
        {
            form.limits.add(rows(), Forces * point, 1);
            bounds.push_back(strength.crushing / form.scale);
        }
    }
    form.rays = static_cast<int>(bounds.size());
    for (int point = 0; point < program.points(); ++point)
    {
        const auto index = static_cast<std::size_t>(point);
        for (int force = 0; force < Forces; ++force)
        {
            form.limits.add(rows(), Forces * point + force, force == 0 ? -program.friction[index] : -1);
            bounds.push_back(
                force == 0 && program.hasStrength() ? program.strength[index].cohesion / form.scale : 0);
        }
    }
    return form;
}

template<int Rows, int Forces>
ConeSolution solutionOf(const ConeProgram<Rows, Forces>& program, const ForceProgram& form,
                        const std::vector<double>& unknowns, const std::vector<double>& multipliers)
{
    ConeSolution solution;
    solution.contactForce =
        form.scale * Eigen::VectorXd::Map(unknowns.data(), static_cast<Eigen::Index>(unknowns.size()) - 1);
    solution.multiplier = unknowns.back();
    solution.displacement =
        Eigen::VectorXd::Map(multipliers.data(), static_cast<Eigen::Index>(multipliers.size()));
    solution.displacement /= program.liveLoad.dot(solution.displacement);
    return solution;
}

template std::optional<ForceProgram> forceProgram(const PlaneConeProgram& program);
template std::optional<ForceProgram> forceProgram(const SpaceConeProgram& program);
template ConeSolution solutionOf(const PlaneConeProgram& program, const ForceProgram& form,
                                 const std::vector<double>& unknowns, const std::vector<double>& multipliers);
template ConeSolution solutionOf(const SpaceConeProgram& program, const ForceProgram& form,
                                 const std::vector<double>& unknowns, const std::vector<double>& multipliers);

} // namespace drystone
