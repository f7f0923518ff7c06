// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/RayProgram.h"

#include "conic/Certificate.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// The power of two next to a value, so that scaling by it changes no digit; 1 for zero.
double powerOfTwo(double value)
{
    return value > 0 && std::isfinite(value) ? std::exp2(std::round(std::log2(value))) : 1;
}

/// Rows of one body with the moment divided by the lever arm.
Eigen::Vector3d scaledRows(const Eigen::Vector3d& rows, double lever)
{
    return {rows[0], rows[1], rows[2] / lever};
}

/// A vector of body rows in elimination order, scaled, with three zeros at its end for the ground. Also its
/// scale.
Eigen::VectorXd scaledLoad(const RayForm& form, const Eigen::VectorXd& rows, double& scale)
{
    const RayProgram& rays = form.program;
    Eigen::VectorXd result = Eigen::VectorXd::Zero(3 * (rays.bodies + 1));
    for (int body = 0; body < rays.bodies; ++body)
    {
        result.segment<3>(3 * rays.position[body]) =
            scaledRows(rows.segment<3>(3 * body), form.scaling.lever);
    }
    scale = powerOfTwo(result.lpNorm<Eigen::Infinity>());
    result /= scale;
    return result;
}

/// Directions of the rays of a point: (1, mu), (1, -mu), or (1, 0) alone without friction.
int rayDirections(double mu, Eigen::Vector2d (&direction)[2])
{
    const double length = std::sqrt(1 + mu * mu);
    direction[0] = Eigen::Vector2d(1, mu) / length;
    direction[1] = Eigen::Vector2d(1, -mu) / length;
    return mu > 0 ? 2 : 1;
}

} // namespace

RayForm makeRayForm(const PlaneConeProgram& program)
{
    RayForm form;
    RayProgram& rays = form.program;
    rays.bodies = program.bodies;
    form.scaling.lever = powerOfTwo(meanLeverArm(program));

    for (const auto& columns : program.contacts)
    {
        const bool isCoupled = columns.first >= 0 && columns.second >= 0;
        // Points of one pair of bodies follow each other.
        if (isCoupled
            && (form.couplings.empty() || form.couplings.back() != Coupling{columns.first, columns.second}))
        {
            form.couplings.push_back({columns.first, columns.second});
        }
    }
    const std::vector<int> order = eliminationOrder(program.bodies, form.couplings);
    rays.position.assign(program.bodies, 0);
    for (int place = 0; place < program.bodies; ++place)
    {
        rays.position[order[place]] = place;
    }
    for (Coupling& pair : form.couplings)
    {
        pair = {rays.position[pair[0]], rays.position[pair[1]]};
    }

    form.firstRay.reserve(program.contacts.size() + 1);
    for (int point = 0; point < program.points(); ++point)
    {
        const auto& columns = program.contacts[point];
        const int one = columns.first < 0 ? rays.bodies : rays.position[columns.first];
        const int other = columns.second < 0 ? rays.bodies : rays.position[columns.second];
        const int first = std::min(one, other);
        const int second = std::max(one, other);
        if (rays.groups.empty() || rays.groups.back().first != first || rays.groups.back().second != second)
        {
            rays.groups.push_back({first, second, rays.rayCount(), rays.rayCount(), -1});
        }
        form.firstRay.push_back(rays.rayCount());
        Eigen::Vector2d direction[2];
        const int count = rayDirections(program.friction[point], direction);
        for (int ray = 0; ray < count; ++ray)
        {
            const Eigen::Vector3d onOne = scaledRows(columns.onFirst * direction[ray], form.scaling.lever);
            const Eigen::Vector3d onOther = scaledRows(columns.onSecond * direction[ray], form.scaling.lever);
            rays.rays.push_back(one < other ? RayProgram::Ray{onOne, onOther}
                                            : RayProgram::Ray{onOther, onOne});
        }
        rays.groups.back().end = rays.rayCount();
    }
    form.firstRay.push_back(rays.rayCount());
    for (RayProgram::Group& group : rays.groups)
    {
        // The fixed ground has no rows: what a ray does to it is zero, so that loops need not ask.
        for (int ray = group.begin; ray < group.end; ++ray)
        {
            if (group.second == rays.bodies)
            {
                rays.rays[ray].onSecond.setZero();
            }
            if (group.first == rays.bodies)
            {
                rays.rays[ray].onFirst.setZero();
            }
        }
    }
    if (program.hasInertia())
    {
        rays.inertia.assign(rays.bodies, RayProgram::Inertia::Zero());
    }
    updateRayForm(form, program);
    return form;
}

SchurSystem<3> makeSchurSystem(RayForm& form)
{
    SchurSystem<3> system(form.program.bodies, form.couplings);
    for (RayProgram::Group& group : form.program.groups)
    {
        group.slot = group.second < form.program.bodies ? system.slot(group.first, group.second) : -1;
    }
    return system;
}

