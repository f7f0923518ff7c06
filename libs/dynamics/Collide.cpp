// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The stage of a step in which blocks collide: which of its points do is CollidingPoints.cpp's, and what
/// they do then Impact.cpp's.
#include "dynamics/CollidingPoints.h"
#include "dynamics/FirstMeeting.h"
#include "dynamics/FreeFlight.h"
#include "dynamics/HeldBlocks.h"
#include "dynamics/Impact.h"
#include "dynamics/Step.h"

#include <algorithm>
#include <utility>

namespace drystone
{
namespace
{

/// Points that close slower than this share of what the loads give a block in one step do not collide: so
/// bounces end, and a structure at rest has no impacts.
constexpr double slowImpact = 1e-6;

/// Nor do those that close slower than velocities are known, in tolerances of the solver: on a table that
/// turns fast each step would begin with an impact.
constexpr double velocityError = 10;

/// Collisions in a row within one step; what is still closing then is stopped by the step itself.
constexpr int mostImpacts = 10;

/// Points that bonds hold take part in every impact: what moves one block moves those that are bonded to it.
template<int Dim>
void addBonded(const StepProgram<Dim>& program, std::vector<std::size_t>& meeting)
{
    for (std::size_t point = 0; program.hasStrength() && point < program.contacts.size(); ++point)
    {
        if (isBonded(program, point))
        {
            meeting.push_back(point);
        }
    }
    std::sort(meeting.begin(), meeting.end());
    meeting.erase(std::unique(meeting.begin(), meeting.end()), meeting.end());
}

/// What friction takes from the blocks in an impact: P_t (u_t- + u_t+)/2, since the velocities change in
/// proportion to the impulses [J].
template<int Dim>
double rubbedIn(const Impact& impact, const StepProgram<Dim>& arrival, const Eigen::VectorXd& bySupports,
                const std::vector<std::size_t>& meeting, const Step<Dim>& step)
{
    const Eigen::VectorXd twiceTheMean =
        closingVelocity(arrival, step.solved.velocity, bySupports, step.scheme.timeStep)
        + closingVelocity(arrival, impact.velocity, bySupports, step.scheme.timeStep);
    double loss = 0;
    for (std::size_t i = 0; i < meeting.size(); ++i)
    {
        const auto own = Dim * static_cast<Eigen::Index>(i) + 1;
        const auto ofProgram = Dim * static_cast<Eigen::Index>(meeting[i]) + 1;
        loss += 0.5 * impact.impulse.segment<Dim - 1>(own).dot(twiceTheMean.segment<Dim - 1>(ofProgram));
    }
    return loss;
}

/// Where blocks are when they meet, and how fast supports close their points then.
template<int Dim>
struct Arrival
{
    StepProgram<Dim> program;
    Eigen::VectorXd bySupports; ///< [m/s]
};

/// Momentum changes at an instant: about the mass centres where they are, not where a step takes them.
template<int Dim>
Arrival<Dim> arrivalOf(const Step<Dim>& step)
{
    StepProgram<Dim> program = step.program;
    if (!step.arrivals.empty())
    {
        setColumns(program, step.arrivals);
    }
    return {
        std::move(program),
        closingAtTheStart(step.points, step.arrivals.empty() ? step.columns : step.arrivals, step.supports)};
}

/// What a solved impact leaves to the account of the step.
template<int Dim>
void accountImpact(StepSolution& solved, const Impact& impact, const std::vector<std::size_t>& meeting,
                   int points)
{
    ++solved.impacts;
    solved.lostInImpacts += impact.energyLoss;
    solved.workOfSupports += impact.workOfSupports;
    solved.restitutionShare = std::min(solved.restitutionShare, impact.restitutionShare);
    if (solved.impulse.size() == 0)
    {
        solved.impulse = Eigen::VectorXd::Zero(Dim * points);
    }
    for (std::size_t i = 0; i < meeting.size(); ++i)
    {
        solved.impulse.segment<Dim>(Dim * static_cast<Eigen::Index>(meeting[i])) +=
            impact.impulse.segment<Dim>(Dim * static_cast<Eigen::Index>(i));
    }
}

/// Gives the blocks the velocities that they have after an impact. \return whether it was solved and has
/// changed them
template<int Dim>
bool takeImpact(Step<Dim>& step, std::vector<std::size_t> meeting)
{
    const double timeStep = step.scheme.timeStep;
    StepSolution& solved = step.solved;
    const Arrival<Dim> arrival = arrivalOf(step);
    addBonded(arrival.program, meeting);
    Impact impact = impactOf<Dim>({.mass = step.mass,
                                   .velocity = solved.velocity,
                                   .program = arrival.program,
                                   .meeting = meeting,
                                   .closingBySupports = arrival.bySupports,
                                   .restitution = step.scene.restitution(),
                                   .slowestRebound = slowestRebound(step),
                                   .timeStep = timeStep,
                                   .timeOfBonds = std::max(timeStep, step.impacts.wholeStep),
                                   .stepForce = &solved.result.contactForce},
                                  step.settings);
    countWork(step, impact.iterations, impact.factorisations, impact.programs);
    solved.isSolved = impact.isSolved;
    if (!solved.isSolved || impact.impulse.isZero(0)) // without impulses it would be the same again
    {
        return false;
    }
    solved.rubbedInImpacts += rubbedIn<Dim>(impact, arrival.program, arrival.bySupports, meeting, step);
    accountImpact<Dim>(solved, impact, meeting, step.program.points());
    solved.velocity = std::move(impact.velocity);
    step.program.load = step.load + times(step.mass, solved.velocity) / (step.scheme.theta * timeStep);
    step.guess.displacement = timeStep * solved.velocity;
    solved.collided = std::move(meeting);
    return true;
}

/// Of a step that is to be tried shorter, as blocks meet in it. \param apart the step as if they did not
template<int Dim>
void keepForces(const Step<Dim>& step, const ThetaStep& apart)
{
    if (!step.attemptForces)
    {
        return;
    }
    const auto forcesOf = [&step](const ThetaStep& result)
    {
        PointForces<Dim> forces{step.points, std::vector<Vector<Dim>>(step.points.size())};
        for (std::size_t point = 0; point < step.points.size(); ++point)
        {
            forces.forces[point] =
                result.contactForce.template segment<Dim>(Dim * static_cast<Eigen::Index>(point));
        }
        return forces;
    };
    step.attemptForces->apart = forcesOf(apart);
    if (step.attemptForces->meeting.forces.empty())
    {
        step.attemptForces->meeting = forcesOf(step.solved.result);
    }
}

/// \return whether blocks collided, or may do so, and the step is to be solved again
template<int Dim>
bool collideOnce(Step<Dim>& step)
{
    StepSolution& solved = step.solved;
    const Eigen::VectorXd closing =
        closingVelocity(step.program, solved.velocity, step.bySupports, step.scheme.timeStep);
    // Nor do points that an impact has just stopped, or thrown back, to its tolerance.
    for (const std::size_t point : solved.collided)
    {
        solved.slowest = std::max(solved.slowest, closing[Dim * static_cast<Eigen::Index>(point)]);
    }
    CollidingPoints colliding = collidingPoints(step, closing);
    solved.collides = isByErrors(step)
                          ? !colliding.all.empty()
                          : !colliding.now.empty() || !colliding.later.empty() || !colliding.crowded.empty();
    if (solved.collides)
    {
        step.isOfAllBlocks = true;
        if (isReduced(step))
        {
            // As if all blocks had come first: from how much work is left follows whether impacts are
            // located.
            forgetBodies(step);
            step.motion.work.done = step.workBeforeSolution;
            return true;
        }
    }
    if (!colliding.later.empty() && colliding.now.empty())
    {
        Meeting meeting = firstMeeting(step, closing, withOthersApart(step, closing, colliding));
        if (meeting.isSolved && meeting.part * step.scheme.timeStep > step.impacts.tolerance)
        {
            if (meeting.part < 1)
            {
                solved.isSolved = false;
                solved.length = meeting.part;
                keepForces(step, meeting.result);
                return false;
            }
            solved.result = std::move(meeting.result); // they do not meet
            return !colliding.crowded.empty() && takeImpact(step, std::move(colliding.crowded));
        }
        if (colliding.isReturning)
        {
            return false;
        }
        return takeImpact(step, std::move(colliding.all));
    }
    std::vector<std::size_t>& meeting = colliding.now;
    meeting.insert(meeting.end(), colliding.crowded.begin(), colliding.crowded.end());
    std::sort(meeting.begin(), meeting.end());
    return !meeting.empty() && takeImpact(step, std::move(meeting));
}

} // namespace

template<int Dim>
bool hasImpacts(const DynamicCase<Dim>& scene)
{
    return scene.restitution() > 0 || scene.schemes.timeIntegration.theta < 1;
}

template<int Dim>
bool keepsColliding(const Motion<Dim>& motion)
{
    constexpr int few = 2; // a stone that bounces flies longer than a step
    return motion.collisions >= few;
}

template<int Dim>
bool collide(Step<Dim>& step)
{
    const StageTimer timer(step.motion.stageTimes, Stage::collide);
    StepSolution& solved = step.solved;
    if (!solved.isSolved || !hasImpacts(step.scene) || step.program.hasCompliance())
    {
        return false;
    }
    if (solved.impacts == 0)
    {
        const double error = velocityError * step.settings.solver.tolerance
                             * farthestMotion<Dim>(step.motion.state.velocity, step.settings.blockSize);
        solved.slowest = std::max(slowImpact * step.acceleration * step.scheme.timeStep, error);
    }
    if (solved.impacts < mostImpacts && collideOnce(step))
    {
        return true;
    }
    if (solved.isSolved)
    {
        solved.flight = flightApart(step, solved.result, solved.velocity);
    }
    return false;
}

template bool hasImpacts(const DynamicCase<2>& scene);
template bool keepsColliding(const Motion<2>& motion);
template bool collide(Step<2>& step);
template bool hasImpacts(const DynamicCase<3>& scene);
template bool keepsColliding(const Motion<3>& motion);
template bool collide(Step<3>& step);

} // namespace drystone
