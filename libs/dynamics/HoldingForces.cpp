// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The balance of the blocks within bodies: the nearest forces, repaired and certified.
#include "dynamics/HoldingForces.h"

#include "conic/BalancedForces.h"
#include "conic/TreeBalance.h"
#include "conic/form/Form.h"
#include "dynamics/ClosedPoints.h"
#include "dynamics/GroupChoice.h"
#include "dynamics/RestingStep.h"

#include <algorithm>
#include <optional>

namespace drystone
{
namespace
{

/// Where more than this share of the points within bodies fail, nothing is known of these.
constexpr double mostFailing = 0.2;

/// The balance of the blocks within the bodies: over the closed points there, under what they lack.
template<int Dim>
struct InnerBalance
{
    StepProgram<Dim> program;        ///< of all blocks, loads of those that share a body or are held
    std::vector<std::size_t> points; ///< of it
};

/// \param missing f - Mbar y - A_O c_O
template<int Dim>
InnerBalance<Dim> innerBalance(const Step<Dim>& step, const BlockGroups<Dim>& groups, Eigen::VectorXd missing)
{
    const StepProgram<Dim>& whole = step.program;
    InnerBalance<Dim> inner;
    inner.program.bodies = whole.bodies;
    inner.program.inertia = whole.inertia;
    inner.program.load = std::move(missing);
    for (std::size_t body = 0; body < groups.group.size(); ++body)
    {
        if (!groups.isBound(body))
        {
            inner.program.load
                .template segment<freedomCount<Dim>>(freedomCount<Dim> * static_cast<Eigen::Index>(body))
                .setZero();
        }
    }
    const bool isAnyHeld = std::find(groups.group.begin(), groups.group.end(), -1) != groups.group.end();
    const std::vector<char> isClosed =
        isAnyHeld ? closedPoints<Dim>(whole, whole.load, step.settings.solver.tolerance)
                  : std::vector<char>();
    const double kept = keptGap(step);
    inner.points.reserve(groups.inner.size());
    inner.program.contacts.reserve(groups.inner.size());
    inner.program.friction.reserve(groups.inner.size());
    for (const std::size_t point : groups.inner)
    {
        const auto& contact = whole.contacts[point];
        const bool moves = groups.of(contact.first >= 0 ? contact.first : contact.second) >= 0;
        const double gap = whole.gap[Dim * static_cast<Eigen::Index>(point)];
        if (std::abs(gap) <= kept || (isAnyHeld && isClosed[point] && !moves))
        {
            inner.points.push_back(point);
            inner.program.contacts.push_back(contact);
            inner.program.friction.push_back(whole.friction[point]);
        }
    }
    // What is kept of a gap counts as none, of a slip likewise, which held blocks have at supports that move.
    inner.program.gap = takenFrom<Dim>(inner.points, whole.gap);
    inner.program.gap = (inner.program.gap.array().abs() <= kept).select(0, inner.program.gap);
    return inner;
}

/// The program from which forces are found: one block of each body that moves is as good as the ground of the
/// others, since their balance is its own.
template<int Dim>
StepProgram<Dim> withGroundInBodies(const BlockGroups<Dim>& groups, StepProgram<Dim> program)
{
    std::vector<char> isGround(groups.group.size(), false);
    for (const std::vector<int>& blocks : groups.blocks)
    {
        if (blocks.size() > 1)
        {
            isGround[static_cast<std::size_t>(blocks.front())] = true;
            program.load.template segment<freedomCount<Dim>>(freedomCount<Dim> * blocks.front()).setZero();
        }
    }
    for (auto& contact : program.contacts)
    {
        for (int* body : {&contact.first, &contact.second})
        {
            *body = *body >= 0 && isGround[static_cast<std::size_t>(*body)] ? -1 : *body;
        }
    }
    program.inertia.clear();
    return program;
}

/// The program from which forces are found, made once it is needed.
template<int Dim>
class GroundedBalance
{
public:
    GroundedBalance(const BlockGroups<Dim>& ofBodies, const StepProgram<Dim>& ofBlocks)
        : groups(ofBodies), inner(ofBlocks)
    {
    }

    const StepProgram<Dim>& operator()()
    {
        return balance ? *balance : balance.emplace(withGroundInBodies(groups, inner));
    }

private:
    const BlockGroups<Dim>& groups;
    const StepProgram<Dim>& inner;
    std::optional<StepProgram<Dim>> balance;
};

/// Forces in balance that are the nearest to those near them; of another size where there are none.
template<int Dim>
Eigen::VectorXd forcesInBalance(Step<Dim>& step, const StepProgram<Dim>& inner,
                                GroundedBalance<Dim>& grounded, const Eigen::VectorXd& near, double tolerance)
{
    if (const auto branches = branchesOfTree(inner)) // as of columns
    {
        return nearestForcesInTree(inner, *branches, near, tolerance);
    }
    ++step.motion.attempt.factorisations;
    return nearestForces(grounded(), near, tolerance, *step.motion.symbolicOfHeld.get());
}

} // namespace

template<int Dim>
HoldingForces findHoldingForces(Step<Dim>& step, const BlockGroups<Dim>& groups, Eigen::VectorXd missing,
                                Eigen::VectorXd& forces)
{
    const double tolerance = step.settings.solver.tolerance;
    const double closer = partOfTolerance * tolerance;
    const InnerBalance<Dim> inner = innerBalance(step, groups, std::move(missing));
    GroundedBalance<Dim> grounded(groups, inner.program);
    const Eigen::VectorXd near = takenFrom<Dim>(inner.points, step.guess.contactForce);
    Eigen::VectorXd holding = forcesInBalance(step, inner.program, grounded, near, closer);
    if (holding.size() != inner.program.gap.size())
    {
        return {};
    }
    std::vector<std::size_t> failing =
        pointsOutside(inner.program, near, holding, step.scene.schemes.effects.margin);
    if (static_cast<double>(failing.size()) > mostFailing * static_cast<double>(inner.points.size()))
    {
        return {};
    }
    if (!failing.empty())
    {
        holding = repairedForces(grounded(), holding, failing, closer, step.motion.attempt.factorisations);
        if (holding.size() == 0)
        {
            for (std::size_t& point : failing)
            {
                point = inner.points[point];
            }
            return {false, {}, std::move(failing)};
        }
    }
    HoldingForces found;
    found.certificate = restWith(inner.program, holding).certificate;
    found.isFound = found.certificate.worst() <= tolerance;
    if (found.isFound)
    {
        putInto<Dim>(inner.points, holding, forces);
    }
    return found;
}

template HoldingForces findHoldingForces(Step<2>& step, const BlockGroups<2>& groups, Eigen::VectorXd missing,
                                         Eigen::VectorXd& forces);
template HoldingForces findHoldingForces(Step<3>& step, const BlockGroups<3>& groups, Eigen::VectorXd missing,
                                         Eigen::VectorXd& forces);

} // namespace drystone
