// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How much work a time step may take before it is given up: counted, not timed, so that a run ends at the
/// same step on every machine.
#pragma once

#include <algorithm>
#include <limits>

namespace drystone
{

/// The work of one step with its programs, impacts and shorter attempts, in factorisations of a program of
/// usual size.
struct StepWork
{
    double most = std::numeric_limits<double>::infinity();
    double done = 0;
    double mostOfAttempt = std::numeric_limits<double>::infinity(); ///< `done` at which it is given up
    int mostPoints = 0;                                             ///< of a program
    int attempts = 0;                                               ///< at the step, shorter ones included

    bool isUsedUp() const { return done > 0.99 * most; }

    /// An attempt may take half of what is left, so that a shorter one, which is easier, has its turn.
    void beginAttempt()
    {
        ++attempts;
        mostOfAttempt = done + (most - done) / 2;
    }
};

/// The work of programs with so many contact points: walls have 4 to 6 a block, and what has more than eight
/// costs as many times more. A hundred sweeps of gaussSeidel count as a factorisation.
/// \param iterations of all programs together \param factorisations likewise
inline double workOf(int iterations, int factorisations, int points, int bodies)
{
    constexpr double pointsPerBody = 8;
    constexpr double sweepsPerFactorisation = 100;
    const double sweeps = std::max(0, iterations - factorisations);
    return (factorisations + sweeps / sweepsPerFactorisation)
           * std::max(1.0, points / (pointsPerBody * std::max(1, bodies)));
}

} // namespace drystone
