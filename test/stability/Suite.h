// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Hard cases, each run with every solver that applies: what is measured, what must hold, and why it is hard.
#pragma once

#include "conic/SolverChoice.h"

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drystone
{

/// What a run of a hard case has come to.
struct Outcome
{
    double figure = 0;       ///< the measured one, which is compared with the limit; NaN is no answer
    std::string broken = {}; ///< what else does not hold, or empty
    std::string note = {};   ///< for the table, such as which of several right answers it was
};

/// The larger of the figure and an error becomes the figure.
inline void worsen(Outcome& outcome, double error)
{
    outcome.figure = error <= outcome.figure ? outcome.figure : error; // keeps NaN
}

/// Whether a case is short enough for every test run.
enum class Length
{
    ordinary, ///< about a second or less
    nightly
};

struct StabilityCase
{
    std::string name;      ///< letters, digits and _
    std::string hard;      ///< why it is hard
    std::string measure;   ///< what the figure is, and in which unit
    double limit = 0;      ///< the figure allowed
    double looseLimit = 0; ///< the same of gaussSeidel, which is run with a tolerance of 1e-4
    std::vector<SolverType> solvers;
    std::function<Outcome(SolverType)> run;
    Length length = Length::ordinary;
};

/// By which faces are out of parallel [rad], and how names say so.
inline constexpr std::array<std::pair<double, const char*>, 6> anglesOutOfParallel{
    {{0, "0"}, {1e-15, "1em15"}, {1e-12, "1em12"}, {1e-9, "1em9"}, {1e-6, "1em6"}, {1e-3, "1em3"}}};

/// All cases, in the order of the table.
std::vector<StabilityCase> limitAnalysisCases();
std::vector<StabilityCase> stepCases();
std::vector<StabilityCase> motionCases();
std::vector<StabilityCase> wallCases();

/// Solvers of limit analysis; of one step; of motion.
inline std::vector<SolverType> staticSolvers()
{
    return {SolverType::interiorPoint};
}
inline std::vector<SolverType> stepSolvers()
{
    return {SolverType::interiorPoint, SolverType::augmentedLagrangian, SolverType::gaussSeidel};
}
inline std::vector<SolverType> motionSolvers()
{
    return {SolverType::automatic, SolverType::interiorPoint, SolverType::augmentedLagrangian,
            SolverType::gaussSeidel};
}

/// A case that a solver is known not to solve. When it does, the test fails until the entry is removed.
struct ExpectedFailure
{
    std::string_view name; ///< of the case
    SolverType solver;
    std::string_view reason;
};
const std::vector<ExpectedFailure>& expectedFailures();

} // namespace drystone
