// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The program of the bodies that a step is taken with, and the forces that hold each of them together.
#include "dynamics/HeldBlocks.h"

#include "conic/BalancedForces.h"
#include "conic/form/Form.h"
#include "dynamics/BlockGroups.h"
#include "dynamics/ClosedPoints.h"
#include "dynamics/GroupChoice.h"
#include "dynamics/RestingStep.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// Fewer bodies than this share of the blocks, or it does not pay.
constexpr double mostBodies = 0.7;

/// Where a guess is not proved it is changed so many times less one.
constexpr int attempts = 3;

/// Where more than this share of the points within bodies fail, another guess is of no use.
constexpr double mostFailing = 0.2;

/// Forces within the bodies are known to this part of the tolerance of the step.
constexpr double innerPartOfTolerance = 0.1;

/// The balance of the blocks within the bodies: over the closed points there, under what they lack.
template<int Dim>
struct InnerBalance
{
    StepProgram<Dim> program;        ///< of all blocks, loads of those that share a body or are held
    std::vector<std::size_t> points; ///< of it
};

/// Whether a block shares its body with others, or is held.
template<int Dim>
bool isBound(const BlockGroups<Dim>& groups, std::size_t body)
{
    const int group = groups.group[body];
    return group < 0 || groups.blocks[static_cast<std::size_t>(group)].size() > 1;
}

/// See Step::isShared.
template<int Dim>
std::vector<char> sharedBlocks(const BlockGroups<Dim>& groups)
{
    std::vector<char> isShared;
    if (!groups.areSingle())
    {
        isShared.resize(groups.group.size());
        for (std::size_t body = 0; body < isShared.size(); ++body)
        {
            isShared[body] = groups.group[body] >= 0 && isBound(groups, body);
        }
    }
    return isShared;
}

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
        if (!isBound(groups, body))
        {
            inner.program.load
                .template segment<freedomCount<Dim>>(freedomCount<Dim> * static_cast<Eigen::Index>(body))
                .setZero();
        }
    }
    const std::vector<char> isClosed = closedPoints<Dim>(whole, step.settings.solver.tolerance);
    std::vector<double> gaps;
    for (const std::size_t point : groups.inner)
    {
        const auto& contact = whole.contacts[point];
        const bool moves = groups.of(contact.first >= 0 ? contact.first : contact.second) >= 0;
        const double gap = whole.gap[Dim * static_cast<Eigen::Index>(point)];
        if (moves ? std::abs(gap) <= keptGap(step) : isClosed[point])
        {
            inner.points.push_back(point);
            inner.program.contacts.push_back(contact);
            inner.program.friction.push_back(whole.friction[point]);
            gaps.push_back(moves ? 0 : gap);
        }
    }
    inner.program.gap = Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(gaps.size()));
    for (std::size_t i = 0; i < gaps.size(); ++i)
    {
        inner.program.gap[Dim * static_cast<Eigen::Index>(i)] = gaps[i];
    }
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

Certificate larger(const Certificate& one, const Certificate& other)
{
    return {std::max(one.primalResidual, other.primalResidual),
            std::max(one.dualResidual, other.dualResidual), std::max(one.gap, other.gap)};
}

/// The interior of the bodies' program among all blocks; zero at the points within, as if they were new.
template<int Dim>
InteriorStart interiorOfWhole(const BlockGroups<Dim>& groups, const StepProgram<Dim>& whole,
                              const InteriorStart& own)
{
    if (own.isEmpty())
    {
        return {};
    }
    InteriorStart interior;
    interior.contactForce = Eigen::VectorXd::Zero(whole.gap.size());
    interior.opening = Eigen::VectorXd::Zero(whole.gap.size());
    putInto<Dim>(groups.outer, own.contactForce, interior.contactForce);
    putInto<Dim>(groups.outer, own.opening, interior.opening);
    interior.displacement = linearDisplacement(groups, own.displacement);
    return interior;
}

/// How a guess came out.
struct Outcome
{
    bool isProved = false;
    std::vector<std::size_t> failing; ///< points of the whole that are not; none: nothing is known
};

/// Gives the solution of the bodies to all blocks. \param displacement of the bodies
template<int Dim>
void takeOver(Step<Dim>& step, const BlockGroups<Dim>& groups, const StepProgram<Dim>& whole, ThetaStep own,
              Eigen::VectorXd forces, const Eigen::VectorXd& displacement)
{
    ThetaStep& result = step.solved.result;
    result = std::move(own);
    result.displacement = displacementOfBlocks(groups, displacement);
    result.contactForce = std::move(forces);
    result.closing = applyTransposed(whole, result.displacement);
    result.interior = interiorOfWhole(groups, whole, result.interior);
}

