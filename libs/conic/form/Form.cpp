// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/form/Form.h"

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

/// Rows of one body with the moments divided by the lever arm.
template<int Rows>
Eigen::Matrix<double, Rows, 1> scaledRows(Eigen::Matrix<double, Rows, 1> rows, double lever)
{
    rows.template tail<Form<Rows>::moments>() /= lever;
    return rows;
}

/// A vector of body rows in elimination order, scaled, with zeros at its end for the ground and for each
/// limit. Also its scale.
template<int Rows>
Eigen::VectorXd scaledLoad(const Form<Rows>& form, const Eigen::VectorXd& rows, double& scale)
{
    Eigen::VectorXd result = Eigen::VectorXd::Zero(form.rows());
    for (int body = 0; body < form.bodies; ++body)
    {
        result.segment<Rows>(Rows * form.position[body]) =
            scaledRows<Rows>(rows.segment<Rows>(Rows * body), form.scaling.lever);
    }
    scale = powerOfTwo(result.lpNorm<Eigen::Infinity>());
    result /= scale;
    return result;
}

/// Friction from which a point gets a ray along the normal besides its cone, which has hardly a normal
/// component where mu is large: a force along the normal is then the difference of forces mu times as large,
/// and their openings are those of slip alone. Points with strength do without, since a limit to crushing
/// needs equal normal components.
constexpr double largeFriction = 5;

/// Half the length of the piece of the shear axis, or the radius of the disc, that a point's set contains:
/// what cohesion allows at the least normal force.
template<int Rows, int Forces>
double shearAlone(const ConeProgram<Rows, Forces>& program, int point)
{
    if (!program.hasStrength())
    {
        return 0;
    }
    const Strength& strength = program.strength[static_cast<std::size_t>(point)];
    return std::max(0.0, strength.cohesion - program.friction[point] * strength.tension);
}

/// The cones that make up the set of a point: directions of its rays, diagonals of T of its round cones.
template<int Forces>
struct PointCones
{
    std::array<Eigen::Matrix<double, Forces, 1>, 3> ray;
    std::array<Eigen::Vector3d, 2> round;
    int pressingRays = 0; ///< they come first, with the same normal component where there is strength
    int rays = 0;
    int rounds = 0; ///< the first one presses where there is friction

    void addRay(const Eigen::Matrix<double, Forces, 1>& direction) { ray[rays++] = direction; }
    void addRound(const Eigen::Vector3d& scale) { round[rounds++] = scale; }
};

/// In the plane (1, mu), (1, -mu), then (1, 0) where mu is large; (1, 0) alone without friction; then (0, 1)
/// where there is cohesion.
PointCones<2> pointCones(const PlaneConeProgram& program, int point)
{
    const double mu = program.friction[point];
    const double length = std::sqrt(1 + mu * mu);
    PointCones<2> cones;
    cones.addRay(Eigen::Vector2d(1, mu) / length);
    if (mu > 0)
    {
        cones.addRay(Eigen::Vector2d(1, -mu) / length);
    }
    if (mu >= largeFriction && !program.hasStrength())
    {
        cones.addRay({1, 0});
    }
    cones.pressingRays = cones.rays;
    if (shearAlone(program, point) > 0)
    {
        cones.addRay({0, 1});
    }
    return cones;
}

/// In space T, then (1, 0, 0) where mu is large; (1, 0, 0) alone without friction; then (p0, t) where there
/// is cohesion.
PointCones<3> pointCones(const SpaceConeProgram& program, int point)
{
    const double mu = program.friction[point];
    PointCones<3> cones;
    if (mu > 0)
    {
        cones.addRound(Eigen::Vector3d(1, mu, mu) / std::sqrt(1 + mu * mu));
    }
    if (mu == 0 || (mu >= largeFriction && !program.hasStrength()))
    {
        cones.addRay({1, 0, 0});
    }
    cones.pressingRays = cones.rays;
    if (shearAlone(program, point) > 0)
    {
        cones.addRound({0, 1, 1});
    }
    return cones;
}

/// c0 of a point: what its cones start from.
template<int Rows, int Forces>
Eigen::Matrix<double, Forces, 1> origin(const ConeProgram<Rows, Forces>& program, int point)
{
    Eigen::Matrix<double, Forces, 1> result = Eigen::Matrix<double, Forces, 1>::Zero();
    if (program.hasStrength())
    {
        result[0] = -program.strength[static_cast<std::size_t>(point)].tension;
        if constexpr (Forces == 2)
        {
            result[1] = -shearAlone(program, point);
        }
    }
    return result;
}

