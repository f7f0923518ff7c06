// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "statics/Settlement.h"

#include "conic/form/Form.h"

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

namespace
{

/// The support as a body without weight in a frictionless guide along its movement d, pushed by alpha d. At a
/// point of it the gap g of a unit movement is F'd, F the part of the free body's columns in its rows of
/// forces, and -F the support's. So its balance along d is -g'c = alpha, and the largest alpha is -R.
PlaneConeProgram withGuidedSupport(PlaneConeProgram program)
{
    const double lever = meanLeverArm(program);
    const int support = program.bodies++;
    Vector<2> direction(0, 0);
    for (int point = 0; point < program.points(); ++point)
    {
        const Eigen::Vector2d gap = program.gap.segment<2>(2 * point);
        if (gap.isZero(0))
        {
            continue;
        }
        auto& columns = program.contacts[static_cast<std::size_t>(point)];
        if (columns.second >= 0)
        {
            std::swap(columns.first, columns.second);
            std::swap(columns.onFirst, columns.onSecond);
        }
        const Eigen::Matrix2d forces = columns.onFirst.topRows<2>();
        direction = forces * gap;
        // The guide bears moments, so that lever arms on the support do not matter.
        columns.second = support;
        columns.onSecond.setZero();
        columns.onSecond.topRows<2>() = -forces;
    }
    const Vector<2> across(-direction.y(), direction.x());
    for (const double side : {1.0, -1.0})
    {
        for (const double arm : {lever, -lever})
        {
            ConeColumns<3, 2> roller;
            roller.first = support;
            roller.onFirst << side * across.x(), side * direction.x(), side * across.y(),
                side * direction.y(), side * arm, 0;
            program.contacts.push_back(roller);
            program.friction.push_back(0);
            if (program.hasStrength())
            {
                program.strength.emplace_back();
            }
        }
    }
    program.load.conservativeResize(3 * program.bodies);
    program.load.tail<3>().setZero();
    program.liveLoad = Eigen::VectorXd::Zero(3 * program.bodies);
    program.liveLoad.tail<3>() << direction, 0;
    program.gap.resize(0);
    return program;
}

} // namespace

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
        // Is the support locked in, so that it can be pushed against its neighbours with any force?
        const PlaneConeProgram guided = withGuidedSupport(program);
        const ConeSolution pushed = solveInteriorPoint(guided, settings);
        result.iterations += pushed.iterations;
        result.factorisations += pushed.factorisations;
        result.solves += pushed.solves;
        if (pushed.status == SolveStatus::unbounded)
        {
            result.status = CollapseStatus::unbounded;
            result.certificate = certify(guided, pushed);
            result.contactForce = pushed.contactForce.head(2 * program.points());
            result.mechanism = Eigen::VectorXd::Zero(3 * program.bodies);
            return result;
        }
        if (pushed.status == SolveStatus::optimal)
        {
            // L'y = 1 is the unit movement.
            ConeSolution settled = solution;
            settled.status = SolveStatus::optimal;
            settled.contactForce = pushed.contactForce.head(2 * program.points());
            settled.displacement = pushed.displacement.head(3 * program.bodies);
            if (certifyOptimal(program, settled).worst() <= settings.tolerance)
            {
                solution = std::move(settled);
            }
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
