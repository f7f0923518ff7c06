// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Coulomb's law in a step by following the forces of the step before: how stiff points are, and where the
/// path begins.
#include "dynamics/FollowedFlow.h"

#include "conic/coulomb/ContactPath.h"
#include "dynamics/CoulombFlow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace drystone
{
namespace
{

/// Error allowed in gaps that are linear predictions, where it does not become less.
constexpr double partOfOverlap = 0.1;

/// Changes of state of points allowed from the forces of the last step; where they do not suffice, it was of
/// another kind. So many, and one more for every so many points; from any forces as many as there are points.
constexpr int fewPivots = 24;
constexpr int pointsToAPivot = 10;

/// In space a path that after so many changes, and one for so many points, is still at its start stays there:
/// it swings about it.
constexpr int pivotsAtStart = 100;
constexpr int pointsToAPivotAtStart = 8;

/// Forces that are followed are those of the overlaps to this part.
constexpr double partOfFollowed = 0.1;

/// From forces of another kind, such as those of the interior point, the way to nearly rigid points is long
/// and winding; by way of points that are softer by these factors it is short.
constexpr std::array<double, 5> gentle{65536, 4096, 256, 16, 1};
/// Where one such way does not end in space, the other often does.
constexpr std::array<double, 4> fromFarSofter{16777216, 65536, 256, 1};
/// And, as pieces turn there, a third way with short stages.
constexpr std::array<double, 13> slow{16777216, 4194304, 1048576, 262144, 65536, 16384, 4096,
                                      1024,     256,     64,      16,     4,     1};
constexpr std::array<std::span<const double>, 3> softenings{gentle, fromFarSofter, slow};
/// In the plane what the first does not reach is stiffened gradually (`softest` below).
constexpr std::size_t waysIn(int dimensions)
{
    return dimensions == 3 ? softenings.size() : 1;
}

/// In powers of 4 times what stops all of a structure in one whole step, so that it stays from step to step,
/// and from part to part, and is the same in any units. \return the stiffness with which points overlap by no
/// more under a force [N/m]
template<int Dim>
double stiffnessFor(const StepProgram<Dim>& program, double force, double overlap, double partOfStep)
{
    double inertia = 0;
    for (const typename StepProgram<Dim>::Inertia& ofBody : program.inertia)
    {
        inertia += ofBody(0, 0);
    }
    inertia *= partOfStep * partOfStep;
    return inertia * std::exp2(2 * std::ceil(0.5 * std::log2(force / (inertia * overlap))));
}

template<int Dim>
using PathOf = ContactPath<freedomCount<Dim>, Dim>;

/// In the plane, where stages do not arrive: from points that are softer by this factor to nearly rigid ones
/// through all stiffnesses between (ContactPath::stiffen). That leads to forces which no other way reaches,
/// in up to so many changes of state and factorisations for each point: half of the ways in rubble take 3 and
/// 0.3, few more than 6 and 1.
constexpr double softest = 16777216;
constexpr int pivotsToStiffen = 12;
constexpr int factorisationsToStiffen = 2;

/// A problem whose flow is followed, and what counts the work.
template<int Dim>
struct FollowedFlow
{
    StepProgram<Dim> program; ///< linearised about where the forces have led
    const FlowProblem<Dim>& problem;
    ThetaStep& step;
    double mostWork = std::numeric_limits<double>::infinity(); ///< of the step at which paths are given up
};

/// A stage of the way to nearly rigid points.
struct FlowStage
{
    double stiffness;    ///< of the points [N/m]
    int mostPivots;      ///< changes of state of points
    double gapTolerance; ///< of the linear prediction [m]
    /// Whether gaps are to be right where the blocks end up, with no more overlaps than the settings want;
    /// before, they stay as they are.
    bool isLast;
    int mostFactorisations = std::numeric_limits<int>::max();
    double softness = 1; ///< by how much points are softer at first, and then stiffen gradually
};

/// The work of the step so far.
template<int Dim>
double workDone(const FollowedFlow<Dim>& flow)
{
    return workOf(flow.step.iterations, flow.step.factorisations, flow.program.points(), flow.program.bodies);
}

/// How many factorisations paths may still take.
template<int Dim>
int factorisationsLeft(const FollowedFlow<Dim>& flow)
{
    const double left = flow.mostWork - workDone(flow);
    const double ofOne = workOf(1, 1, flow.program.points(), flow.program.bodies);
    return static_cast<int>(std::clamp<double>(left / ofOne, 0, std::numeric_limits<int>::max()));
}

/// Takes the overlaps c/k away: with gaps that are smaller by them points carry the same forces where they
/// touch (the method of multipliers, Hestenes 1969). What is left of the overlaps is what the forces change
/// by, over k, and they change by the inertia of displacements as small as overlaps only.
template<int Dim>
bool closeOverlaps(const FollowedFlow<Dim>& flow, PathOf<Dim>& path, ConeSolution& solution, double stiffness)
{
    constexpr int rounds = 2;
    for (int round = 0; round < rounds; ++round)
    {
        StepProgram<Dim> smaller = flow.program;
        smaller.gap -= solution.contactForce / stiffness;
        if (!path.follow(smaller))
        {
            return false;
        }
        solution.contactForce = path.contactForce();
    }
    solution.displacement = displacementUnder(
        flow.program, flow.program.load - applyEquilibrium(flow.program, solution.contactForce));
    return true;
}

/// Where a stage begins with softer points, from a solution to theirs, and on until they are as stiff as the
/// stage has them. \return whether that was reached
template<int Dim>
bool stiffenGradually(const FollowedFlow<Dim>& flow, PathOf<Dim>& path, const FlowStage& stage)
{
    if constexpr (Dim == 2)
    {
        return stage.softness == 1 || (path.follow(flow.program) && path.stiffen(stage.stiffness));
    }
    return true;
}

/// From a solution to that of a stage, with gaps that are right where it leads. \return whether it was
/// reached
template<int Dim>
bool followTo(FollowedFlow<Dim>& flow, ConeSolution& solution, const FlowStage& stage)
{
    constexpr double beyond = 1e-3;
    constexpr double exact = 1e-3;
    const FlowProblem<Dim>& problem = flow.problem;
    const StepSettings& settings = problem.settings;
    ContactPathSettings ofPath{.stiffness = stage.stiffness / stage.softness,
                               .tolerance = beyond * settings.solver.tolerance,
                               .maximumPivots = stage.mostPivots,
                               .maximumFactorisations =
                                   std::min(factorisationsLeft(flow), stage.mostFactorisations)};
    if (Dim == 3)
    {
        ofPath.maximumPivotsAtStart = pivotsAtStart + flow.program.points() / pointsToAPivotAtStart;
    }
    PathOf<Dim> path(flow.program, solution, ofPath, problem.symbolic);
    const bool begins = stiffenGradually(flow, path, stage);
    bool isReached = false;
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0; begins && !isReached && round <= mostRelinearisations && path.follow(flow.program);
         ++round)
    {
        solution.contactForce = path.contactForce();
        solution.displacement = displacementUnder(
            flow.program, flow.program.load - applyEquilibrium(flow.program, solution.contactForce));
        if (!stage.isLast || !problem.relinearise)
        {
            isReached = true;
            break;
        }
        // To rounding: what is left of an error differs between motions that are alike.
        const double error = problem.relinearise(solution.displacement, solution.contactForce, flow.program);
        isReached =
            error <= exact * stage.gapTolerance || (error <= stage.gapTolerance && error >= 0.5 * before);
        before = error;
    }
    if (isReached && stage.isLast && settings.overlaps == Overlaps::closed)
    {
        isReached = closeOverlaps(flow, path, solution, stage.stiffness);
    }
    flow.step.iterations += path.factorisations();
    flow.step.factorisations += path.factorisations();
    return isReached;
}

/// Paths that lead nowhere leave programs their share of the work.
template<int Dim>
void leaveWorkForPrograms(FollowedFlow<Dim>& flow)
{
    constexpr double partOfWork = Dim == 3 ? 0.5 : 0.75; // in the plane they arrive
    if (const StepWork* work = flow.problem.settings.work)
    {
        const double done = workDone(flow);
        flow.mostWork = done + partOfWork * std::max(0.0, work->mostOfAttempt - work->done - done);
    }
}

/// From forces of another kind, by way of softer points: in stages, or else gradually. \param last stage
/// \return whether it was reached
template<int Dim>
bool followFromAfar(FollowedFlow<Dim>& flow, ConeSolution& solution, const ConeSolution& start,
                    const FlowStage& last)
{
    if (Dim == 3)
    {
        leaveWorkForPrograms(flow);
    }
    const StepProgram<Dim>& program = flow.problem.program;
    double lostFrom = 0; // how much softer points were at a first stage that is not reached
    for (std::size_t way = 0; way < waysIn(Dim); ++way)
    {
        if (softenings[way].front() == lostFrom)
        {
            continue;
        }
        flow.program = program;
        solution = start;
        bool isReached = true;
        for (std::size_t stage = 0; isReached && stage < softenings[way].size(); ++stage)
        {
            FlowStage softer = last;
            softer.stiffness /= softenings[way][stage];
            softer.isLast = stage + 1 == softenings[way].size();
            isReached = followTo(flow, solution, softer);
            lostFrom = stage == 0 && !isReached ? softenings[way].front() : lostFrom;
        }
        if (isReached)
        {
            return true;
        }
    }
    if (Dim == 3)
    {
        return false;
    }
    leaveWorkForPrograms(flow);
    flow.program = program;
    solution = start;
    FlowStage gradual = last;
    gradual.softness = softest;
    gradual.mostPivots = pivotsToStiffen * program.points();
    gradual.mostFactorisations = factorisationsToStiffen * program.points();
    return followTo(flow, solution, gradual);
}

} // namespace

