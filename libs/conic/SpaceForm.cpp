// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/SpaceForm.h"

#include "conic/Certificate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

/// The power of two next to a value, so that scaling by it changes no digit; 1 for zero.
double powerOfTwo(double value)
{
    return value > 0 && std::isfinite(value) ? std::exp2(std::round(std::log2(value))) : 1;
}

/// Diagonal that divides moments by the lever arm.
Eigen::Matrix<double, 6, 1> rowScale(double lever)
{
    Eigen::Matrix<double, 6, 1> scale;
    scale << 1, 1, 1, 1 / lever, 1 / lever, 1 / lever;
    return scale;
}

/// Diagonal of T.
Eigen::Vector3d coneScale(double mu)
{
    return Eigen::Vector3d(1, mu, mu) / std::sqrt(1 + mu * mu);
}

/// A vector of body rows in elimination order, scaled, with six zeros at its end for the ground.
VectorXd scaledLoad(const SpaceForm& form, const VectorXd& rows, double& scale)
{
    VectorXd result = VectorXd::Zero(6 * (form.bodies + 1));
    const auto divide = rowScale(form.scaling.lever);
    for (int body = 0; body < form.bodies; ++body)
    {
        result.segment<6>(6 * form.position[body]) = rows.segment<6>(6 * body).cwiseProduct(divide);
    }
    scale = powerOfTwo(result.lpNorm<Eigen::Infinity>());
    result /= scale;
    return result;
}

} // namespace

SpaceForm makeSpaceForm(const SpaceConeProgram& program)
{
    if (program.hasStrength())
    {
        throw std::invalid_argument("solvers of space take cones only, no strength");
    }
    SpaceForm form;
    form.bodies = program.bodies;
    form.scaling.lever = powerOfTwo(meanLeverArm(program));
    for (const auto& columns : program.contacts)
    {
        if (columns.first >= 0 && columns.second >= 0
            && (form.couplings.empty() || form.couplings.back() != Coupling{columns.first, columns.second}))
        {
            form.couplings.push_back({columns.first, columns.second});
        }
    }
    const std::vector<int> order = eliminationOrder(program.bodies, form.couplings);
    form.position.assign(program.bodies, 0);
    for (int place = 0; place < program.bodies; ++place)
    {
        form.position[order[place]] = place;
    }
    for (Coupling& pair : form.couplings)
    {
        pair = {form.position[pair[0]], form.position[pair[1]]};
    }

    const auto rows = rowScale(form.scaling.lever);
    for (int point = 0; point < program.points(); ++point)
    {
        const auto& columns = program.contacts[point];
        const int one = columns.first < 0 ? form.bodies : form.position[columns.first];
        const int other = columns.second < 0 ? form.bodies : form.position[columns.second];
        const Eigen::Vector3d cone = coneScale(program.friction[point]);
        // The fixed ground has no rows: what a point does to it is zero, so that loops need not ask.
        Eigen::Matrix<double, 6, 3> onOne = rows.asDiagonal() * columns.onFirst * cone.asDiagonal();
        Eigen::Matrix<double, 6, 3> onOther = rows.asDiagonal() * columns.onSecond * cone.asDiagonal();
        onOne *= columns.first < 0 ? 0 : 1;
        onOther *= columns.second < 0 ? 0 : 1;
        form.points.push_back({std::min(one, other), std::max(one, other), -1, one < other ? onOne : onOther,
                               one < other ? onOther : onOne});
    }

    form.load = scaledLoad(form, program.load, form.scaling.load);
    if (program.hasMultiplier())
    {
        form.liveLoad = scaledLoad(form, program.liveLoad, form.scaling.liveLoad);
        form.liveWork = powerOfTwo(form.liveLoad.lpNorm<1>());
    }
    // y~ = y / displacement turns L'y = 1 into L~'y~ = w (limit analysis), and Mbar into M~ = Mbar
    // displacement / load, which should be of order one (time step).
    form.scaling.displacement = 1 / (form.scaling.liveLoad * form.liveWork);
    if (program.hasInertia())
    {
        double largest = 0;
        for (const auto& block : program.inertia)
        {
            largest = std::max(largest, block.topLeftCorner<3, 3>().cwiseAbs().maxCoeff());
        }
        form.scaling.displacement = form.scaling.load / powerOfTwo(largest);
        form.inertia.resize(program.bodies);
        for (int body = 0; body < program.bodies; ++body)
        {
            form.inertia[form.position[body]] = rows.asDiagonal() * program.inertia[body] * rows.asDiagonal()
                                                * (form.scaling.displacement / form.scaling.load);
        }
    }
    form.gap = VectorXd::Zero(3 * form.pointCount());
    for (int point = 0; program.gap.size() > 0 && point < program.points(); ++point)
    {
        form.gap.segment<3>(3 * point) =
            coneScale(program.friction[point]).cwiseProduct(program.gap.segment<3>(3 * point))
            / form.scaling.displacement;
    }
    return form;
}