/// f - A c0: the load that the cones have to balance. Not called without strength.
template<int Rows, int Forces>
Eigen::VectorXd shiftedLoad(const ConeProgram<Rows, Forces>& program)
{
    Eigen::VectorXd shift(Forces * program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        shift.segment<Forces>(Forces * point) = origin(program, point);
    }
    return program.load - applyEquilibrium(program, shift);
}

/// The upper limits of a point's cones, in the units of the program.
template<int Rows, int Forces>
void addLimits(Form<Rows>& form, const ConeProgram<Rows, Forces>& program, int point,
               const PointCones<Forces>& cones)
{
    const int group = static_cast<int>(form.groups.size()) - 1;
    const int ray = form.firstRay.back();
    const int round = form.firstRound.back();
    const Strength& strength = program.strength[static_cast<std::size_t>(point)];
    if (strength.isBounded())
    {
        const double bound = strength.crushing + strength.tension;
        if (cones.pressingRays > 0)
        {
            form.limits.push_back({group, ray, cones.pressingRays, -1, cones.ray[0][0], bound, 1});
        }
        else
        {
            form.limits.push_back({group, -1, 0, round, cones.round[0][0], bound, 1});
        }
    }
    if (cones.rays > cones.pressingRays)
    {
        form.limits.push_back(
            {group, ray + cones.pressingRays, 1, -1, 1.0, 2 * shearAlone(program, point), 1});
    }
    else if (shearAlone(program, point) > 0)
    {
        form.limits.push_back({group, -1, 0, round + cones.rounds - 1, 1.0, shearAlone(program, point), 1});
    }
}

/// The column of a unit of force in a direction at a point, from body `first` to `second` of its columns, or
/// with its bodies exchanged.
enum class Bodies
{
    asGiven,
    exchanged
};

template<int Rows, int Forces>
typename Form<Rows>::Column makeColumn(const ConeColumns<Rows, Forces>& columns,
                                       const Eigen::Matrix<double, Forces, 1>& direction, double lever,
                                       Bodies bodies)
{
    constexpr int moments = Form<Rows>::moments;
    using Moments = Eigen::Matrix<double, moments, 1>;
    const Eigen::Matrix<double, Rows, 1> first = columns.onFirst * direction;
    const Eigen::Matrix<double, Rows, 1> second = columns.onSecond * direction;
    // Of a body that does not move the rows may have been left out.
    const Eigen::Matrix<double, Forces, 1> force =
        (columns.first >= 0 ? first : Eigen::Matrix<double, Rows, 1>(-second)).template head<Forces>();
    const Moments onFirst =
        columns.first >= 0 ? Moments(first.template tail<moments>() / lever) : Moments(Moments::Zero());
    const Moments onSecond =
        columns.second >= 0 ? Moments(second.template tail<moments>() / lever) : Moments(Moments::Zero());
    typename Form<Rows>::Column column;
    if (bodies == Bodies::asGiven)
    {
        column << force, onFirst, onSecond;
    }
    else
    {
        column << -force, onSecond, onFirst;
    }
    return column;
}

/// Pairs of bodies that touch, as the program numbers them. Points of one pair follow each other.
template<int Rows, int Forces>
std::vector<Coupling> touchingBodies(const ConeProgram<Rows, Forces>& program)
{
    std::vector<Coupling> touching;
    for (const auto& columns : program.contacts)
    {
        const bool isCoupled = columns.first >= 0 && columns.second >= 0;
        if (isCoupled && (touching.empty() || touching.back() != Coupling{columns.first, columns.second}))
        {
            touching.push_back({columns.first, columns.second});
        }
    }
    return touching;
}

