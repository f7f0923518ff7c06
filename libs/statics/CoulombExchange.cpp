// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Forces of a point that slides become one column; mechanisms are the multipliers of a cone program.
#include "statics/CoulombExchange.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

/// Points that open or slide by less than this share of the largest rate stand still.
constexpr double stillRate = 1e-7;

/// Forces nearer to a limit than this share of the largest are at it.
constexpr double atLimit = 1e-7;

/// A mechanism is another one where what is in the way of a lower multiplier moves less by this share.
constexpr double smallestChange = 1e-3;

/// Of the forces that keep points from moving, whose weights in the objective are at most 1.
constexpr double widestBound = 1e4;

/// What a component of the rates of a point must not do, as the limits of the force that prevents it.
constexpr Strength mustNotClose = {};
constexpr Strength mustNotMove = {.tension = widestBound, .crushing = widestBound};

/// The mechanisms that forces allow by Coulomb's law, L'y = 1, as the multipliers of a program; its load, the
/// objective, is for others to say. Every component of A'y that is restricted is a point with a normal force
/// alone: one that must not close, or one that must not move, which a force between wide bounds prevents.
template<int Rows, int Forces>
ConeProgram<Rows, Forces> ratesProgram(const ConeProgram<Rows, Forces>& given, const VectorXd& forces)
{
    const double none = atLimit * forces.template lpNorm<Eigen::Infinity>();
    ConeProgram<Rows, Forces> rates;
    rates.bodies = given.bodies;
    rates.liveLoad = given.liveLoad;
    const auto restrict =
        [&](int point, const Eigen::Matrix<double, Forces, 1>& component, const Strength& limits)
    {
        ConeColumns<Rows, Forces> columns = given.contacts[static_cast<std::size_t>(point)];
        for (auto* side : {&columns.onFirst, &columns.onSecond})
        {
            side->col(0) = (*side * component).eval();
            side->template rightCols<Forces - 1>().setZero();
        }
        rates.contacts.push_back(columns);
        rates.friction.push_back(0);
        rates.strength.push_back(limits);
    };
    using Force = Eigen::Matrix<double, Forces, 1>;
    for (int point = 0; point < given.points(); ++point)
    {
        const Strength strength = given.strengthOf(static_cast<std::size_t>(point));
        const Force force = forces.template segment<Forces>(Forces * point);
        const double limit = strength.cohesion + given.friction[static_cast<std::size_t>(point)] * force[0];
        const auto shear = force.template tail<Forces - 1>();
        Force component = Force::Unit(0);
        const bool opens = force[0] <= -strength.tension + none;
        const bool closes = force[0] >= strength.crushing - none;
        restrict(point, closes ? Force(-component) : component, opens || closes ? mustNotClose : mustNotMove);
        if (limit <= none)
        {
            continue;
        }
        if (shear.norm() < limit - none)
        {
            for (int i = 1; i < Forces; ++i)
            {
                restrict(point, Force::Unit(i), mustNotMove);
            }
            continue;
        }
        component << 0, -shear / shear.norm();
        restrict(point, component, mustNotClose);
        if constexpr (Forces == 3)
        {
            component << 0, -shear[1] / shear.norm(), shear[0] / shear.norm();
            restrict(point, component, mustNotMove);
        }
    }
    return rates;
}

} // namespace

namespace
{

/// The forces that a mechanism allows: those of points that open or crush stay as they are; at points that
/// slide, t = (C + mu n) d against the slip, so that one column is left, with the constant part as a load;
/// all others are free within their limits.
template<int Rows, int Forces>
class SuitedForces
{
public:
    SuitedForces(const ConeProgram<Rows, Forces>& structure, const CoulombPair& pair)
        : program(structure),
          constant(VectorXd::Zero(Forces * structure.points())),
          given(structure),
          closing(applyTransposed(structure, pair.mechanism)),
          still(stillRate * closing.template lpNorm<Eigen::Infinity>())
    {
        for (int point = 0; point < given.points(); ++point)
        {
            restrict(point, pair.contactForce.template segment<Forces>(Forces * point));
        }
        program.load -= applyEquilibrium(given, constant);
        leaveOutPointsWithoutSay();
    }

    /// F k of the structure. \param ofProgram those of `program`
    VectorXd contactForce(const VectorXd& ofProgram) const
    {
        VectorXd forces = constant;
        for (std::size_t i = 0; i < kept.size(); ++i)
        {
            auto force = forces.template segment<Forces>(Forces * kept[i]);
            const auto from = ofProgram.template segment<Forces>(static_cast<Eigen::Index>(Forces * i));
            const auto slip = closing.template segment<Forces - 1>(Forces * kept[i] + 1);
            const double size = slip.norm();
            if (size > still)
            {
                force[0] = from[0];
                force.template tail<Forces - 1>() +=
                    given.friction[static_cast<std::size_t>(kept[i])] * from[0] * slip / size;
            }
            else
            {
                force = from;
            }
        }
        return forces;
    }

