// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
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

} // namespace

EventOutcome integrateToEvent(const EventProblem& problem, double start, std::vector<double> state,
                              double end, const EventTolerance& tolerance)
{
    const std::size_t size = state.size();
    gsl_odeiv2_system system{rateForGsl, nullptr, size, const_cast<EventProblem*>(&problem)};
    const std::unique_ptr<gsl_odeiv2_step, FreeStepper> step(
        gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, size));
    const std::unique_ptr<gsl_odeiv2_control, FreeStepper> control(
        gsl_odeiv2_control_y_new(tolerance.absolute, tolerance.relative));
    const std::unique_ptr<gsl_odeiv2_evolve, FreeStepper> evolve(gsl_odeiv2_evolve_alloc(size));

    double time = start;
    double length = std::min(tolerance.longestStep, 1e-3);
    while (time < end)
    {
        const double before = time;
        const std::vector<double> stateBefore = state;
        length = std::min(length, tolerance.longestStep);
        const int status = gsl_odeiv2_evolve_apply(evolve.get(), control.get(), step.get(), &system, &time,
                                                   end, &length, state.data());
        if (status != GSL_SUCCESS || !(time > before))
        {
            throw std::runtime_error("the integration tolerance asks for steps too short to advance time");
        }
        if (problem.event(time, state.data()) >= 0)
        {
            continue;
        }

        // The event lies within this step. `after` gives the state at a part of it.
        std::vector<double> trial(size);
        std::vector<double> error(size);
        const auto after = [&](double h)
        {
            trial = stateBefore;
            if (h > 0)
            {
                gsl_odeiv2_step_apply(step.get(), before, h, trial.data(), error.data(), nullptr, nullptr,
                                      &system);
            }
            return problem.event(before + h, trial.data());
        };
        double high = time - before;
        double low = 0;
        double highValue = after(high);
        double lowValue = after(0);
        // An event at the very start (a block that has just hit the ground) is not the one sought: look for a
        // point inside where the function is positive. If there is none, the event happens at once.
        for (int halving = 0; lowValue <= 0 && halving < 80; ++halving)
        {
            const double middle = 0.5 * high;
            const double value = after(middle);
            if (value > 0)
            {
                low = middle;
                lowValue = value;
            }
            else
            {
                high = middle;
                highValue = value;
            }
        }
        if (lowValue <= 0)
        {
            return {before, stateBefore, true};
        }
        // Illinois variant of the false position: always bracketed, and faster than bisection
        int side = 0;
        for (int iteration = 0; iteration < 100 && high - low > 1e-16 * (1 + before); ++iteration)
        {
            double middle = (low * highValue - high * lowValue) / (highValue - lowValue);
            if (!(middle > low && middle < high))
            {
                middle = 0.5 * (low + high);
            }
            if (!(middle > low && middle < high))
            {
                break;
            }
            const double value = after(middle);
            if (value > 0)
            {
                low = middle;
                lowValue = value;
                if (side == 1)
                {
                    highValue *= 0.5;
                }
                side = 1;
            }
            else
            {
                high = middle;
                highValue = value;
                if (side == -1)
                {
                    lowValue *= 0.5;
                }
                side = -1;
                if (value == 0)
                {
                    break;
                }
            }
        }
        after(high);
        return {before + high, trial, true};
    }
    return {end, state, false};
}

} // namespace drystone