template<int Dim>
Outcome solveGroups(Step<Dim>& step, const BlockGroups<Dim>& groups)
{
    StepProgram<Dim> whole = step.program;
    const double tolerance = step.settings.solver.tolerance;
    const StepProgram<Dim> program = programOfGroups(groups, whole);
    ThetaStep own = solveThetaStep(program, step.settings, guessOfGroups(groups, whole, program, step.guess),
                                   relinearisationOfGroups(step, groups, whole), step.motion.symbolic.get());
    countWork(step, own.iterations, own.factorisations, own.programs);
    if (own.status != SolveStatus::optimal)
    {
        return {};
    }
    Eigen::VectorXd displacement = own.displacement;
    if (!groups.areSingle())
    {
        displacement = balancedDisplacement(groups, whole, program, own.contactForce, displacement);
        if ((displacement - own.displacement).template lpNorm<Eigen::Infinity>()
            > tolerance * displacement.lpNorm<Eigen::Infinity>())
        {
            return {};
        }
    }
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(whole.gap.size());
    putInto<Dim>(groups.outer, own.contactForce, forces);
    const Eigen::VectorXd y = displacementOfBlocks(groups, displacement);
    const InnerBalance<Dim> inner = innerBalance(
        step, groups, Eigen::VectorXd(whole.load - applyInertia(whole, y) - applyEquilibrium(whole, forces)));
    const Eigen::VectorXd near = takenFrom<Dim>(inner.points, step.guess.contactForce);
    const Eigen::VectorXd holding =
        nearestForces(withGroundInBodies(groups, inner.program), near, innerPartOfTolerance * tolerance,
                      *step.motion.symbolicOfHeld.get());
    ++step.motion.attempt.factorisations;
    if (holding.size() != inner.program.gap.size())
    {
        return {};
    }
    std::vector<std::size_t> failing =
        pointsOutside(inner.program, near, holding, step.scene.schemes.effects.margin);
    if (!failing.empty())
    {
        for (std::size_t& point : failing)
        {
            point = inner.points[point];
        }
        return {false, std::move(failing)};
    }
    const Rest rest = restWith(inner.program, holding);
    if (rest.certificate.worst() > tolerance)
    {
        return {};
    }
    putInto<Dim>(inner.points, holding, forces);
    own.certificate = larger(own.certificate, rest.certificate);
    takeOver(step, groups, whole, std::move(own), std::move(forces), displacement);
    return {true, {}};
}

/// Says which blocks were simulated, and in which bodies.
template<int Dim>
void keepGroups(Step<Dim>& step, const BlockGroups<Dim>& groups)
{
    const std::vector<int>& free = step.scene.free;
    std::vector<char>& isAwake = step.motion.isAwake;
    std::vector<int>& bodies = step.motion.bodies;
    isAwake.assign(free.size(), false);
    bodies.assign(free.size(), -1);
    for (std::size_t block = 0; block < free.size(); ++block)
    {
        bodies[block] = groups.of(free[block]);
        isAwake[block] = bodies[block] >= 0;
    }
}

} // namespace

template<int Dim>
std::string_view whyAllBlocks(const DynamicCase<Dim>& scene)
{
    if (traitsOf(scene.effects).isCompliant)
    {
        return "elastic joints give way at rest too";
    }
    if (scene.schemes.timeIntegration.theta < 1)
    {
        return "with theta below 1 blocks that meet have impacts of their own, which depend on forces that "
               "are not "
               "unique";
    }
    if (scene.flowRule() == FlowRule::nonAssociative)
    {
        if (Dim == 3)
        {
            return "in space Coulomb's law is reached to a part of what a step does, so that two ways to it "
                   "differ";
        }
        if (hasImpacts(scene) || traitsOf(scene.effects).holdsJoints)
        {
            return "by Coulomb's law impacts and bonds depend on forces that are not unique";
        }
    }
    return "";
}

template<int Dim>
bool solveAwake(Step<Dim>& step)
{
    const StepProgram<Dim>& program = step.program;
    if (step.scene.schemes.effects.selection != EffectSelection::automatic || program.bodies == 0
        || !whyAllBlocks(step.scene).empty())
    {
        return false;
    }
    GroupChoice<Dim> choice(step);
    for (int attempt = 0; attempt < attempts; ++attempt)
    {
        const int bodies = choice.bodies();
        if (bodies == 0 || bodies > mostBodies * program.bodies)
        {
            return false;
        }
        const BlockGroups<Dim> groups = blockGroups(step, choice.groups());
        step.isShared = sharedBlocks(groups);
        step.measuredPoints = &groups.outer;
        const Outcome outcome = solveGroups(step, groups);
        step.measuredPoints = nullptr;
        step.isShared.clear();
        if (outcome.isProved)
        {
            keepGroups(step, groups);
            return true;
        }
        if (static_cast<double>(outcome.failing.size())
            > mostFailing * static_cast<double>(groups.inner.size()))
        {
            return false;
        }
        choice.change(outcome.failing);
    }
    return false;
}

template std::string_view whyAllBlocks(const DynamicCase<2>& scene);
template bool solveAwake(Step<2>& step);
template std::string_view whyAllBlocks(const DynamicCase<3>& scene);
template bool solveAwake(Step<3>& step);

} // namespace drystone
