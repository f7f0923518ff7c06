// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Columns point by point in elimination order, units that are powers of two, and shares for threads.
#include "conic/form/Form.h"

#include "conic/form/PointCones.h"
#include "conic/form/PowerOfTwo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace drystone
{
namespace
{

/// Rows of one body with the moments divided by the lever arm.
template<int Rows>
Eigen::Matrix<double, Rows, 1> scaledRows(Eigen::Matrix<double, Rows, 1> rows, double lever)
{
    rows.template tail<Form<Rows>::moments>() /= lever;
    return rows;
}

/// A vector of body rows in elimination order, its moments as forces at the mean lever arm, with zeros at its
/// end for the ground and for each limit.
template<int Rows>
Eigen::VectorXd orderedLoad(const Form<Rows>& form, const Eigen::VectorXd& rows)
{
    Eigen::VectorXd result = Eigen::VectorXd::Zero(form.rows());
    for (int body = 0; body < form.bodies; ++body)
    {
        result.segment<Rows>(Rows * form.position[body]) =
            scaledRows<Rows>(rows.segment<Rows>(Rows * body), form.scaling.lever);
    }
    return result;
}

/// A vector of body rows in elimination order, scaled, with zeros at its end for the ground and for each
/// limit. Also its scale.
template<int Rows>
Eigen::VectorXd scaledLoad(const Form<Rows>& form, const Eigen::VectorXd& rows, double& scale)
{
    Eigen::VectorXd result = orderedLoad(form, rows);
    scale = powerOfTwo(result.lpNorm<Eigen::Infinity>());
    result /= scale;
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

/// Divides the groups into shares, which depend on their number alone.
template<int Rows>
void divideGroups(Form<Rows>& form)
{
    constexpr int fewest = 4096;
    constexpr int most = 32; // shares
    const int groups = static_cast<int>(form.groups.size());
    const int ofShare = std::max(fewest, (groups + most - 1) / most);
    if (groups <= ofShare)
    {
        return;
    }
    struct Known
    {
        int share = -1; // that touches it first,
        int last = -1;  // or did so last
        int place = 0;  // where that one adds
    };
    std::vector<Known> known(static_cast<std::size_t>(form.bodies) + 1);
    for (int begin = 0; begin < groups; begin += ofShare)
    {
        const int share = static_cast<int>(form.shares.size());
        form.shares.push_back({begin, std::min(begin + ofShare, groups)});
        const auto placeOf = [&](int body)
        {
            Known& of = known[static_cast<std::size_t>(body)];
            if (of.last != share)
            {
                of.last = share;
                of.share = of.share < 0 ? share : of.share;
                of.place = body;
                if (of.share != share && body < form.bodies)
                {
                    of.place = form.bodies + 1 + static_cast<int>(form.lent.size());
                    form.lent.push_back(body);
                }
            }
            return of.place;
        };
        for (int group = begin; group < form.shares.back().end; ++group)
        {
            const int first = placeOf(form.groups[group].first);
            form.places.push_back({first, placeOf(form.groups[group].second)});
        }
    }
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

/// Puts the bodies into the order of elimination.
template<int Rows>
void placeBodies(Form<Rows>& form, const SymbolicAnalysis& symbolic)
{
    form.position = placesIn(symbolic.order);
    form.couplings = couplingsByPlace(symbolic.touching, form.position);
}

template<int Rows, int Forces>
void reserve(Form<Rows>& form, const ConeProgram<Rows, Forces>& program)
{
    form.firstRay.reserve(program.contacts.size() + 1);
    form.firstRound.reserve(program.contacts.size() + 1);
    form.groups.reserve(form.couplings.size());
    if constexpr (Forces == 2) // friction alone gives each point two rays, in space a round cone
    {
        form.rays.reserve(2 * program.contacts.size());
        form.directions.reserve(2 * program.contacts.size());
    }
    else
    {
        form.rounds.reserve(program.contacts.size());
        form.roundScales.reserve(program.contacts.size());
    }
}

/// Opens a group where a point is not between the bodies of the last one. \param first, second places in the
/// order, first below second
template<int Rows>
void beginPoint(Form<Rows>& form, int first, int second)
{
    const int ray = static_cast<int>(form.rays.size());
    const int round = static_cast<int>(form.rounds.size());
    if (form.groups.empty() || form.groups.back().first != first || form.groups.back().second != second)
    {
        form.groups.push_back({first, second, ray, ray, -1, round, round});
    }
    form.firstRay.push_back(ray);
    form.firstRound.push_back(round);
}

/// Adds the columns of a point's cones to its group.
template<int Rows, int Forces>
void addCones(Form<Rows>& form, const ConeColumns<Rows, Forces>& columns, const PointCones<Forces>& cones,
              Bodies bodies)
{
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
}

} // namespace

template<int Rows, int Forces>
void analyse(const ConeProgram<Rows, Forces>& program, SymbolicAnalysis& symbolic)
{
    std::vector<Coupling> touching = touchingBodies(program);
    if (symbolic.order.empty() || symbolic.bodies != program.bodies || symbolic.touching != touching)
    {
        symbolic.bodies = program.bodies;
        symbolic.order = eliminationOrder(program.bodies, touching);
        symbolic.touching = std::move(touching);
        symbolic.systems = {};
        symbolic.unsymmetricSystems = {};
    }
}

template<int Rows, int Forces>
Form<Rows> makeForm(const ConeProgram<Rows, Forces>& program, SymbolicAnalysis& symbolic, double multiplier)
{
    Form<Rows> form;
    form.bodies = program.bodies;
    form.scaling.lever = powerOfTwo(meanLeverArm(program));
    analyse(program, symbolic);
    placeBodies(form, symbolic);
    reserve(form, program);
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
        beginPoint(form, std::min(one, other), std::max(one, other));
        if (point == 0 || program.hasStrength() || program.friction[point] != program.friction[point - 1])
        {
            cones = pointCones(program, point);
        }
        addCones(form, columns, cones, one < other ? Bodies::asGiven : Bodies::exchanged);
        if (program.hasStrength())
        {
            addLimits(form, program, point, cones);
        }
    }
    form.firstRay.push_back(static_cast<int>(form.rays.size()));
    form.firstRound.push_back(static_cast<int>(form.rounds.size()));
    divideGroups(form);
    setNumbers(form, program, multiplier);
    return form;
}

template<int Rows>
Eigen::VectorXd loadOf(const Form<Rows>& form, const Eigen::VectorXd& load)
{
    return orderedLoad(form, load) / form.scaling.load;
}

namespace
{

/// Whether points of one pair of bodies are in two shares, which would add to its coupling at the same time:
/// in programs whose pairs are not together.
template<int Rows>
bool isAnyPairShared(const Form<Rows>& form)
{
    std::vector<int> shareOf; // of each slot
    for (std::size_t share = 0; share < form.shares.size(); ++share)
    {
        for (int group = form.shares[share].begin; group < form.shares[share].end; ++group)
        {
            const int slot = form.groups[group].slot;
            if (slot < 0)
            {
                continue;
            }
            shareOf.resize(std::max(shareOf.size(), static_cast<std::size_t>(slot) + 1), -1);
            int& own = shareOf[static_cast<std::size_t>(slot)];
            if (own >= 0 && own != static_cast<int>(share))
            {
                return true;
            }
            own = static_cast<int>(share);
        }
    }
    return false;
}

} // namespace

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
    if (isAnyPairShared(form))
    {
        form.shares.clear(); // by one thread
    }
    return *kept;
}

template void analyse(const PlaneConeProgram&, SymbolicAnalysis&);
template void analyse(const SpaceConeProgram&, SymbolicAnalysis&);
template Form<3> makeForm(const PlaneConeProgram&, SymbolicAnalysis&, double);
template Form<6> makeForm(const SpaceConeProgram&, SymbolicAnalysis&, double);
template Eigen::VectorXd loadOf(const Form<3>& form, const Eigen::VectorXd& load);
template Eigen::VectorXd loadOf(const Form<6>& form, const Eigen::VectorXd& load);
template SchurSystem<3>& schurSystem(Form<3>&, SymbolicAnalysis&);
template SchurSystem<6>& schurSystem(Form<6>&, SymbolicAnalysis&);

} // namespace drystone
