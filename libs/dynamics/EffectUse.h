// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a run with `selection automatic` has left out, and what that has saved.
#pragma once

namespace drystone
{

/// Sums over the steps of a run, times of the processor; steps that were tried and not taken, and parts of
/// steps, count each.
struct EffectUse
{
    long steps = 0;                     ///< all, parts of parted steps each
    long atRest = 0;                    ///< of them taken with a proof instead of a program
    double blocks = 0;                  ///< free ones, summed over the steps
    double awakeBlocks = 0;             ///< of them those that were simulated
    double secondsAtRest = 0;           ///< that these have taken, their proofs included [s]
    double secondsOfOthers = 0;         ///< that the others have taken [s]
    long verified = 0;                  ///< steps that were solved with everything on, too
    double secondsOfVerified = 0;       ///< that they have taken with everything on [s]
    double largestDifference = 0;       ///< of a displacement [m]
    double timeOfLargestDifference = 0; ///< [s]
};

} // namespace drystone