    ConeProgram<Rows, Forces> program; ///< of the forces that are left, with the live load of the structure

private:
    void restrict(int point, const Eigen::Matrix<double, Forces, 1>& force)
    {
        const auto at = static_cast<std::size_t>(point);
        const auto slip = closing.template segment<Forces - 1>(Forces * point + 1);
        const double size = slip.norm();
        auto& columns = program.contacts[at];
        if (std::abs(closing[Forces * point]) > still)
        {
            constant.template segment<Forces>(Forces * point) = force;
            columns.onFirst.setZero();
            columns.onSecond.setZero();
        }
        else if (size > still)
        {
            const Eigen::Matrix<double, Forces - 1, 1> direction = slip / size;
            for (auto* side : {&columns.onFirst, &columns.onSecond})
            {
                side->col(0) += given.friction[at] * side->template rightCols<Forces - 1>() * direction;
            }
            if (given.hasStrength())
            {
                constant.template segment<Forces - 1>(Forces * point + 1) =
                    given.strength[at].cohesion * direction;
                program.strength[at].cohesion = 0;
            }
            program.friction[at] = 0;
        }
    }

    void leaveOutPointsWithoutSay()
    {
        for (int point = 0; point < given.points(); ++point)
        {
            const auto from = static_cast<std::size_t>(point);
            const auto& columns = program.contacts[from];
            if (!columns.onFirst.isZero(0) || !columns.onSecond.isZero(0))
            {
                const auto to = kept.size();
                program.contacts[to] = columns;
                program.friction[to] = program.friction[from];
                if (given.hasStrength())
                {
                    program.strength[to] = program.strength[from];
                }
                kept.push_back(point);
            }
        }
        program.contacts.resize(kept.size());
        program.friction.resize(kept.size());
        program.strength.resize(given.hasStrength() ? kept.size() : 0);
    }

    VectorXd constant; ///< F k of the structure
    std::vector<int> kept;
    const ConeProgram<Rows, Forces>& given;
    VectorXd closing; ///< A'y
    double still;     ///< rates below
};

} // namespace

template<int Rows, int Forces>
std::vector<Eigen::Matrix<double, Rows, Rows>> inertiaOfPoints(const ConeProgram<Rows, Forces>& given)
{
    using Inertia = Eigen::Matrix<double, Rows, Rows>;
    constexpr double least = 1e-3; // of a body whose points do not feel all its motions
    std::vector<Inertia> ofBodies(static_cast<std::size_t>(given.bodies), Inertia::Zero());
    const auto add = [&ofBodies](int body, const Eigen::Matrix<double, Rows, Forces>& part)
    {
        if (body >= 0)
        {
            ofBodies[static_cast<std::size_t>(body)] += part * part.transpose();
        }
    };
    for (const ConeColumns<Rows, Forces>& columns : given.contacts)
    {
        add(columns.first, columns.onFirst);
        add(columns.second, columns.onSecond);
    }
    for (Inertia& inertia : ofBodies)
    {
        inertia += least * inertia.diagonal().maxCoeff() * Inertia::Identity();
    }
    return ofBodies;
}

template<int Rows, int Forces>
std::optional<LeastPair> leastPair(const ConeProgram<Rows, Forces>& given, const CoulombPair& pair,
                                   const ProgramSolver<Rows, Forces>& solve)
{
    SuitedForces<Rows, Forces> suited(given, pair);
    suited.program.liveLoad = -given.liveLoad;
    const ConeSolution solved = solve(suited.program);
    if (solved.status != SolveStatus::optimal)
    {
        return std::nullopt;
    }
    return LeastPair{{-solved.multiplier, suited.contactForce(solved.contactForce), pair.mechanism, {}},
                     solved.displacement};
}

template<int Rows, int Forces>
std::optional<CoulombPair> nearestPair(const ConeProgram<Rows, Forces>& given, const CoulombPair& pair,
                                       const ProgramSolver<Rows, Forces>& solve)
{
    SuitedForces<Rows, Forces> suited(given, pair);
    suited.program.load += pair.alpha * given.liveLoad;
    suited.program.liveLoad.resize(0);
    suited.program.inertia = inertiaOfPoints(given);
    suited.program.gap = VectorXd::Zero(Forces * suited.program.points());
    const ConeSolution solved = solve(suited.program);
    return solved.status == SolveStatus::optimal ? std::optional(
               CoulombPair{pair.alpha, suited.contactForce(solved.contactForce), pair.mechanism, {}})
                                                 : std::nullopt;
}

