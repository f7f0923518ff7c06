// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// One program of unit masses for each multiplier; the motion it leaves is the mechanism of the next bound.
#include "conic/UpperBounds.h"

#include "conic/AugmentedLagrangian.h"
#include "conic/Certificate.h"
#include "conic/form/Form.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace drystone
{

template<int Rows, int Forces>
bool hasUpperBounds(const ConeProgram<Rows, Forces>& program)
{
    return program.hasMultiplier() && !program.hasInertia() && !program.hasStrength()
           && !program.hasCompliance() && program.gap.size() == 0;
}

template<int Rows, int Forces>
ConeSolution solveByUpperBounds(const ConeProgram<Rows, Forces>& program, double from, double tolerance,
                                int maximumIterations)
{
    constexpr int mostBounds = 40;
    const AugmentedLagrangianSettings exact = exactSettings(maximumIterations);
    if (!hasUpperBounds(program))
    {
        throw std::invalid_argument(
            "solveByUpperBounds needs a multiplier, and neither inertia, gaps nor strengths");
    }
    ConeProgram<Rows, Forces> pushed = withUnitInertia(program);
    pushed.liveLoad.resize(0);
    SymbolicAnalysis symbolic;
    ConeSolution nearest; // of the last program
    ConeSolution solution;
    solution.multiplier = std::isfinite(from) ? from : 0;
    solution.contactForce = Eigen::VectorXd::Zero(Forces * program.points());
    solution.displacement = Eigen::VectorXd::Zero(program.load.size());
    double further = 1;
    for (int bound = 0; bound < mostBounds; ++bound)
    {
        pushed.load = program.load + solution.multiplier * program.liveLoad;
        nearest = solveAugmentedLagrangian(pushed, nearest, exact, &symbolic);
        addWork(solution, nearest);
        solution.contactForce = nearest.contactForce;
        if (certifyOptimal(program, solution).worst() <= tolerance)
        {
            solution.status = SolveStatus::optimal;
            break;
        }
        const double work = program.liveLoad.dot(nearest.displacement);
        if (!(work > 0)) // carried, or too low: from further above, and not from where it was before
        {
            solution.multiplier += further * std::max(1.0, std::abs(solution.multiplier));
            further /= 2;
            continue;
        }
        solution.displacement = nearest.displacement / work;
        solution.multiplier = -program.load.dot(solution.displacement);
    }
    return solution;
}

template bool hasUpperBounds(const PlaneConeProgram&);
template bool hasUpperBounds(const SpaceConeProgram&);
template ConeSolution solveByUpperBounds(const PlaneConeProgram&, double, double, int);
template ConeSolution solveByUpperBounds(const SpaceConeProgram&, double, double, int);

} // namespace drystone
