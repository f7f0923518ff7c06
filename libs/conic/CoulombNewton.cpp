// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/CoulombNewton.h"

#include "linear/BlockLu.h"
#include "linear/SchurSystem.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

/// rho, relative to the mass that a point moves. Small enough to begin with for Newton's method to find its
/// way among the states of the points, and growing slowly while it does: measured on the paper's walls in
/// collapse, from 1e4, or growing tenfold, many steps do not end.
constexpr double firstPenalty = 1e3;
constexpr double largestPenalty = 1e10;
constexpr double penaltyGrowth = 3;

constexpr int mostTurns = 30;

/// Along one Newton step the best of these shares is taken, or the first that lessens the residual enough: it
/// is piecewise linear, and a full step may cross many pieces.
constexpr int mostHalvings = 8;
constexpr double leastDecrease = 0.1;

enum class PointState : char
{
    open,  ///< carries what it can in tension and, if it slides too, in shear: nothing without strength
    hangs, ///< opens, but its cohesion keeps it from sliding
    sticks,
    slidesForwards,
    slidesBackwards
};

/// In increments from the start, in units that make the inertia 1: y = start + M^-1/2 x.
class CoulombNewton
{
public:
    CoulombNewton(const PlaneConeProgram& ofProgram, const ConeSolution& startAt);

    /// Newton's method for fixed s. \return whether it ended
    bool minimise(double enough, int maximumIterations);
    /// s = c, and a larger rho. \return the error in gaps and slips that was left [m]
    double turn();

    double loadSize() const { return program.load.cwiseQuotient(root).lpNorm<Eigen::Infinity>(); }
    VectorXd displacement() const { return start + x.cwiseQuotient(root); }
    const VectorXd& contactForce() const { return c; }
    int iterations = 0;
    int factorisations = 0;

private:
    void project();
    bool factorise();
    VectorXd solve(const VectorXd& rows);
    std::size_t diagonal(int body) const
    {
        return static_cast<std::size_t>(pattern.columnStart[position[body]]);
    }
    VectorXd columnsTimes(const VectorXd& forces) const;
    VectorXd columnsTransposedTimes(const VectorXd& rows) const;

    const PlaneConeProgram& program;
    const VectorXd start;
    VectorXd root; ///< of the inertia
    std::vector<ConeColumns<3, 2>> columns;
    VectorXd load, gap;
    VectorXd rho; ///< of each row of c
    double penalty = firstPenalty;
    VectorXd s, w, c, x;
    std::vector<PointState> states, factorised;
    std::vector<int> position; ///< of each body in elimination order
    std::vector<int> slot;     ///< of each point's pair in the pattern, or -1 on the ground
    BlockPattern pattern;
    std::vector<Eigen::Matrix3d> lower, upperTransposed;
    std::optional<BlockLu<3>> factor;
    VectorXd ordered; ///< work: rows in elimination order
};

CoulombNewton::CoulombNewton(const PlaneConeProgram& ofProgram, const ConeSolution& startAt)
    : program(ofProgram), start(startAt.displacement), columns(ofProgram.contacts), s(startAt.contactForce)
{
    root.resize(program.load.size());
    for (int body = 0; body < program.bodies; ++body)
    {
        root.segment<3>(3 * body) = program.inertia[static_cast<std::size_t>(body)].diagonal().cwiseSqrt();
    }
    load = (program.load - applyInertia(program, start)).cwiseQuotient(root);
    gap = (program.gap.size() > 0 ? program.gap : VectorXd::Zero(2 * program.points()))
          - applyTransposed(program, start);
    rho.resize(2 * program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        ConeColumns<3, 2>& column = columns[static_cast<std::size_t>(point)];
        double compliance = 0;
        if (column.first >= 0)
        {
            column.onFirst.array().colwise() /= root.segment<3>(3 * column.first).array();
            compliance += column.onFirst.col(0).squaredNorm();
        }
        if (column.second >= 0)
        {
            column.onSecond.array().colwise() /= root.segment<3>(3 * column.second).array();
            compliance += column.onSecond.col(0).squaredNorm();
        }
        rho.segment<2>(2 * point).setConstant(firstPenalty / compliance);
    }
    x = VectorXd::Zero(load.size());
    w = s;
    c = s;
    states.assign(static_cast<std::size_t>(program.points()), PointState::open);

    std::vector<Coupling> couplings;
    for (const ConeColumns<3, 2>& column : columns)
    {
        if (column.first >= 0 && column.second >= 0)
        {
            couplings.push_back({column.first, column.second});
        }
    }
    const std::vector<int> order = eliminationOrder(program.bodies, couplings);
    position.resize(order.size());
    for (int place = 0; place < program.bodies; ++place)
    {
        position[order[place]] = place;
    }
    for (Coupling& pair : couplings)
    {
        pair = {position[pair[0]], position[pair[1]]};
    }
    pattern = makeBlockPattern(program.bodies, couplings);
    for (const ConeColumns<3, 2>& column : columns)
    {
        slot.push_back(column.first >= 0 && column.second >= 0
                           ? pattern.slot(position[column.first], position[column.second])
                           : -1);
    }
    lower.resize(pattern.row.size());
    upperTransposed.resize(pattern.row.size());
    factor.emplace(pattern);
}

