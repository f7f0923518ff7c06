// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Siconos, linked where it is installed.
#include "Peers.h"

#if __has_include(<FrictionContactProblem.h>)
#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>

#include <Eigen/Cholesky>

namespace drystone
{
namespace
{

/// Which of its solvers, by dimension; -1: none.
struct Solvers
{
    int plane;
    int space;
    int maximumIterations;
};

/// z = W c + q with W = A' Mbar^-1 A and q = g - A' Mbar^-1 f: the program in contact forces alone. Forces
/// are over the largest load, openings over the largest q.
template<int Rows, int Forces>
std::optional<PeerAnswer> solveStep(const ConeProgram<Rows, Forces>& program, const Solvers& solvers,
                                    double tolerance)
{
    const int solver = Forces == 2 ? solvers.plane : solvers.space;
    if (solver < 0 || !program.hasInertia() || program.hasMultiplier() || program.hasStrength()
        || program.points() > 1000)
    {
        return {};
    }
    const int size = Forces * program.points();
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(Rows * program.bodies, size);
    Eigen::MatrixXd moved = A;
    Eigen::VectorXd fall(A.rows());
    for (int point = 0; point < program.points(); ++point)
    {
        const auto& columns = program.contacts[static_cast<std::size_t>(point)];
        if (columns.first >= 0)
        {
            A.template block<Rows, Forces>(Rows * columns.first, Forces * point) = columns.onFirst;
        }
        if (columns.second >= 0)
        {
            A.template block<Rows, Forces>(Rows * columns.second, Forces * point) = columns.onSecond;
        }
    }
    for (int body = 0; body < program.bodies; ++body)
    {
        const auto factor = program.inertia[static_cast<std::size_t>(body)].ldlt();
        moved.middleRows<Rows>(Rows * body) = factor.solve(A.middleRows<Rows>(Rows * body));
        fall.segment<Rows>(Rows * body) = factor.solve(program.load.template segment<Rows>(Rows * body));
    }
    Eigen::VectorXd q = -A.transpose() * fall;
    if (program.gap.size() > 0)
    {
        q += program.gap;
    }
    const double force = program.load.template lpNorm<Eigen::Infinity>();
    const double opening = std::max(q.lpNorm<Eigen::Infinity>(), 1e-300);
    Eigen::MatrixXd W = A.transpose() * moved * (force / opening);
    q /= opening;
    std::vector<double> friction = program.friction;
    Eigen::VectorXd reaction = Eigen::VectorXd::Zero(size);
    Eigen::VectorXd velocity = Eigen::VectorXd::Zero(size);

    NumericsMatrix* matrix = NM_create_from_data(NM_DENSE, size, size, W.data());
    FrictionContactProblem problem{};
    problem.dimension = Forces;
    problem.numberOfContacts = program.points();
    problem.M = matrix;
    problem.q = q.data();
    problem.mu = friction.data();
    SolverOptions* options = solver_options_create(solver);
    options->dparam[SICONOS_DPARAM_TOL] = tolerance;
    options->iparam[SICONOS_IPARAM_MAX_ITER] = solvers.maximumIterations;
    const double start = cpuSeconds();
    if (Forces == 2)
    {
        fc2d_driver(&problem, reaction.data(), velocity.data(), options);
    }
    else
    {
        fc3d_driver(&problem, reaction.data(), velocity.data(), options);
    }
    PeerAnswer answer;
    answer.seconds = cpuSeconds() - start;
    answer.solution.iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
    solver_options_delete(options);
    matrix->matrix0 = nullptr; // ours
    NM_free(matrix);
    answer.solution.contactForce = force * reaction;
    answer.solution.displacement = fall - moved * answer.solution.contactForce;
    return answer;
}

std::optional<Peer> siconos(const std::string& name, const Solvers& solvers)
{
    return Peer{name, ContactLaw::Coulomb, [solvers](const AnyConeProgram& any, double tolerance) {
                    return std::visit(
                        [&](const auto& program) { return solveStep(program, solvers, tolerance); }, any);
                }};
}

} // namespace

std::optional<Peer> siconosGaussSeidel()
{
    return siconos("Siconos NSGS", {SICONOS_FRICTION_2D_NSGS, SICONOS_FRICTION_3D_NSGS, 20000});
}

std::optional<Peer> siconosLemke()
{
    return siconos("Siconos Lemke", {SICONOS_FRICTION_2D_LEMKE, -1, 2000});
}

} // namespace drystone
#else
std::optional<drystone::Peer> drystone::siconosGaussSeidel()
{
    return {};
}
std::optional<drystone::Peer> drystone::siconosLemke()
{
    return {};
}
#endif
