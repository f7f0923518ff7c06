// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The stage of a step in which blocks collide: which points, and when. What they do then is Impact.cpp's.
#include "core/DisjointSets.h"
#include "dynamics/FirstMeeting.h"
#include "dynamics/FreeFlight.h"
#include "dynamics/HeldBlocks.h"
#include "dynamics/Impact.h"
#include "dynamics/Step.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

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

/// Points that would part slower after an impact do not part at all: their flight would be too short [m/s].
template<int Dim>
double slowestRebound(const Step<Dim>& step)
{
    return 0.5 * step.acceleration * step.impacts.shortestFlight;
}

/// Whether a point that comes, or has come, with a speed rebounds to a flight that is long enough to count.
/// By the associative law what slides is apart, however little: there any does. \param speed at which the
/// point closes, or parts where it is negative [m/s] \param clearance at the start of the step [m]
template<int Dim>
bool flies(const Step<Dim>& step, double speed, double clearance)
{
    if (step.settings.flowRule == FlowRule::associative)
    {
        return true;
    }
    const double byLoads = 2 * step.acceleration * std::max(0.0, clearance); // as it falls, squared
    const double share = speed > 0 ? step.scene.restitution() : 1; // what parts has rebounded already
    return share * std::sqrt(speed * speed + byLoads) > slowestRebound(step);
}

/// Whether an impact of its own changes what a point does: with theta 1 the step is itself the impact without
/// rebound. So joints that turn or slide in a smooth motion, and close by a little in every step, need none.
/// By the associative rule sliding joints are apart, which looks like a fall.
/// \param speed at which the point closes, or parts where it is negative [m/s] \param clearance at the start
/// of the step [m]
template<int Dim>
bool needsImpact(const Step<Dim>& step, double speed, double clearance)
{
    return step.scheme.theta < 1 || flies(step, speed, clearance);
}

/// A point belongs to the impact when it carries more than this share of the largest contact force, and is
/// closed when the step ends.
constexpr double carriesForce = 1e-9;

/// Collisions in a row within one step; what is still closing then is stopped by the step itself.
constexpr int mostImpacts = 10;

/// A step is not parted where more pairs of bodies of one structure meet in it than these: in walls that fall
/// apart impacts come so close that it would be parted for ever, and no single one of them decides what the
/// wall does.
constexpr std::size_t mostMeetingPairs = 2;

/// Whether the points are closed where the step takes the blocks. Solutions are right to a tolerance, and
/// some solvers end inside the cones, where a point that stays wide apart carries force too, a little. Of
/// force and opening, which the exact solution never has both, the smaller part is then the error: force as a
/// share of the largest one, opening as a share of the farthest motion.
template<int Dim>
std::vector<char> closedAtEnd(const Step<Dim>& step)
{
    const StepProgram<Dim>& program = step.program;
    const ThetaStep& result = step.solved.result;
    const StepSettings& settings = step.settings;
    const Eigen::VectorXd opening = openingAtEnd(step, result.displacement, result.contactForce);
    const double largestForce = result.contactForce.lpNorm<Eigen::Infinity>();
    const double farthest = farthestMotion<Dim>(result.displacement, settings.blockSize);
    const double error = settings.contactTolerance + result.flowError;
    std::vector<char> isClosed(static_cast<std::size_t>(program.points()));
    for (std::size_t point = 0; point < isClosed.size(); ++point)
    {
        const auto row = Dim * static_cast<Eigen::Index>(point);
        // Where points slide, the associative law opens them by mu |u_t|, and they press nevertheless.
        const double byFlow = settings.flowRule == FlowRule::associative
                                  ? program.friction[point] * opening.segment<Dim - 1>(row + 1).norm()
                                  : 0;
        const double apart = opening[row] - byFlow;
        isClosed[point] = apart <= error || apart * largestForce <= result.contactForce[row] * farthest;
    }
    return isClosed;
}

/// Whether the forces are one choice of many, from a program with fewer bodies, or of the associative law in
/// place of Coulomb's. Which points take part in an impact follows from forces: then any that is closed at
/// the end counts as if it carried one, and if none of these collides no forces make an impact.
template<int Dim>
bool isReduced(const Step<Dim>& step)
{
    return step.solved.sticks || !step.isAwake.empty();
}

/// Whether closing velocities as small as the errors of a solution count: by the associative law, where any
/// point that carries a force may then collide.
template<int Dim>
bool isByErrors(const Step<Dim>& step)
{
    return step.settings.flowRule == FlowRule::associative;
}