VectorXd CoulombNewton::columnsTimes(const VectorXd& forces) const
{
    VectorXd rows = VectorXd::Zero(load.size());
    Eigen::Index row = 0;
    for (const ConeColumns<3, 2>& column : columns)
    {
        const auto force = forces.segment<2>(row);
        if (column.first >= 0)
        {
            rows.segment<3>(3 * column.first) += column.onFirst * force;
        }
        if (column.second >= 0)
        {
            rows.segment<3>(3 * column.second) += column.onSecond * force;
        }
        row += 2;
    }
    return rows;
}

VectorXd CoulombNewton::columnsTransposedTimes(const VectorXd& rows) const
{
    VectorXd closing = VectorXd::Zero(2 * program.points());
    Eigen::Index row = 0;
    for (const ConeColumns<3, 2>& column : columns)
    {
        if (column.first >= 0)
        {
            closing.segment<2>(row) += column.onFirst.transpose() * rows.segment<3>(3 * column.first);
        }
        if (column.second >= 0)
        {
            closing.segment<2>(row) += column.onSecond.transpose() * rows.segment<3>(3 * column.second);
        }
        row += 2;
    }
    return closing;
}

void CoulombNewton::project()
{
    for (int point = 0; point < program.points(); ++point)
    {
        const Strength strength =
            program.hasStrength() ? program.strength[static_cast<std::size_t>(point)] : Strength{};
        const double normal = std::max(-strength.tension, w[2 * point]);
        const double most =
            std::max(0.0, strength.cohesion + program.friction[static_cast<std::size_t>(point)] * normal);
        const double shear = w[2 * point + 1];
        PointState& state = states[static_cast<std::size_t>(point)];
        state = !(normal > -strength.tension)
                    ? (std::abs(shear) < most ? PointState::hangs : PointState::open)
                : shear >= most  ? PointState::slidesForwards
                : shear <= -most ? PointState::slidesBackwards
                                 : PointState::sticks;
        c[2 * point] = normal;
        c[2 * point + 1] = std::clamp(shear, -most, most);
    }
}

/// I + sum_k A_k (dc_k/dw_k) rho_k A_k'
bool CoulombNewton::factorise()
{
    if (factorisations > 0 && states == factorised)
    {
        return true;
    }
    std::fill(lower.begin(), lower.end(), Eigen::Matrix3d::Zero());
    std::fill(upperTransposed.begin(), upperTransposed.end(), Eigen::Matrix3d::Zero());
    for (int body = 0; body < program.bodies; ++body)
    {
        lower[static_cast<std::size_t>(pattern.columnStart[body])].setIdentity();
    }
    for (int point = 0; point < program.points(); ++point)
    {
        const ConeColumns<3, 2>& column = columns[static_cast<std::size_t>(point)];
        const double mu = program.friction[static_cast<std::size_t>(point)];
        Eigen::Matrix2d change = Eigen::Matrix2d::Zero(); // dc/dw
        switch (states[static_cast<std::size_t>(point)])
        {
        case PointState::open:
            continue;
        case PointState::hangs:
            change << 0, 0, 0, 1;
            break;
        case PointState::sticks:
            change.setIdentity();
            break;
        case PointState::slidesForwards:
            change << 1, 0, mu, 0;
            break;
        case PointState::slidesBackwards:
            change << 1, 0, -mu, 0;
            break;
        }
        change *= rho[2 * point];
        const Eigen::Matrix<double, 3, 2> first = column.onFirst * change;
        const Eigen::Matrix<double, 3, 2> second = column.onSecond * change;
        if (column.first >= 0)
        {
            lower[diagonal(column.first)] += first * column.onFirst.transpose();
        }
        if (column.second >= 0)
        {
            lower[diagonal(column.second)] += second * column.onSecond.transpose();
        }
        if (column.first >= 0 && column.second >= 0)
        {
            const auto place = static_cast<std::size_t>(slot[static_cast<std::size_t>(point)]);
            if (position[column.first] > position[column.second])
            {
                lower[place] += first * column.onSecond.transpose();
                upperTransposed[place] += column.onFirst * second.transpose();
            }
            else
            {
                lower[place] += second * column.onFirst.transpose();
                upperTransposed[place] += column.onSecond * first.transpose();
            }
        }
    }
    ++factorisations;
    factorised = states;
    return factor->factorise(lower, upperTransposed);
}

