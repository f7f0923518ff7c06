// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// CVXOPT, run in Python on a program file.
#include "Peers.h"
#include "Subprocess.h"

#include <fmt/format.h>

#include <fstream>

namespace drystone
{
namespace
{

/// A Python that has CVXOPT: Debian's own, or that of PATH.
std::string pythonWithCvxopt()
{
    for (const char* python : {"/usr/bin/python3", "python3"})
    {
        if (runProgram(std::string(python) + " -c 'import cvxopt'").status == 0)
        {
            return python;
        }
    }
    return {};
}

} // namespace

std::optional<Peer> cvxopt()
{
    const std::string python = pythonWithCvxopt();
    if (python.empty())
    {
        return {};
    }
    const auto solve = [python](const AnyConeProgram& any, double tolerance) -> std::optional<PeerAnswer>
    {
        const Scratch scratch;
        std::visit([&](const auto& program) { writeProgram(scratch.folder / "program", program); }, any);
        runProgram(fmt::format("timeout 300 {} '{}' '{}/program' '{}/solution' {}", python,
                               DRYSTONE_PEERS "/solveWithCvxopt.py", scratch.folder.string(),
                               scratch.folder.string(), tolerance));
        PeerAnswer answer;
        ConeSolution& solution = answer.solution;
        std::visit(
            [&](const auto& program)
            {
                solution.contactForce.setZero(program.points()
                                              * (program.load.size() == 3 * program.bodies ? 2 : 3));
                solution.displacement.setZero(program.load.size());
            },
            any);
        std::ifstream stream(scratch.folder / "solution");
        stream >> answer.seconds >> solution.iterations >> solution.multiplier;
        for (Eigen::VectorXd* vector : {&solution.contactForce, &solution.displacement})
        {
            for (double& entry : *vector)
            {
                stream >> entry;
            }
        }
        if (!stream)
        {
            solution.displacement.setConstant(std::numeric_limits<double>::quiet_NaN());
        }
        return answer;
    };
    return Peer{"CVXOPT", ContactLaw::associative, solve};
}

} // namespace drystone
