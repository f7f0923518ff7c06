// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Limit analyses of the plane that differ in friction and loads only, several at once: one in each lane of
/// the processor's vector registers. Beside the interior point of InteriorPoint.h, which solves any program
/// and proves that there is no solution where there is none, because small programs leave most of a register,
/// and most of the time, unused there: samples of an ensemble are solved here some three times as fast. What
/// has no answer here is left to that solver.
#pragma once

#include "conic/ConeProgram.h"

#include <memory>
#include <vector>

namespace drystone
{

class LaneBeginnings;
class LaneGeometry;

/// The iterations are those of solveInteriorPoint. Answers do not depend on what else is solved, before or at
/// the same time, by a single bit: on the program, the tolerance and the references alone. Not for two
/// threads at once.
class LaneSolver
{
public:
    LaneSolver();
    ~LaneSolver();
    LaneSolver(const LaneSolver&) = delete;
    LaneSolver& operator=(const LaneSolver&) = delete;

    /// How many programs are solved at the same time: as many as a register of this processor has numbers.
    static int lanes();

    /// How many programs are best handed over at once: lanes take the next one as soon as their own has
    /// ended, and wait for each other once, at the end.
    static int together() { return 8 * lanes(); }

    /// Whether a program may be solved here: one with a multiplier, without inertia, gaps, compliance and
    /// strength, of some hundred bodies at most, all of whose points have friction, not a large one, the same
    /// for all points of two bodies.
    static bool takes(const PlaneConeProgram& program);

    /// Whether two programs may be solved together: the same points between the same bodies.
    static bool areAlike(const PlaneConeProgram& one, const PlaneConeProgram& other);

    /// From now on programs of the same points begin near the solution of the nearest of these, and are
    /// solved in fewer iterations the nearer it is; what is not answered from there, from scratch. Answers
    /// depend on the references, to the tolerance. \param references alike, each taken; none: all from
    /// scratch
    void beginFrom(std::vector<PlaneConeProgram> references);

    /// \param programs any number, all taken and alike; not null
    /// \param tolerance on every figure of the certificate
    /// \return a solution each, `optimal` where its certificate meets the tolerance, else `notConverged` and
    /// to be solved otherwise; with `forceOfLoadAlone` where forces were found that may carry it
    std::vector<ConeSolution> solve(const std::vector<const PlaneConeProgram*>& programs, double tolerance);

private:
    bool prepareBeginnings(const PlaneConeProgram& program, double tolerance);
    std::vector<ConeSolution> solveAtOnce(const std::vector<const PlaneConeProgram*>& programs,
                                          double tolerance, bool isBegun);

    std::vector<PlaneConeProgram> references;
    std::unique_ptr<LaneBeginnings> beginnings; ///< of the references, once a program like them is solved
    std::unique_ptr<LaneGeometry> geometry;     ///< of the last points
};

} // namespace drystone
