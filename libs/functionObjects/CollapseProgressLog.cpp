// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How far the search has come, at most every ten seconds.
#include "functionObjects/CollapseProgressLog.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace drystone
{
namespace
{

/// How a start of a search is called that a path follows, and one that programs with cohesion do.
constexpr std::string_view pathWord = "path ";
constexpr std::string_view startWord = "start ";

} // namespace

bool isCollapseProgress(std::string_view line)
{
    return line.starts_with(coulombWords)
           && (line.substr(coulombWords.size()).starts_with(pathWord)
               || line.substr(coulombWords.size()).starts_with(startWord));
}

std::function<void(const CollapseProgress&)> collapseProgressLog(SearchTime time,
                                                                 std::function<double()> clock)
{
    constexpr double every = 10;  // [s]
    constexpr double isLong = 30; // likewise
    const double begin = clock();
    return [time, clock = std::move(clock), begin, last = begin,
            hasSaid = false](const CollapseProgress& progress) mutable
    {
        if (clock() - last >= every)
        {
            last = clock();
            info("{}{}{}, {} {}, at {:.4g} times the live load; {}. ClockTime = {:.0f} s", coulombWords,
                 progress.isPath ? pathWord : startWord, progress.path, progress.pieces,
                 progress.isPath ? "pieces" : "programs", progress.multiplier,
                 std::isfinite(progress.lowest)
                     ? fmt::format("lowest collapse so far {:.6g}", progress.lowest)
                     : "no collapse met yet",
                 last);
            if (time == SearchTime::endless && !hasSaid && last - begin >= isLong)
            {
                hasSaid = true;
                printLine("This may last long. `nonAssociative { maximumTime 600; }` in "
                          "system/solution/limitAnalysis ends such a search after 600 s, with the lowest "
                          "collapse met until then.");
            }
            flushLog();
        }
    };
}

} // namespace drystone