SchurSystem<6> makeSchurSystem(SpaceForm& form)
{
    SchurSystem<6> system(form.bodies, form.couplings);
    for (SpaceForm::Point& point : form.points)
    {
        point.slot = point.second < form.bodies ? system.slot(point.first, point.second) : -1;
    }
    return system;
}

void applyTransposed(const SpaceForm& form, const VectorXd& y, VectorXd& out)
{
    out.resize(3 * form.pointCount());
    for (int point = 0; point < form.pointCount(); ++point)
    {
        const SpaceForm::Point& columns = form.points[point];
        out.segment<3>(3 * point) = columns.onFirst.transpose() * y.segment<6>(6 * columns.first)
                                    + columns.onSecond.transpose() * y.segment<6>(6 * columns.second);
    }
}

void addForces(const SpaceForm& form, const VectorXd& s, VectorXd& out)
{
    for (int point = 0; point < form.pointCount(); ++point)
    {
        const SpaceForm::Point& columns = form.points[point];
        const Eigen::Vector3d force = s.segment<3>(3 * point);
        out.segment<6>(6 * columns.first) += columns.onFirst * force;
        out.segment<6>(6 * columns.second) += columns.onSecond * force;
    }
    out.tail<6>().setZero();
}

void addInertia(const SpaceForm& form, const VectorXd& y, VectorXd& out)
{
    for (int body = 0; form.hasInertia() && body < form.bodies; ++body)
    {
        out.segment<6>(6 * body) += form.inertia[body] * y.segment<6>(6 * body);
    }
}

void assembleSchur(const SpaceForm& form, const std::vector<FramedMatrix>& d, double delta, double relative,
                   SchurSystem<6>& system)
{
    system.setZero();
    for (int body = 0; body < form.bodies; ++body)
    {
        auto& block = system.diagonal(body);
        if (form.hasInertia())
        {
            block = form.inertia[body];
        }
        block.diagonal().array() += delta;
    }
    for (int point = 0; point < form.pointCount(); ++point)
    {
        const SpaceForm::Point& columns = form.points[point];
        if (columns.first >= form.bodies)
        {
            continue;
        }
        const Eigen::Matrix3d frame = d[point].frame();
        const Eigen::Matrix<double, 6, 3> first = columns.onFirst * frame;
        const Eigen::Matrix<double, 6, 3> firstD = first * d[point].eigenvalues.asDiagonal();
        system.diagonal(columns.first).noalias() += firstD * first.transpose();
        if (columns.slot >= 0)
        {
            const Eigen::Matrix<double, 6, 3> second = columns.onSecond * frame;
            const Eigen::Matrix<double, 6, 3> secondD = second * d[point].eigenvalues.asDiagonal();
            system.coupling(columns.slot).noalias() += secondD * first.transpose();
            system.diagonal(columns.second).noalias() += secondD * second.transpose();
        }
    }
    for (int body = 0; relative > 0 && body < form.bodies; ++body)
    {
        system.diagonal(body).diagonal() *= 1 + relative;
    }
}

VectorXd toCones(const SpaceConeProgram& program, const SpaceForm& form, const VectorXd& contactForce)
{
    VectorXd s = contactForce / form.scaling.load;
    for (int point = 0; point < program.points(); ++point)
    {
        for (int column = 0; column < 3; ++column)
        {
            const double scale = coneScale(program.friction[point])[column];
            s[3 * point + column] = scale > 0 ? s[3 * point + column] / scale : 0;
        }
    }
    return s;
}

ConeSolution fromCones(const SpaceConeProgram& program, const SpaceForm& form, const VectorXd& s,
                       const VectorXd& y, double multiplier)
{
    ConeSolution solution;
    solution.multiplier = multiplier * form.scaling.load / form.scaling.liveLoad;
    solution.contactForce = s * form.scaling.load;
    for (int point = 0; point < program.points(); ++point)
    {
        solution.contactForce.segment<3>(3 * point).array() *= coneScale(program.friction[point]).array();
    }
    solution.displacement = VectorXd::Zero(6 * program.bodies);
    const auto rows = rowScale(form.scaling.lever);
    for (int body = 0; body < program.bodies; ++body)
    {
        solution.displacement.segment<6>(6 * body) =
            y.segment<6>(6 * form.position[body]).cwiseProduct(rows) * form.scaling.displacement;
    }
    return solution;
}

} // namespace drystone
