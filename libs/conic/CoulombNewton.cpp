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
    CoulombNewton(const PlaneConeProgram& program, const ConeSolution& start);

    /// Newton's method for fixed s. \return whether it ended
    bool minimise(double enough, int maximumIterations);
    /// s = c, and a larger rho. \return the error in gaps and slips that was left [m]
    double turn();

    double loadSize() const { return program_.load.cwiseQuotient(root_).lpNorm<Eigen::Infinity>(); }
    VectorXd displacement() const { return start_ + x_.cwiseQuotient(root_); }
    const VectorXd& contactForce() const { return c_; }
    int iterations = 0;
    int factorisations = 0;

private:
    void project();
    bool factorise();
    VectorXd solve(const VectorXd& rows);
    std::size_t diagonal(int body) const
    {
        return static_cast<std::size_t>(pattern_.columnStart[position_[body]]);
    }
    VectorXd columnsTimes(const VectorXd& forces) const;
    VectorXd columnsTransposedTimes(const VectorXd& x) const;

    const PlaneConeProgram& program_;
    const VectorXd start_;
    VectorXd root_; ///< of the inertia
    std::vector<ConeColumns<3, 2>> columns_;
    VectorXd load_, gap_;
    VectorXd rho_; ///< of each row of c
    double penalty_ = firstPenalty;
    VectorXd s_, w_, c_, x_;
    std::vector<PointState> states_, factorised_;
    std::vector<int> position_; ///< of each body in elimination order
    std::vector<int> slot_;     ///< of each point's pair in the pattern, or -1 on the ground
    BlockPattern pattern_;
    std::vector<Eigen::Matrix3d> lower_, upperTransposed_;
    std::optional<BlockLu<3>> factor_;
    VectorXd ordered_; ///< work: rows in elimination order
};

CoulombNewton::CoulombNewton(const PlaneConeProgram& program, const ConeSolution& start)
    : program_(program), start_(start.displacement), columns_(program.contacts), s_(start.contactForce)
{
    root_.resize(program.load.size());
    for (int body = 0; body < program.bodies; ++body)
    {
        root_.segment<3>(3 * body) = program.inertia[static_cast<std::size_t>(body)].diagonal().cwiseSqrt();
    }
    load_ = (program.load - applyInertia(program, start_)).cwiseQuotient(root_);
    gap_ = (program.gap.size() > 0 ? program.gap : VectorXd::Zero(2 * program.points()))
           - applyTransposed(program, start_);
    rho_.resize(2 * program.points());
    for (int point = 0; point < program.points(); ++point)
    {
        ConeColumns<3, 2>& column = columns_[static_cast<std::size_t>(point)];
        double compliance = 0;
        if (column.first >= 0)
        {
            column.onFirst.array().colwise() /= root_.segment<3>(3 * column.first).array();
            compliance += column.onFirst.col(0).squaredNorm();
        }
        if (column.second >= 0)
        {
            column.onSecond.array().colwise() /= root_.segment<3>(3 * column.second).array();
            compliance += column.onSecond.col(0).squaredNorm();
        }
        rho_.segment<2>(2 * point).setConstant(firstPenalty / compliance);
    }
    x_ = VectorXd::Zero(load_.size());
    w_ = s_;
    c_ = s_;
    states_.assign(static_cast<std::size_t>(program.points()), PointState::open);

    std::vector<Coupling> couplings;
    for (const ConeColumns<3, 2>& column : columns_)
    {
        if (column.first >= 0 && column.second >= 0)
        {
            couplings.push_back({column.first, column.second});
        }
    }
    const std::vector<int> order = eliminationOrder(program.bodies, couplings);
    position_.resize(order.size());
    for (int place = 0; place < program.bodies; ++place)
    {
        position_[order[place]] = place;
    }
    for (Coupling& pair : couplings)
    {
        pair = {position_[pair[0]], position_[pair[1]]};
    }
    pattern_ = makeBlockPattern(program.bodies, couplings);
    for (const ConeColumns<3, 2>& column : columns_)
    {
        slot_.push_back(column.first >= 0 && column.second >= 0
                            ? pattern_.slot(position_[column.first], position_[column.second])
                            : -1);
    }
    lower_.resize(pattern_.row.size());
    upperTransposed_.resize(pattern_.row.size());
    factor_.emplace(pattern_);
}

