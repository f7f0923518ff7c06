// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The list of installed solvers, and their measurement by our certificate.
#include "Peers.h"

#include <ctime>

namespace drystone
{

std::vector<Peer> installedPeers()
{
    std::vector<Peer> peers;
    for (const auto& peer : {glpk(), clp(), cvxopt(), siconosGaussSeidel(), siconosLemke()})
    {
        if (peer)
        {
            peers.push_back(*peer);
        }
    }
    return peers;
}

template<int Rows, int Forces>
ConeProgram<Rows, Forces> withSlipOpening(ConeProgram<Rows, Forces> program,
                                          const Eigen::VectorXd& displacement)
{
    const Eigen::VectorXd closing = applyTransposed(program, displacement);
    if (program.gap.size() == 0)
    {
        program.gap = Eigen::VectorXd::Zero(closing.size());
    }
    for (int point = 0; point < program.points(); ++point)
    {
        // The opening z_t = g_t - A_t' y.
        const Eigen::VectorXd slip = program.gap.segment(Forces * point + 1, Forces - 1)
                                     - closing.segment(Forces * point + 1, Forces - 1);
        program.gap[Forces * point] += program.friction[static_cast<std::size_t>(point)] * slip.norm();
    }
    return program;
}

Certificate certifyByLaw(const AnyConeProgram& any, const ConeSolution& solution, ContactLaw law)
{
    return std::visit(
        [&](const auto& program)
        {
            return certifyOptimal(law == ContactLaw::Coulomb ? withSlipOpening(program, solution.displacement)
                                                             : program,
                                  solution);
        },
        any);
}

template<int Rows, int Forces>
ConeSolution solveCoulomb(const ConeProgram<Rows, Forces>& program,
                          const std::function<ConeSolution(const ConeProgram<Rows, Forces>&)>& solve,
                          int mostPrograms)
{
    ConeSolution solution = solve(program);
    for (int programs = 1; programs < mostPrograms; ++programs)
    {
        if (certifyByLaw(program, solution, ContactLaw::Coulomb).worst() <= 1e-9)
        {
            break;
        }
        solution = solve(withSlipOpening(program, solution.displacement));
    }
    return solution;
}

double cpuSeconds()
{
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template PlaneConeProgram withSlipOpening(PlaneConeProgram, const Eigen::VectorXd&);
template SpaceConeProgram withSlipOpening(SpaceConeProgram, const Eigen::VectorXd&);
template ConeSolution solveCoulomb(const PlaneConeProgram&,
                                   const std::function<ConeSolution(const PlaneConeProgram&)>&, int);
template ConeSolution solveCoulomb(const SpaceConeProgram&,
                                   const std::function<ConeSolution(const SpaceConeProgram&)>&, int);

} // namespace drystone