VectorXd CoulombNewton::solve(const VectorXd& rows)
{
    ordered.resize(rows.size());
    for (int body = 0; body < program.bodies; ++body)
    {
        ordered.segment<3>(3 * position[body]) = rows.segment<3>(3 * body);
    }
    factor->solve(ordered);
    VectorXd result(rows.size());
    for (int body = 0; body < program.bodies; ++body)
    {
        result.segment<3>(3 * body) = ordered.segment<3>(3 * position[body]);
    }
    return result;
}

bool CoulombNewton::minimise(double enough, int maximumIterations)
{
    VectorXd closing = columnsTransposedTimes(x) - gap;
    w = s + rho.cwiseProduct(closing);
    project();
    VectorXd residual = load - x - columnsTimes(c);
    while (residual.lpNorm<Eigen::Infinity>() > enough)
    {
        if (iterations == maximumIterations || !residual.allFinite() || !factorise())
        {
            return false;
        }
        ++iterations;
        const VectorXd step = solve(residual);
        closing = columnsTransposedTimes(step);
        // By increments: rho times a difference of numbers of order one would lose digits.
        const VectorXd from = w;
        const double norm = residual.norm();
        const auto go = [&](double share)
        {
            w = from + share * rho.cwiseProduct(closing);
            project();
            residual = load - x - share * step - columnsTimes(c);
            return residual.norm();
        };
        double best = 1;
        double least = std::numeric_limits<double>::infinity();
        double share = 1;
        for (int halvings = 0; halvings <= mostHalvings; ++halvings, share /= 2)
        {
            const double now = go(share);
            if (now < least)
            {
                least = now;
                best = share;
            }
            if (now < (1 - leastDecrease * share) * norm)
            {
                break;
            }
        }
        if (share < best)
        {
            go(best);
        }
        x += best * step;
    }
    return true;
}

double CoulombNewton::turn()
{
    const double error = (c - s).cwiseQuotient(rho).lpNorm<Eigen::Infinity>();
    s = c;
    if (penalty < largestPenalty)
    {
        penalty *= penaltyGrowth;
        rho *= penaltyGrowth;
        factorised.clear();
    }
    return error;
}

} // namespace

ConeSolution solveCoulombNewton(const PlaneConeProgram& program, const ConeSolution& start,
                                const CoulombNewtonSettings& settings)
{
    if (!program.hasInertia() || program.hasMultiplier())
    {
        throw std::invalid_argument("solveCoulombNewton needs inertia and no multiplier");
    }
    if (program.hasCompliance() || program.hasCrushing())
    {
        throw std::invalid_argument("solveCoulombNewton needs rigid points that do not crush");
    }
    if (start.displacement.size() != program.load.size() || start.contactForce.size() != 2 * program.points())
    {
        throw std::invalid_argument("solveCoulombNewton needs a start of the size of the program");
    }
    CoulombNewton newton(program, start);
    ConeSolution solution;
    const double enough = settings.tolerance * newton.loadSize();
    double before = std::numeric_limits<double>::infinity();
    for (int turn = 0; turn < mostTurns && newton.minimise(enough, settings.maximumIterations); ++turn)
    {
        const double error = newton.turn();
        const bool isSettled = error > 0.9 * before && error <= settings.gapTolerance;
        if (isSettled || error <= settings.tolerance * newton.displacement().lpNorm<Eigen::Infinity>())
        {
            solution.status = SolveStatus::optimal;
            break;
        }
        before = error;
    }
    solution.displacement = newton.displacement();
    solution.contactForce = newton.contactForce();
    solution.iterations = newton.iterations;
    solution.factorisations = newton.factorisations;
    return solution;
}

} // namespace drystone
