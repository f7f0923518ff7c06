// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Products with the matrices of a cone program, written for clarity: solvers keep their own faster forms.
#include "conic/ConeProgram.h"

#include <cmath>

namespace drystone
{

template<int Rows, int Forces>
Eigen::VectorXd applyEquilibrium(const ConeProgram<Rows, Forces>& program,
                                 const Eigen::VectorXd& contactForce)
{
    Eigen::VectorXd balanced = Eigen::VectorXd::Zero(Rows * program.bodies);
    for (int point = 0; point < program.points(); ++point)
    {
        addForce<Rows, Forces>(program.contacts[point], contactForce.template segment<Forces>(Forces * point),
                               balanced);
    }
    return balanced;
}

template<int Rows, int Forces>
Eigen::VectorXd applyTransposed(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& displacement)
{
    Eigen::VectorXd closing(Forces * program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        const auto& columns = program.contacts[point];
        for (int component = 0; component < Forces; ++component)
        {
            closing[Forces * point + component] = closingAlong(columns, component, displacement);
        }
    }
    return closing;
}

template<int Rows, int Forces>
Eigen::VectorXd gapOf(const ConeProgram<Rows, Forces>& program)
{
    return program.gap.size() > 0 ? program.gap : Eigen::VectorXd::Zero(Forces * program.points()).eval();
}

template<int Rows, int Forces>
Eigen::VectorXd gapAfter(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& displacement)
{
    return gapOf(program) - applyTransposed(program, displacement);
}

template<int Rows, int Forces>
Eigen::VectorXd gapUnder(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& contactForce)
{
    Eigen::VectorXd gap = gapOf(program);
    if (program.hasCompliance())
    {
        gap += program.compliance.cwiseProduct(contactForce);
    }
    return gap;
}

template<int Rows, int Forces>
Eigen::VectorXd applyInertia(const ConeProgram<Rows, Forces>& program, const Eigen::VectorXd& displacement)
{
    Eigen::VectorXd force = Eigen::VectorXd::Zero(Rows * program.bodies);
    if (program.hasInertia())
    {
        for (int body = 0; body < program.bodies; ++body)
        {
            force.template segment<Rows>(Rows * body) =
                program.inertia[body] * displacement.template segment<Rows>(Rows * body);
        }
    }
    return force;
}

template<int Rows, int Forces>
double objective(const ConeProgram<Rows, Forces>& program, const ConeSolution& solution)
{
    double value = 0.5 * applyInertia(program, solution.displacement).dot(solution.displacement);
    if (program.gap.size() > 0)
    {
        value += program.gap.dot(solution.contactForce);
    }
    if (program.hasCompliance())
    {
        value += 0.5 * program.compliance.dot(solution.contactForce.cwiseAbs2());
    }
    return program.hasMultiplier() ? value - solution.multiplier : value;
}

template<int Rows, int Forces>
double meanLeverArm(const ConeProgram<Rows, Forces>& program)
{
    double forceSum = 0;
    double momentSum = 0;
    for (const auto& columns : program.contacts)
    {
        for (const auto* part : {&columns.onFirst, &columns.onSecond})
        {
            forceSum += part->template topRows<Forces>().squaredNorm();
            momentSum += part->template bottomRows<Rows - Forces>().squaredNorm();
        }
    }
    return forceSum > 0 && momentSum > 0 ? std::sqrt(momentSum / forceSum) : 1;
}

template<int Rows, int Forces>
ConeProgram<Rows, Forces> withUnitInertia(ConeProgram<Rows, Forces> program)
{
    const double lever = meanLeverArm(program);
    Eigen::Matrix<double, Rows, 1> inertia;
    inertia.template head<Forces>().setOnes();
    inertia.template tail<Rows - Forces>().setConstant(lever * lever);
    program.inertia.assign(program.bodies, inertia.asDiagonal().toDenseMatrix());
    return program;
}

void addWork(SolverWork& whole, const SolverWork& part)
{
    whole.iterations += part.iterations;
    whole.factorisations += part.factorisations;
    whole.solves += part.solves;
}

std::string_view nameOf(SolveStatus status)
{
    switch (status)
    {
    case SolveStatus::optimal:
        return "optimal";
    case SolveStatus::infeasible:
        return "infeasible";
    case SolveStatus::unbounded:
        return "unbounded";
    case SolveStatus::notConverged:
        break;
    }
    return "notConverged";
}

template double objective(const PlaneConeProgram&, const ConeSolution&);
template double objective(const SpaceConeProgram&, const ConeSolution&);
template double meanLeverArm(const PlaneConeProgram&);
template double meanLeverArm(const SpaceConeProgram&);
template PlaneConeProgram withUnitInertia(PlaneConeProgram);
template SpaceConeProgram withUnitInertia(SpaceConeProgram);
template Eigen::VectorXd applyEquilibrium(const PlaneConeProgram&, const Eigen::VectorXd&);
template Eigen::VectorXd applyEquilibrium(const SpaceConeProgram&, const Eigen::VectorXd&);
template Eigen::VectorXd applyTransposed(const PlaneConeProgram&, const Eigen::VectorXd&);
template Eigen::VectorXd applyTransposed(const SpaceConeProgram&, const Eigen::VectorXd&);
template Eigen::VectorXd gapOf(const PlaneConeProgram&);
template Eigen::VectorXd gapOf(const SpaceConeProgram&);
template Eigen::VectorXd gapAfter(const PlaneConeProgram&, const Eigen::VectorXd&);
template Eigen::VectorXd gapAfter(const SpaceConeProgram&, const Eigen::VectorXd&);
template Eigen::VectorXd gapUnder(const PlaneConeProgram&, const Eigen::VectorXd&);
template Eigen::VectorXd gapUnder(const SpaceConeProgram&, const Eigen::VectorXd&);
template Eigen::VectorXd applyInertia(const PlaneConeProgram&, const Eigen::VectorXd&);
template Eigen::VectorXd applyInertia(const SpaceConeProgram&, const Eigen::VectorXd&);

} // namespace drystone