void updateRayForm(RayForm& form, const PlaneConeProgram& program)
{
    RayProgram& rays = form.program;
    RayScaling& scaling = form.scaling;
    rays.load = scaledLoad(form, program.load, scaling.load);
    scaling.liveLoad = 1;
    rays.liveLoad.resize(0);
    if (program.hasMultiplier())
    {
        rays.liveLoad = scaledLoad(form, program.liveLoad, scaling.liveLoad);
        rays.liveWork = powerOfTwo(rays.liveLoad.lpNorm<1>());
    }

    // y~ = y / displacement turns L'y = 1 into L~'y~ = w (limit analysis), and Mbar into M~ = Mbar
    // displacement / load, which should be of order one (time step).
    scaling.displacement = 1 / (scaling.liveLoad * rays.liveWork);
    if (program.hasInertia())
    {
        double largest = 0;
        for (const auto& block : program.inertia)
        {
            largest = std::max(largest, block.topLeftCorner<2, 2>().cwiseAbs().maxCoeff());
        }
        scaling.displacement = scaling.load / powerOfTwo(largest);
        const Eigen::Vector3d row(1, 1, 1 / scaling.lever);
        for (int body = 0; body < rays.bodies; ++body)
        {
            rays.inertia[rays.position[body]] = row.asDiagonal() * program.inertia[body] * row.asDiagonal()
                                                * (scaling.displacement / scaling.load);
        }
    }

    rays.gap = Eigen::VectorXd::Zero(rays.rayCount());
    if (program.gap.size() > 0)
    {
        for (int point = 0; point < program.points(); ++point)
        {
            Eigen::Vector2d direction[2];
            const int count = rayDirections(program.friction[point], direction);
            for (int ray = 0; ray < count; ++ray)
            {
                rays.gap[form.firstRay[point] + ray] =
                    direction[ray].dot(program.gap.segment<2>(2 * point)) / scaling.displacement;
            }
        }
    }
}

void applyRaysTransposed(const RayProgram& program, const Eigen::VectorXd& y, Eigen::VectorXd& out)
{
    out.resize(program.rayCount());
    for (const RayProgram::Group& group : program.groups)
    {
        const Eigen::Vector3d first = y.segment<3>(3 * group.first);
        const Eigen::Vector3d second = y.segment<3>(3 * group.second);
        for (int ray = group.begin; ray < group.end; ++ray)
        {
            out[ray] = program.rays[ray].onFirst.dot(first) + program.rays[ray].onSecond.dot(second);
        }
    }
}

void addRays(const RayProgram& program, const Eigen::VectorXd& s, Eigen::VectorXd& out)
{
    for (const RayProgram::Group& group : program.groups)
    {
        Eigen::Vector3d first = Eigen::Vector3d::Zero();
        Eigen::Vector3d second = Eigen::Vector3d::Zero();
        for (int ray = group.begin; ray < group.end; ++ray)
        {
            first += program.rays[ray].onFirst * s[ray];
            second += program.rays[ray].onSecond * s[ray];
        }
        out.segment<3>(3 * group.first) += first;
        out.segment<3>(3 * group.second) += second;
    }
}

void assembleSchur(const RayProgram& program, const Eigen::VectorXd& d, double delta, double relative,
                   SchurSystem<3>& system)
{
    system.setZero();
    for (int body = 0; body < program.bodies; ++body)
    {
        auto& block = system.diagonal(body);
        if (program.hasInertia())
        {
            block = program.inertia[body];
        }
        block.diagonal().array() += delta;
    }
    for (const RayProgram::Group& group : program.groups)
    {
        if (group.first >= program.bodies)
        {
            continue;
        }
        Eigen::Matrix3d firstFirst = Eigen::Matrix3d::Zero();
        if (group.slot < 0)
        {
            for (int ray = group.begin; ray < group.end; ++ray)
            {
                const Eigen::Vector3d& first = program.rays[ray].onFirst;
                firstFirst.noalias() += (d[ray] * first) * first.transpose();
            }
            system.diagonal(group.first) += firstFirst;
            continue;
        }
        Eigen::Matrix3d secondFirst = Eigen::Matrix3d::Zero();
        Eigen::Matrix3d secondSecond = Eigen::Matrix3d::Zero();
        for (int ray = group.begin; ray < group.end; ++ray)
        {
            const Eigen::Vector3d& first = program.rays[ray].onFirst;
            const Eigen::Vector3d& second = program.rays[ray].onSecond;
            const Eigen::Vector3d weighted = d[ray] * second;
            firstFirst.noalias() += (d[ray] * first) * first.transpose();
            secondFirst.noalias() += weighted * first.transpose();
            secondSecond.noalias() += weighted * second.transpose();
        }
        system.diagonal(group.first) += firstFirst;
        system.coupling(group.slot) += secondFirst;
        system.diagonal(group.second) += secondSecond;
    }
    for (int body = 0; relative > 0 && body < program.bodies; ++body)
    {
        system.diagonal(body).diagonal() *= 1 + relative;
    }
}

ConeSolution fromRays(const PlaneConeProgram& program, const RayForm& form, const Eigen::VectorXd& s,
                      const Eigen::VectorXd& y, double multiplier)
{
    const RayScaling& scaling = form.scaling;
    ConeSolution solution;
    solution.multiplier = multiplier * scaling.load / scaling.liveLoad;
    solution.contactForce = Eigen::VectorXd::Zero(2 * program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        Eigen::Vector2d direction[2];
        const int count = rayDirections(program.friction[point], direction);
        for (int ray = 0; ray < count; ++ray)
        {
            solution.contactForce.segment<2>(2 * point) +=
                direction[ray] * s[form.firstRay[point] + ray] * scaling.load;
        }
    }
    solution.displacement = Eigen::VectorXd::Zero(3 * program.bodies);
    for (int body = 0; body < program.bodies; ++body)
    {
        const Eigen::Vector3d rows = y.segment<3>(3 * form.program.position[body]) * scaling.displacement;
        solution.displacement.segment<3>(3 * body) = scaledRows(rows, scaling.lever);
    }
    return solution;
}

} // namespace drystone
