// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Solver x problem: every solver, ours and other people's, on every problem of its kind, held to one
/// certificate. What fails is listed by name and reason; what is listed and does not fail is a fault too.
#include "HardCases.h"
#include "Peers.h"
#include "Walls.h"

#include "conic/AugmentedLagrangian.h"
#include "conic/GaussSeidel.h"
#include "conic/InteriorPoint.h"
#include "dynamics/ThetaStep.h"

#include <Eigen/Cholesky>

#include <gtest/gtest.h>

#include <map>

namespace drystone
{
namespace
{

struct Problem
{
    std::string name;
    AnyConeProgram program;
};

const std::vector<Problem>& problems()
{
    static const std::vector<Problem> all = []
    {
        std::vector<Problem> list;
        for (int number = 1; number <= 6; ++number)
        {
            list.push_back({fmt::format("wall {} limit", number), limitAnalysisOf(paperWall(number))});
        }
        const auto direction = [](double angle) { return Eigen::Vector2d(std::cos(angle), std::sin(angle)); };
        for (const int boxes : {1, 5, 20})
        {
            Tower tower = evenTower(boxes);
            tower.push = direction(0.4);
            list.push_back({fmt::format("tower {} limit plane", boxes), planeLimitAnalysis(tower)});
            list.push_back({fmt::format("tower {} limit space", boxes), spaceLimitAnalysis(tower)});
        }
        Tower heavy = evenTower(5, 1e6);
        heavy.push = direction(0.4);
        list.push_back({"tower heavy limit plane", planeLimitAnalysis(heavy)});
        list.push_back({"tower heavy limit space", spaceLimitAnalysis(heavy)});
        list.push_back({"wall 1 step standing", stepOf(paperWall(1), 0.8 * paperMultipliers[0])});
        list.push_back({"wall 1 step moving", stepOf(paperWall(1), 1.1 * paperMultipliers[0])});
        for (const HardCase& hard : hardCases())
        {
            const bool isSmall = hard.tower.boxes.size() <= 20 && hard.tower.pointsPerSide <= 10;
            if (isSmall)
            {
                list.push_back({hard.name + " step plane", planeStep(hard.tower, hard.alpha)});
                list.push_back({hard.name + " step space", spaceStep(hard.tower, hard.alpha)});
            }
        }
        return list;
    }();
    return all;
}

/// A solver with the certificate it has to reach.
struct Contestant
{
    Peer peer;
    double asked = 1e-9;    ///< tolerance it is given
    double demanded = 1e-8; ///< certificate it must reach
};

bool isStep(const AnyConeProgram& any)
{
    return std::visit([](const auto& program) { return program.hasInertia() && !program.hasMultiplier(); },
                      any);
}

std::vector<Contestant> contestants()
{
    const auto ours = [](const std::string& name, auto solve, bool stepsOnly)
    {
        return Peer{
            name, ContactLaw::associative,
            [solve, stepsOnly](const AnyConeProgram& any, double tolerance) -> std::optional<PeerAnswer>
            {
                if (stepsOnly && !isStep(any))
                {
                    return {};
                }
                return PeerAnswer{
                    std::visit([&](const auto& program) { return solve(program, tolerance); }, any), 0};
            }};
    };
    std::vector<Contestant> all;
    all.push_back({ours(
                       "interiorPoint",
                       [](const auto& program, double tolerance)
                       { return solveInteriorPoint(program, {.tolerance = tolerance}); },
                       false),
                   1e-9, 1e-9});
    all.push_back({ours(
                       "augmentedLagrangian",
                       [](const auto& program, double tolerance) {
                           return solveAugmentedLagrangian(
                               program, {}, {.tolerance = tolerance, .maximumIterations = 400});
                       },
                       true),
                   1e-9, 1e-9});
    all.push_back(
        {ours(
             "gaussSeidel",
             [](const auto& program, double tolerance)
             { return solveGaussSeidel(program, {}, {.tolerance = tolerance, .maximumIterations = 2000}); },
             true),
         1e-4, 1e-4});
    // What a peer has to solve is in its own terms, of residuals that it scales in its own way.
    const std::map<std::string, std::pair<double, double>> accuracies{{"GLPK", {1e-9, 1e-8}},
                                                                      {"Clp", {1e-9, 1e-8}},
                                                                      {"CVXOPT", {1e-9, 1e-6}},
                                                                      {"Siconos NSGS", {1e-8, 1e-4}},
                                                                      {"Siconos Lemke", {1e-10, 1e-6}}};
    for (const Peer& peer : installedPeers())
    {
        const auto [asked, demanded] = accuracies.at(peer.name);
        all.push_back({peer, asked, demanded});
    }
    return all;
}

/// Why a solver fails on some problems.
struct ExpectedFailure
{
    std::string solver;
    std::string reason;
    std::vector<std::string> problems;
};

const std::vector<ExpectedFailure>& expectedFailures()
{
    static const std::vector<ExpectedFailure> all{
        {"gaussSeidel",
         "a force passes one block a sweep, and heavy blocks on light ones hand back most of it",
         {"massRatio=100 standing step plane", "massRatio=100 standing step space",
          "massRatio=100 moving step plane", "massRatio=100 moving step space",
          "massRatio=10000 standing step plane", "massRatio=10000 standing step space",
          "massRatio=10000 moving step plane", "massRatio=10000 moving step space",
          "massRatio=1e+06 standing step plane", "massRatio=1e+06 standing step space",
          "massRatio=1e+06 moving step plane", "massRatio=1e+06 moving step space",
          "massRatio=1e+08 standing step plane", "massRatio=1e+08 standing step space",
          "massRatio=1e+08 moving step plane", "massRatio=1e+08 moving step space"}},
        {"gaussSeidel",
         "too many points in the way of a force, or forces that are not unique: thousands of sweeps are not "
         "enough",
         {"wall 1 step standing", "wall 1 step moving", "massRatio=1 standing step space",
          "massRatio=1 moving step space", "blocks=5 standing step space", "blocks=5 moving step space",
          "blocks=20 standing step plane", "blocks=20 standing step space", "blocks=20 moving step plane",
          "blocks=20 moving step space", "pointsPerSide=10 standing step space",
          "pointsPerSide=10 moving step plane", "pointsPerSide=10 moving step space"}},
        {"Siconos NSGS",
         "as gaussSeidel: heavy on light",
         {"massRatio=100 standing step plane", "massRatio=100 standing step space",
          "massRatio=100 moving step space", "massRatio=10000 standing step plane",
          "massRatio=10000 standing step space", "massRatio=10000 moving step plane",
          "massRatio=10000 moving step space", "massRatio=1e+06 standing step plane",
          "massRatio=1e+06 standing step space", "massRatio=1e+06 moving step plane",
          "massRatio=1e+06 moving step space", "massRatio=1e+08 standing step plane",
          "massRatio=1e+08 standing step space", "massRatio=1e+08 moving step plane",
          "massRatio=1e+08 moving step space"}},
        {"Siconos NSGS",
         "as gaussSeidel: a tall tower",
         {"blocks=20 standing step plane", "blocks=20 standing step space", "blocks=20 moving step plane",
          "blocks=20 moving step space"}},
        {"Siconos Lemke",
         "pivots that differ by the ratio of masses",
         {"massRatio=1e+08 standing step plane", "massRatio=1e+08 moving step plane"}},
        {"Siconos Lemke",
         "redundant points make W singular, and the pivoting ends on a ray",
         {"wall 1 step standing", "wall 1 step moving", "pointsPerSide=10 standing step plane",
          "pointsPerSide=10 moving step plane"}},
    };
    return all;
}

/// \return the reason why a failure is expected; empty when none is
std::string expectedReason(const std::string& solver, const std::string& problem)
{
    for (const ExpectedFailure& failure : expectedFailures())
    {
        if (failure.solver == solver
            && std::find(failure.problems.begin(), failure.problems.end(), problem) != failure.problems.end())
        {
            return failure.reason;
        }
    }
    return {};
}

double objectiveOf(const AnyConeProgram& any, const ConeSolution& solution)
{
    return std::visit([&](const auto& program) { return objective(program, solution); }, any);
}

/// What an objective is compared with: alpha with itself, the energy of a step with that of a free fall.
double objectiveScale(const AnyConeProgram& any, double reference)
{
    return std::visit(
        [&](const auto& program)
        {
            double fall = 0;
            for (int body = 0; body < (program.hasInertia() ? program.bodies : 0); ++body)
            {
                const auto& inertia = program.inertia[static_cast<std::size_t>(body)];
                const Eigen::VectorXd load = program.load.segment(inertia.rows() * body, inertia.rows());
                fall += load.dot(inertia.ldlt().solve(load));
            }
            return std::max(fall, std::abs(reference));
        },
        any);
}

TEST(CrossChecks, AllPeersAreInstalled)
{
    std::string missing;
    for (const auto& [name, peer] : {std::pair("GLPK", glpk()), std::pair("Clp", clp()),
                                     std::pair("CVXOPT", cvxopt()), std::pair("Siconos", siconosLemke())})
    {
        missing += peer ? "" : std::string(" ") + name;
    }
    if (!missing.empty())
    {
        GTEST_SKIP() << "not compared, because not installed:" << missing
                     << " (etc/bootstrap test installs them)";
    }
}

/// And its objective is that of the interior point.
TEST(CrossChecks, EachSolverReachesItsCertificateOrIsListed)
{
    std::map<std::string, double> references;
    for (const Problem& problem : problems())
    {
        references[problem.name] =
            std::visit([](const auto& program)
                       { return objective(program, solveInteriorPoint(program, {.tolerance = 1e-10})); },
                       problem.program);
    }
    for (const Contestant& contestant : contestants())
    {
        int solved = 0;
        for (const Problem& problem : problems())
        {
            const auto answer = contestant.peer.solve(problem.program, contestant.asked);
            if (!answer)
            {
                continue;
            }
            const double worst = certifyByLaw(problem.program, answer->solution, contestant.peer.law).worst();
            const bool reached = worst <= contestant.demanded;
            solved += reached ? 1 : 0;
            const std::string reason = expectedReason(contestant.peer.name, problem.name);
            EXPECT_EQ(reached, reason.empty())
                << contestant.peer.name << " on " << problem.name << ": certificate " << worst
                << (reason.empty() ? "" : "; expected to fail: " + reason);
            if (reached && contestant.peer.law == ContactLaw::associative)
            {
                const double found = objectiveOf(problem.program, answer->solution);
                const double reference = references.at(problem.name);
                EXPECT_NEAR(found, reference,
                            10 * contestant.demanded * objectiveScale(problem.program, reference))
                    << contestant.peer.name << " on " << problem.name;
            }
        }
        EXPECT_GT(solved, 0) << contestant.peer.name;
        fmt::print("{}: {} problems\n", contestant.peer.name, solved);
    }
}

/// In the plane as contactDynamics solves it.
ConeSolution coulombStep(const PlaneConeProgram& program)
{
    StepSettings settings;
    settings.flowRule = FlowRule::nonAssociative;
    settings.solver.tolerance = 1e-10;
    const ThetaStep step = solveThetaStep(program, settings);
    ConeSolution solution;
    solution.contactForce = step.contactForce;
    solution.displacement = step.displacement;
    return solution;
}

ConeSolution coulombStep(const SpaceConeProgram& program)
{
    return solveCoulomb(program, std::function<ConeSolution(const SpaceConeProgram&)>(
                                     [](const SpaceConeProgram& shifted)
                                     { return solveInteriorPoint(shifted, {.tolerance = 1e-10}); }));
}

/// Two motions obey Coulomb's law here, 1.7e-3 of a free fall apart. Started from either of them, the next
/// program gives back the same motion to 5e-14 m and 5e-17 m, at certificates of 6e-10 and 3e-13.
constexpr const char* severalMotions = "wall 1 step moving";

/// Where a step with Coulomb's law has one solution, ours must be Siconos'.
TEST(CrossChecks, CoulombStepsAreThoseOfSiconos)
{
    const auto peer = siconosGaussSeidel();
    if (!peer)
    {
        GTEST_SKIP() << "Siconos is not installed (etc/bootstrap test installs it)";
    }
    int compared = 0;
    for (const Problem& problem : problems())
    {
        if (!isStep(problem.program))
        {
            continue;
        }
        const auto answer = peer->solve(problem.program, 1e-10);
        if (!answer || certifyByLaw(problem.program, answer->solution, ContactLaw::Coulomb).worst() > 1e-7)
        {
            continue;
        }
        const auto* plane = std::get_if<PlaneConeProgram>(&problem.program);
        const ConeSolution ours =
            plane ? coulombStep(*plane) : coulombStep(std::get<SpaceConeProgram>(problem.program));
        const double worst = certifyByLaw(problem.program, ours, ContactLaw::Coulomb).worst();
        // The fixed point stands when the dilatancy does to ten times the tolerance of a program.
        EXPECT_LE(worst, 1e-6) << problem.name;
        if (problem.name == severalMotions)
        {
            continue;
        }
        // A certificate of e leaves the motion open to about the root of 2 e, in the norm of the energy.
        const double theirs = certifyByLaw(problem.program, answer->solution, ContactLaw::Coulomb).worst();
        const double open = std::sqrt(2 * worst) + std::sqrt(2 * theirs);
        const double apart = std::visit(
            [&](const auto& program)
            {
                const Eigen::VectorXd difference = ours.displacement - answer->solution.displacement;
                return std::sqrt(difference.dot(applyInertia(program, difference)));
            },
            problem.program);
        EXPECT_LE(apart, std::max(1e-6, open) * std::sqrt(objectiveScale(problem.program, 0)))
            << problem.name << ": certificates " << worst << " and " << theirs;
        ++compared;
    }
    EXPECT_GT(compared, 5);
    fmt::print("{} steps compared\n", compared);
}

} // namespace
} // namespace drystone
