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

} // namespace

template<int Dim>
Meeting firstMeeting(Step<Dim>& step, const Eigen::VectorXd& closing,
                     const std::vector<std::size_t>& approaching)
{
    // Far enough not to be reached, whatever the other contacts do to the blocks.
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
    StepProgram<Dim> lifting = step.program;
    lifting.gap += lift;
    const Relinearisation<Dim> relinearise =
        step.relinearise
            ? [&](const Eigen::VectorXd& displacement, const Eigen::VectorXd& force, StepProgram<Dim>& lifted)
    {
        lifted.gap -= lift;
        const double error = step.relinearise(displacement, force, lifted);
        lifted.gap += lift;
        return error;
    }
            : Relinearisation<Dim>();
    Meeting meeting;
    StepGuess guess = step.guess;
    if (followsFlow(step.settings))
    {
        // Those without the points are followed from those with them.
        guess.contactForce = step.solved.result.contactForce;
    }
    meeting.result =
        solveThetaStep(std::move(lifting), step.settings, guess, relinearise, step.motion.symbolic.get());
    countWork(step, meeting.result.iterations, meeting.result.factorisations, meeting.result.programs);
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
        const double start = step.points[point].gap;
        const double slope = -step.scheme.timeStep * closing[row];
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
