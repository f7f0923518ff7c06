// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "statics/Settlement.h"

#include "conic/RayProgram.h"

namespace drystone
{

Eigen::VectorXd settlementGaps(const Assembly<2>& assembly, const std::vector<ContactPoint<2>>& points,
                               const SupportMovement& movement)
{
    Eigen::VectorXd gaps = Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(points.size()));
    const auto moves = [&](int block) { return assembly.blocks[block].support == movement.support; };
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        // The normal points into `block`: what moves that block opens, what moves the neighbour closes.
        const double sign = moves(points[i].block) ? 1 : moves(points[i].neighbour) ? -1 : 0;
        gaps.segment<2>(2 * static_cast<Eigen::Index>(i)) << sign * points[i].normal.dot(movement.direction),
            sign * tangent(points[i]).dot(movement.direction);
    }
    return gaps;
}

LimitAnalysis solveSettlement(const PlaneConeProgram& program, const InteriorPointSettings& settings)
{
    SymbolicAnalysis symbolic;
    ConeSolution solution = solveInteriorPoint(program, settings, &symbolic);
    LimitAnalysis result;
    result.variables = 2 * program.points();
    result.iterations = solution.iterations;
    result.factorisations = solution.factorisations;
    result.solves = solution.solves;
    result.contactForce = Eigen::VectorXd::Zero(2 * program.points());
    if (solution.status != SolveStatus::optimal)
    {
        // Does it stand at all? Gaps have no part in that.
        PlaneConeProgram dead = program;
        dead.gap.resize(0);
        const ConeSolution standing = solveInteriorPoint(dead, settings, &symbolic);
        result.iterations += standing.iterations;
        result.factorisations += standing.factorisations;
        result.solves += standing.solves;
        if (standing.status == SolveStatus::infeasible)
        {
            result.status = CollapseStatus::unstable;
            result.certificate = certify(dead, standing);
            result.mechanism = standing.displacement / standing.displacement.lpNorm<Eigen::Infinity>();
            return result;
        }
    }
    result.certificate = certify(program, solution);
    result.status =
        solution.status == SolveStatus::optimal ? CollapseStatus::optimal : CollapseStatus::notConverged;
    result.alpha = program.gap.dot(solution.contactForce);
    result.contactForce = std::move(solution.contactForce);
    result.mechanism = std::move(solution.displacement);
    return result;
}

} // namespace drystone
