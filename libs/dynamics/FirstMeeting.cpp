// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The instant at which blocks meet within a step.
#include "dynamics/FirstMeeting.h"

#include "dynamics/FollowedFlow.h"
#include "dynamics/FreeFlight.h"

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// The step up to where blocks meet ends earlier by this part of itself, so that they do not overlap there.
constexpr double stopsEarly = 1e-7;

/// By how much farther apart points are put so that the step does not close them, whatever the other contacts
/// do to the blocks [m]; zero at all others.
template<int Dim>
Eigen::VectorXd liftOf(const Step<Dim>& step, const Eigen::VectorXd& closing,
                       const std::vector<std::size_t>& approaching)
{
    constexpr double far = 10;
    double fastest = step.acceleration * step.scheme.timeStep;
    for (const std::size_t point : approaching)
    {
        fastest = std::max(fastest, closing[Dim * static_cast<Eigen::Index>(point)]);
    }
    Eigen::VectorXd lift = Eigen::VectorXd::Zero(step.program.gap.size());
    for (const std::size_t point : approaching)
    {
        lift[Dim * static_cast<Eigen::Index>(point)] =
            step.points[point].gap + far * fastest * step.scheme.timeStep;
    }
    return lift;
}

/// The step with points farther apart.
template<int Dim>
ThetaStep solveLifted(Step<Dim>& step, const Eigen::VectorXd& lift)
{
    StepProgram<Dim> program = step.program;
    program.gap += lift;
    Relinearisation<Dim> relinearise;
    if (step.relinearise)
    {
        relinearise =
            [&](const Eigen::VectorXd& displacement, const Eigen::VectorXd& force, StepProgram<Dim>& lifted)
        {
            lifted.gap -= lift;
            const double error = step.relinearise(displacement, force, lifted);
            lifted.gap += lift;
            return error;
        };
    }
    StepGuess guess = step.guess;
    if (followsFlow(step.settings))
    {
        // Those without the points are followed from those with them.
        guess.contactForce = step.solved.result.contactForce;
    }
    ThetaStep result =
        solveThetaStep(std::move(program), step.settings, guess, relinearise, step.motion.symbolic.get());
    countWork(step, result.iterations, result.factorisations, result.programs);
    return result;
}

/// After which part of a step a gap is closed that changes as a parabola. \param start the gap [m] \param
/// slope its change over the step as it begins [m] \param end the gap after the step, below 0 [m]
double partUntilClosed(double start, double slope, double end)
{
    const double curvature = end - start - slope;
    const double root = std::sqrt(std::max(slope * slope - 4 * curvature * start, 0.0));
    return slope < 0 ? 2 * start / (root - slope) : -(slope + root) / (2 * curvature);
}

} // namespace

template<int Dim>
Meeting firstMeeting(Step<Dim>& step, const Eigen::VectorXd& closing,
                     const std::vector<std::size_t>& approaching)
{
    Meeting meeting;
    meeting.result = solveLifted(step, liftOf(step, closing, approaching));
    meeting.isSolved = meeting.result.status == SolveStatus::optimal;
    if (!meeting.isSolved)
    {
        return meeting;
    }
    const Eigen::VectorXd& velocity = step.solved.velocity;
    const Eigen::VectorXd flight = flightOf(step, meeting.result, velocity, approaching);
    const Eigen::VectorXd opening = openingAfterFlight(step, meeting.result, flight);
    for (const std::size_t point : approaching)
    {
        const auto row = Dim * static_cast<Eigen::Index>(point);
        if (opening[row] < 0)
        {
            const double part =
                partUntilClosed(step.points[point].gap, -step.scheme.timeStep * closing[row], opening[row]);
            meeting.part = std::min(meeting.part, (1 - stopsEarly) * part);
        }
    }
    if (meeting.part == 1 && flight.size() > 0)
    {
        // What keeps blocks from flying into others may let them meet after all.
        const Eigen::VectorXd kept = flightApart(step, meeting.result, velocity);
        const Eigen::VectorXd end = openingAfterFlight(step, meeting.result, kept);
        meeting.isSolved =
            std::none_of(approaching.begin(), approaching.end(),
                         [&](std::size_t point)
                         { return end[Dim * static_cast<Eigen::Index>(point)] < -step.scene.roundingGap; });
    }
    return meeting;
}

template Meeting firstMeeting(Step<2>& step, const Eigen::VectorXd& closing,
                              const std::vector<std::size_t>& approaching);
template Meeting firstMeeting(Step<3>& step, const Eigen::VectorXd& closing,
                              const std::vector<std::size_t>& approaching);

} // namespace drystone
