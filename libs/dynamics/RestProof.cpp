// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Forces at rest of the dead load and of loads that are just carried, and what lies between them.
#include "dynamics/RestProof.h"

#include "conic/BalancedForces.h"
#include "conic/InteriorPoint.h"
#include "conic/form/Form.h"
#include "dynamics/BlockGroups.h"
#include "dynamics/ClosedPoints.h"

#include <Eigen/Dense>

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

namespace drystone
{
namespace
{

/// A load of which the structure carries any amount is known up to so many times the dead load.
constexpr double timesDeadLoad = 10;

/// Rows of bodies that nothing touches are zero: nothing balances them, and the certificate of a step says
/// what that means.
template<int Dim>
Eigen::VectorXd ofTouched(const StepProgram<Dim>& program, Eigen::VectorXd rows)
{
    std::vector<char> isTouched(static_cast<std::size_t>(program.bodies), false);
    for (const auto& contact : program.contacts)
    {
        for (const int body : {contact.first, contact.second})
        {
            if (body >= 0)
            {
                isTouched[static_cast<std::size_t>(body)] = true;
            }
        }
    }
    for (int body = 0; body < program.bodies; ++body)
    {
        if (!isTouched[static_cast<std::size_t>(body)])
        {
            rows.segment<freedomCount<Dim>>(freedomCount<Dim> * body).setZero();
        }
    }
    return rows;
}

/// The balance over the closed points.
template<int Dim>
struct ClosedBalance
{
    StepProgram<Dim> program;        ///< its load the dead load
    std::vector<std::size_t> points; ///< of it, in the proof's program

