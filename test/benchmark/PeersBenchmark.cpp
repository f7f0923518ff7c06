// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Our solvers and those of others on the same problems: limit analysis of the six walls and of square ones,
/// and the first step of wall 1 and wall 6. Times are CPU times of the solvers alone, in ms and in units of
/// F, one assembly, factorisation and solution of the same Schur matrix in the same run (those of Clp include
/// reading the file, because it is a separate program). The certificate is ours for all, so that speed at the
/// expense of accuracy is visible. Solvers that are not installed are omitted.
///
///     build/test/PeersBenchmark --benchmark_out=peers.csv --benchmark_out_format=csv
#include "CholmodUnit.h"
#include "Peers.h"
#include "Walls.h"

#include "conic/UnitOfWork.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>

namespace drystone
{
namespace
{

struct Problem
{
    std::string name;
    std::function<PlaneConeProgram()> make;
};

const std::vector<Problem>& problems()
{
    static const std::vector<Problem> all = []
    {
        std::vector<Problem> list;
        for (int wall = 1; wall <= 6; ++wall)
        {
            list.push_back(
                {fmt::format("wall {} limit", wall), [wall] { return limitAnalysisOf(paperWall(wall)); }});
        }
        for (const int size : {20, 40, 80})
        {
            list.push_back(
                {fmt::format("square {} limit", size), [size] { return limitAnalysisOf(squareWall(size)); }});
        }
        for (const int wall : {1, 6})
        {
            for (const double share : {0.8, 1.1})
            {
                list.push_back({fmt::format("wall {} step {} alpha", wall, share), [wall, share]
                                { return stepOf(paperWall(wall), share * paperMultipliers[wall - 1]); }});
            }
        }
        return list;
    }();
    return all;
}

std::vector<Peer> contestants()
{
    const auto ours = [](SolverType solver)
    {
        return Peer{nameOf(solver), ContactLaw::associative,
                    [solver](const AnyConeProgram& any, double tolerance) -> std::optional<PeerAnswer>
                    {
                        const auto& program = std::get<PlaneConeProgram>(any);
                        if (solvesMotionOnly(solver) && !program.hasInertia())
                        {
                            return {};
                        }
                        SolverChoice choice;
                        choice.solver = solver;
                        choice.tolerance = tolerance;
                        choice.maximumIterations = 2000;
                        const double start = cpuSeconds();
                        PeerAnswer answer{solveConeProgram(program, choice), 0};
                        answer.seconds = cpuSeconds() - start;
                        return answer;
                    }};
    };
    std::vector<Peer> all{ours(SolverType::interiorPoint), ours(SolverType::augmentedLagrangian),
                          ours(SolverType::gaussSeidel)};
    for (const Peer& peer : installedPeers())
    {
        all.push_back(peer);
    }
    for (const std::optional<Peer>& peer : {ecos(), qoco(), piqp(), highsSimplex(), highsInteriorPoint()})
    {
        if (peer)
        {
            all.push_back(*peer);
        }
    }
    return all;
}

void solve(benchmark::State& state)
{
    const Problem& problem = problems()[static_cast<std::size_t>(state.range(0))];
    const Peer peer = contestants()[static_cast<std::size_t>(state.range(1))];
    const PlaneConeProgram program = problem.make();
    state.SetLabel(problem.name + ": " + peer.name + (peer.law == ContactLaw::Coulomb ? " (Coulomb)" : ""));
    const double unit = unitOfWork(program);
    const double cholmodUnit = cholmodUnitOfWork(program);
    std::optional<PeerAnswer> answer;
    for (auto _ : state)
    {
        // The least of five for what takes less than a second.
        constexpr int turns = 5;
        for (int turn = 0; turn < turns && (turn == 0 || (answer && answer->seconds < 1)); ++turn)
        {
            std::optional<PeerAnswer> again = peer.solve(program, 1e-8);
            answer = !answer || (again && again->seconds < answer->seconds) ? std::move(again) : answer;
        }
        state.SetIterationTime(answer ? answer->seconds : 0);
    }
    if (!answer)
    {
        state.SkipWithError("not a problem of its kind");
        return;
    }
    state.counters["blocks"] = program.bodies;
    state.counters["iterations"] = answer->solution.iterations;
    state.counters["certificate"] = certifyByLaw(program, answer->solution, peer.law).worst();
    state.counters["solve[ms]"] = 1e3 * answer->seconds;
    state.counters["F[ms]"] = 1e3 * unit;
    state.counters["solve[F]"] = answer->seconds / unit;
    state.counters["CHOLMOD F[ms]"] = 1e3 * cholmodUnit;
    state.counters["solve[CHOLMOD F]"] = answer->seconds / cholmodUnit;
}

void allPairs(benchmark::internal::Benchmark* benchmark)
{
    benchmark->ArgNames({"problem", "solver"})->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(1);
    const std::vector<Peer> solvers = contestants();
    for (std::size_t problem = 0; problem < problems().size(); ++problem)
    {
        for (std::size_t solver = 0; solver < solvers.size(); ++solver)
        {
            const bool isStep = problems()[problem].name.find("step") != std::string::npos;
            const std::string& name = solvers[solver].name;
            const bool stepsOnly = solvers[solver].law == ContactLaw::Coulomb
                                   || name == nameOf(SolverType::augmentedLagrangian)
                                   || name == nameOf(SolverType::gaussSeidel);
            constexpr std::array ofLimitAnalysis{"GLPK", "Clp", "HiGHS simplex", "HiGHS interior point",
                                                 "ECOS", "QOCO"};
            const bool limitOnly =
                std::find(ofLimitAnalysis.begin(), ofLimitAnalysis.end(), name) != ofLimitAnalysis.end();
            if (isStep ? !limitOnly : !stepsOnly)
            {
                benchmark->Args({static_cast<long>(problem), static_cast<long>(solver)});
            }
        }
    }
}
BENCHMARK(solve)->Apply(allPairs);

} // namespace
} // namespace drystone
