// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Takes off leaf after leaf; in each branch forces change least in the metric of the barrier.
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
    if constexpr (Forces == 2) // whose shear has one direction
    {
        const double reach = force[1] / friction;
        const double along = std::pow(std::max(least, force[0] + reach), 2);
        const double against = std::pow(std::max(least, force[0] - reach), 2);
        metric(0, 0) = along + against;
        metric(1, 0) = metric(0, 1) = friction * (along - against);
        metric(1, 1) = friction * friction * (along + against);
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

/// What the forces at the points of a branch answer a motion of its outer body with.
template<int Rows, int Forces>
struct BranchAnswers
{
    std::vector<Eigen::Matrix<double, Forces, Rows>> ofPoint; ///< D A' of each point of the program
    std::vector<Eigen::Matrix<double, Rows, Rows>> inverse;   ///< of the factor of A D A' of each branch
};

/// \param least that eigenvalues of D count as \return nothing where the points of a branch can not give a
/// body every load
template<int Rows, int Forces>
std::optional<BranchAnswers<Rows, Forces>> answersOf(const ConeProgram<Rows, Forces>& program,
                                                     const std::vector<TreeBranch>& branches,
                                                     const Eigen::VectorXd& forces, double least)
{
    using System = Eigen::Matrix<double, Rows, Rows>;
    constexpr double relative = 1e-13; // one point alone leaves S singular
    BranchAnswers<Rows, Forces> answers;
    answers.ofPoint.resize(static_cast<std::size_t>(program.points()));
    answers.inverse.resize(branches.size());
    for (std::size_t i = 0; i < branches.size(); ++i)
    {
        System system = System::Zero();
        for (int point = branches[i].begin; point < branches[i].end; ++point)
        {
            const auto at = static_cast<std::size_t>(point);
            const auto& columns = columnsOn(program.contacts[at], branches[i].body);
            answers.ofPoint[at] =
                barrierMetric<Forces>(forces.segment<Forces>(Forces * point), program.friction[at], least)
                    .lazyProduct(columns.transpose());
            system += columns.lazyProduct(answers.ofPoint[at]);
        }
        system.diagonal() *= 1 + relative;
        if (!invertFactor<Rows, double>(system, answers.inverse[i]))
        {
            return std::nullopt;
        }
    }
    return answers;
}

/// Changes the forces at the points of a branch by the least until they balance what its outer body lacks.
/// \param lacking load of each body that no force balances \param allowed error of the balance \return
/// whether they do
template<int Rows, int Forces>
bool balanceBranch(const ConeProgram<Rows, Forces>& program, const TreeBranch& branch,
                   const BranchAnswers<Rows, Forces>& answers,
                   const Eigen::Matrix<double, Rows, Rows>& inverse, double allowed, Eigen::VectorXd& lacking,
                   Eigen::VectorXd& forces)
{
    constexpr int mostRefinements = 4;
    const auto own = lacking.segment<Rows>(Rows * branch.body);
    for (int refinement = 0; own.template lpNorm<Eigen::Infinity>() > allowed; ++refinement)
    {
        if (refinement == mostRefinements)
        {
            return false;
        }
        const Eigen::Matrix<double, Rows, 1> motion =
            inverse.transpose().lazyProduct(inverse.lazyProduct(own).eval());
        for (int point = branch.begin; point < branch.end; ++point)
        {
            const auto at = static_cast<std::size_t>(point);
            const Eigen::Matrix<double, Forces, 1> change = answers.ofPoint[at].lazyProduct(motion);
            forces.segment<Forces>(Forces * point) += change;
            addForce<Rows, Forces>(program.contacts[at], -change, lacking);
        }
    }
    return true;
}

} // namespace

template<int Rows, int Forces>
std::optional<std::vector<TreeBranch>> branchesOfTree(const ConeProgram<Rows, Forces>& program)
{
    std::vector<TreeBranch> pairs;
    pairs.reserve(static_cast<std::size_t>(program.points()));
    struct PairsLeft
    {
        int count = 0;
        int sum = 0; // of their indices: the pair itself where there is one
    };
    std::vector<PairsLeft> left(static_cast<std::size_t>(program.bodies));
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
                ++left[static_cast<std::size_t>(body)].count;
                left[static_cast<std::size_t>(body)].sum += pair;
            }
        }
    }
    std::vector<TreeBranch> branches;
    branches.reserve(pairs.size());
    for (int first = 0; first < program.bodies; ++first)
    {
        // From a leaf inwards, as far as what it hangs on becomes one.
        for (int body = first; body >= 0 && left[static_cast<std::size_t>(body)].count == 1;)
        {
            const int pair = left[static_cast<std::size_t>(body)].sum;
            TreeBranch branch = pairs[static_cast<std::size_t>(pair)];
            if (branch.body != body)
            {
                std::swap(branch.body, branch.other);
            }
            branches.push_back(branch);
            left[static_cast<std::size_t>(body)].count = 0;
            if (branch.other >= 0)
            {
                --left[static_cast<std::size_t>(branch.other)].count;
                left[static_cast<std::size_t>(branch.other)].sum -= pair;
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
    const auto answers = answersOf(program, branches, near, least);
    if (!answers)
    {
        return {};
    }
    Eigen::VectorXd forces = near;
    Eigen::VectorXd lacking = program.load - applyEquilibrium(program, forces);
    for (std::size_t i = 0; i < branches.size(); ++i)
    {
        if (!balanceBranch(program, branches[i], *answers, answers->inverse[i], allowed, lacking, forces))
        {
            return {};
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
