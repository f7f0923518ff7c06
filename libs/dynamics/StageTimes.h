// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The stages of a time step, and the time that each of them takes: what stepping spends its time on.
#pragma once

#include <array>
#include <chrono>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

namespace drystone
{

/// What a step consists of, in this order; solve, collide and review may have several turns.
enum class Stage
{
    findContacts, ///< points where blocks touch or may meet within the step, and their lever arms
    assemble,     ///< the cone program of the rigid step, and where its solution may be
    contribute,   ///< the terms of effects and of moving supports
    solve,        ///< the cone programs of the step
    collide,      ///< impacts of their own, and the instants at which blocks meet
    review,       ///< effects examine the solution, and may request another one
    move,         ///< new placements and velocities
    account,      ///< energy, and what the next step starts from
    rest          ///< proofs that blocks stay at rest, and steps taken with them
};

constexpr std::array<std::pair<std::string_view, Stage>, 9> namesOf(Stage)
{
    return {{{"findContacts", Stage::findContacts},
             {"assemble", Stage::assemble},
             {"contribute", Stage::contribute},
             {"solve", Stage::solve},
             {"collide", Stage::collide},
             {"review", Stage::review},
             {"move", Stage::move},
             {"account", Stage::account},
             {"rest", Stage::rest}}};
}

/// Elapsed time of each stage, summed over steps [s]. Steps that were tried and not taken count.
struct StageTimes
{
    std::array<double, namesOf(Stage{}).size()> seconds{}; ///< in the order of Stage
    /// Of the stage before in the same step; empty until the first has ended.
    std::optional<std::chrono::steady_clock::time_point> end;

    double of(Stage stage) const { return seconds[static_cast<std::size_t>(stage)]; }
    double total() const { return std::accumulate(seconds.begin(), seconds.end(), 0.0); }
};

/// Adds to a stage the time until the end of its own life: since the stage before has ended, so that the
/// clock is read once for each, or since its own beginning where there is none. The times are not owned and
/// must outlive it.
class StageTimer
{
public:
    StageTimer(StageTimes& stageTimes, Stage timedStage)
        : times(stageTimes), stage(timedStage), start(times.end ? *times.end : Clock::now())
    {
    }
    ~StageTimer()
    {
        times.end = Clock::now();
        times.seconds[static_cast<std::size_t>(stage)] +=
            std::chrono::duration<double>(*times.end - start).count();
    }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

private:
    using Clock = std::chrono::steady_clock;

    StageTimes& times;
    Stage stage;
    Clock::time_point start;
};

} // namespace drystone
