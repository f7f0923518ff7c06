// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "conic/TreeBalance.h"

#include "linear/PivotBlock.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// The metric of the barrier at a force: its quadratic representation in the cone of friction, with the
/// eigenvectors (1, mu d) and (1, -mu d), d the direction of its shear, and that across them. \param least
/// that eigenvalues count as
template<int Forces>
Eigen::Matrix<double, Forces, Forces> barrierMetric(const Eigen::Matrix<double, Forces, 1>& force,
                                                    double friction, double least)
{
    using Force = Eigen::Matrix<double, Forces, 1>;
    Eigen::Matrix<double, Forces, Forces> metric = Eigen::Matrix<double, Forces, Forces>::Zero();
    if (!(friction > 0))
    {
        metric(0, 0) = std::pow(std::max(least, force[0]), 2);
        return metric;
    }
    using Shear = Eigen::Matrix<double, Forces - 1, 1>;
    const Shear shear = force.template tail<Forces - 1>();
    const double length = shear.norm();
    const Shear direction = length > 0 ? Shear(shear / length) : Shear(Shear::Unit(0));
    const double larger = std::max(least, force[0] + length / friction);
    const double smaller = std::max(least, force[0] - length / friction);
    Force along;
    along << 1, friction * direction;
    Force against;
    against << 1, -friction * direction;
    metric = (larger * larger * along).lazyProduct(along.transpose());
    metric += (smaller * smaller * against).lazyProduct(against.transpose());
    if constexpr (Forces == 3)
    {
        const Force across(0, -friction * direction[1], friction * direction[0]);
        metric += (2 * larger * smaller * across).lazyProduct(across.transpose());
    }
    return metric;
}

/// Changes the forces at the points of a branch by the least until they balance what its outer body lacks.
/// \param lacking load of that body that no other force balances \param allowed error of the balance
/// \param answers room for D A' of each point \return whether they do
template<int Rows, int Forces>
bool balanceBranch(const ConeProgram<Rows, Forces>& program, const TreeBranch& branch,
                   Eigen::Matrix<double, Rows, 1> lacking, double least, double allowed,
                   std::vector<Eigen::Matrix<double, Forces, Rows>>& answers, Eigen::VectorXd& forces)
{
    using Force = Eigen::Matrix<double, Forces, 1>;
    using System = Eigen::Matrix<double, Rows, Rows>;
    constexpr int mostRefinements = 4;
    constexpr double relative = 1e-13; // one point alone leaves S singular
    const auto at = [&forces](int point) { return forces.segment<Forces>(Forces * point); };
    System system = System::Zero();
    answers.clear();
    for (int point = branch.begin; point < branch.end; ++point)
    {
        const auto index = static_cast<std::size_t>(point);
        const auto& columns = columnsOn(program.contacts[index], branch.body);
        const Force force = at(point);
        answers.push_back(
            barrierMetric<Forces>(force, program.friction[index], least).lazyProduct(columns.transpose()));
        system += columns.lazyProduct(answers.back());
        lacking -= columns.lazyProduct(force);
    }
    system.diagonal() *= 1 + relative;
    System inverse; // of the factor
    if (!invertFactor<Rows, double>(system, inverse))
    {
        return false;
    }
    for (int refinement = 0; refinement <= mostRefinements; ++refinement)
    {
        if (lacking.template lpNorm<Eigen::Infinity>() <= allowed)
        {
            return true;
        }
        const Eigen::Matrix<double, Rows, 1> motion =
            inverse.transpose().lazyProduct(inverse.lazyProduct(lacking).eval());
        for (int point = branch.begin; point < branch.end; ++point)
        {
            const Force change = answers[static_cast<std::size_t>(point - branch.begin)].lazyProduct(motion);
            at(point) += change;
            lacking -=
                columnsOn(program.contacts[static_cast<std::size_t>(point)], branch.body).lazyProduct(change);
        }
    }
    return false;
}

} // namespace