template<int Rows, int Forces>
std::optional<Eigen::VectorXd> otherMechanism(const ConeProgram<Rows, Forces>& given, const LeastPair& least,
                                              const ProgramSolver<Rows, Forces>& solve)
{
    const VectorXd closing = applyTransposed(given, least.pair.mechanism);
    const double still = stillRate * closing.template lpNorm<Eigen::Infinity>();
    const VectorXd price = applyTransposed(given, least.balance);
    const VectorXd& forces = least.pair.contactForce;
    VectorXd against = VectorXd::Zero(forces.size()); // w and v, as forces of the points
    for (int point = 0; point < given.points(); ++point)
    {
        const double friction = given.friction[static_cast<std::size_t>(point)];
        const auto slip = closing.template segment<Forces - 1>(Forces * point + 1);
        const auto shearPrice = price.template segment<Forces - 1>(Forces * point + 1);
        const double normalPrice = price[Forces * point];
        if (closing[Forces * point] < -still)
        {
            against[Forces * point] = std::max(0.0, normalPrice + friction * shearPrice.norm());
        }
        else if (slip.norm() > still)
        {
            const double weight = std::max(0.0, -shearPrice.dot(slip) / slip.norm());
            against.template segment<Forces - 1>(Forces * point + 1) = -weight * slip / slip.norm();
        }
    }
    const double largest = against.template lpNorm<Eigen::Infinity>();
    if (!(largest > stillRate * price.template lpNorm<Eigen::Infinity>()))
    {
        return std::nullopt;
    }
    against /= largest;

    ConeProgram<Rows, Forces> rates = ratesProgram(given, forces);
    rates.load = applyEquilibrium(given, against);
    const ConeSolution solved = solve(rates);
    const double inTheWay = -rates.load.dot(least.pair.mechanism);
    return solved.status == SolveStatus::optimal
                   && -rates.load.dot(solved.displacement) < (1 - smallestChange) * inTheWay
               ? std::optional(solved.displacement)
               : std::nullopt;
}

template<int Rows, int Forces>
std::optional<Eigen::VectorXd> mechanismOf(const ConeProgram<Rows, Forces>& given,
                                           const Eigen::VectorXd& forces,
                                           const ProgramSolver<Rows, Forces>& solve)
{
    VectorXd against = VectorXd::Zero(forces.size());
    for (Eigen::Index row = 0; row < forces.size(); row += Forces)
    {
        const auto shear = forces.template segment<Forces - 1>(row + 1);
        const double size = shear.norm();
        against[row] = 1;
        if (size > 0)
        {
            against.template segment<Forces - 1>(row + 1) = -shear / size;
        }
    }
    ConeProgram<Rows, Forces> rates = ratesProgram(given, forces);
    rates.load = applyEquilibrium(given, against);
    const ConeSolution solved = solve(rates);
    return solved.status == SolveStatus::optimal ? std::optional(solved.displacement) : std::nullopt;
}

template std::optional<LeastPair> leastPair(const PlaneConeProgram& given, const CoulombPair& pair,
                                            const ProgramSolver<3, 2>& solve);
template std::optional<LeastPair> leastPair(const SpaceConeProgram& given, const CoulombPair& pair,
                                            const ProgramSolver<6, 3>& solve);
template std::vector<Eigen::Matrix3d> inertiaOfPoints(const PlaneConeProgram& given);
template std::vector<Eigen::Matrix<double, 6, 6>> inertiaOfPoints(const SpaceConeProgram& given);
template std::optional<CoulombPair> nearestPair(const PlaneConeProgram& given, const CoulombPair& pair,
                                                const ProgramSolver<3, 2>& solve);
template std::optional<CoulombPair> nearestPair(const SpaceConeProgram& given, const CoulombPair& pair,
                                                const ProgramSolver<6, 3>& solve);
template std::optional<Eigen::VectorXd> otherMechanism(const PlaneConeProgram& given, const LeastPair& least,
                                                       const ProgramSolver<3, 2>& solve);
template std::optional<Eigen::VectorXd> otherMechanism(const SpaceConeProgram& given, const LeastPair& least,
                                                       const ProgramSolver<6, 3>& solve);

template std::optional<Eigen::VectorXd>
mechanismOf(const PlaneConeProgram& given, const Eigen::VectorXd& forces, const ProgramSolver<3, 2>& solve);
template std::optional<Eigen::VectorXd>
mechanismOf(const SpaceConeProgram& given, const Eigen::VectorXd& forces, const ProgramSolver<6, 3>& solve);

} // namespace drystone
