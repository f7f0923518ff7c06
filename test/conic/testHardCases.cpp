// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Steps in time that are hard on solvers: mass ratios up to 1e8, frictions from 0 to 3, tall towers, faces
/// with hundreds of redundant points. The two exact solvers must converge to the same certificate on each.
#include "conic/AugmentedLagrangian.h"
#include "conic/Certificate.h"
#include "conic/GaussSeidel.h"
#include "conic/InteriorPoint.h"

#include "HardCases.h"

#include <Eigen/Cholesky>

#include <gtest/gtest.h>

namespace drystone
{
namespace
{

constexpr double tolerance = 1e-8;

template<class Program>
void expectBothSolve(const Program& program)
{
    const ConeSolution interior = solveInteriorPoint(program, {.tolerance = tolerance});
    EXPECT_EQ(interior.status, SolveStatus::optimal)
        << "interiorPoint: certificate " << certifyOptimal(program, interior).worst() << " after "
        << interior.factorisations << " factorisations";
    const ConeSolution multipliers =
        solveAugmentedLagrangian(program, {}, {.tolerance = tolerance, .maximumIterations = 4000});
    EXPECT_EQ(multipliers.status, SolveStatus::optimal)
        << "augmentedLagrangian: certificate " << certifyOptimal(program, multipliers).worst() << " after "
        << multipliers.factorisations << " factorisations";
    // Displacements are unique, and half their distance squared, in the metric of the inertia, is no more
    // than what the objectives lack: compared with the energy of a free fall.
    const Eigen::VectorXd apart = interior.displacement - multipliers.displacement;
    double fall = 0;
    for (int body = 0; body < program.bodies; ++body)
    {
        const auto rows = program.inertia[body].rows();
        const Eigen::VectorXd load = program.load.segment(rows * body, rows);
        fall += load.dot(program.inertia[body].ldlt().solve(load));
    }
    EXPECT_LE(apart.dot(applyInertia(program, apart)), 100 * tolerance * fall);
}

/// Gauss-Seidel need not converge, but it must know. \return whether it did
template<class Program>
bool gaussSeidelKnows(const Program& program)
{
    const ConeSolution solution =
        solveGaussSeidel(program, {}, {.tolerance = 1e-4, .maximumIterations = 300});
    const Certificate certificate = certifyOptimal(program, solution);
    EXPECT_EQ(solution.status == SolveStatus::optimal, certificate.worst() <= 1e-4);
    EXPECT_LE(certificate.primalResidual, 1e-12);
    return solution.status == SolveStatus::optimal;
}

TEST(HardCases, BothExactSolversReachTheSameCertificateInThePlane)
{
    for (const HardCase& hard : hardCases())
    {
        SCOPED_TRACE(hard.name);
        expectBothSolve(planeStep(hard.tower, hard.alpha));
    }
}

TEST(HardCases, BothExactSolversReachTheSameCertificateInSpace)
{
    for (const HardCase& hard : hardCases())
    {
        SCOPED_TRACE(hard.name);
        expectBothSolve(spaceStep(hard.tower, hard.alpha));
    }
}

TEST(HardCases, GaussSeidelIsHonestAboutWhatItCannotDo)
{
    int solved = 0;
    int unsolved = 0;
    for (const HardCase& hard : hardCases())
    {
        SCOPED_TRACE(hard.name);
        if (hard.tower.boxes.size() > 50 || hard.tower.pointsPerSide > 100)
        {
            continue; // slow, and no different
        }
        ++(gaussSeidelKnows(planeStep(hard.tower, hard.alpha)) ? solved : unsolved);
        ++(gaussSeidelKnows(spaceStep(hard.tower, hard.alpha)) ? solved : unsolved);
    }
    EXPECT_GT(solved, 0);
    EXPECT_GT(unsolved, 0); // or these cases are not hard any more
}

} // namespace
} // namespace drystone
