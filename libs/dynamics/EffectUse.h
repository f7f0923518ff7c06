// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a run with `selection automatic` has left out, and what that has saved.
#pragma once

#include <vector>

namespace drystone
{

/// How often an effect acted (EffectCalls.h): a step that it did not act on is the same without it.
struct EffectCallSums
{
    long steps = 0;    ///< on which it acted
    double places = 0; ///< share of the points, or blocks, on which it did, summed over all steps
};

/// Sums over the steps of a run, times those of their stages (StageTimes); steps that were tried and not
/// taken, and parts of steps, count each.
struct EffectUse
{
    long steps = 0;                     ///< all, parts of parted steps each
    long atRest = 0;                    ///< of them taken with a proof instead of a program
    long sticking = 0;                  ///< by the associative law, see StickingStep.h
    double blocks = 0;                  ///< free ones, summed over the steps
    double awakeBlocks = 0;             ///< of them those that were simulated
    double bodies = 0;                  ///< that these were, blocks that moved as one being one
    std::vector<EffectCallSums> calls;  ///< one an effect of namesOfEffects
    double secondsAtRest = 0;           ///< that these have taken, their proofs included [s]
    double secondsOfOthers = 0;         ///< that the others have taken [s]
    long verified = 0;                  ///< steps that were solved with all effects, too
    double secondsOfVerified = 0;       ///< that they have taken with all effects [s]
    double largestDifference = 0;       ///< of a displacement [m]
    double timeOfLargestDifference = 0; ///< [s]
};

} // namespace drystone
