// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Names in words, a line for each iteration, and CPU time that timers add to their phase as they end.
#include "conic/interiorPoint/Trace.h"

#include "core/Log.h"

#include <fmt/format.h>

namespace drystone
{

std::string_view nameOf(Ending ending)
{
    switch (ending)
    {
    case Ending::converged:
        return "converged";
    case Ending::falls:
        return "the displacements show that nothing balances the loads";
    case Ending::grows:
        return "there may be no largest multiplier";
    case Ending::runsOff:
        return "the iterates run off";
    case Ending::stalled:
        return "rounding, or the loads, keep the forces from balance";
    case Ending::shortSteps:
        return "short steps from this start";
    case Ending::notDefinite:
        return "the Schur system is not positive definite";
    case Ending::noStart:
        return "no start";
    case Ending::tooManyIterations:
        break;
    }
    return "too many iterations";
}

std::string_view nameOf(Phase phase)
{
    switch (phase)
    {
    case Phase::residuals:
        return "residuals";
    case Phase::factorise:
        return "factorise";
    case Phase::predict:
        return "predict";
    case Phase::correct:
        return "correct";
    case Phase::move:
        return "move";
    case Phase::count:
        break;
    }
    return "";
}

std::vector<std::string> IterationTrace::text() const
{
    std::vector<std::string> lines;
    for (const Run& run : runs)
    {
        lines.push_back(fmt::format("interior point from {}:", run.start));
        lines.push_back("  it  complementarity  balance   opening   multiplier     primal  dual");
        for (const Line& line : run.lines)
        {
            lines.push_back(fmt::format("{:4d}  {:15.3e}  {:8.1e}  {:8.1e}  {:13.6e}  {:6.4f}  {:6.4f}",
                                        line.iteration, line.complementarity, line.balance, line.opening,
                                        line.multiplier, line.primal, line.dual));
        }
        lines.push_back(fmt::format("  ended: {}", nameOf(run.ending)));
    }
    std::string times = "interior point, CPU time [s]:";
    for (std::size_t phase = 0; phase < seconds.size(); ++phase)
    {
        times += fmt::format(" {} {:.3g}", nameOf(static_cast<Phase>(phase)), seconds[phase]);
    }
    lines.push_back(times);
    return lines;
}

PhaseTimer::PhaseTimer(IterationTrace* ofTrace, Phase ofPhase)
    : trace(ofTrace), phase(ofPhase), start(ofTrace ? cpuTime() : 0)
{
}

PhaseTimer::~PhaseTimer()
{
    if (trace)
    {
        trace->seconds[static_cast<std::size_t>(phase)] += cpuTime() - start;
    }
}

} // namespace drystone