/// Sets load, liveLoad and gap, their scaling, and the inertia, once the structure stands.
template<int Rows, int Forces>
void setNumbers(Form<Rows>& form, const ConeProgram<Rows, Forces>& program, double multiplier)
{
    typename Form<Rows>::Scaling& scaling = form.scaling;
    if (program.hasMultiplier())
    {
        form.liveLoad = scaledLoad(form, program.liveLoad, scaling.liveLoad);
        form.liveWork = powerOfTwo(form.liveLoad.template lpNorm<1>());
    }
    form.load = scaledLoad(form, program.load, scaling.load);
    if (multiplier * scaling.liveLoad > scaling.load)
    {
        const double expected = powerOfTwo(multiplier * scaling.liveLoad);
        form.load *= scaling.load / expected;
        scaling.load = expected;
    }
    if (program.hasStrength())
    {
        // The scale is that of the load itself, which residuals are compared with: where strengths are large
        // compared with it, so is the shifted load.
        double ownScale = 1;
        form.load = scaledLoad(form, shiftedLoad(program), ownScale);
        form.load *= ownScale / scaling.load;
        for (std::size_t limit = 0; limit < form.limits.size(); ++limit)
        {
            // Divided by a bound beyond the loads, so that the slack is of order one.
            typename Form<Rows>::Limit& at = form.limits[limit];
            const double bound = at.bound / scaling.load;
            const double scale = std::max(1.0, bound);
            at.factor = at.component / scale;
            form.load[form.row(limit)] = bound / scale;
        }
    }

    // y~ = y / displacement turns L'y = 1 into L~'y~ = w (limit analysis), and Mbar into M~ = Mbar
    // displacement / load, which should be of order one (time step).
    scaling.displacement = 1 / (scaling.liveLoad * form.liveWork);
    if (program.hasInertia())
    {
        double largest = 0;
        for (const auto& block : program.inertia)
        {
            largest = std::max(largest, block.template topLeftCorner<Forces, Forces>().cwiseAbs().maxCoeff());
        }
        scaling.displacement = scaling.load / powerOfTwo(largest);
        const Eigen::Matrix<double, Rows, 1> row =
            scaledRows<Rows>(Eigen::Matrix<double, Rows, 1>::Ones(), scaling.lever);
        form.inertia.resize(static_cast<std::size_t>(form.bodies));
        for (int body = 0; body < form.bodies; ++body)
        {
            form.inertia[form.position[body]] = row.asDiagonal() * program.inertia[body] * row.asDiagonal()
                                                * (scaling.displacement / scaling.load);
        }
    }
    form.gap = conesOfOpening(form, program.gap);
}

/// Whether a point, of a program without strength, has a ray along its normal besides its cone.
template<int Rows>
bool hasNormalRay(const Form<Rows>& form, std::size_t point)
{
    const int first = form.firstRay[point];
    const int rays = form.firstRay[point + 1] - first;
    return Rows == 3 ? rays == 3 && form.directions[static_cast<std::size_t>(first) + 2][1] == 0
                     : rays == 1 && form.firstRound[point + 1] > form.firstRound[point];
}

/// Forces of the cones of one point of the plane for its normal force and its shear without what cohesion
/// holds, in units of the form.
void setPressing(const Form<3>& form, int point, double mu, double normal, double shear, Eigen::VectorXd& s)
{
    const int first = form.firstRay[point];
    if (hasNormalRay(form, static_cast<std::size_t>(point)))
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
}

void setPressing(const Form<6>& form, int point, double mu, double normal, const Eigen::Vector2d& shear,
                 Eigen::VectorXd& s)
{
    const auto at = static_cast<std::size_t>(point);
    if (!(mu > 0))
    {
        s[form.firstRay[at]] = std::max(0.0, normal);
        return;
    }
    double pressing = normal;
    if (hasNormalRay(form, at))
    {
        pressing = std::min(shear.norm() / mu, std::max(0.0, normal));
        s[form.firstRay[at]] = std::max(0.0, normal - pressing);
    }
    const int round = form.firstRound[at];
    const Eigen::Vector3d& scale = form.roundScales[static_cast<std::size_t>(round)];
    const Eigen::Vector3d force(pressing / scale[0], shear[0] / scale[1], shear[1] / scale[2]);
    s.segment<3>(form.cones().at(round)) = projectOntoCone(force).point;
}

/// What of a point's shear cohesion holds, set in its cone; `alone` in units of the form.
double holdShear(const Form<3>& form, int point, double alone, double shear, Eigen::VectorXd& s)
{
    const double held = alone > 0 ? std::clamp(shear, -alone, alone) : 0;
    if (alone > 0)
    {
        s[form.firstRay[static_cast<std::size_t>(point) + 1] - 1] = held + alone;
    }
    return held;
}

