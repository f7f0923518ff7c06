// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the iterations of the interior point did: a line for each, why they ended, and the time of each
/// phase. Part of the interior point's interface: solvers fill it in where a caller requests it.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// Why iterations ended.
enum class Ending
{
    converged,
    falls,       ///< displacements show that nothing balances the loads
    grows,       ///< the multiplier is so large that there may be no largest one
    runsOff,     ///< along a ray, or to what is no number
    stalled,     ///< full steps no longer balance the loads: for rounding, or as nothing does
    shortSteps,  ///< from a start that was not near enough, or too short to go on at all
    notDefinite, ///< the Schur system, for rounding
    noStart,
    tooManyIterations
};
std::string_view nameOf(Ending ending);

/// What the time of an iteration goes into.
enum class Phase
{
    residuals,
    factorise,
    predict,
    correct,
    move,
    count
};
std::string_view nameOf(Phase phase);

struct IterationTrace
{
    struct Line
    {
        int iteration;
        double complementarity;
        double balance; ///< largest that is missing from it, scaled
        double opening;
        double multiplier; ///< scaled
        double primal;     ///< step to here
        double dual;
    };
    /// One start and what came of it.
    struct Run
    {
        std::string start; ///< as Starts.h has them
        std::vector<Line> lines;
        Ending ending = Ending::tooManyIterations;
    };
    std::vector<Run> runs;
    std::array<double, static_cast<std::size_t>(Phase::count)> seconds{}; ///< CPU time, all runs together

    /// As a table for a log, one line an iteration.
    std::vector<std::string> text() const;
};

/// Adds the CPU time of a scope to a phase; does nothing without a trace.
class PhaseTimer
{
public:
    PhaseTimer(IterationTrace* ofTrace, Phase ofPhase);
    ~PhaseTimer();
    PhaseTimer(const PhaseTimer&) = delete;
    PhaseTimer& operator=(const PhaseTimer&) = delete;

private:
    IterationTrace* trace;
    Phase phase;
    double start;
};

} // namespace drystone
