// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/RayProgram.h"

#include "conic/Certificate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

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

/// A vector of body rows in elimination order, scaled, with three zeros at its end for the ground and one for
/// each limit. Also its scale.
Eigen::VectorXd scaledLoad(const RayForm& form, const Eigen::VectorXd& rows, double& scale)
{
    const RayProgram& rays = form.program;
    Eigen::VectorXd result = Eigen::VectorXd::Zero(rays.row(rays.limits.size()));
    for (int body = 0; body < rays.bodies; ++body)
    {
        result.segment<3>(3 * rays.position[body]) =
            scaledRows(rows.segment<3>(3 * body), form.scaling.lever);
    }
    scale = powerOfTwo(result.lpNorm<Eigen::Infinity>());
    result /= scale;
    return result;
}

/// Directions of the rays of a point: (1, mu), (1, -mu), or (1, 0) alone without friction; then (0, 1) where
/// there is cohesion.
struct RayDirections
{
    std::array<Eigen::Vector2d, 3> direction;
    int pressing = 0; ///< rays that press; they come first and have the same normal component
    int count = 0;
};

/// Half the length of the piece of the shear axis that a point's set contains: what cohesion allows at the
/// least normal force.
double shearAlone(const PlaneConeProgram& program, int point)
{
    if (!program.hasStrength())
    {
        return 0;
    }
    const Strength& strength = program.strength[static_cast<std::size_t>(point)];
    return std::max(0.0, strength.cohesion - program.friction[point] * strength.tension);
}

RayDirections rayDirections(const PlaneConeProgram& program, int point)
{
    const double mu = program.friction[point];
    const double length = std::sqrt(1 + mu * mu);
    RayDirections rays;
    rays.direction = {Eigen::Vector2d(1, mu) / length, Eigen::Vector2d(1, -mu) / length, {0, 1}};
    rays.pressing = mu > 0 ? 2 : 1;
    rays.count = rays.pressing;
    if (shearAlone(program, point) > 0)
    {
        rays.direction[rays.count++] = {0, 1};
    }
    return rays;
}

/// c0 of a point: what its rays start from.
Eigen::Vector2d origin(const PlaneConeProgram& program, int point)
{
    return program.hasStrength() ? Eigen::Vector2d(-program.strength[static_cast<std::size_t>(point)].tension,
                                                   -shearAlone(program, point))
                                 : Eigen::Vector2d(0, 0);
}

/// f - A c0: the load that the rays have to balance. Not called for cones.
Eigen::VectorXd shiftedLoad(const PlaneConeProgram& program)
{
    Eigen::VectorXd shift(2 * program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        shift.segment<2>(2 * point) = origin(program, point);
    }
    return program.load - applyEquilibrium(program, shift);
}

/// The upper limits of a point's rays, in the units of the program.
void addLimits(RayProgram& rays, const PlaneConeProgram& program, int point, int firstRay,
               const RayDirections& directions)
{
    const int group = static_cast<int>(rays.groups.size()) - 1;
    const Strength& strength = program.strength[static_cast<std::size_t>(point)];
    if (strength.isBounded())
    {
        rays.limits.push_back({group, firstRay, directions.pressing, directions.direction[0].x(),
                               strength.crushing + strength.tension});
    }
    if (directions.count > directions.pressing)
    {
        rays.limits.push_back(
            {group, firstRay + directions.pressing, 1, 1.0, 2 * shearAlone(program, point)});
    }
}

/// Stiffness that a limit adds to its rays, q = e^2 / d_w, and what is left of their weights: eliminating the
/// row of a limit from B diag(d) B' leaves, for one ray, d / (1 + q d), and for two
///
///     (diag(1/d1, 1/d2) + q [1 1; 1 1])^-1 = diag(d1, d2) / t + q d1 d2 / t [1 -1; -1 1],  t = 1 + q (d1 +
///     d2):
///
/// sums of what is positive, without cancellation however firm the limit. The last part belongs to the
/// difference of the two rays.
struct LimitedWeights
{
    double share = 1;      ///< 1 / t
    double difference = 0; ///< q d1 d2 / t
};