Eigen::Vector2d holdShear(const Form<6>& form, int point, double alone, const Eigen::Vector2d& shear,
                          Eigen::VectorXd& s)
{
    if (!(alone > 0))
    {
        return Eigen::Vector2d::Zero();
    }
    const double size = shear.norm();
    const Eigen::Vector2d held = size > alone ? Eigen::Vector2d(shear * (alone / size)) : shear;
    const Eigen::Index at = form.cones().at(form.firstRound[static_cast<std::size_t>(point) + 1] - 1);
    s.segment<3>(at) << alone, held;
    return held;
}

/// Openings of the one point of the plane, or of space, in units of the form.
Eigen::Vector2d pointOpening(const Form<3>& form, std::size_t point, const Eigen::VectorXd& z)
{
    const int first = form.firstRay[point];
    const Eigen::Vector2d& direction = form.directions[static_cast<std::size_t>(first)];
    if (form.firstRay[point + 1] - first == 1)
    {
        return {z[first] / direction.x(), 0};
    }
    if (hasNormalRay(form, point))
    {
        return {z[first + 2], (z[first] - z[first + 1]) / (2 * direction.y())};
    }
    // The directions mirror one another: z = (n u_n + t u_t, n u_n - t u_t).
    return {(z[first] + z[first + 1]) / (2 * direction.x()), (z[first] - z[first + 1]) / (2 * direction.y())};
}

Eigen::Vector3d pointOpening(const Form<6>& form, std::size_t point, const Eigen::VectorXd& z)
{
    Eigen::Vector3d opening = Eigen::Vector3d::Zero();
    if (form.firstRound[point + 1] > form.firstRound[point])
    {
        const int round = form.firstRound[point];
        opening = z.segment<3>(form.cones().at(round))
                      .cwiseQuotient(form.roundScales[static_cast<std::size_t>(round)]);
    }
    if (form.firstRay[point + 1] > form.firstRay[point])
    {
        opening[0] = z[form.firstRay[point]];
    }
    return opening;
}

} // namespace

template<int Rows, int Forces>
Form<Rows> makeForm(const ConeProgram<Rows, Forces>& program, SymbolicAnalysis& symbolic, double multiplier)
{
    Form<Rows> form;
    form.bodies = program.bodies;
    form.scaling.lever = powerOfTwo(meanLeverArm(program));
    form.couplings = touchingBodies(program);
    if (symbolic.order.empty() || symbolic.bodies != program.bodies || symbolic.touching != form.couplings)
    {
        symbolic.bodies = program.bodies;
        symbolic.touching = form.couplings;
        symbolic.order = eliminationOrder(program.bodies, form.couplings);
        symbolic.systems = {};
    }
    form.position.assign(program.bodies, 0);
    for (int place = 0; place < program.bodies; ++place)
    {
        form.position[symbolic.order[place]] = place;
    }
    for (Coupling& pair : form.couplings)
    {
        pair = {form.position[pair[0]], form.position[pair[1]]};
    }

    form.firstRay.reserve(program.contacts.size() + 1);
    form.firstRound.reserve(program.contacts.size() + 1);
    PointCones<Forces> cones;
    for (int point = 0; point < program.points(); ++point)
    {
        const auto& columns = program.contacts[point];
        if (!hasOppositeForces(columns))
        {
            throw std::invalid_argument("the forces of a contact on its two bodies must be opposite");
        }
        const int one = columns.first < 0 ? form.bodies : form.position[columns.first];
        const int other = columns.second < 0 ? form.bodies : form.position[columns.second];
        const int first = std::min(one, other);
        const int second = std::max(one, other);
        if (form.groups.empty() || form.groups.back().first != first || form.groups.back().second != second)
        {
            const int ray = static_cast<int>(form.rays.size());
            const int round = static_cast<int>(form.rounds.size());
            form.groups.push_back({first, second, ray, ray, -1, round, round});
        }
        form.firstRay.push_back(static_cast<int>(form.rays.size()));
        form.firstRound.push_back(static_cast<int>(form.rounds.size()));
        if (point == 0 || program.hasStrength() || program.friction[point] != program.friction[point - 1])
        {
            cones = pointCones(program, point);
        }
        const Bodies bodies = one < other ? Bodies::asGiven : Bodies::exchanged;
        for (int ray = 0; ray < cones.rays; ++ray)
        {
            form.directions.push_back(cones.ray[ray]);
            form.rays.push_back(makeColumn(columns, cones.ray[ray], form.scaling.lever, bodies));
        }
        for (int round = 0; round < cones.rounds; ++round)
        {
            form.roundScales.push_back(cones.round[round]);
            typename Form<Rows>::RoundColumns made;
            for (int component = 0; component < Forces; ++component)
            {
                const Eigen::Matrix<double, Forces, 1> direction =
                    cones.round[round][component] * Eigen::Matrix<double, Forces, 1>::Unit(component);
                made.col(component) = makeColumn(columns, direction, form.scaling.lever, bodies);
            }
            form.rounds.push_back(made);
        }
        form.groups.back().end = static_cast<int>(form.rays.size());
        form.groups.back().endRound = static_cast<int>(form.rounds.size());
        if (program.hasStrength())
        {
            addLimits(form, program, point, cones);
        }
    }
    form.firstRay.push_back(static_cast<int>(form.rays.size()));
    form.firstRound.push_back(static_cast<int>(form.rounds.size()));
    setNumbers(form, program, multiplier);
    return form;
}