    /// Forces of all points.
    Eigen::VectorXd ofAll(const StepProgram<Dim>& whole, const Eigen::VectorXd& forces) const
    {
        Eigen::VectorXd all = Eigen::VectorXd::Zero(Dim * whole.points());
        putInto<Dim>(points, forces, all);
        return all;
    }
};

template<int Dim>
ClosedBalance<Dim> closedBalance(const RestProof<Dim>& proof)
{
    const StepProgram<Dim>& program = proof.program;
    const std::vector<char>& isClosed = proof.isClosed;
    ClosedBalance<Dim> balance;
    balance.program.bodies = program.bodies;
    balance.program.load = proof.deadLoad;
    for (std::size_t point = 0; point < isClosed.size(); ++point)
    {
        if (isClosed[point])
        {
            balance.points.push_back(point);
            balance.program.contacts.push_back(program.contacts[point]);
            balance.program.friction.push_back(program.friction[point]);
            if (program.hasStrength())
            {
                balance.program.strength.push_back(program.strength[point]);
            }
        }
    }
    return balance;
}

template<int Dim>
ConeSolution solveCounted(RestProof<Dim>& proof, const StepProgram<Dim>& balance,
                          const InteriorPointSettings& settings)
{
    ConeSolution solution = solveInteriorPoint(balance, settings);
    ++proof.programs;
    proof.factorisations += solution.factorisations;
    return solution;
}

/// Nearly the largest multiple of a load that is carried with the dead load, from a program that is solved
/// roughly: most of it, and a little of the forces of the dead load, which are inside the cones, by the
/// nearest forces that balance them. A program of a wall with one degenerate joint may take hundreds of
/// factorisations to its last digits, which a proof has no use for.
template<int Dim>
typename RestProof<Dim>::Carried nearlyMostOf(RestProof<Dim>& proof, ClosedBalance<Dim> balance)
{
    constexpr double roughly = 1e-6;
    constexpr double part = 0.9999; // what is left is far more than roughly
    InteriorPointSettings settings;
    settings.tolerance = roughly;
    settings.arithmetic = Arithmetic::standard;
    const ConeSolution solution = solveCounted(proof, balance.program, settings);
    if (solution.status != SolveStatus::optimal || solution.multiplier <= 0)
    {
        return {};
    }
    const double factor = part * solution.multiplier;
    balance.program.load += factor * balance.program.liveLoad;
    balance.program.liveLoad.resize(0);
    const Eigen::VectorXd near =
        part * solution.contactForce + (1 - part) * takenFrom<Dim>(balance.points, proof.forcesOfDeadLoad);
    SymbolicAnalysis symbolic;
    const Eigen::VectorXd forces =
        nearestForces(balance.program, near, partOfTolerance * proof.tolerance, symbolic);
    ++proof.factorisations;
    if (forces.size() == 0 || !pointsOutside(balance.program, near, forces, 0).empty())
    {
        return {};
    }
    return {factor, balance.ofAll(proof.program, forces)};
}

/// The largest multiple of a load that is carried with the dead load, or nearly.
template<int Dim>
typename RestProof<Dim>::Carried mostOf(RestProof<Dim>& proof, const Eigen::VectorXd& live)
{
    ClosedBalance<Dim> balance = closedBalance(proof);
    balance.program.liveLoad = live;
    if (!balance.program.hasStrength()) // of which nearest forces know nothing
    {
        typename RestProof<Dim>::Carried nearly = nearlyMostOf(proof, balance);
        if (nearly.factor > 0)
        {
            return nearly;
        }
    }
    InteriorPointSettings settings;
    settings.tolerance = partOfTolerance * proof.tolerance;
    const ConeSolution solution = solveCounted(proof, balance.program, settings);
    if (solution.status == SolveStatus::optimal && solution.multiplier > 0)
    {
        return {solution.multiplier, balance.ofAll(proof.program, solution.contactForce)};
    }
    if (solution.status == SolveStatus::unbounded)
    {
        const double factor = timesDeadLoad * proof.deadLoad.template lpNorm<Eigen::Infinity>()
                              / live.lpNorm<Eigen::Infinity>();
        return {factor,
                proof.forcesOfDeadLoad + factor * balance.ofAll(proof.program, solution.contactForce)};
    }
    return {};
}

/// The entry for the sum of some directions, found if it is not known.
/// \param key directions from 1 on, negative for the opposite, by size
template<int Dim>
const typename RestProof<Dim>::Carried& carriedOf(RestProof<Dim>& proof, const std::vector<int>& key)
{
    const auto known = proof.carried.find(key);
    if (known != proof.carried.end())
    {
        return known->second;
    }
    Eigen::VectorXd live = Eigen::VectorXd::Zero(proof.deadLoad.size());
    for (const int direction : key)
    {
        const double size = key.size() == 1 ? 1 : carriedOf(proof, {direction}).factor;
        live += (direction > 0 ? size : -size)
                * proof.directions[static_cast<std::size_t>(std::abs(direction) - 1)];
    }
    return proof.carried.emplace(key, mostOf(proof, live)).first->second;
}

} // namespace

template<int Dim>
std::vector<char> closedPoints(const StepProgram<Dim>& program, const Eigen::VectorXd& load, double tolerance)
{
    double fall = 0;
    for (int body = 0; body < program.bodies; ++body)
    {
        const Eigen::Index row = freedomCount<Dim> * body;
        fall = std::max(fall, load.template segment<Dim>(row).norm()
                                  / program.inertia[static_cast<std::size_t>(body)](0, 0));
    }
    std::vector<char> isClosed(program.contacts.size(), true);
    for (int point = 0; program.gap.size() > 0 && point < program.points(); ++point)
    {
        isClosed[static_cast<std::size_t>(point)] =
            program.gap[Dim * point] <= partOfTolerance * tolerance * fall;
    }
    return isClosed;
}

template<int Dim>
RestProof<Dim> proofOfRest(StepProgram<Dim> program, double timeStep, Eigen::VectorXd deadLoad,
                           const std::vector<Eigen::VectorXd>& loads, double tolerance)
{
    constexpr double independent = 1e-6; // of what is left of a load without those before it
    RestProof<Dim> proof;
    proof.program = std::move(program);
    proof.timeStep = timeStep;
    proof.tolerance = tolerance;
    proof.deadLoad = ofTouched<Dim>(proof.program, std::move(deadLoad));
    proof.isClosed = closedPoints<Dim>(proof.program, proof.deadLoad, tolerance);
    std::vector<Eigen::VectorXd> axes;
    for (const Eigen::VectorXd& load : loads)
    {
        const Eigen::VectorXd direction = ofTouched<Dim>(proof.program, load);
        Eigen::VectorXd left = direction;
        for (const Eigen::VectorXd& axis : axes)
        {
            left -= axis.dot(left) * axis;
        }
        if (left.norm() > independent * direction.norm())
        {
            axes.push_back(left.normalized());
            proof.directions.push_back(direction);
        }
    }
    const ClosedBalance<Dim> balance = closedBalance(proof);
    InteriorPointSettings settings;
    settings.tolerance = partOfTolerance * tolerance;
    const ConeSolution solution = solveCounted(proof, balance.program, settings);
    if (solution.status == SolveStatus::optimal)
    {
        proof.forcesOfDeadLoad = balance.ofAll(proof.program, solution.contactForce);
    }
    return proof;
}

template<int Dim>
RestProof<Dim> proofOfElasticRest(StepProgram<Dim> program, double timeStep, Eigen::VectorXd forces)
{
    RestProof<Dim> proof;
    proof.deadLoad = program.load;
    proof.program = std::move(program);
    proof.timeStep = timeStep;
    proof.forcesOfDeadLoad = std::move(forces);
    return proof;
}

namespace
{

/// The share b_k = |a_k|/s_k that a load takes of what a direction alone carries.
struct LoadShare
{
    double share = 0;
    int direction = 0; ///< from 1 on, negative for the opposite, as in RestProof::carried
};

/// The shares of a load f0 + sum_k a_k L_k in falling order, those of its directions that are not 0; nothing
/// where one is more than the margin leaves. \param live the load without f0
template<int Dim>
std::optional<std::vector<LoadShare>> sharesOf(const Eigen::VectorXd& live, RestProof<Dim>& proof,
                                               double margin)
{
    const auto count = static_cast<Eigen::Index>(proof.directions.size());
    Eigen::MatrixXd directions(live.size(), count);
    for (Eigen::Index k = 0; k < count; ++k)
    {
        directions.col(k) = proof.directions[static_cast<std::size_t>(k)];
    }
    const Eigen::VectorXd factors =
        count > 0 ? Eigen::VectorXd(
            (directions.transpose() * directions).ldlt().solve(directions.transpose() * live))
                  : Eigen::VectorXd(); // a_k
    std::vector<LoadShare> shares;
    for (Eigen::Index k = 0; k < count; ++k)
    {
        if (factors[k] == 0)
        {
            continue;
        }
        const int direction = static_cast<int>(factors[k] > 0 ? k + 1 : -k - 1);
        const double most = carriedOf(proof, {direction}).factor;
        const double share = std::abs(factors[k]) / most;
        if (!(share <= 1 - margin)) // nothing is carried: not a number, or infinite
        {
            return std::nullopt;
        }
        shares.push_back({share, direction});
    }
    std::stable_sort(shares.begin(), shares.end(),
                     [](const LoadShare& a, const LoadShare& b) { return a.share > b.share; });
    return shares;
}

} // namespace

template<int Dim>
Eigen::VectorXd forcesAtRest(RestProof<Dim>& proof, const Eigen::VectorXd& load, double margin)
{
    if (proof.forcesOfDeadLoad.size() == 0)
    {
        return {};
    }
    const Eigen::VectorXd live = ofTouched<Dim>(proof.program, load) - proof.deadLoad;
    const std::optional<std::vector<LoadShare>> shares = sharesOf(live, proof, margin);
    if (!shares)
    {
        return {};
    }
    // c = c_0 + sum lambda_i (c_i - c_0), lambda_i = (b_i - b_i+1)/alpha_i
    Eigen::VectorXd forces = proof.forcesOfDeadLoad;
    double used = 0;
    std::vector<int> key;
    for (std::size_t i = 0; i < shares->size(); ++i)
    {
        key.push_back((*shares)[i].direction);
        const double weight = (*shares)[i].share - (i + 1 < shares->size() ? (*shares)[i + 1].share : 0);
        if (weight == 0)
        {
            continue;
        }
        std::vector<int> sorted = key;
        std::sort(sorted.begin(), sorted.end(), [](int a, int b) { return std::abs(a) < std::abs(b); });
        const auto& carried = carriedOf(proof, sorted);
        // Of one direction the multiplier is s_k itself; of several it is that of the sum of s_k L_k.
        const double share = key.size() == 1 ? weight : weight / carried.factor;
        used += share;
        if (!(used <= 1 - margin))
        {
            return {};
        }
        forces += share * (carried.contactForce - proof.forcesOfDeadLoad);
    }
    return forces;
}

template struct RestProof<2>;
template std::vector<char> closedPoints(const StepProgram<2>& program, const Eigen::VectorXd& load,
                                        double tolerance);
template RestProof<2> proofOfRest(StepProgram<2> program, double timeStep, Eigen::VectorXd deadLoad,
                                  const std::vector<Eigen::VectorXd>& loads, double tolerance);
template RestProof<2> proofOfElasticRest(StepProgram<2> program, double timeStep, Eigen::VectorXd forces);
template Eigen::VectorXd forcesAtRest(RestProof<2>& proof, const Eigen::VectorXd& load, double margin);
template struct RestProof<3>;
template std::vector<char> closedPoints(const StepProgram<3>& program, const Eigen::VectorXd& load,
                                        double tolerance);
template RestProof<3> proofOfRest(StepProgram<3> program, double timeStep, Eigen::VectorXd deadLoad,
                                  const std::vector<Eigen::VectorXd>& loads, double tolerance);
template RestProof<3> proofOfElasticRest(StepProgram<3> program, double timeStep, Eigen::VectorXd forces);
template Eigen::VectorXd forcesAtRest(RestProof<3>& proof, const Eigen::VectorXd& load, double margin);

} // namespace drystone