LimitedWeights limitedWeights(const RayProgram& program, std::size_t limit, const Eigen::VectorXd& d)
{
    const RayProgram::Limit& at = program.limits[limit];
    const double q = at.factor * at.factor / d[program.slack(limit)];
    const double one = d[at.ray];
    const double two = at.rays == 2 ? d[at.ray + 1] : 0;
    const double share = 1 / (1 + q * (one + two));
    return {share, q * one * two * share};
}

/// What a ray does to the rows of its two bodies.
Eigen::Vector3d onFirst(const RayProgram::Ray& ray)
{
    return {ray[0], ray[1], ray[2]};
}
Eigen::Vector3d onSecond(const RayProgram::Ray& ray)
{
    return {-ray[0], -ray[1], ray[3]};
}

/// The ray of a unit of force in a direction at a point, from body `first` to `second` of its columns.
RayProgram::Ray makeRay(const ConeColumns<3, 2>& columns, const Eigen::Vector2d& direction, double lever)
{
    if (!hasOppositeForces(columns))
    {
        throw std::invalid_argument("the forces of a contact on its two bodies must be opposite");
    }
    const Eigen::Vector3d first = columns.onFirst * direction;
    const Eigen::Vector3d second = columns.onSecond * direction;
    // Of a body that does not move the rows may have been left out.
    const Eigen::Vector2d force = (columns.first >= 0 ? first : Eigen::Vector3d(-second)).head<2>();
    return {force.x(), force.y(), columns.first >= 0 ? first.z() / lever : 0.0,
            columns.second >= 0 ? second.z() / lever : 0.0};
}

/// The same ray with its bodies exchanged.
RayProgram::Ray exchanged(const RayProgram::Ray& ray)
{
    return {-ray[0], -ray[1], ray[3], ray[2]};
}

/// sum d b b' over rays of a group, added to the blocks of its bodies.
void addToBlocks(const RayProgram& program, const RayProgram::Group& group, const Eigen::Matrix4d& products,
                 SchurSystem<3>& system)
{
    if (group.first >= program.bodies)
    {
        return;
    }
    system.diagonal(group.first) += products.topLeftCorner<3, 3>();
    if (group.slot < 0)
    {
        return;
    }
    // With the translations of the second body opposite to those of the first.
    Eigen::Matrix3d secondFirst;
    secondFirst << -products.topLeftCorner<2, 3>(), products.bottomLeftCorner<1, 3>();
    system.coupling(group.slot) += secondFirst;
    Eigen::Matrix3d secondSecond;
    secondSecond << products.topLeftCorner<2, 2>(), -products.topRightCorner<2, 1>(),
        -products.bottomLeftCorner<1, 2>(), products(3, 3);
    system.diagonal(group.second) += secondSecond;
}

/// The Schur system of the rays alone.
void assembleRays(const RayProgram& program, const Eigen::VectorXd& d, double delta, SchurSystem<3>& system);

} // namespace

RayForm makeRayForm(const PlaneConeProgram& program, SymbolicAnalysis& symbolic, double multiplier)
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
    if (symbolic.order.empty() || symbolic.bodies != program.bodies || symbolic.touching != form.couplings)
    {
        symbolic.bodies = program.bodies;
        symbolic.touching = form.couplings;
        symbolic.order = eliminationOrder(program.bodies, form.couplings);
        symbolic.system.reset();
    }
    rays.position.assign(program.bodies, 0);
    for (int place = 0; place < program.bodies; ++place)
    {
        rays.position[symbolic.order[place]] = place;
    }
    for (Coupling& pair : form.couplings)
    {
        pair = {rays.position[pair[0]], rays.position[pair[1]]};
    }

    form.firstRay.reserve(program.contacts.size() + 1);
    RayDirections directions;
    for (int point = 0; point < program.points(); ++point)
    {
        const auto& columns = program.contacts[point];
        const int one = columns.first < 0 ? rays.bodies : rays.position[columns.first];
        const int other = columns.second < 0 ? rays.bodies : rays.position[columns.second];
        const int first = std::min(one, other);
        const int second = std::max(one, other);
        if (rays.groups.empty() || rays.groups.back().first != first || rays.groups.back().second != second)
        {
            const int next = static_cast<int>(rays.rays.size());
            rays.groups.push_back({first, second, next, next, -1});
        }
        form.firstRay.push_back(static_cast<int>(rays.rays.size()));
        if (point == 0 || program.hasStrength() || program.friction[point] != program.friction[point - 1])
        {
            directions = rayDirections(program, point);
        }
        for (int ray = 0; ray < directions.count; ++ray)
        {
            form.directions.push_back(directions.direction[ray]);
            const RayProgram::Ray made = makeRay(columns, directions.direction[ray], form.scaling.lever);
            rays.rays.push_back(one < other ? made : exchanged(made));
        }
        rays.groups.back().end = static_cast<int>(rays.rays.size());
        if (program.hasStrength())
        {
            addLimits(rays, program, point, form.firstRay.back(), directions);
        }
    }
    form.firstRay.push_back(static_cast<int>(rays.rays.size()));
    if (program.hasInertia())
    {
        rays.inertia.assign(rays.bodies, RayProgram::Inertia::Zero());
    }
    updateRayForm(form, program, multiplier);
    return form;
}