template<int Rows>
SchurSystem<Rows>& schurSystem(Form<Rows>& form, SymbolicAnalysis& symbolic)
{
    std::optional<SchurSystem<Rows>>& kept = symbolic.system<Rows>();
    if (!kept)
    {
        kept.emplace(form.bodies, form.couplings);
    }
    for (typename Form<Rows>::Group& group : form.groups)
    {
        group.slot = group.second < form.bodies ? kept->slot(group.first, group.second) : -1;
    }
    return *kept;
}

template<int Rows, int Forces>
Eigen::VectorXd conesOf(const ConeProgram<Rows, Forces>& program, const Form<Rows>& form,
                        const Eigen::VectorXd& contactForce)
{
    Eigen::VectorXd s = Eigen::VectorXd::Zero(form.cones().size());
    for (int point = 0; point < program.points(); ++point)
    {
        const double alone = shearAlone(program, point) / form.scaling.load;
        const double tension =
            program.hasStrength() ? program.strength[static_cast<std::size_t>(point)].tension : 0;
        const double normal = (contactForce[Forces * point] + tension) / form.scaling.load;
        if constexpr (Forces == 2)
        {
            const double whole = contactForce[2 * point + 1] / form.scaling.load;
            const double shear = whole - holdShear(form, point, alone, whole, s);
            setPressing(form, point, program.friction[point], normal, shear, s);
        }
        else
        {
            const Eigen::Vector2d whole = contactForce.segment<2>(3 * point + 1) / form.scaling.load;
            const Eigen::Vector2d shear = whole - holdShear(form, point, alone, whole, s);
            setPressing(form, point, program.friction[point], normal, shear, s);
        }
    }
    return s;
}

template<int Rows>
Eigen::VectorXd conesOfOpening(const Form<Rows>& form, const Eigen::VectorXd& opening)
{
    constexpr int forces = Form<Rows>::forces;
    Eigen::VectorXd z = Eigen::VectorXd::Zero(form.cones().size());
    for (Eigen::Index point = 0; forces * point < opening.size(); ++point)
    {
        const auto at = static_cast<std::size_t>(point);
        const auto ofPoint = opening.segment<forces>(forces * point);
        for (int ray = form.firstRay[at]; ray < form.firstRay[at + 1]; ++ray)
        {
            z[ray] = form.directions[static_cast<std::size_t>(ray)].dot(ofPoint) / form.scaling.displacement;
        }
        for (int round = form.firstRound[at]; round < form.firstRound[at + 1]; ++round)
        {
            z.segment<forces>(form.cones().at(round)) =
                form.roundScales[static_cast<std::size_t>(round)].template head<forces>().cwiseProduct(
                    ofPoint)
                / form.scaling.displacement;
        }
    }
    return z;
}

template<int Rows>
Eigen::VectorXd openingOf(const Form<Rows>& form, const Eigen::VectorXd& z)
{
    constexpr int forces = Form<Rows>::forces;
    const std::size_t points = form.firstRay.size() - 1;
    Eigen::VectorXd opening(forces * static_cast<Eigen::Index>(points));
    for (std::size_t point = 0; point < points; ++point)
    {
        opening.segment<forces>(forces * static_cast<Eigen::Index>(point)) = pointOpening(form, point, z);
    }
    return form.scaling.displacement * opening;
}

