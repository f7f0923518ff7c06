// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where no answer comes, the support is pushed in a guide of rollers, which shows whether it is locked in.
#include "statics/Settlement.h"

#include "conic/form/Form.h"
#include "geometry/space/Frame.h"

namespace drystone
{

template<int Dim>
Eigen::VectorXd settlementGaps(const Assembly<Dim>& assembly, const std::vector<ContactPoint<Dim>>& points,
                               const SupportMovement<Dim>& movement)
{
    Eigen::VectorXd gaps = Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(points.size()));
    const auto moves = [&](int block) { return assembly.blocks[block].support == movement.support; };
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        // The normal points into `block`: what moves that block opens, what moves the neighbour closes.
        const double sign = moves(points[i].block) ? 1 : moves(points[i].neighbour) ? -1 : 0;
        gaps.segment<Dim>(Dim * static_cast<Eigen::Index>(i)) =
            sign * (contactFrame(points[i]).transpose() * movement.direction);
    }
    return gaps;
}

namespace
{

/// Frictionless rollers that keep a body in a guide along `direction`: forces to either side across it, each
/// with moments of either sense about every axis, so that sums of them are any force across and any moment.
std::vector<ConeColumns<3, 2>> rollersOfGuide(int body, const Vector<2>& direction, double lever)
{
    std::vector<ConeColumns<3, 2>> rollers;
    const Vector<2> across(-direction.y(), direction.x());
    for (const double side : {1.0, -1.0})
    {
        for (const double arm : {lever, -lever})
        {
            ConeColumns<3, 2> roller;
            roller.first = body;
            roller.onFirst << side * across.x(), side * direction.x(), side * across.y(),
                side * direction.y(), side * arm, 0;
            rollers.push_back(roller);
        }
    }
    return rollers;
}

std::vector<ConeColumns<6, 3>> rollersOfGuide(int body, const Vector<3>& direction, double lever)
{
    std::vector<ConeColumns<6, 3>> rollers;
    const Eigen::Matrix3d frame = frameOf(direction);
    for (const int across : {1, 2})
    {
        for (const double side : {1.0, -1.0})
        {
            for (int axis = 0; axis < 3; ++axis)
            {
                for (const double arm : {lever, -lever})
                {
                    ConeColumns<6, 3> roller;
                    roller.first = body;
                    roller.onFirst.col(0).head<3>() = side * frame.col(across);
                    roller.onFirst.col(0).tail<3>() = arm * frame.col(axis);
                    roller.onFirst.col(1).head<3>() = side * frame.col(3 - across);
                    roller.onFirst.col(2).head<3>() = frame.col(0);
                    rollers.push_back(roller);
                }
            }
        }
    }
    return rollers;
}

/// The support as a body without weight in a frictionless guide along its movement d, pushed by alpha d. At a
/// point of it the gap g of a unit movement is F'd, F the part of the free body's columns in its rows of
/// forces, and -F the support's. So its balance along d is -g'c = alpha, and the largest alpha is -R.
template<int Rows, int Forces>
ConeProgram<Rows, Forces> withGuidedSupport(ConeProgram<Rows, Forces> program)
{
    using Force = Eigen::Matrix<double, Forces, 1>;
    const double lever = meanLeverArm(program);
    const int support = program.bodies++;
    Force direction = Force::Zero();
    for (int point = 0; point < program.points(); ++point)
    {
        const Force gap = program.gap.template segment<Forces>(Forces * point);
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
        const Eigen::Matrix<double, Forces, Forces> forces = columns.onFirst.template topRows<Forces>();
        direction = forces * gap;
        // The guide bears moments, so that lever arms on the support do not matter.
        columns.second = support;
        columns.onSecond.setZero();
        columns.onSecond.template topRows<Forces>() = -forces;
    }
    for (const ConeColumns<Rows, Forces>& roller : rollersOfGuide(support, direction, lever))
    {
        program.contacts.push_back(roller);
        program.friction.push_back(0);
        if (program.hasStrength())
        {
            program.strength.emplace_back();
        }
    }
    program.load.conservativeResize(Rows * program.bodies);
    program.load.template tail<Rows>().setZero();
    program.liveLoad = Eigen::VectorXd::Zero(Rows * program.bodies);
    program.liveLoad.template segment<Forces>(Rows * support) = direction;
    program.gap.resize(0);
    return program;
}

/// Whether the structure does not stand at all, in which gaps have no part. \param result then the proof;
/// work is added to it
template<int Rows, int Forces>
bool isUnstable(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                SymbolicAnalysis& symbolic, LimitAnalysis& result)
{
    ConeProgram<Rows, Forces> dead = program;
    dead.gap.resize(0);
    const ConeSolution standing = solveInteriorPoint(dead, settings, &symbolic);
    addWork(result, standing);
    if (standing.status != SolveStatus::infeasible)
    {
        return false;
    }
    result.status = CollapseStatus::unstable;
    result.certificate = certify(dead, standing);
    result.mechanism = standing.displacement / standing.displacement.lpNorm<Eigen::Infinity>();
    return true;
}

/// Whether the support is locked in, so that it can be pushed against its neighbours with any force. \param
/// solution if not, improved where the push has found a better one \param result if so the proof; work is
/// added to it
template<int Rows, int Forces>
bool isLockedIn(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings,
                ConeSolution& solution, LimitAnalysis& result)
{
    const ConeProgram<Rows, Forces> guided = withGuidedSupport(program);
    const ConeSolution pushed = solveInteriorPoint(guided, settings);
    addWork(result, pushed);
    if (pushed.status == SolveStatus::unbounded)
    {
        result.status = CollapseStatus::unbounded;
        result.certificate = certify(guided, pushed);
        result.contactForce = pushed.contactForce.head(Forces * program.points());
        result.mechanism = Eigen::VectorXd::Zero(Rows * program.bodies);
        return true;
    }
    if (pushed.status == SolveStatus::optimal)
    {
        // L'y = 1 is the unit movement.
        ConeSolution settled = solution;
        settled.status = SolveStatus::optimal;
        settled.contactForce = pushed.contactForce.head(Forces * program.points());
        settled.displacement = pushed.displacement.head(Rows * program.bodies);
        if (certifyOptimal(program, settled).worst() <= settings.tolerance)
        {
            solution = std::move(settled);
        }
    }
    return false;
}

} // namespace