SchurSystem<3>& schurSystem(RayForm& form, SymbolicAnalysis& symbolic)
{
    if (!symbolic.system)
    {
        symbolic.system.emplace(form.program.bodies, form.couplings);
    }
    SchurSystem<3>& system = *symbolic.system;
    for (RayProgram::Group& group : form.program.groups)
    {
        group.slot = group.second < form.program.bodies ? system.slot(group.first, group.second) : -1;
    }
    return system;
}

void updateRayForm(RayForm& form, const PlaneConeProgram& program, double multiplier)
{
    RayProgram& rays = form.program;
    RayScaling& scaling = form.scaling;
    scaling.liveLoad = 1;
    rays.liveLoad.resize(0);
    if (program.hasMultiplier())
    {
        rays.liveLoad = scaledLoad(form, program.liveLoad, scaling.liveLoad);
        rays.liveWork = powerOfTwo(rays.liveLoad.lpNorm<1>());
    }
    rays.load = scaledLoad(form, program.load, scaling.load);
    if (multiplier * scaling.liveLoad > scaling.load)
    {
        const double expected = powerOfTwo(multiplier * scaling.liveLoad);
        rays.load *= scaling.load / expected;
        scaling.load = expected;
    }
    if (program.hasStrength())
    {
        // The scale is that of the load itself, which residuals are compared with: where strengths are large
        // beside it, so is the shifted load.
        double ownScale = 1;
        rays.load = scaledLoad(form, shiftedLoad(program), ownScale);
        rays.load *= ownScale / scaling.load;
        for (std::size_t limit = 0; limit < rays.limits.size(); ++limit)
        {
            // Divided by a bound beyond the loads, so that the slack is of order one.
            RayProgram::Limit& at = rays.limits[limit];
            const double bound = at.bound / scaling.load;
            const double scale = std::max(1.0, bound);
            at.factor = at.component / scale;
            rays.load[rays.row(limit)] = bound / scale;
        }
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

    rays.gap = raysOfOpening(form, program.gap);
}

void applyRaysTransposed(const RayProgram& program, const Eigen::VectorXd& y, Eigen::VectorXd& out)
{
    out.resize(program.rayCount());
    for (const RayProgram::Group& group : program.groups)
    {
        const auto first = y.segment<3>(3 * group.first);
        const auto second = y.segment<3>(3 * group.second);
        const Eigen::Vector4d closing(first[0] - second[0], first[1] - second[1], first[2], second[2]);
        for (int ray = group.begin; ray < group.end; ++ray)
        {
            out[ray] = program.rays[ray].dot(closing);
        }
    }
    for (std::size_t limit = 0; limit < program.limits.size(); ++limit)
    {
        const RayProgram::Limit& at = program.limits[limit];
        const double change = y[program.row(limit)];
        out.segment(at.ray, at.rays).array() += at.factor * change;
        out[program.slack(limit)] = change;
    }
}

void addRays(const RayProgram& program, const Eigen::VectorXd& s, Eigen::VectorXd& out)
{
    for (const RayProgram::Group& group : program.groups)
    {
        RayProgram::Ray sum = RayProgram::Ray::Zero();
        for (int ray = group.begin; ray < group.end; ++ray)
        {
            sum += program.rays[ray] * s[ray];
        }
        if (group.first < program.bodies)
        {
            out.segment<3>(3 * group.first) += onFirst(sum);
        }
        if (group.second < program.bodies)
        {
            out.segment<3>(3 * group.second) += onSecond(sum);
        }
    }
    for (std::size_t limit = 0; limit < program.limits.size(); ++limit)
    {
        const RayProgram::Limit& at = program.limits[limit];
        out[program.row(limit)] += at.factor * s.segment(at.ray, at.rays).sum() + s[program.slack(limit)];
    }
}

namespace
{

void assembleRays(const RayProgram& program, const Eigen::VectorXd& d, double delta, SchurSystem<3>& system)
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
        Eigen::Matrix4d products = Eigen::Matrix4d::Zero();
        for (int ray = group.begin; ray < group.end; ++ray)
        {
            const RayProgram::Ray& force = program.rays[ray];
            products.noalias() += (d[ray] * force).lazyProduct(force.transpose());
        }
        addToBlocks(program, group, products, system);
    }
}

} // namespace