template<int Rows>
Eigen::VectorXd rowsOf(const Form<Rows>& form, const Eigen::VectorXd& displacement)
{
    Eigen::VectorXd y = Eigen::VectorXd::Zero(form.rows());
    for (int body = 0; body < form.bodies; ++body)
    {
        Eigen::Matrix<double, Rows, 1> rows = displacement.segment<Rows>(Rows * body);
        rows.template tail<Form<Rows>::moments>() *= form.scaling.lever;
        y.segment<Rows>(Rows * form.position[body]) = rows / form.scaling.displacement;
    }
    return y;
}

template<int Rows, int Forces, class Scalar>
ConeSolution solutionOf(const ConeProgram<Rows, Forces>& program, const Form<Rows>& form,
                        const VectorOf<Scalar>& s, const VectorOf<Scalar>& y, const Scalar& multiplier)
{
    const typename Form<Rows>::Scaling& scaling = form.scaling;
    ConeSolution solution;
    solution.multiplier = static_cast<double>(multiplier) * scaling.load / scaling.liveLoad;
    solution.contactForce = Eigen::VectorXd::Zero(Forces * program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        Eigen::Matrix<Scalar, Forces, 1> force = origin(program, point).template cast<Scalar>();
        for (int ray = form.firstRay[point]; ray < form.firstRay[point + 1]; ++ray)
        {
            force += form.directions[ray].template cast<Scalar>() * s[ray] * Scalar(scaling.load);
        }
        for (int round = form.firstRound[point]; round < form.firstRound[point + 1]; ++round)
        {
            for (int component = 0; component < Forces; ++component)
            {
                force[component] += Scalar(form.roundScales[round][component])
                                    * s[form.cones().at(round) + component] * Scalar(scaling.load);
            }
        }
        solution.contactForce.segment<Forces>(Forces * point) = force.template cast<double>();
    }
    solution.displacement = Eigen::VectorXd::Zero(Rows * program.bodies);
    for (int body = 0; body < program.bodies; ++body)
    {
        const Eigen::Matrix<double, Rows, 1> rows =
            y.template segment<Rows>(Rows * form.position[body]).template cast<double>()
            * scaling.displacement;
        solution.displacement.segment<Rows>(Rows * body) = scaledRows<Rows>(rows, scaling.lever);
    }
    return solution;
}

template Form<3> makeForm(const PlaneConeProgram&, SymbolicAnalysis&, double);
template Form<6> makeForm(const SpaceConeProgram&, SymbolicAnalysis&, double);
template SchurSystem<3>& schurSystem(Form<3>&, SymbolicAnalysis&);
template SchurSystem<6>& schurSystem(Form<6>&, SymbolicAnalysis&);
template Eigen::VectorXd conesOf(const PlaneConeProgram&, const Form<3>&, const Eigen::VectorXd&);
template Eigen::VectorXd conesOf(const SpaceConeProgram&, const Form<6>&, const Eigen::VectorXd&);
template Eigen::VectorXd conesOfOpening(const Form<3>&, const Eigen::VectorXd&);
template Eigen::VectorXd conesOfOpening(const Form<6>&, const Eigen::VectorXd&);
template Eigen::VectorXd openingOf(const Form<3>&, const Eigen::VectorXd&);
template Eigen::VectorXd openingOf(const Form<6>&, const Eigen::VectorXd&);
template Eigen::VectorXd rowsOf(const Form<3>&, const Eigen::VectorXd&);
template Eigen::VectorXd rowsOf(const Form<6>&, const Eigen::VectorXd&);
template ConeSolution solutionOf(const PlaneConeProgram&, const Form<3>&, const VectorOf<double>&,
                                 const VectorOf<double>&, const double&);
template ConeSolution solutionOf(const SpaceConeProgram&, const Form<6>&, const VectorOf<double>&,
                                 const VectorOf<double>&, const double&);
template ConeSolution solutionOf(const PlaneConeProgram&, const Form<3>&, const VectorOf<DoubleDouble>&,
                                 const VectorOf<DoubleDouble>&, const DoubleDouble&);
template ConeSolution solutionOf(const SpaceConeProgram&, const Form<6>&, const VectorOf<DoubleDouble>&,
                                 const VectorOf<DoubleDouble>&, const DoubleDouble&);

} // namespace drystone