template<int Rows, int Forces>
LimitAnalysis solveSettlement(const ConeProgram<Rows, Forces>& program, const InteriorPointSettings& settings)
{
    SymbolicAnalysis symbolic;
    ConeSolution solution = solveInteriorPoint(program, settings, &symbolic);
    LimitAnalysis result;
    result.variables = Forces * program.points();
    addWork(result, solution);
    result.contactForce = Eigen::VectorXd::Zero(Forces * program.points());
    if (solution.status != SolveStatus::optimal
        && (isUnstable(program, settings, symbolic, result)
            || isLockedIn(program, settings, solution, result)))
    {
        return result;
    }
    result.certificate = certify(program, solution);
    result.status =
        solution.status == SolveStatus::optimal ? CollapseStatus::optimal : CollapseStatus::notConverged;
    result.alpha = program.gap.dot(solution.contactForce);
    result.contactForce = std::move(solution.contactForce);
    result.mechanism = std::move(solution.displacement);
    return result;
}

template Eigen::VectorXd settlementGaps(const Assembly<2>& assembly,
                                        const std::vector<ContactPoint<2>>& points,
                                        const SupportMovement<2>& movement);
template Eigen::VectorXd settlementGaps(const Assembly<3>& assembly,
                                        const std::vector<ContactPoint<3>>& points,
                                        const SupportMovement<3>& movement);
template LimitAnalysis solveSettlement(const PlaneConeProgram& program,
                                       const InteriorPointSettings& settings);
template LimitAnalysis solveSettlement(const SpaceConeProgram& program,
                                       const InteriorPointSettings& settings);

} // namespace drystone