void assembleSchur(const RayProgram& program, const Eigen::VectorXd& d, double delta, double relative,
                   SchurSystem<3>& system)
{
    if (program.limits.empty())
    {
        assembleRays(program, d, delta, system);
    }
    else
    {
        Eigen::VectorXd limited = d;
        for (std::size_t limit = 0; limit < program.limits.size(); ++limit)
        {
            const RayProgram::Limit& at = program.limits[limit];
            limited.segment(at.ray, at.rays) *= limitedWeights(program, limit, d).share;
        }
        assembleRays(program, limited, delta, system);
        for (std::size_t limit = 0; limit < program.limits.size(); ++limit)
        {
            const RayProgram::Limit& at = program.limits[limit];
            if (at.rays == 2)
            {
                const RayProgram::Ray force = program.rays[at.ray] - program.rays[at.ray + 1];
                addToBlocks(program, program.groups[at.group],
                            limitedWeights(program, limit, d).difference * force * force.transpose(), system);
            }
        }
    }
    for (int body = 0; relative > 0 && body < program.bodies; ++body)
    {
        system.diagonal(body).diagonal() *= 1 + relative;
    }
}

/// With p = e^2 sum d + d_w on the diagonal of a limit's row and h = e B d beside it, the bodies' part of
/// [S h; h' p] (y, v) = (right, r) is (S - h h'/p) y = right - h r/p, and v = (r - h'y) / p.
void solveWithLimits(const RayProgram& program, const Eigen::VectorXd& d, SchurSystem<3>& system,
                     Eigen::VectorXd& x)
{
    const auto weightOf = [&](std::size_t limit)
    {
        const RayProgram::Limit& at = program.limits[limit];
        return at.factor * at.factor * d.segment(at.ray, at.rays).sum() + d[program.slack(limit)];
    };
    for (std::size_t limit = 0; limit < program.limits.size(); ++limit)
    {
        const RayProgram::Limit& at = program.limits[limit];
        const RayProgram::Group& group = program.groups[at.group];
        const double share = at.factor * x[program.row(limit)] / weightOf(limit);
        for (int ray = at.ray; ray < at.ray + at.rays; ++ray)
        {
            x.segment<3>(3 * group.first) -= share * d[ray] * onFirst(program.rays[ray]);
            if (group.second < program.bodies)
            {
                x.segment<3>(3 * group.second) -= share * d[ray] * onSecond(program.rays[ray]);
            }
        }
    }
    system.solve(x.head(3 * program.bodies));
    for (std::size_t limit = 0; limit < program.limits.size(); ++limit)
    {
        const RayProgram::Limit& at = program.limits[limit];
        const RayProgram::Group& group = program.groups[at.group];
        double coupled = 0;
        for (int ray = at.ray; ray < at.ray + at.rays; ++ray)
        {
            coupled += d[ray]
                       * (onFirst(program.rays[ray]).dot(x.segment<3>(3 * group.first))
                          + onSecond(program.rays[ray]).dot(x.segment<3>(3 * group.second)));
        }
        x[program.row(limit)] = (x[program.row(limit)] - at.factor * coupled) / weightOf(limit);
    }
}