/// Whether a point is open, and not only as points are that have just met.
template<int Dim>
bool isApart(const Step<Dim>& step, std::size_t point, double speed)
{
    const double gap = step.points[point].gap;
    return gap > step.settings.contactTolerance && gap > step.impacts.tolerance * speed;
}

/// Points that the step closes.
struct Colliding
{
    std::vector<std::size_t> now;   ///< at the start of the step, where one of them closes then
    std::vector<std::size_t> later; ///< in the course of it
    /// At the start after all, of structures of which more than mostMeetingPairs meet in the course of it.
    std::vector<std::size_t> crowded;
    std::vector<std::size_t> all; ///< those at rest, too
    bool isReturning = false;     ///< none closes when it begins, but some part, and are back before its end
};

/// A pair of bodies that have a point in common; what is fixed is one body, -1, in however many pieces.
template<int Dim>
std::pair<int, int> bodiesAt(const Step<Dim>& step, std::size_t point)
{
    const auto bodyOf = [&step](int block) { return step.scene.free[static_cast<std::size_t>(block)]; };
    return std::minmax({bodyOf(step.points[point].block), bodyOf(step.points[point].neighbour)});
}

/// Finds the structures, bodies that are connected by points, of which too many pairs meet: all their points
/// are `crowded` then.
template<int Dim>
void moveCrowded(const Step<Dim>& step, Colliding& colliding)
{
    std::set<std::pair<int, int>> pairs;
    for (const std::size_t point : colliding.later)
    {
        pairs.insert(bodiesAt(step, point));
    }
    if (pairs.size() <= mostMeetingPairs)
    {
        return;
    }
    DisjointSets structures(step.scene.free.size());
    for (std::size_t point = 0; point < step.points.size(); ++point)
    {
        if (const auto [one, other] = bodiesAt(step, point); one >= 0)
        {
            structures.join(one, other);
        }
    }
    std::vector<std::size_t> pairsOf(step.scene.free.size());
    const auto ofStructure = [&](const std::pair<int, int>& pair) -> std::size_t&
    { return pairsOf[static_cast<std::size_t>(structures.firstOf(pair.second))]; };
    for (const auto& pair : pairs)
    {
        ++ofStructure(pair);
    }
    const auto isCrowded = [&](std::size_t point)
    { return ofStructure(bodiesAt(step, point)) > mostMeetingPairs; };
    for (std::vector<std::size_t>* together : {&colliding.now, &colliding.later})
    {
        const auto crowded =
            std::stable_partition(together->begin(), together->end(), std::not_fn(isCrowded));
        colliding.crowded.insert(colliding.crowded.end(), crowded, together->end());
        together->erase(crowded, together->end());
    }
    std::sort(colliding.crowded.begin(), colliding.crowded.end());
}

/// With points that meet in the course of the step all others that are open and close, but for those of
/// crowded structures: which of several that meet together carry the force is one choice of many, and what
/// the others do until then has to be without them too. \param closing see collidingPoints
template<int Dim>
std::vector<std::size_t> withOthersApart(const Step<Dim>& step, const Eigen::VectorXd& closing,
                                         const Colliding& colliding)
{
    const auto isIn = [](const std::vector<std::size_t>& points, std::size_t point)
    { return std::binary_search(points.begin(), points.end(), point); };
    std::vector<std::size_t> apart;
    for (std::size_t point = 0; point < step.points.size(); ++point)
    {
        const double speed = closing[Dim * static_cast<Eigen::Index>(point)];
        const bool mayMeet =
            speed > step.solved.slowest && isApart(step, point, speed) && !isIn(colliding.crowded, point);
        if (mayMeet || isIn(colliding.later, point))
        {
            apart.push_back(point);
        }
    }
    return apart;
}

