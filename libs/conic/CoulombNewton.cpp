// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Newton's method in increments from the start, with shortened steps; forces become multipliers in turns.
#include "conic/CoulombNewton.h"

#include "conic/coulomb/ContactSystem.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace drystone
{
namespace
{

using Eigen::VectorXd;

/// rho, relative to the mass that a point moves. Small enough to begin with for Newton's method to find its
/// way among the states of the points, and growing slowly while it does.
constexpr double firstPenalty = 1e3;
constexpr double stiffestPenalty = 1e10;
constexpr double penaltyGrowth = 3;

constexpr int mostTurns = 30;

/// Along one Newton step the best of these shares is taken, or the first that lessens the residual enough: it
/// is smooth in pieces only, and a full step may cross many of them.
constexpr int mostHalvings = 8;
constexpr double leastDecrease = 0.1;

/// In increments from the start, in units that make the inertia 1: y = start + L'^-1 x.
template<int Rows, int Forces>
class CoulombNewton
{
public:
    CoulombNewton(const ConeProgram<Rows, Forces>& ofProgram, const ConeSolution& startAt,
                  SymbolicAnalysis& symbolic);

    /// Newton's method for fixed s. \return whether it ended
    bool minimise(double enough, int maximumIterations);
    /// s = c, and a larger rho. \return the error in gaps and slips that was left [m]
    double turn();

    double loadSize() const { return system.scaledRows(program.load).template lpNorm<Eigen::Infinity>(); }
    VectorXd displacement() const { return start + system.displacementOf(x); }
    const VectorXd& contactForce() const { return c; }
    int iterations = 0;
    int factorisations = 0;

private:
    using Force = Eigen::Matrix<double, Forces, 1>;

    /// rho times closings.
    VectorXd pressed(VectorXd closings) const;
    /// c(w), and the pieces of the law that w is on.
    void project();
    bool factorise();

    const ConeProgram<Rows, Forces>& program;
    ContactSystem<Rows, Forces> system;
    const VectorXd start;
    VectorXd load, gap;
    std::vector<SlidingLaw> laws;
    VectorXd rho; ///< of each point
    double penalty = firstPenalty;
    VectorXd s, w, c, x;
    std::vector<PointForce<Forces>> pieces, factorised;
};

template<int Rows, int Forces>
CoulombNewton<Rows, Forces>::CoulombNewton(const ConeProgram<Rows, Forces>& ofProgram,
                                           const ConeSolution& startAt, SymbolicAnalysis& symbolic)
    : program(ofProgram),
      system(ofProgram, Sliding::coulomb, symbolic),
      start(startAt.displacement),
      load(system.scaledRows(program.load - applyInertia(program, start))),
      gap(gapAfter(program, start)),
      laws(slidingLaws(program, Sliding::coulomb)),
      rho(program.points()),
      s(startAt.contactForce),
      w(s),
      c(s),
      x(VectorXd::Zero(load.size())),
      pieces(laws.size())
{
    for (int point = 0; point < program.points(); ++point)
    {
        rho[point] = firstPenalty / system.normalCompliance(point);
    }
}

template<int Rows, int Forces>
VectorXd CoulombNewton<Rows, Forces>::pressed(VectorXd closings) const
{
    for (int point = 0; point < program.points(); ++point)
    {
        closings.segment<Forces>(Forces * point) *= rho[point];
    }
    return closings;
}

template<int Rows, int Forces>
void CoulombNewton<Rows, Forces>::project()
{
    for (std::size_t point = 0; point < laws.size(); ++point)
    {
        const auto row = Forces * static_cast<Eigen::Index>(point);
        const Force trial = w.template segment<Forces>(row);
        pieces[point] = forceOn<Forces>(laws[point], stateOf<Forces>(laws[point], trial), trial);
        c.template segment<Forces>(row) = pieces[point].force;
    }
}

/// S of the pieces, unless it is that of the last time.
template<int Rows, int Forces>
bool CoulombNewton<Rows, Forces>::factorise()
{
    const bool isSame = std::equal(pieces.begin(), pieces.end(), factorised.begin(), factorised.end(),
                                   [](const PointForce<Forces>& a, const PointForce<Forces>& b)
                                   { return a.derivative == b.derivative; });
    if (isSame && factorisations > 0)
    {
        return true;
    }
    ++factorisations;
    factorised = pieces;
    return system.factorise(rho, pieces);
}

template<int Rows, int Forces>
bool CoulombNewton<Rows, Forces>::minimise(double enough, int maximumIterations)
{
    w = s + pressed(system.closings(x) - gap);
    project();
    VectorXd residual = load - x - system.forcesOnBodies(c);
    while (residual.lpNorm<Eigen::Infinity>() > enough)
    {
        if (iterations == maximumIterations || !residual.allFinite() || !factorise())
        {
            return false;
        }
        ++iterations;
        const VectorXd step = system.solve(residual);
        const VectorXd change = pressed(system.closings(step));
        // By increments: rho times a difference of numbers of order one would lose digits.
        const VectorXd from = w;
        const double norm = residual.norm();
        const auto go = [&](double share)
        {
            w = from + share * change;
            project();
            residual = load - x - share * step - system.forcesOnBodies(c);
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

template<int Rows, int Forces>
double CoulombNewton<Rows, Forces>::turn()
{
    double error = 0;
    for (int point = 0; point < program.points(); ++point)
    {
        error = std::max(error,
                         (c - s).template segment<Forces>(Forces * point).template lpNorm<Eigen::Infinity>()
                             / rho[point]);
    }
    s = c;
    if (penalty < stiffestPenalty)
    {
        penalty *= penaltyGrowth;
        rho *= penaltyGrowth;
        factorised.clear();
    }
    return error;
}

} // namespace

template<int Rows, int Forces>
ConeSolution solveCoulombNewton(const ConeProgram<Rows, Forces>& program, const ConeSolution& start,
                                const CoulombNewtonSettings& settings, SymbolicAnalysis& symbolic)
{
    if (!program.hasInertia() || program.hasMultiplier())
    {
        throw std::invalid_argument("solveCoulombNewton needs inertia and no multiplier");
    }
    if (program.hasCompliance() || program.hasCrushing())
    {
        throw std::invalid_argument("solveCoulombNewton needs rigid points that do not crush");
    }
    if (start.displacement.size() != program.load.size()
        || start.contactForce.size() != Forces * program.points())
    {
        throw std::invalid_argument("solveCoulombNewton needs a start of the size of the program");
    }
    CoulombNewton<Rows, Forces> newton(program, start, symbolic);
    ConeSolution solution;
    const double enough = settings.tolerance * newton.loadSize();
    double before = std::numeric_limits<double>::infinity();
    for (int turn = 0; turn < mostTurns && newton.minimise(enough, settings.maximumIterations); ++turn)
    {
        const double error = newton.turn();
        const bool isSettled = error > 0.9 * before && error <= settings.gapTolerance;
        if (isSettled
            || error <= settings.tolerance * newton.displacement().template lpNorm<Eigen::Infinity>())
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

template ConeSolution solveCoulombNewton(const PlaneConeProgram& program, const ConeSolution& start,
                                         const CoulombNewtonSettings& settings, SymbolicAnalysis& symbolic);
template ConeSolution solveCoulombNewton(const SpaceConeProgram& program, const ConeSolution& start,
                                         const CoulombNewtonSettings& settings, SymbolicAnalysis& symbolic);

} // namespace drystone