template<int Dim>
bool areFollowed(const StepProgram<Dim>& program, const Eigen::VectorXd& contactForce)
{
    // One stiffness for all points: that of the largest force.
    Eigen::Index strongest = 0;
    for (Eigen::Index row = 0; row < contactForce.size(); row += Dim)
    {
        strongest = contactForce[row] > contactForce[strongest] ? row : strongest;
    }
    if (contactForce.size() == 0 || !(program.gap[strongest] < 0))
    {
        return false;
    }
    const double stiffness = contactForce[strongest] / -program.gap[strongest];
    double missed = 0;
    double sum = 0;
    for (Eigen::Index row = 0; row < contactForce.size(); row += Dim)
    {
        missed += std::abs(contactForce[row] - stiffness * std::max(0.0, -program.gap[row]));
        sum += contactForce[row];
    }
    return missed <= partOfFollowed * sum;
}

template<int Dim>
bool followFlow(ThetaStep& step, const FlowProblem<Dim>& problem, const ConeSolution& start,
                Following following)
{
    const StepProgram<Dim>& program = problem.program;
    const StepSettings& settings = problem.settings;
    const double largest = start.contactForce.size() > 0 ? start.contactForce.lpNorm<Eigen::Infinity>() : 0;
    const bool isMotion = settings.kind == StepKind::motion; // an impact has its gaps as they are
    if (following == Following::notAtAll || (isMotion && !problem.relinearise) || !followsFlow(settings)
        || program.hasCompliance() || program.hasCrushing() || !(largest > 0))
    {
        return false;
    }
    // Half of what is allowed under the largest force of the step before.
    const double overlap = settings.contactOverlap * settings.blockSize;
    const double stiffness = stiffnessFor(program, largest, overlap / 2, settings.partOfStep);
    const double gapTolerance = partOfOverlap * overlap;
    const int few = fewPivots + program.points() / pointsToAPivot;
    const int many = program.points();
    FollowedFlow<Dim> flow{program, problem, step};
    ConeSolution solution = start;
    const bool isReached =
        followTo(flow, solution, {stiffness, few, gapTolerance, true})
        || (following == Following::fromAnyForces
            && followFromAfar(flow, solution, start, {stiffness, many, gapTolerance, true}));
    if (!isReached)
    {
        return false;
    }
    solution.status = SolveStatus::optimal;
    ThetaStep taken = step;
    takeOver(taken, flow.program, std::move(solution), settings, overlap, overlap);
    if (problem.relinearise && settings.overlaps == Overlaps::closed)
    {
        // About the motion that is left with the overlaps closed.
        problem.relinearise(taken.displacement, taken.contactForce, flow.program);
    }
    const bool isRight = taken.certificate.worst() <= settings.solver.tolerance
                         && (!problem.relinearise || keepMomenta(taken, flow.program, problem.relinearise));
    if (isRight)
    {
        step = std::move(taken);
    }
    return isRight;
}

template bool followFlow(ThetaStep& step, const FlowProblem<2>& problem, const ConeSolution& start,
                         Following following);
template bool areFollowed(const StepProgram<2>& program, const Eigen::VectorXd& contactForce);
template bool followFlow(ThetaStep& step, const FlowProblem<3>& problem, const ConeSolution& start,
                         Following following);
template bool areFollowed(const StepProgram<3>& program, const Eigen::VectorXd& contactForce);

} // namespace drystone