Eigen::VectorXd raysOf(const PlaneConeProgram& program, const RayForm& form,
                       const Eigen::VectorXd& contactForce)
{
    Eigen::VectorXd s = Eigen::VectorXd::Zero(form.program.rayCount());
    for (int point = 0; point < program.points(); ++point)
    {
        const double alone = shearAlone(program, point) / form.scaling.load;
        const double tension =
            program.hasStrength() ? program.strength[static_cast<std::size_t>(point)].tension : 0;
        const double normal = (contactForce[2 * point] + tension) / form.scaling.load;
        const double whole = contactForce[2 * point + 1] / form.scaling.load;
        const double held = alone > 0 ? std::clamp(whole, -alone, alone) : 0;
        const double shear = whole - held;
        const double mu = program.friction[point];
        const int first = form.firstRay[point];
        if (mu > 0)
        {
            const double length = 1 / form.directions[first].x();
            s[first] = std::max(0.0, length * (normal + shear / mu) / 2);
            s[first + 1] = std::max(0.0, length * (normal - shear / mu) / 2);
        }
        else
        {
            s[first] = std::max(0.0, normal);
        }
        if (alone > 0)
        {
            s[form.firstRay[point + 1] - 1] = held + alone;
        }
    }
    return s;
}

Eigen::VectorXd raysOfOpening(const RayForm& form, const Eigen::VectorXd& opening)
{
    Eigen::VectorXd z = Eigen::VectorXd::Zero(form.program.rayCount());
    for (Eigen::Index point = 0; 2 * point < opening.size(); ++point)
    {
        const auto at = static_cast<std::size_t>(point);
        for (int ray = form.firstRay[at]; ray < form.firstRay[at + 1]; ++ray)
        {
            z[ray] = form.directions[static_cast<std::size_t>(ray)].dot(opening.segment<2>(2 * point))
                     / form.scaling.displacement;
        }
    }
    return z;
}

Eigen::VectorXd openingOf(const RayForm& form, const Eigen::VectorXd& z)
{
    const auto points = static_cast<Eigen::Index>(form.firstRay.size()) - 1;
    Eigen::VectorXd opening = Eigen::VectorXd::Zero(2 * points);
    for (Eigen::Index point = 0; point < points; ++point)
    {
        const int first = form.firstRay[static_cast<std::size_t>(point)];
        const int rays = form.firstRay[static_cast<std::size_t>(point) + 1] - first;
        const Eigen::Vector2d& direction = form.directions[static_cast<std::size_t>(first)];
        if (rays == 1)
        {
            opening[2 * point] = z[first] / direction.x();
        }
        else // the directions mirror one another: z = (n u_n + t u_t, n u_n - t u_t)
        {
            opening[2 * point] = (z[first] + z[first + 1]) / (2 * direction.x());
            opening[2 * point + 1] = (z[first] - z[first + 1]) / (2 * direction.y());
        }
    }
    return form.scaling.displacement * opening;
}

Eigen::VectorXd rowsOf(const RayForm& form, const Eigen::VectorXd& displacement)
{
    const RayProgram& rays = form.program;
    Eigen::VectorXd y = Eigen::VectorXd::Zero(rays.row(rays.limits.size()));
    for (int body = 0; body < rays.bodies; ++body)
    {
        Eigen::Vector3d rows = displacement.segment<3>(3 * body);
        rows[2] *= form.scaling.lever;
        y.segment<3>(3 * rays.position[body]) = rows / form.scaling.displacement;
    }
    return y;
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
        solution.contactForce.segment<2>(2 * point) = origin(program, point);
        for (int ray = form.firstRay[point]; ray < form.firstRay[point + 1]; ++ray)
        {
            solution.contactForce.segment<2>(2 * point) += form.directions[ray] * s[ray] * scaling.load;
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
