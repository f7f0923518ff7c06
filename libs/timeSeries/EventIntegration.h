// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Ordinary differential equations integrated to the last digits, up to the instant at which something
/// happens. For reference solutions; the motion of walls is stepped elsewhere.
#pragma once

#include <functional>
#include <vector>

namespace drystone
{

/// y' = f(t, y), smooth from the start of an integration to its end, and an event: a function that is
/// positive, or zero at the start, until the event happens.
struct EventProblem
{
    std::function<void(double time, const double* state, double* rate)> rate;
    std::function<double(double time, const double* state)> event;
};

struct EventTolerance
{
    double absolute = 1e-13; ///< error allowed in each entry of the state over one step
    double relative = 1e-13;
    double longestStep = 0.005; ///< [s]: an event that comes and goes within one step would be missed
};

struct EventOutcome
{
    double time = 0;
    std::vector<double> state;
    bool happened = false; ///< at `time`, to the last digits; otherwise `time` is the end requested
};

/// Integrate from `start` to `end`, or to the event if that comes first, by the method of Prince and Dormand
/// of order 8 with steps adapted to the tolerance (GSL's rk8pd). The event is located by repeating its step
/// with other lengths. \throws std::runtime_error when the tolerance requires steps too short to advance time
EventOutcome integrateToEvent(const EventProblem& problem, double start, std::vector<double> state,
                              double end, const EventTolerance& tolerance = {});

} // namespace drystone