template<int Rows, int Forces>
std::optional<std::vector<TreeBranch>> branchesOfTree(const ConeProgram<Rows, Forces>& program)
{
    std::vector<TreeBranch> pairs;
    pairs.reserve(static_cast<std::size_t>(program.points()));
    std::vector<int> pairsLeft(static_cast<std::size_t>(program.bodies), 0);
    std::vector<int> sumOfPairs(pairsLeft.size(), 0); // of those left: the pair itself where there is one
    for (int point = 0; point < program.points(); ++point)
    {
        const auto& columns = program.contacts[static_cast<std::size_t>(point)];
        if (!pairs.empty() && pairs.back().body == columns.first && pairs.back().other == columns.second)
        {
            pairs.back().end = point + 1;
            continue;
        }
        const int pair = static_cast<int>(pairs.size());
        pairs.push_back({point, point + 1, columns.first, columns.second});
        for (const int body : {columns.first, columns.second})
        {
            if (body >= 0)
            {
                ++pairsLeft[static_cast<std::size_t>(body)];
                sumOfPairs[static_cast<std::size_t>(body)] += pair;
            }
        }
    }
    std::vector<TreeBranch> branches;
    branches.reserve(pairs.size());
    for (int first = 0; first < program.bodies; ++first)
    {
        // From a leaf inwards, as far as what it hangs on becomes one.
        for (int body = first; body >= 0 && pairsLeft[static_cast<std::size_t>(body)] == 1;)
        {
            const int pair = sumOfPairs[static_cast<std::size_t>(body)];
            TreeBranch branch = pairs[static_cast<std::size_t>(pair)];
            if (branch.body != body)
            {
                std::swap(branch.body, branch.other);
            }
            branches.push_back(branch);
            pairsLeft[static_cast<std::size_t>(body)] = 0;
            if (branch.other >= 0)
            {
                --pairsLeft[static_cast<std::size_t>(branch.other)];
                sumOfPairs[static_cast<std::size_t>(branch.other)] -= pair;
            }
            body = branch.other;
        }
    }
    const auto betweenFixed = std::count_if(
        pairs.begin(), pairs.end(), [](const TreeBranch& pair) { return pair.body < 0 && pair.other < 0; });
    return branches.size() + static_cast<std::size_t>(betweenFixed) == pairs.size()
               ? std::optional(std::move(branches))
               : std::nullopt;
}

template<int Rows, int Forces>
Eigen::VectorXd nearestForcesInTree(const ConeProgram<Rows, Forces>& program,
                                    const std::vector<TreeBranch>& branches, const Eigen::VectorXd& near,
                                    double tolerance)
{
    constexpr double leastOfMean = 1e-3; // as in BalancedForces.cpp
    double squares = 0;
    for (Eigen::Index row = 0; row < near.size(); row += Forces)
    {
        squares += near[row] * near[row];
    }
    const double least = leastOfMean * std::sqrt(squares / std::max(1, program.points()));
    const double allowed = tolerance * program.load.template lpNorm<Eigen::Infinity>();
    Eigen::VectorXd forces = near;
    Eigen::VectorXd lacking = program.load;
    const auto rowsOf = [&lacking](int body) { return lacking.segment<Rows>(Rows * body); };
    std::vector<Eigen::Matrix<double, Forces, Rows>> answers;
    for (const TreeBranch& branch : branches)
    {
        if (!balanceBranch<Rows, Forces>(program, branch, rowsOf(branch.body), least, allowed, answers,
                                         forces))
        {
            return {};
        }
        for (int point = branch.begin; branch.other >= 0 && point < branch.end; ++point)
        {
            rowsOf(branch.other) -= columnsOn(program.contacts[static_cast<std::size_t>(point)], branch.other)
                                        .lazyProduct(forces.segment<Forces>(Forces * point));
        }
    }
    return forces;
}

template std::optional<std::vector<TreeBranch>> branchesOfTree(const PlaneConeProgram& program);
template std::optional<std::vector<TreeBranch>> branchesOfTree(const SpaceConeProgram& program);
template Eigen::VectorXd nearestForcesInTree(const PlaneConeProgram& program,
                                             const std::vector<TreeBranch>& branches,
                                             const Eigen::VectorXd& near, double tolerance);
template Eigen::VectorXd nearestForcesInTree(const SpaceConeProgram& program,
                                             const std::vector<TreeBranch>& branches,
                                             const Eigen::VectorXd& near, double tolerance);

} // namespace drystone
