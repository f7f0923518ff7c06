// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// GSL's rk8pd; the instant by the Illinois variant of false position, from the beginning of its step.
#include "timeSeries/EventIntegration.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace drystone
{

namespace
{

struct FreeStepper
{
    void operator()(gsl_odeiv2_step* object) const { gsl_odeiv2_step_free(object); }
    void operator()(gsl_odeiv2_control* object) const { gsl_odeiv2_control_free(object); }
    void operator()(gsl_odeiv2_evolve* object) const { gsl_odeiv2_evolve_free(object); }
};

int rateForGsl(double time, const double state[], double rate[], void* problem)
{
    static_cast<const EventProblem*>(problem)->rate(time, state, rate);
    return GSL_SUCCESS;
}

/// GSL's method of order 8 for a problem, with steps that it chooses.
class Integrator
{
public:
    Integrator(const EventProblem& ofEvent, std::size_t size, const EventTolerance& tolerance)
        : problem(ofEvent),
          system{rateForGsl, nullptr, size, const_cast<EventProblem*>(&ofEvent)},
          step(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, size)),
          control(gsl_odeiv2_control_y_new(tolerance.absolute, tolerance.relative)),
          evolve(gsl_odeiv2_evolve_alloc(size))
    {
    }

    /// One step towards `end`. \param length that is tried, and then that the next should have
    void advance(double end, double& time, double& length, std::vector<double>& state)
    {
        const double before = time;
        const int status = gsl_odeiv2_evolve_apply(evolve.get(), control.get(), step.get(), &system, &time,
                                                   end, &length, state.data());
        if (status != GSL_SUCCESS || !(time > before))
        {
            throw std::runtime_error("the integration tolerance requires steps too short to advance time");
        }
    }

    double event(double time, const std::vector<double>& state) const
    {
        return problem.event(time, state.data());
    }

    /// The state after one step of a given length.
    std::vector<double> after(double time, std::vector<double> state, double length)
    {
        if (length > 0)
        {
            std::vector<double> error(state.size());
            gsl_odeiv2_step_apply(step.get(), time, length, state.data(), error.data(), nullptr, nullptr,
                                  &system);
        }
        return state;
    }

private:
    const EventProblem& problem;
    gsl_odeiv2_system system;
    std::unique_ptr<gsl_odeiv2_step, FreeStepper> step;
    std::unique_ptr<gsl_odeiv2_control, FreeStepper> control;
    std::unique_ptr<gsl_odeiv2_evolve, FreeStepper> evolve;
};

/// Two parts of a step between which the event's function passes zero downwards, and its values there.
struct Bracket
{
    double low;
    double high;
    double lowValue;  ///< > 0 if there is a bracket
    double highValue; ///< <= 0
};

/// An event at the very start (a block that has just hit the ground) is not the one sought: a point inside
/// is, where the function is positive.
template<class Event>
Bracket bracketOf(const Event& event, double length)
{
    constexpr int mostHalvings = 80;
    Bracket bracket{0, length, event(0), event(length)};
    for (int halving = 0; bracket.lowValue <= 0 && halving < mostHalvings; ++halving)
    {
        const double middle = 0.5 * bracket.high;
        const double value = event(middle);
        (value > 0 ? bracket.low : bracket.high) = middle;
        (value > 0 ? bracket.lowValue : bracket.highValue) = value;
    }
    return bracket;
}

/// The Illinois variant of the false position: always bracketed, and faster than bisection. \param scale of
/// the instants that are distinguished \return the upper end of what is left
template<class Event>
double zeroWithin(const Event& event, Bracket bracket, double scale)
{
    constexpr int mostIterations = 100;
    constexpr double rounding = 1e-16;
    auto& [low, high, lowValue, highValue] = bracket;
    const auto isInside = [&bracket](double part) { return part > bracket.low && part < bracket.high; };
    int side = 0; // that moved last: 1 the lower
    for (int iteration = 0; iteration < mostIterations && high - low > rounding * scale; ++iteration)
    {
        double middle = (low * highValue - high * lowValue) / (highValue - lowValue);
        middle = isInside(middle) ? middle : 0.5 * (low + high);
        if (!isInside(middle))
        {
            break;
        }
        const double value = event(middle);
        const bool isBefore = value > 0;
        const int moves = isBefore ? 1 : -1;
        (isBefore ? low : high) = middle;
        (isBefore ? lowValue : highValue) = value;
        if (side == moves)
        {
            (isBefore ? highValue : lowValue) *= 0.5;
        }
        side = moves;
        if (value == 0)
        {
            break;
        }
    }
    return high;
}

} // namespace

EventOutcome integrateToEvent(const EventProblem& problem, double start, std::vector<double> state,
                              double end, const EventTolerance& tolerance)
{
    constexpr double firstStep = 1e-3;
    Integrator integrator(problem, state.size(), tolerance);
    double time = start;
    double length = firstStep;
    while (time < end)
    {
        const double before = time;
        const std::vector<double> stateBefore = state;
        length = std::min(length, tolerance.longestStep);
        integrator.advance(end, time, length, state);
        if (integrator.event(time, state) >= 0)
        {
            continue;
        }
        const auto eventAfter = [&](double part)
        { return integrator.event(before + part, integrator.after(before, stateBefore, part)); };
        const Bracket bracket = bracketOf(eventAfter, time - before);
        if (bracket.lowValue <= 0) // at once
        {
            return {before, stateBefore, true};
        }
        const double part = zeroWithin(eventAfter, bracket, 1 + before);
        return {before + part, integrator.after(before, stateBefore, part), true};
    }
    return {end, state, false};
}

} // namespace drystone