/// With ImpactInstant::stepStart all collide now that the step closes, if one was closing when it began.
/// \param closing velocity of the points [m/s], Dim a point
template<int Dim>
Colliding collidingPoints(const Step<Dim>& step, const Eigen::VectorXd& closing)
{
    const ThetaStep& result = step.solved.result;
    const double slowest = step.solved.slowest;
    const double force = carriesForce * result.contactForce.lpNorm<Eigen::Infinity>();
    const bool isLocated = step.impacts.instant == ImpactInstant::located;
    const bool mayReturn = isLocated && step.scene.restitution() > 0;
    const auto speedOf = [&](std::size_t point) { return closing[Dim * static_cast<Eigen::Index>(point)]; };
    const bool mayCarry = isReduced(step) && !isByErrors(step);
    const auto carries = [&](std::size_t point)
    { return mayCarry || result.contactForce[Dim * static_cast<Eigen::Index>(point)] > force; };
    // Points that bonds hold are together already.
    const auto mayMeet = [&](std::size_t point) { return carries(point) && !isBonded(step.program, point); };
    const auto collides = [&](std::size_t point) { return mayMeet(point) && speedOf(point) > slowest; };
    const auto returns = [&](std::size_t point)
    {
        return mayReturn && mayMeet(point) && speedOf(point) < -slowest
               && flies(step, speedOf(point), step.points[point].gap);
    };
    std::vector<std::size_t> points(static_cast<std::size_t>(step.program.points()));
    std::iota(points.begin(), points.end(), 0);
    const auto mayCollide = [&](std::size_t point) { return collides(point) || returns(point); };
    if (std::none_of(points.begin(), points.end(), mayCollide))
    {
        return {};
    }
    const std::vector<char> isClosed = closedAtEnd(step);
    // Which of several points that meet at once the step gives its force is one choice of many: at its start,
    // or where impacts are not located, in it.
    const auto meetsNow = [&](std::size_t point)
    {
        return !isByErrors(step) && !isBonded(step.program, point) && speedOf(point) > slowest
               && (isLocated ? !isApart(step, point, speedOf(point)) : static_cast<bool>(isClosed[point]));
    };
    std::erase_if(points, [&](std::size_t point)
                  { return !(carries(point) && isClosed[point]) && !meetsNow(point); });
    const auto isImpact = [&](std::size_t point)
    { return needsImpact(step, speedOf(point), step.points[point].gap); };
    const auto rebounds = [&](std::size_t point)
    { return (collides(point) || meetsNow(point)) && isImpact(point); };

    Colliding colliding;
    for (const std::size_t point : points)
    {
        const bool isLater =
            isLocated && isImpact(point) && (isApart(step, point, speedOf(point)) || returns(point));
        (isLater ? colliding.later : colliding.now).push_back(point);
    }
    moveCrowded(step, colliding);
    for (std::vector<std::size_t>* together : {&colliding.now, &colliding.crowded})
    {
        if (std::none_of(together->begin(), together->end(), rebounds))
        {
            together->clear(); // at rest
        }
    }
    colliding.all = points;
    colliding.isReturning = std::none_of(points.begin(), points.end(), rebounds);
    return colliding;
}

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

/// Gives the blocks the velocities that they have after an impact. \return whether it was solved and has
/// changed them
template<int Dim>
bool takeImpact(Step<Dim>& step, std::vector<std::size_t> meeting)
{
    const DynamicCase<Dim>& scene = step.scene;
    const double timeStep = step.scheme.timeStep;
    StepSolution& solved = step.solved;
    // Momentum changes at an instant: about the mass centres where they are, not where a step takes them.
    StepProgram<Dim> arrival = step.program;
    if (!step.arrivals.empty())
    {
        setColumns(arrival, step.arrivals);
    }
    const Eigen::VectorXd bySupports =
        closingAtTheStart(step.points, step.arrivals.empty() ? step.columns : step.arrivals, step.supports);
    addBonded(arrival, meeting);
    Impact impact = impactOf<Dim>({.mass = step.mass,
                                   .velocity = solved.velocity,
                                   .program = arrival,
                                   .meeting = meeting,
                                   .closingBySupports = bySupports,
                                   .restitution = scene.restitution(),
                                   .slowestRebound = slowestRebound(step),
                                   .timeStep = timeStep,
                                   .timeOfBonds = std::max(timeStep, step.impacts.wholeStep),
                                   .stepForce = &solved.result.contactForce},
                                  step.settings);
    countWork(step, impact.iterations, impact.factorisations, impact.programs);
    solved.isSolved = impact.isSolved;
    if (!solved.isSolved)
    {
        return false;
    }
    if (impact.impulse.isZero(0))
    {
        return false; // again it would be the same
    }
    ++solved.impacts;
    solved.lostInImpacts += impact.energyLoss;
    solved.rubbedInImpacts += rubbedIn<Dim>(impact, arrival, bySupports, meeting, step);
    solved.workOfSupports += impact.workOfSupports;
    solved.restitutionShare = std::min(solved.restitutionShare, impact.restitutionShare);
    solved.velocity = std::move(impact.velocity);
    if (solved.impulse.size() == 0)
    {
        solved.impulse = Eigen::VectorXd::Zero(Dim * step.program.points());
    }
    for (std::size_t i = 0; i < meeting.size(); ++i)
    {
        solved.impulse.segment<Dim>(Dim * static_cast<Eigen::Index>(meeting[i])) +=
            impact.impulse.segment<Dim>(Dim * static_cast<Eigen::Index>(i));
    }
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
    Colliding colliding = collidingPoints(step, closing);
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
