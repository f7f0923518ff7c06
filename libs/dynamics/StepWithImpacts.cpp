// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
// Here: when blocks collide in a step. What they do then is Impact.cpp's.
#include "dynamics/StepWithImpacts.h"

#include "dynamics/Impact.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace drystone
{
namespace
{

/// Points that close slower than this share of what the loads give a block in one step do not collide: so
/// bounces end, and a structure at rest has no impacts.
constexpr double slowImpact = 1e-6;

/// A point belongs to the impact when it carries more than this share of the largest contact force, and is
/// closed when the step ends.
constexpr double carriesForce = 1e-9;

/// Collisions in a row within one step; what is still closing then is stopped by the step itself.
constexpr int mostImpacts = 10;

/// A step in which more pairs of blocks meet than these is not parted: where walls fall apart impacts come so
/// close that it would be parted for ever, and no single one of them decides what the wall does.
constexpr std::size_t mostMeetingPairs = 2;

/// The step up to where blocks meet ends earlier by this part of itself, so that they do not overlap there.
constexpr double stopsEarly = 1e-7;

/// A block is in free flight when its contacts carry no more than this part of its loads.
constexpr double flightForce = 1e-9;

/// Whether the points are closed where the step takes the blocks. Solutions are right to a tolerance, and
/// some solvers end inside the cones, where a point that stays wide apart carries force too, a little. Of
/// force and opening, which the exact solution never has both, the smaller part is then the error: force as a
/// share of the largest one, opening as a share of the farthest motion. \param program as it was first made
std::vector<char> closedPoints(const PlaneConeProgram& program, const ThetaStep& step,
                               const StepSettings& settings, const Relinearisation& relinearise)
{
    const Eigen::VectorXd opening = openingAtEnd(program, step, relinearise);
    const double largestForce = step.contactForce.lpNorm<Eigen::Infinity>();
    const double farthest = farthestMotion(step.displacement, settings.blockSize);
    const double error = settings.contactTolerance + step.flowError;
    std::vector<char> isClosed(static_cast<std::size_t>(program.points()));
    for (std::size_t point = 0; point < isClosed.size(); ++point)
    {
        const auto row = 2 * static_cast<Eigen::Index>(point);
        // Where points slide, the associative law opens them by mu |u_t|, and they press nevertheless.
        const double byFlow = settings.flowRule == FlowRule::associative
                                  ? program.friction[point] * std::abs(opening[row + 1])
                                  : 0;
        const double apart = opening[row] - byFlow;
        isClosed[point] = apart <= error || apart * largestForce <= step.contactForce[row] * farthest;
    }
    return isClosed;
}

/// Points that the step closes.
struct Colliding
{
    std::vector<std::size_t> now;   ///< at the start of the step, where one of them closes then
    std::vector<std::size_t> later; ///< in the course of it
    std::vector<std::size_t> all;   ///< those at rest, too
    bool isReturning = false; ///< none closes when it begins, but some part, and are back before its end
};

/// With ImpactInstant::stepStart all collide now that the step closes, if one was closing when it began.
/// \param program as it was first made \param closing velocity of the points [m/s], two a point
Colliding collidingPoints(const StepProblem& problem, const PlaneConeProgram& program, const ThetaStep& step,
                          const Eigen::VectorXd& closing, double slowest)
{
    const double force = carriesForce * step.contactForce.lpNorm<Eigen::Infinity>();
    const bool isLocated = problem.instant == ImpactInstant::located;
    const bool mayReturn = isLocated && problem.scene.restitution() > 0;
    const auto speedOf = [&](std::size_t point) { return closing[2 * static_cast<Eigen::Index>(point)]; };
    const auto carries = [&](std::size_t point)
    { return step.contactForce[2 * static_cast<Eigen::Index>(point)] > force; };
    const auto collides = [&](std::size_t point) { return carries(point) && speedOf(point) > slowest; };
    const auto returns = [&](std::size_t point)
    { return mayReturn && carries(point) && speedOf(point) < -slowest; };
    std::vector<std::size_t> points(static_cast<std::size_t>(program.points()));
    std::iota(points.begin(), points.end(), 0);
    const auto mayCollide = [&](std::size_t point) { return collides(point) || returns(point); };
    if (std::none_of(points.begin(), points.end(), mayCollide))
    {
        return {};
    }
    const std::vector<char> isClosed = closedPoints(program, step, problem.settings, problem.relinearise);
    std::erase_if(points, [&](std::size_t point) { return !carries(point) || !isClosed[point]; });

    Colliding colliding;
    std::set<std::pair<int, int>> pairs;
    for (const std::size_t point : points)
    {
        const double gap = problem.points[point].gap;
        const bool isApart =
            gap > problem.settings.contactTolerance && gap > problem.instantTolerance * speedOf(point);
        if (isLocated && (isApart || returns(point)))
        {
            colliding.later.push_back(point);
            pairs.emplace(problem.points[point].block, problem.points[point].neighbour);
        }
        else
        {
            colliding.now.push_back(point);
        }
    }
    if (pairs.size() > mostMeetingPairs)
    {
        colliding = {points, {}, points};
    }
    if (std::none_of(colliding.now.begin(), colliding.now.end(), collides))
    {
        colliding.now.clear(); // at rest
    }
    colliding.all = points;
    colliding.isReturning = std::none_of(points.begin(), points.end(), collides);
    return colliding;
}

/// What blocks in free flight move by beyond the step: the mean of their velocities and not the step's, see
/// solveWithImpacts. Empty where there is none. \param free points that no force acts on, whatever the step
/// says
Eigen::VectorXd flightOf(const StepProblem& problem, const PlaneConeProgram& program, const ThetaStep& step,
                         const Eigen::VectorXd& velocity, const std::vector<std::size_t>& free = {})
{
    const DynamicCase& scene = problem.scene;
    const double theta = scene.schemes.timeIntegration.theta;
    if (scene.restitution() == 0 || theta == 0.5 || !scene.effects.empty())
    {
        return {};
    }
    std::vector<char> flies(static_cast<std::size_t>(program.bodies), true);
    for (std::size_t point = 0; point < program.contacts.size(); ++point)
    {
        const double force =
            std::find(free.begin(), free.end(), point) == free.end()
                ? step.contactForce.segment<2>(2 * static_cast<Eigen::Index>(point)).lpNorm<Eigen::Infinity>()
                : 0;
        for (const int body : {program.contacts[point].first, program.contacts[point].second})
        {
            if (body >= 0
                && force > flightForce * problem.load.segment<3>(3 * body).lpNorm<Eigen::Infinity>())
            {
                flies[static_cast<std::size_t>(body)] = false;
            }
        }
    }
    // y = dt (theta v1 + (1 - theta) v0), and dt (v0 + v1)/2 is to be.
    Eigen::VectorXd flight = (0.5 - theta) / theta * (step.displacement - problem.timeStep * velocity);
    bool isAny = false;
    for (int body = 0; body < program.bodies; ++body)
    {
        if (!flies[static_cast<std::size_t>(body)])
        {
            flight.segment<3>(3 * body).setZero();
        }
        isAny = isAny || flies[static_cast<std::size_t>(body)];
    }
    return isAny ? flight : Eigen::VectorXd();
}

/// Where the step takes the blocks, those in flight too [m].
Eigen::VectorXd openingAfterFlight(const StepProblem& problem, const PlaneConeProgram& program,
                                   const ThetaStep& step, const Eigen::VectorXd& flight)
{
    if (flight.size() == 0)
    {
        return openingAtEnd(program, step, problem.relinearise);
    }
    ThetaStep flown;
    flown.displacement = step.displacement + flight;
    flown.contactForce = step.contactForce;
    return openingAtEnd(program, flown, problem.relinearise);
}

/// The same without what would lead blocks into each other.
Eigen::VectorXd flightApart(const StepProblem& problem, const PlaneConeProgram& program,
                            const ThetaStep& step, const Eigen::VectorXd& velocity)
{
    Eigen::VectorXd flight = flightOf(problem, program, step, velocity);
    if (flight.size() == 0 || program.points() == 0)
    {
        return flight;
    }
    for (bool isApart = false; !isApart;)
    {
        isApart = true;
        const Eigen::VectorXd opening = openingAfterFlight(problem, program, step, flight);
        for (int point = 0; point < program.points(); ++point)
        {
            for (const int body : {program.contacts[static_cast<std::size_t>(point)].first,
                                   program.contacts[static_cast<std::size_t>(point)].second})
            {
                if (opening[2 * point] < -problem.scene.roundingGap && body >= 0
                    && !flight.segment<3>(3 * body).isZero(0))
                {
                    flight.segment<3>(3 * body).setZero();
                    isApart = false; // but for what else this block then meets
                }
            }
        }
    }
    return flight;
}

/// The step as if some points were not there.
struct Meeting
{
    ThetaStep step;
    bool isSolved = false;
    double part = 1; ///< of the step after which the first of them meet; 1: none does
};

/// \param guess of the step \param count adds the work of a step to that of all
template<typename Count>
Meeting firstMeeting(const StepProblem& problem, PlaneConeProgram program, const StepGuess& guess,
                     const Eigen::VectorXd& velocity, const Eigen::VectorXd& closing,
                     const std::vector<std::size_t>& approaching, const Count& count)
{
    // Far enough not to be reached, whatever the other contacts do to the blocks.
    constexpr double far = 10;
    double fastest = problem.acceleration * problem.timeStep;
    for (const std::size_t point : approaching)
    {
        fastest = std::max(fastest, closing[2 * static_cast<Eigen::Index>(point)]);
    }
    Eigen::VectorXd lift = Eigen::VectorXd::Zero(program.gap.size());
    for (const std::size_t point : approaching)
    {
        lift[2 * static_cast<Eigen::Index>(point)] =
            problem.points[point].gap + far * fastest * problem.timeStep;
    }
    program.gap += lift;
    const Relinearisation relinearise =
        problem.relinearise
            ? [&](const Eigen::VectorXd& displacement, const Eigen::VectorXd& force, PlaneConeProgram& lifted)
    {
        lifted.gap -= lift;
        const double error = problem.relinearise(displacement, force, lifted);
        lifted.gap += lift;
        return error;
    }
            : Relinearisation();
    Meeting meeting;
    meeting.step = solveThetaStep(program, problem.settings, guess, relinearise, problem.symbolic);
    count(meeting.step);
    meeting.isSolved = meeting.step.status == SolveStatus::optimal;
    if (!meeting.isSolved)
    {
        return meeting;
    }
    program.gap -= lift;
    const Eigen::VectorXd flight = flightOf(problem, program, meeting.step, velocity, approaching);
    const Eigen::VectorXd opening = openingAfterFlight(problem, program, meeting.step, flight);
    for (const std::size_t point : approaching)
    {
        const auto row = 2 * static_cast<Eigen::Index>(point);
        const double start = problem.points[point].gap;
        const double slope = -problem.timeStep * closing[row];
        const double curvature = opening[row] - start - slope;
        if (opening[row] < 0)
        {
            const double root = std::sqrt(std::max(slope * slope - 4 * curvature * start, 0.0));
            const double part = slope < 0 ? 2 * start / (root - slope) : -(slope + root) / (2 * curvature);
            meeting.part = std::min(meeting.part, (1 - stopsEarly) * part);
        }
    }
    if (meeting.part == 1 && flight.size() > 0)
    {
        // What keeps blocks from flying into others may let them meet after all.
        const Eigen::VectorXd kept = flightApart(problem, program, meeting.step, velocity);
        const Eigen::VectorXd end = openingAfterFlight(problem, program, meeting.step, kept);
        meeting.isSolved =
            std::none_of(approaching.begin(), approaching.end(),
                         [&](std::size_t point)
                         { return end[2 * static_cast<Eigen::Index>(point)] < -problem.scene.roundingGap; });
    }
    return meeting;
}

} // namespace

bool hasImpacts(const DynamicCase& scene)
{
    return scene.restitution() > 0 || scene.schemes.timeIntegration.theta < 1;
}

double farthestMotion(const Eigen::VectorXd& displacement, double blockSize)
{
    double farthest = 0;
    for (Eigen::Index row = 0; row < displacement.size(); row += 3)
    {
        farthest = std::max({farthest, displacement.segment<2>(row).lpNorm<Eigen::Infinity>(),
                             blockSize * std::abs(displacement[row + 2])});
    }
    return farthest;
}

Eigen::VectorXd openingAtEnd(PlaneConeProgram program, const ThetaStep& step,
                             const Relinearisation& relinearise)
{
    if (relinearise)
    {
        relinearise(step.displacement, step.contactForce, program);
    }
    return program.gap - applyTransposed(program, step.displacement);
}

StepSolution solveWithImpacts(const StepProblem& problem, PlaneConeProgram program, StepResiduals& work)
{
    const DynamicCase& scene = problem.scene;
    const Eigen::VectorXd& bySupports = problem.bySupports;
    const double timeStep = problem.timeStep;
    const double theta = scene.schemes.timeIntegration.theta;
    StepWork& whole = problem.work;
    whole.mostPoints = std::max(whole.mostPoints, program.points());
    const auto count = [&work, &whole, &program](const auto& solved)
    {
        whole.done += workOf(solved.iterations, solved.factorisations, program.points(), program.bodies);
        work.iterations += solved.iterations;
        work.factorisations += solved.factorisations;
        work.programs += solved.programs;
    };

    StepSolution solution;
    Eigen::VectorXd& velocity = solution.velocity;
    velocity = problem.state.velocity;
    ThetaStep& step = solution.step;
    StepGuess guess = problem.guess;
    const auto solve = [&]
    {
        step = solveThetaStep(program, problem.settings, guess, problem.relinearise, problem.symbolic);
        count(step);
        solution.isSolved = step.status == SolveStatus::optimal;
    };
    solve();
    if (!hasImpacts(scene) || program.hasCompliance())
    {
        return solution;
    }
    // Nor do points that an impact has just stopped, or thrown back, to its tolerance.
    double slowest = slowImpact * problem.acceleration * timeStep;
    std::vector<std::size_t> collided;
    for (int impacts = 0; solution.isSolved && impacts < mostImpacts; ++impacts)
    {
        Eigen::VectorXd closing = applyTransposed(program, velocity);
        if (bySupports.size() > 0)
        {
            closing += bySupports / timeStep;
        }
        for (const std::size_t point : collided)
        {
            slowest = std::max(slowest, closing[2 * static_cast<Eigen::Index>(point)]);
        }
        Colliding colliding = collidingPoints(problem, program, step, closing, slowest);
        if (!colliding.later.empty() && colliding.now.empty())
        {
            Meeting meeting =
                firstMeeting(problem, program, guess, velocity, closing, colliding.later, count);
            const bool isLater = meeting.isSolved && meeting.part * timeStep > problem.instantTolerance;
            if (isLater && meeting.part < 1)
            {
                solution.isSolved = false;
                solution.length = meeting.part;
                return solution;
            }
            if (isLater)
            {
                step = std::move(meeting.step);
                break;
            }
            if (colliding.isReturning)
            {
                break;
            }
            colliding.now = std::move(colliding.all);
        }
        if (colliding.now.empty())
        {
            break;
        }
        // Momentum changes at an instant: about the mass centres where they are, not where a step takes them.
        PlaneConeProgram before = program;
        if (problem.columns)
        {
            setColumns(before, *problem.columns);
        }
        Impact impact = collide({scene.mass, velocity, before, colliding.now, bySupports, scene.restitution(),
                                 problem.slowestRebound, timeStep},
                                problem.settings);
        count(impact);
        solution.isSolved = impact.isSolved;
        if (solution.isSolved)
        {
            solution.lostInImpacts += impact.energyLoss;
            solution.workOfSupports += impact.workOfSupports;
            solution.restitutionShare = std::min(solution.restitutionShare, impact.restitutionShare);
            velocity = std::move(impact.velocity);
            if (solution.impulse.size() == 0)
            {
                solution.impulse = Eigen::VectorXd::Zero(2 * program.points());
            }
            for (std::size_t i = 0; i < colliding.now.size(); ++i)
            {
                solution.impulse.segment<2>(2 * static_cast<Eigen::Index>(colliding.now[i])) +=
                    impact.impulse.segment<2>(2 * static_cast<Eigen::Index>(i));
            }
            program.load = problem.load + scene.mass.cwiseProduct(velocity) / (theta * timeStep);
            guess.displacement = timeStep * velocity;
            collided = std::move(colliding.now);
            solve();
        }
    }
    if (solution.isSolved)
    {
        solution.flight = flightApart(problem, program, step, velocity);
    }
    return solution;
}

} // namespace drystone
