// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// ECOS (Domahidi, Chu & Boyd 2013), run in R on a file of numbers: limit analysis in the contact forces.
#include "Peers.h"
#include "Subprocess.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

namespace drystone
{
namespace
{

struct Triplets
{
    std::vector<std::array<double, 3>> entries; ///< row and column from 1, value

    void add(Eigen::Index row, Eigen::Index column, double value)
    {
        if (value != 0)
        {
            entries.push_back({static_cast<double>(row + 1), static_cast<double>(column + 1), value});
        }
    }
};

/// minimise -alpha subject to A c - alpha L = f, -T <= c_n <= N, (C + mu c_n, c_t) in second-order cones;
/// loads over the largest.
template<int Rows, int Forces>
std::string problemText(const ConeProgram<Rows, Forces>& program, double scale)
{
    const Eigen::Index unknowns = Forces * program.points() + 1;
    const Eigen::Index equations = program.load.size();
    Triplets equality;
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
                    equality.add(Rows * body + row, Forces * point + force, (*part)(row, force));
                }
            }
        }
    }
    for (Eigen::Index row = 0; row < equations; ++row)
    {
        equality.add(row, unknowns - 1, -program.liveLoad[row] / scale);
    }
    Triplets limits;
    std::vector<double> bounds;
    for (int point = 0; point < program.points() && program.hasStrength(); ++point)
    {
        const Strength& strength = program.strength[static_cast<std::size_t>(point)];
        limits.add(static_cast<Eigen::Index>(bounds.size()), Forces * point, -1);
        bounds.push_back(strength.tension / scale);
        if (strength.isBounded())
        {
            limits.add(static_cast<Eigen::Index>(bounds.size()), Forces * point, 1);
            bounds.push_back(strength.crushing / scale);
        }
    }
    const std::size_t rays = bounds.size();
    for (int point = 0; point < program.points(); ++point)
    {
        const auto index = static_cast<std::size_t>(point);
        for (int force = 0; force < Forces; ++force)
        {
            limits.add(static_cast<Eigen::Index>(bounds.size()), Forces * point + force,
                       force == 0 ? -program.friction[index] : -1);
            bounds.push_back(force == 0 && program.hasStrength() ? program.strength[index].cohesion / scale
                                                                 : 0);
        }
    }
    std::string text = fmt::format("{} {} {} {} {}\n", unknowns, equations, rays, program.points(), Forces);
    for (Eigen::Index i = 0; i < unknowns; ++i)
    {
        text += i + 1 < unknowns ? "0 " : "-1\n";
    }
    for (const double load : program.load)
    {
        text += fmt::format("{:.17g}\n", load / scale);
    }
    text += fmt::format("{:.17g}\n", fmt::join(bounds, "\n"));
    for (const Triplets& matrix : {equality, limits})
    {
        text += fmt::format("{}\n", matrix.entries.size());
        for (const auto& [row, column, value] : matrix.entries)
        {
            text += fmt::format("{:.0f} {:.0f} {:.17g}\n", row, column, value);
        }
    }
    return text;
}

template<int Rows, int Forces>
std::optional<PeerAnswer> solve(const ConeProgram<Rows, Forces>& program, double tolerance)
{
    if (program.hasInertia() || program.gap.size() > 0 || program.hasCompliance() || !program.hasMultiplier())
    {
        return {};
    }
    const double scale = std::max(program.load.template lpNorm<Eigen::Infinity>(),
                                  program.liveLoad.template lpNorm<Eigen::Infinity>());
    const Scratch scratch;
    std::ofstream(scratch.folder / "problem") << problemText(program, scale);
    runProgram(fmt::format("timeout 300 Rscript '{}' '{}/problem' '{}/solution' {}",
                           DRYSTONE_PEERS "/solveWithEcos.R", scratch.folder.string(),
                           scratch.folder.string(), tolerance));
    PeerAnswer answer;
    ConeSolution& solution = answer.solution;
    solution.contactForce.setZero(Forces * program.points());
    solution.displacement.setZero(Rows * program.bodies);
    double iterations = 0;
    std::ifstream stream(scratch.folder / "solution");
    stream >> answer.seconds >> iterations;
    solution.iterations = static_cast<int>(iterations);
    for (double& force : solution.contactForce)
    {
        stream >> force;
    }
    stream >> solution.multiplier;
    for (double& entry : solution.displacement)
    {
        stream >> entry;
    }
    if (!stream)
    {
        solution.displacement.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    solution.contactForce *= scale;
    // Up to sign and scale the multipliers of the equations: L does unit work.
    solution.displacement /= program.liveLoad.dot(solution.displacement);
    return answer;
}

} // namespace

std::optional<Peer> ecos()
{
    if (runProgram("Rscript -e 'library(ECOSolveR)'").status != 0)
    {
        return {};
    }
    return Peer{"ECOS", ContactLaw::associative, [](const AnyConeProgram& any, double tolerance) {
                    return std::visit([&](const auto& program) { return solve(program, tolerance); }, any);
                }};
}

} // namespace drystone
