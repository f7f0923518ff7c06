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

/// Friction from which a point gets a third ray, along the normal. Two rays have hardly a normal component
/// where mu is large: a force along the normal is then the difference of forces mu times as large, and their
/// openings are those of slip alone. With three rays the iterations of walls and arches are as many as with
/// two up to here, and do not grow with mu, where two fail from mu = 10 in walls of 80 units and from 1e4 in
/// all. Points with strength keep two, since a limit to crushing needs equal normal components.
constexpr double largeFriction = 5;

/// Directions of the rays of a point: (1, mu), (1, -mu), then (1, 0) where mu is large; (1, 0) alone without
/// friction; then (0, 1) where there is cohesion.
struct RayDirections
{
    std::array<Eigen::Vector2d, 3> direction;
    int pressing =
        0; ///< rays that press; they come first, with the same normal component where there is strength
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
    if (mu >= largeFriction && !program.hasStrength())
    {
        rays.direction = {Eigen::Vector2d(1, mu) / length, Eigen::Vector2d(1, -mu) / length, {1, 0}};
        rays.pressing = rays.count = 3;
        return rays;
    }
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

namespace
{

/// Whether a point, of a program without strength, has a third ray along its normal.
bool hasNormalRay(const RayForm& form, int point)
{
    const int first = form.firstRay[static_cast<std::size_t>(point)];
    return form.firstRay[static_cast<std::size_t>(point) + 1] - first == 3
           && form.directions[static_cast<std::size_t>(first) + 2].y() == 0;
}

} // namespace

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
        if (hasNormalRay(form, point))
        {
            const double sliding = std::min(std::abs(shear) / mu, std::max(0.0, normal)); // its normal force
            s[shear > 0 ? first : first + 1] = sliding / form.directions[first].x();
            s[first + 2] = std::max(0.0, normal - sliding);
        }
        else if (mu > 0)
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
        else if (hasNormalRay(form, static_cast<int>(point)))
        {
            opening[2 * point] = z[first + 2];
            opening[2 * point + 1] = (z[first] - z[first + 1]) / (2 * direction.y());
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

namespace
{

template<class Scalar>
ConeSolution solutionOfRays(const PlaneConeProgram& program, const RayForm& form,
                            const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& s,
                            const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& y, const Scalar& multiplier)
{
    const RayScaling& scaling = form.scaling;
    ConeSolution solution;
    solution.multiplier = static_cast<double>(multiplier) * scaling.load / scaling.liveLoad;
    solution.contactForce = Eigen::VectorXd::Zero(2 * program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        Eigen::Matrix<Scalar, 2, 1> force = origin(program, point).template cast<Scalar>();
        for (int ray = form.firstRay[point]; ray < form.firstRay[point + 1]; ++ray)
        {
            force += form.directions[ray].template cast<Scalar>() * s[ray] * Scalar(scaling.load);
        }
        solution.contactForce.segment<2>(2 * point) = force.template cast<double>();
    }
    solution.displacement = Eigen::VectorXd::Zero(3 * program.bodies);
    for (int body = 0; body < program.bodies; ++body)
    {
        const Eigen::Vector3d rows =
            y.template segment<3>(3 * form.program.position[body]).template cast<double>()
            * scaling.displacement;
        solution.displacement.segment<3>(3 * body) = scaledRows(rows, scaling.lever);
    }
    return solution;
}

} // namespace

ConeSolution fromRays(const PlaneConeProgram& program, const RayForm& form, const Eigen::VectorXd& s,
                      const Eigen::VectorXd& y, double multiplier)
{
    return solutionOfRays<double>(program, form, s, y, multiplier);
}

ConeSolution fromRays(const PlaneConeProgram& program, const RayForm& form,
                      const Eigen::Matrix<DoubleDouble, Eigen::Dynamic, 1>& s,
                      const Eigen::Matrix<DoubleDouble, Eigen::Dynamic, 1>& y, const DoubleDouble& multiplier)
{
    return solutionOfRays<DoubleDouble>(program, form, s, y, multiplier);
}

} // namespace drystone
