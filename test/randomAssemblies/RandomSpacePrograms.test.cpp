// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Random cone programs of space, with round friction cones, strengths, gaps, compliance and inertia: what is
/// claimed must be proved by the certificate, and an independent solver must find the same.
#include "Peers.h"

#include "conic/Certificate.h"
#include "conic/SolverChoice.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <random>

namespace drystone
{
namespace
{

using Random = std::mt19937;

double uniform(Random& random, double from, double to)
{
    return std::uniform_real_distribution<double>(from, to)(random);
}

Eigen::Vector3d direction(Random& random)
{
    std::normal_distribution<double> normal;
    return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
}

/// A x of a point: the forces (normal, two tangents) on a body, with their moments about its centre,
/// reversed, as A c balances the loads.
Eigen::Matrix<double, 6, 3> columnsAt(const Eigen::Vector3d& arm, const Eigen::Matrix3d& axes)
{
    Eigen::Matrix<double, 6, 3> columns;
    for (int column = 0; column < 3; ++column)
    {
        columns.col(column) << -axes.col(column), -arm.cross(axes.col(column));
    }
    return columns;
}

/// Between 1 and 12 boxes about 1 m in size, heaped: each lies on the ground or on earlier ones with up to
/// four points a joint about normals that are mostly upright. Some of them are held, some float.
SpaceConeProgram randomProgram(Random& random)
{
    SpaceConeProgram program;
    program.bodies = std::uniform_int_distribution<int>(1, 12)(random);
    std::vector<Eigen::Vector3d> centre;
    std::vector<double> weight;
    for (int body = 0; body < program.bodies; ++body)
    {
        centre.emplace_back(uniform(random, -2, 2), uniform(random, -2, 2), 0.5 + 0.6 * body);
        weight.push_back(std::exp(uniform(random, -2, 2)));
    }
    const bool isEven = uniform(random, 0, 1) < 0.5; // one friction throughout
    const double common = std::exp(uniform(random, std::log(0.1), std::log(2.0)));
    for (int body = 0; body < program.bodies; ++body)
    {
        const int joints = std::uniform_int_distribution<int>(1, 3)(random);
        for (int joint = 0; joint < joints; ++joint)
        {
            const int under = std::uniform_int_distribution<int>(-1, body - 1)(random);
            const Eigen::Vector3d normal =
                (Eigen::Vector3d::UnitZ() + uniform(random, 0, 0.8) * direction(random)).normalized();
            Eigen::Matrix3d axes;
            axes.col(0) = normal;
            axes.col(1) = normal.unitOrthogonal();
            axes.col(2) = normal.cross(axes.col(1));
            const Eigen::Vector3d middle =
                centre[body] + Eigen::Vector3d(uniform(random, -0.3, 0.3), uniform(random, -0.3, 0.3), -0.5);
            const double mu = uniform(random, 0, 1) < 0.05 ? 0
                              : isEven                     ? common
                                                           : std::exp(uniform(random, -2.3, 0.7));
            const int points = std::uniform_int_distribution<int>(1, 4)(random);
            for (int point = 0; point < points; ++point)
            {
                const Eigen::Vector3d at = middle + axes.col(1) * uniform(random, -0.5, 0.5)
                                           + axes.col(2) * uniform(random, -0.5, 0.5);
                ConeColumns<6, 3> columns;
                columns.first = body;
                columns.second = under;
                columns.onFirst = columnsAt(at - centre[body], axes);
                if (under >= 0)
                {
                    columns.onSecond = -columnsAt(at - centre[under], axes);
                }
                program.contacts.push_back(columns);
                program.friction.push_back(mu);
            }
        }
    }
    program.load = Eigen::VectorXd::Zero(6 * program.bodies);
    for (int body = 0; body < program.bodies; ++body)
    {
        program.load[6 * body + 2] = -weight[body];
    }
    const int kind = std::uniform_int_distribution<int>(0, 3)(random);
    if (kind < 2) // limit analysis, with or without strengths
    {
        program.liveLoad = Eigen::VectorXd::Zero(6 * program.bodies);
        const Eigen::Vector3d push =
            uniform(random, 0, 1) < 0.2 ? Eigen::Vector3d(-Eigen::Vector3d::UnitZ()) : direction(random);
        for (int body = 0; body < program.bodies; ++body)
        {
            program.liveLoad.segment<3>(6 * body) = weight[body] * push;
        }
    }
    else // a step in time, with gaps, strengths or compliance
    {
        for (int body = 0; body < program.bodies; ++body)
        {
            Eigen::Matrix<double, 6, 6> inertia = Eigen::Matrix<double, 6, 6>::Zero();
            inertia.diagonal() << weight[body], weight[body], weight[body], 0.2 * weight[body],
                0.1 * weight[body], 0.15 * weight[body];
            program.inertia.push_back(inertia * 1e4);
            program.load.segment<3>(6 * body) += weight[body] * uniform(random, 0, 20) * direction(random);
        }
        program.gap = Eigen::VectorXd::Zero(3 * program.points());
        for (int point = 0; point < program.points(); ++point)
        {
            program.gap[3 * point] = uniform(random, 0, 1) < 0.5 ? 0 : uniform(random, 0, 1e-3);
        }
        if (kind == 3 && uniform(random, 0, 1) < 0.5)
        {
            program.compliance.resize(3 * program.points());
            for (int point = 0; point < program.points(); ++point)
            {
                const double normal = std::exp(uniform(random, std::log(1e-6), std::log(1e-3)));
                program.compliance.segment<3>(3 * point) << normal, 2 * normal, 2 * normal;
            }
        }
    }
    if (program.compliance.size() == 0 && kind % 2 == 1)
    {
        for (int point = 0; point < program.points(); ++point)
        {
            Strength strength;
            strength.tension = uniform(random, 0, 1) < 0.5 ? 0 : uniform(random, 0, 0.1);
            strength.cohesion = program.friction[point] * strength.tension
                                + (uniform(random, 0, 1) < 0.5 ? 0 : uniform(random, 0, 0.2));
            if (uniform(random, 0, 1) < 0.5)
            {
                strength.crushing = std::exp(uniform(random, 0, 5));
            }
            program.strength.push_back(strength);
        }
    }
    return program;
}

struct Count
{
    std::array<int, 4> byStatus{};
    int wrong = 0;
    int factorisations = 0;
    int compared = 0;
};

/// \param compared each so-manieth with CVXOPT, where it is installed; 0: none
Count judge(unsigned first, int programs, int compared)
{
    Count count;
    const std::optional<Peer> peer = compared > 0 ? cvxopt() : std::nullopt;
    for (int trial = 0; trial < programs; ++trial)
    {
        Random random(first + static_cast<unsigned>(trial));
        const SpaceConeProgram program = randomProgram(random);
        SolverChoice choice;
        choice.tolerance = 1e-8;
        const ConeSolution solution = solveConeProgram(program, choice);
        ++count.byStatus[static_cast<std::size_t>(solution.status)];
        count.factorisations += solution.factorisations;
        if (solution.status == SolveStatus::notConverged)
        {
            std::cout << "seed " << first + static_cast<unsigned>(trial) << ": not converged, certificate "
                      << certify(program, solution).worst() << "\n";
            continue;
        }
        const double worst = certify(program, solution).worst();
        if (!(worst <= choice.tolerance))
        {
            ++count.wrong;
            ADD_FAILURE() << "seed " << first + static_cast<unsigned>(trial) << ": "
                          << nameOf(solution.status) << " with a certificate of " << worst;
        }
        if (peer && trial % compared == 0 && solution.status == SolveStatus::optimal)
        {
            const std::optional<PeerAnswer> answer = peer->solve(program, 1e-9);
            if (answer && certifyOptimal(program, answer->solution).worst() <= 1e-6)
            {
                ++count.compared;
                const double ours = objective(program, solution);
                EXPECT_NEAR(objective(program, answer->solution), ours, 1e-5 * std::max(1.0, std::abs(ours)))
                    << "seed " << first + static_cast<unsigned>(trial);
            }
        }
    }
    std::cout << programs << " programs: optimal " << count.byStatus[0] << ", infeasible "
              << count.byStatus[1] << ", unbounded " << count.byStatus[2] << ", not converged "
              << count.byStatus[3] << ", wrong " << count.wrong << ", compared with CVXOPT " << count.compared
              << ", factorisations a program " << static_cast<double>(count.factorisations) / programs
              << "\n";
    return count;
}

TEST(RandomSpacePrograms, AreProvedOrSaidNotToBe)
{
    const Count count = judge(1, 300, 15);
    EXPECT_EQ(count.wrong, 0);
    EXPECT_LE(count.byStatus[3], 1);
}

TEST(NightlyRandomSpacePrograms, AreProvedOrSaidNotToBe)
{
    const Count count = judge(100001, 2000, 3);
    EXPECT_EQ(count.wrong, 0);
    EXPECT_LE(count.byStatus[3], 10);
}

} // namespace
} // namespace drystone
