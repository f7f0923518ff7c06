// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The program of the blocks that are awake, and the forces that hold the others.
#include "dynamics/HeldBlocks.h"

#include "conic/BalancedForces.h"
#include "conic/form/Form.h"
#include "dynamics/ClosedPoints.h"
#include "dynamics/RestingStep.h"

#include <algorithm>

namespace drystone
{
namespace
{

/// A block that is slower than this part of the fastest is held, if that is proved.
constexpr double slow = 1e-6;

/// Holding fewer of the blocks does not pay.
constexpr double leastHeld = 0.3;

/// Blocks about those that are awake wake up when the first attempt is not proved, and so do those about
/// them.
constexpr int attempts = 2;
constexpr int rings = 2;

/// The blocks that are awake, the points that touch them, and where they are in the program of these.
template<int Dim>
struct AwakePart
{
    std::vector<char> isAwake;       ///< of each free block
    std::vector<int> bodies;         ///< those that are
    std::vector<int> place;          ///< of each free block in it, or -1
    std::vector<std::size_t> points; ///< that touch one of them
};

bool isAwakeAt(const std::vector<char>& isAwake, int body)
{
    return body >= 0 && isAwake[static_cast<std::size_t>(body)];
}

template<int Dim>
AwakePart<Dim> awakePart(const StepProgram<Dim>& program, std::vector<char> isAwake)
{
    AwakePart<Dim> part;
    part.place.assign(isAwake.size(), -1);
    for (std::size_t body = 0; body < isAwake.size(); ++body)
    {
        if (isAwake[body])
        {
            part.place[body] = static_cast<int>(part.bodies.size());
            part.bodies.push_back(static_cast<int>(body));
        }
    }
    for (std::size_t point = 0; point < program.contacts.size(); ++point)
    {
        if (isAwakeAt(isAwake, program.contacts[point].first)
            || isAwakeAt(isAwake, program.contacts[point].second))
        {
            part.points.push_back(point);
        }
    }
    part.isAwake = std::move(isAwake);
    return part;
}

/// Blocks that move, or fall in this step: nothing of the last one holds them.
template<int Dim>
std::vector<char> movingBlocks(const Step<Dim>& step)
{
    const Eigen::VectorXd& velocity = step.motion.state.velocity;
    std::vector<double> speeds(static_cast<std::size_t>(step.program.bodies));
    for (std::size_t body = 0; body < speeds.size(); ++body)
    {
        const auto own =
            velocity.segment<freedomCount<Dim>>(freedomCount<Dim> * static_cast<Eigen::Index>(body));
        speeds[body] = own.template head<Dim>().norm()
                       + step.scene.blockSize * own.template tail<rotationCount<Dim>>().norm();
    }
    const double fastest = speeds.empty() ? 0 : *std::max_element(speeds.begin(), speeds.end());
    std::vector<char> isMoving(speeds.size());
    for (std::size_t body = 0; body < speeds.size(); ++body)
    {
        isMoving[body] = speeds[body] > slow * fastest;
    }
    return isMoving;
}

/// With the neighbours of those that are awake.
template<int Dim>
std::vector<char> withNeighbours(const StepProgram<Dim>& program, std::vector<char> isAwake)
{
    for (int ring = 0; ring < rings; ++ring)
    {
        const std::vector<char> before = isAwake;
        for (const auto& contact : program.contacts)
        {
            if (contact.first >= 0 && contact.second >= 0
                && (isAwakeAt(before, contact.first) || isAwakeAt(before, contact.second)))
            {
                isAwake[static_cast<std::size_t>(contact.first)] = true;
                isAwake[static_cast<std::size_t>(contact.second)] = true;
            }
        }
    }
    return isAwake;
}

/// The numbers of some of many that have `size` each: rows of blocks, or of points. What is empty stays so.
template<int size, class Index>
Eigen::VectorXd takenFrom(const std::vector<Index>& some, const Eigen::VectorXd& whole)
{
    Eigen::VectorXd own(whole.size() > 0 ? size * static_cast<Eigen::Index>(some.size()) : 0);
    for (Eigen::Index i = 0; size * i < own.size(); ++i)
    {
        own.segment<size>(size * i) =
            whole.segment<size>(size * static_cast<Eigen::Index>(some[static_cast<std::size_t>(i)]));
    }
    return own;
}

/// The other way.
template<int size, class Index>
void putInto(const std::vector<Index>& some, const Eigen::VectorXd& own, Eigen::VectorXd& whole)
{
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(some.size()); ++i)
    {
        whole.segment<size>(size * static_cast<Eigen::Index>(some[static_cast<std::size_t>(i)])) =
            own.segment<size>(size * i);
    }
}

/// The columns of a point with the blocks that are held as the ground.
template<int Dim, class Columns>
Columns columnsOfPart(const AwakePart<Dim>& part, Columns columns)
{
    columns.first = columns.first < 0 ? -1 : part.place[static_cast<std::size_t>(columns.first)];
    columns.second = columns.second < 0 ? -1 : part.place[static_cast<std::size_t>(columns.second)];
    return columns;
}

template<int Dim>
void setContacts(const AwakePart<Dim>& part, const StepProgram<Dim>& whole, StepProgram<Dim>& program)
{
    program.contacts.clear();
    for (const std::size_t point : part.points)
    {
        program.contacts.push_back(columnsOfPart(part, whole.contacts[point]));
    }
}

template<int Dim>
StepProgram<Dim> programOfPart(const AwakePart<Dim>& part, const StepProgram<Dim>& whole)
{
    StepProgram<Dim> program;
    program.bodies = static_cast<int>(part.bodies.size());
    setContacts(part, whole, program);
    for (const std::size_t point : part.points)
    {
        program.friction.push_back(whole.friction[point]);
    }
    for (const int body : part.bodies)
    {
        program.inertia.push_back(whole.inertia[static_cast<std::size_t>(body)]);
    }
    program.load = takenFrom<freedomCount<Dim>>(part.bodies, whole.load);
    program.gap = takenFrom<Dim>(part.points, whole.gap);
    return program;
}

template<int Dim>
StepGuess guessOfPart(const AwakePart<Dim>& part, const StepGuess& whole)
{
    StepGuess guess;
    guess.displacement = takenFrom<freedomCount<Dim>>(part.bodies, whole.displacement);
    guess.contactForce = takenFrom<Dim>(part.points, whole.contactForce);
    if (!whole.interior.isEmpty())
    {
        guess.interior = {takenFrom<Dim>(part.points, whole.interior.contactForce),
                          takenFrom<Dim>(part.points, whole.interior.opening),
                          takenFrom<freedomCount<Dim>>(part.bodies, whole.interior.displacement)};
    }
    return guess;
}

/// The relinearisation of all blocks, for those that are awake. \param whole the program of all, kept up to
/// date; not owned, as the others
template<int Dim>
Relinearisation<Dim> relinearisationOfPart(const Step<Dim>& step, const AwakePart<Dim>& part,
                                           StepProgram<Dim>& whole)
{
    if (!step.relinearise)
    {
        return {};
    }
    return [&step, &part, &whole](const Eigen::VectorXd& displacement, const Eigen::VectorXd& contactForce,
                                  StepProgram<Dim>& program)
    {
        Eigen::VectorXd y = Eigen::VectorXd::Zero(whole.load.size());
        Eigen::VectorXd c = Eigen::VectorXd::Zero(whole.gap.size());
        putInto<freedomCount<Dim>>(part.bodies, displacement, y);
        putInto<Dim>(part.points, contactForce, c);
        putInto<Dim>(part.points, program.gap, whole.gap);
        putInto<freedomCount<Dim>>(part.bodies, program.load, whole.load);
        const double error = step.relinearise(y, c, whole);
        program.gap = takenFrom<Dim>(part.points, whole.gap);
        program.load = takenFrom<freedomCount<Dim>>(part.bodies, whole.load);
        setContacts(part, whole, program);
        return error;
    };
}

/// The balance of the blocks that are held, under what the others press them with, over the closed points
/// among them and the ground.
template<int Dim>
struct HeldBalance
{
    StepProgram<Dim> program;        ///< of all blocks, loads on those held only
    std::vector<std::size_t> points; ///< of it
};

template<int Dim>
HeldBalance<Dim> heldBalance(const AwakePart<Dim>& part, const StepProgram<Dim>& whole,
                             const Eigen::VectorXd& forcesOfAwake, double tolerance)
{
    HeldBalance<Dim> held;
    held.program.bodies = whole.bodies;
    held.program.inertia = whole.inertia;
    held.program.load = whole.load - applyEquilibrium(whole, forcesOfAwake);
    for (const int body : part.bodies)
    {
        held.program.load.template segment<freedomCount<Dim>>(freedomCount<Dim> * body).setZero();
    }
    const std::vector<char> isClosed = closedPoints<Dim>(whole, tolerance);
    std::vector<double> gaps;
    for (std::size_t point = 0; point < isClosed.size(); ++point)
    {
        const auto& contact = whole.contacts[point];
        if (isClosed[point] && !isAwakeAt(part.isAwake, contact.first)
            && !isAwakeAt(part.isAwake, contact.second))
        {
            held.points.push_back(point);
            held.program.contacts.push_back(contact);
            held.program.friction.push_back(whole.friction[point]);
        }
    }
    held.program.gap.resize(Dim * static_cast<Eigen::Index>(held.points.size()));
    for (std::size_t i = 0; i < held.points.size(); ++i)
    {
        held.program.gap.template segment<Dim>(Dim * static_cast<Eigen::Index>(i)) =
            whole.gap.template segment<Dim>(Dim * static_cast<Eigen::Index>(held.points[i]));
    }
    return held;
}

Certificate larger(const Certificate& one, const Certificate& other)
{
    return {std::max(one.primalResidual, other.primalResidual),
            std::max(one.dualResidual, other.dualResidual), std::max(one.gap, other.gap)};
}

/// The interior of the part among all blocks; zero at the points of the others, as if they were new.
template<int Dim>
InteriorStart interiorOfWhole(const AwakePart<Dim>& part, const StepProgram<Dim>& whole,
                              const InteriorStart& own)
{
    if (own.isEmpty())
    {
        return {};
    }
    InteriorStart interior;
    interior.contactForce = Eigen::VectorXd::Zero(whole.gap.size());
    interior.opening = Eigen::VectorXd::Zero(whole.gap.size());
    interior.displacement = Eigen::VectorXd::Zero(whole.load.size());
    putInto<Dim>(part.points, own.contactForce, interior.contactForce);
    putInto<Dim>(part.points, own.opening, interior.opening);
    putInto<freedomCount<Dim>>(part.bodies, own.displacement, interior.displacement);
    return interior;
}

template<int Dim>
bool solvePart(Step<Dim>& step, const AwakePart<Dim>& part)
{
    StepProgram<Dim> whole = step.program;
    const double tolerance = step.settings.solver.tolerance;
    ThetaStep own = solveThetaStep(programOfPart(part, whole), step.settings, guessOfPart(part, step.guess),
                                   relinearisationOfPart(step, part, whole), step.motion.symbolic.get());
    countWork(step, own.iterations, own.factorisations, own.programs);
    if (own.status != SolveStatus::optimal)
    {
        return false;
    }
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(whole.gap.size());
    putInto<Dim>(part.points, own.contactForce, forces);
    HeldBalance<Dim> held = heldBalance(part, whole, forces, tolerance);
    Eigen::VectorXd near(held.program.gap.size());
    for (std::size_t i = 0; i < held.points.size(); ++i)
    {
        near.segment<Dim>(Dim * static_cast<Eigen::Index>(i)) =
            step.guess.contactForce.template segment<Dim>(Dim * static_cast<Eigen::Index>(held.points[i]));
    }
    constexpr double partOfTolerance = 0.1;
    StepProgram<Dim> balance = held.program;
    balance.inertia.clear();
    const Eigen::VectorXd holding =
        balancedForces(balance, near, {step.scene.schemes.effects.margin, partOfTolerance * tolerance},
                       *step.motion.symbolicOfHeld.get());
    ++step.motion.attempt.factorisations;
    if (holding.size() != held.program.gap.size())
    {
        return false;
    }
    const Rest rest = restWith(held.program, holding);
    if (rest.certificate.worst() > tolerance)
    {
        return false;
    }
    for (std::size_t i = 0; i < held.points.size(); ++i)
    {
        forces.segment<Dim>(Dim * static_cast<Eigen::Index>(held.points[i])) =
            holding.segment<Dim>(Dim * static_cast<Eigen::Index>(i));
    }
    ThetaStep& result = step.solved.result;
    result = std::move(own);
    result.certificate = larger(result.certificate, rest.certificate);
    Eigen::VectorXd displacement = Eigen::VectorXd::Zero(whole.load.size());
    putInto<freedomCount<Dim>>(part.bodies, result.displacement, displacement);
    result.displacement = std::move(displacement);
    Eigen::VectorXd closing = Eigen::VectorXd::Zero(whole.gap.size());
    if (result.closing.size() > 0)
    {
        putInto<Dim>(part.points, result.closing, closing);
    }
    result.closing = std::move(closing);
    result.contactForce = std::move(forces);
    result.interior = interiorOfWhole(part, whole, result.interior);
    return true;
}

} // namespace

