// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Forces at rest of the dead load and of loads that are just carried, and what lies between them.
#include "dynamics/RestProof.h"

#include "conic/InteriorPoint.h"
#include "dynamics/ClosedPoints.h"

#include <Eigen/Dense>

#include <algorithm>
#include <numeric>

namespace drystone
{
namespace
{

/// Forces are known to this part of the tolerance, so that their means meet it.
constexpr double partOfTolerance = 0.1;

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

/// Solves the balance of the dead load, and of as much as possible of another one, by forces of closed
/// points. \param live or empty \return with forces of all points
template<int Dim>
ConeSolution solveBalance(RestProof<Dim>& proof, const Eigen::VectorXd& live)
{
    const StepProgram<Dim>& program = proof.program;
    const std::vector<char> isClosed = closedPoints<Dim>(program, proof.tolerance);
    StepProgram<Dim> balance;
    balance.bodies = program.bodies;
    balance.load = proof.deadLoad;
    balance.liveLoad = live;
    for (std::size_t point = 0; point < isClosed.size(); ++point)
    {
        if (isClosed[point])
        {
            balance.contacts.push_back(program.contacts[point]);
            balance.friction.push_back(program.friction[point]);
            if (program.hasStrength())
            {
                balance.strength.push_back(program.strength[point]);
            }
        }
    }
    InteriorPointSettings settings;
    settings.tolerance = partOfTolerance * proof.tolerance;
    ConeSolution solution = solveInteriorPoint(balance, settings);
    ++proof.programs;
    proof.factorisations += solution.factorisations;
    if (solution.contactForce.size() == 0)
    {
        return solution;
    }
    const Eigen::VectorXd ofClosed = std::move(solution.contactForce);
    solution.contactForce = Eigen::VectorXd::Zero(Dim * program.points());
    for (std::size_t point = 0, closed = 0; point < isClosed.size(); ++point)
    {
        if (isClosed[point])
        {
            solution.contactForce.segment<Dim>(Dim * static_cast<Eigen::Index>(point)) =
                ofClosed.segment<Dim>(Dim * static_cast<Eigen::Index>(closed++));
        }
    }
    return solution;
}

/// The largest multiple of a load that is carried with the dead load.
template<int Dim>
typename RestProof<Dim>::Carried mostOf(RestProof<Dim>& proof, const Eigen::VectorXd& live)
{
    ConeSolution solution = solveBalance(proof, live);
    if (solution.status == SolveStatus::optimal && solution.multiplier > 0)
    {
        return {solution.multiplier, std::move(solution.contactForce)};
    }
    if (solution.status == SolveStatus::unbounded)
    {
        const double factor = timesDeadLoad * proof.deadLoad.template lpNorm<Eigen::Infinity>()
                              / live.lpNorm<Eigen::Infinity>();
        return {factor, proof.forcesOfDeadLoad + factor * solution.contactForce};
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
std::vector<char> closedPoints(const StepProgram<Dim>& program, double tolerance)
{
    double fall = 0;
    for (int body = 0; body < program.bodies; ++body)
    {
        const Eigen::Index row = freedomCount<Dim> * body;
        fall = std::max(fall, program.load.template segment<Dim>(row).norm()
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
    const ConeSolution solution = solveBalance(proof, {});
    if (solution.status == SolveStatus::optimal)
    {
        proof.forcesOfDeadLoad = solution.contactForce;
    }
    return proof;
}

template<int Dim>
Eigen::VectorXd forcesAtRest(RestProof<Dim>& proof, const Eigen::VectorXd& load, double margin)
{
    if (proof.forcesOfDeadLoad.size() == 0)
    {
        return {};
    }
    const auto count = static_cast<Eigen::Index>(proof.directions.size());
    Eigen::MatrixXd directions(load.size(), count);
    for (Eigen::Index k = 0; k < count; ++k)
    {
        directions.col(k) = proof.directions[static_cast<std::size_t>(k)];
    }
    const Eigen::VectorXd live = ofTouched<Dim>(proof.program, load) - proof.deadLoad;
    const Eigen::VectorXd factors =
        count > 0 ? Eigen::VectorXd(
            (directions.transpose() * directions).ldlt().solve(directions.transpose() * live))
                  : Eigen::VectorXd();

    // b_k, in falling order
    std::vector<std::pair<double, int>> shares;
    for (Eigen::Index k = 0; k < count; ++k)
    {
        if (factors[k] == 0)
        {
            continue;
        }
        const int direction = static_cast<int>(factors[k] > 0 ? k + 1 : -k - 1);
        const double most = carriedOf(proof, {direction}).factor;
        const double share = most > 0 ? std::abs(factors[k]) / most : 1;
        if (share > 1 - margin)
        {
            return {};
        }
        shares.emplace_back(share, direction);
    }
    std::stable_sort(shares.begin(), shares.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });

    Eigen::VectorXd forces = proof.forcesOfDeadLoad;
    double used = 0;
    std::vector<int> key;
    for (std::size_t i = 0; i < shares.size(); ++i)
    {
        key.push_back(shares[i].second);
        const double weight = shares[i].first - (i + 1 < shares.size() ? shares[i + 1].first : 0);
        if (weight == 0)
        {
            continue;
        }
        std::vector<int> sorted = key;
        std::sort(sorted.begin(), sorted.end(), [](int a, int b) { return std::abs(a) < std::abs(b); });
        const auto& carried = carriedOf(proof, sorted);
        // Of one direction the multiplier is s_k itself; of several it is that of the sum of s_k L_k.
        const double share = key.size() == 1 ? weight : (carried.factor > 0 ? weight / carried.factor : 1);
        used += share;
        if (used > 1 - margin)
        {
            return {};
        }
        forces += share * (carried.contactForce - proof.forcesOfDeadLoad);
    }
    return forces;
}

template struct RestProof<2>;
template std::vector<char> closedPoints(const StepProgram<2>& program, double tolerance);
template RestProof<2> proofOfRest(StepProgram<2> program, double timeStep, Eigen::VectorXd deadLoad,
                                  const std::vector<Eigen::VectorXd>& loads, double tolerance);
template Eigen::VectorXd forcesAtRest(RestProof<2>& proof, const Eigen::VectorXd& load, double margin);
template struct RestProof<3>;
template std::vector<char> closedPoints(const StepProgram<3>& program, double tolerance);
template RestProof<3> proofOfRest(StepProgram<3> program, double timeStep, Eigen::VectorXd deadLoad,
                                  const std::vector<Eigen::VectorXd>& loads, double tolerance);
template Eigen::VectorXd forcesAtRest(RestProof<3>& proof, const Eigen::VectorXd& load, double margin);

} // namespace drystone
