// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Solvers of others on our cone programs, where they are installed: oracles for the tests and a comparison
/// for the benchmarks. Their answers are measured by our certificate, so that the accuracy is the same for
/// all.
#pragma once

#include "conic/Certificate.h"
#include "conic/ProgramFile.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// What a peer answered. `solution.status` is not looked at: the certificate says what the answer is worth.
struct PeerAnswer
{
    ConeSolution solution;
    double seconds = 0; ///< CPU time of its solver alone, without passing the problem on
};

/// The law of contact that a solver follows.
enum class ContactLaw
{
    associative, ///< the cone program as it stands
    Coulomb      ///< without dilatancy: the program whose gaps have grown by mu |u_t| of its own solution
};

struct Peer
{
    std::string name;
    ContactLaw law = ContactLaw::associative;
    /// \param tolerance of the peer, in its own terms
    /// \return nothing when the program is not of the kind that the peer solves
    std::function<std::optional<PeerAnswer>(const AnyConeProgram& program, double tolerance)> solve;
};

/// GLPK's simplex method on plane limit analysis and settlement, through its library. Nothing when it is not
/// installed; the same holds for those below.
std::optional<Peer> glpk();
/// Clp's dual simplex method on the same, as a program of its own through files.
std::optional<Peer> clp();
/// CVXOPT's cone solver on all programs, as a program of its own through files.
std::optional<Peer> cvxopt();
/// ECOS on limit analysis, as a package of R (Debian's r-cran-ecosolver), through files; for benchmarks, not
/// among installedPeers.
std::optional<Peer> ecos();
/// For benchmarks likewise, what Debian has no package of and nobody has unless he built it. QOCO on limit
/// analysis, PIQP on all programs of the plane without strengths, HiGHS as GLPK.
std::optional<Peer> qoco();
std::optional<Peer> piqp();
std::optional<Peer> highsSimplex();
std::optional<Peer> highsInteriorPoint();
/// Siconos' block Gauss-Seidel on steps with Coulomb's law, plane and space.
std::optional<Peer> siconosGaussSeidel();
/// Siconos' method of Lemke on plane steps with Coulomb's law.
std::optional<Peer> siconosLemke();

/// All that are installed.
std::vector<Peer> installedPeers();

/// The program with the gap of each point grown by mu |u_t|, u = the slip that `displacement` makes: with
/// Coulomb's law the displacements of a step solve the program that they themselves shift so.
template<int Rows, int Forces>
ConeProgram<Rows, Forces> withSlipOpening(ConeProgram<Rows, Forces> program,
                                          const Eigen::VectorXd& displacement);

/// Certificate of an answer by the law of the solver.
Certificate certifyByLaw(const AnyConeProgram& program, const ConeSolution& solution, ContactLaw law);

/// Solves a step with Coulomb's law: repeats `solve` on the shifted program until the shift stands.
/// \return the last solution; the certificate says whether it stood
template<int Rows, int Forces>
ConeSolution solveCoulomb(const ConeProgram<Rows, Forces>& program,
                          const std::function<ConeSolution(const ConeProgram<Rows, Forces>&)>& solve,
                          int mostPrograms = 200);

/// CPU time of this process [s].
double cpuSeconds();

} // namespace drystone