template<int Dim>
bool solveAwake(Step<Dim>& step)
{
    const DynamicCase<Dim>& scene = step.scene;
    const StepProgram<Dim>& program = step.program;
    // In space Coulomb's law is reached to a part of what the step does, and two ways to it may end so far
    // apart.
    const bool isApproximate = Dim == 3 && step.settings.flowRule == FlowRule::nonAssociative;
    if (scene.schemes.effects.selection != EffectSelection::automatic || hasImpacts(scene) || isApproximate
        || program.hasCompliance() || program.hasStrength() || program.bodies == 0)
    {
        return false;
    }
    std::vector<char> isAwake = movingBlocks(step);
    for (int attempt = 0; attempt < attempts; ++attempt)
    {
        const auto awake = std::count(isAwake.begin(), isAwake.end(), true);
        if (awake == 0 || awake > (1 - leastHeld) * program.bodies)
        {
            return false;
        }
        const AwakePart<Dim> part = awakePart<Dim>(program, isAwake);
        if (solvePart(step, part))
        {
            std::vector<char>& ofBlocks = step.motion.isAwake;
            ofBlocks.assign(scene.free.size(), false);
            for (std::size_t block = 0; block < scene.free.size(); ++block)
            {
                ofBlocks[block] = isAwakeAt(part.isAwake, scene.free[block]);
            }
            return true;
        }
        isAwake = withNeighbours<Dim>(program, std::move(isAwake));
    }
    return false;
}

template bool solveAwake(Step<2>& step);
template bool solveAwake(Step<3>& step);

} // namespace drystone
