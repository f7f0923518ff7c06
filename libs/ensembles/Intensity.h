// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Which intensities an incremental analysis tries: `intensity` of system/incrementalDynamicsDict.
///
///     intensity { type step; unit g; from 0.6; to 0.7; step 0.001; }
///     intensity { type bisection; unit g; low 0.2; high 0.5; tolerance 0.001; }
///     intensity { type list; unit m/s2; values (1 2 5); }
///
/// The intensity is the peak acceleration of the ground: the motion is scaled to have this peak.
#pragma once

#include "dictionary/Registry.h"

#include <functional>
#include <string_view>
#include <vector>

namespace drystone
{

enum class IntensityUnit
{
    g, ///< gravity of constant/g, so that a block slides at mu and a wall moves at its multiplier
       ///< alpha
    metresPerSecondSquared
};

/// Names in dictionaries.
constexpr std::array<std::pair<std::string_view, IntensityUnit>, 2> namesOf(IntensityUnit)
{
    return {{{"g", IntensityUnit::g}, {"m/s2", IntensityUnit::metresPerSecondSquared}}};
}
void read(TokenCursor& cursor, IntensityUnit& unit); ///< m/s2 needs no quotes
std::string_view nameOf(IntensityUnit unit);

/// How a run ended.
enum class Verdict
{
    stands,       ///< the end time was reached within the limit of the criterion
    meets,        ///< the quantity of the criterion exceeded its limit
    notConverged, ///< a step could not be solved: the verdict is unknown
    interrupted   ///< by a signal
};

/// A completed run.
struct Trial
{
    double intensity = 0; ///< in the unit of the plan
    Verdict verdict = Verdict::stands;
};

/// The order in which intensities are tried.
struct IntensityPlan
{
    IntensityUnit unit = IntensityUnit::g;

    /// The intensities to try next. Depends only on its argument, so that the number of threads has no
    /// influence.
    /// \param trials all so far, in any order
    /// \return intensities of runs that may be concurrent; empty at the end
    std::function<std::vector<double>(const std::vector<Trial>& trials)> next;

    long mostRuns = 0;        ///< that this takes, for one motion of the ground
    bool isBisection = false; ///< takes the verdict to change once
    double interval = 0;      ///< the widest that may be left between one that meets and the next below
};

/// All types: step, bisection, list.
const Registry<IntensityPlan>& intensityTypes();

/// The conclusion from a set of runs about the least intensity that meets the criterion.
struct LeastIntensity
{
    enum class Kind
    {
        found,       ///< `value` meets it, and `below`, the next lower one tried, does not
        belowRange,  ///< the lowest one tried, `value`, meets it already
        aboveRange,  ///< none meets it; the highest one tried is `value`
        notConverged ///< a run that did not converge lies below the first that meets it; that one is `value`
    };
    Kind kind = Kind::aboveRange;
    double value = 0;
    double below = 0;
    bool isMonotone = true; ///< no run above `value` stands
};

/// \param trials at least one, in any order
LeastIntensity leastIntensity(std::vector<Trial> trials);

} // namespace drystone