VectorXd CoulombNewton::columnsTimes(const VectorXd& forces) const
{
    VectorXd rows = VectorXd::Zero(load_.size());
    Eigen::Index row = 0;
    for (const ConeColumns<3, 2>& column : columns_)
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

VectorXd CoulombNewton::columnsTransposedTimes(const VectorXd& x) const
{
    VectorXd closing = VectorXd::Zero(2 * program_.points());
    Eigen::Index row = 0;
    for (const ConeColumns<3, 2>& column : columns_)
    {
        if (column.first >= 0)
        {
            closing.segment<2>(row) += column.onFirst.transpose() * x.segment<3>(3 * column.first);
        }
        if (column.second >= 0)
        {
            closing.segment<2>(row) += column.onSecond.transpose() * x.segment<3>(3 * column.second);
        }
        row += 2;
    }
    return closing;
}

void CoulombNewton::project()
{
    for (int point = 0; point < program_.points(); ++point)
    {
        const Strength strength =
            program_.hasStrength() ? program_.strength[static_cast<std::size_t>(point)] : Strength{};
        const double normal = std::max(-strength.tension, w_[2 * point]);
        const double most =
            std::max(0.0, strength.cohesion + program_.friction[static_cast<std::size_t>(point)] * normal);
        const double shear = w_[2 * point + 1];
        PointState& state = states_[static_cast<std::size_t>(point)];
        state = !(normal > -strength.tension)
                    ? (std::abs(shear) < most ? PointState::hangs : PointState::open)
                : shear >= most  ? PointState::slidesForwards
                : shear <= -most ? PointState::slidesBackwards
                                 : PointState::sticks;
        c_[2 * point] = normal;
        c_[2 * point + 1] = std::clamp(shear, -most, most);
    }
}

/// I + sum_k A_k (dc_k/dw_k) rho_k A_k'
bool CoulombNewton::factorise()
{
    if (factorisations > 0 && states_ == factorised_)
    {
        return true;
    }
    std::fill(lower_.begin(), lower_.end(), Eigen::Matrix3d::Zero());
    std::fill(upperTransposed_.begin(), upperTransposed_.end(), Eigen::Matrix3d::Zero());
    for (int body = 0; body < program_.bodies; ++body)
    {
        lower_[static_cast<std::size_t>(pattern_.columnStart[body])].setIdentity();
    }
    for (int point = 0; point < program_.points(); ++point)
    {
        const ConeColumns<3, 2>& column = columns_[static_cast<std::size_t>(point)];
        const double mu = program_.friction[static_cast<std::size_t>(point)];
        Eigen::Matrix2d change = Eigen::Matrix2d::Zero(); // dc/dw
        switch (states_[static_cast<std::size_t>(point)])
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
        change *= rho_[2 * point];
        const Eigen::Matrix<double, 3, 2> first = column.onFirst * change;
        const Eigen::Matrix<double, 3, 2> second = column.onSecond * change;
        if (column.first >= 0)
        {
            lower_[diagonal(column.first)] += first * column.onFirst.transpose();
        }
        if (column.second >= 0)
        {
            lower_[diagonal(column.second)] += second * column.onSecond.transpose();
        }
        if (column.first >= 0 && column.second >= 0)
        {
            const auto slot = static_cast<std::size_t>(slot_[static_cast<std::size_t>(point)]);
            if (position_[column.first] > position_[column.second])
            {
                lower_[slot] += first * column.onSecond.transpose();
                upperTransposed_[slot] += column.onFirst * second.transpose();
            }
            else
            {
                lower_[slot] += second * column.onFirst.transpose();
                upperTransposed_[slot] += column.onSecond * first.transpose();
            }
        }
    }
    ++factorisations;
    factorised_ = states_;
    return factor_->factorise(lower_, upperTransposed_);
}

VectorXd CoulombNewton::solve(const VectorXd& rows)
{
    ordered_.resize(rows.size());
    for (int body = 0; body < program_.bodies; ++body)
    {
        ordered_.segment<3>(3 * position_[body]) = rows.segment<3>(3 * body);
    }
    factor_->solve(ordered_);
    VectorXd result(rows.size());
    for (int body = 0; body < program_.bodies; ++body)
    {
        result.segment<3>(3 * body) = ordered_.segment<3>(3 * position_[body]);
    }
    return result;
}

bool CoulombNewton::minimise(double enough, int maximumIterations)
{
    VectorXd closing = columnsTransposedTimes(x_) - gap_;
    w_ = s_ + rho_.cwiseProduct(closing);
    project();
    VectorXd residual = load_ - x_ - columnsTimes(c_);
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
        const VectorXd from = w_;
        const double norm = residual.norm();
        const auto go = [&](double share)
        {
            w_ = from + share * rho_.cwiseProduct(closing);
            project();
            residual = load_ - x_ - share * step - columnsTimes(c_);
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
        x_ += best * step;
    }
    return true;
}

double CoulombNewton::turn()
{
    const double error = (c_ - s_).cwiseQuotient(rho_).lpNorm<Eigen::Infinity>();
    s_ = c_;
    if (penalty_ < largestPenalty)
    {
        penalty_ *= penaltyGrowth;
        rho_ *= penaltyGrowth;
        factorised_.clear();
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
