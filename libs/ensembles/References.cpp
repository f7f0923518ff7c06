// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Integrates the reference solutions between events.
#include "ensembles/References.h"

#include "timeSeries/EventIntegration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace drystone
{

double RockingBlock::radius() const
{
    return 0.5 * std::hypot(width, height);
}

double RockingBlock::slenderness() const
{
    return std::atan2(width, height);
}

double RockingBlock::frequencyParameter() const
{
    // I = 4/3 m R^2 about a corner, and m g R / I = p^2
    return std::sqrt(0.75 * gravity / radius());
}

double RockingBlock::restitution() const
{
    // moment of momentum about the new corner before and after: I w' = (I - 2 m R^2 sin^2 alpha) w
    const double sine = std::sin(slenderness());
    return 1 - 1.5 * sine * sine;
}

namespace
{

/// The first time from `from` at which the ground accelerates by more than a level, or the last kink if it
/// never does. \param from where the search begins \param end of the search [s]
double firstTimeAbove(const GroundAcceleration& ground, double level, double from, double end)
{
    std::vector<double> times = ground.kinks();
    std::erase_if(times, [&](double time) { return !(time > from && time < end); });
    times.push_back(end);
    double start = from;
    for (const double stop : times)
    {
        constexpr int parts = 256; // of a smooth piece
        double before = start;
        for (int part = 0; part < parts; ++part)
        {
            // just short of the kink at the end of the piece, where the next piece begins
            const double time =
                std::min(start + (stop - start) * (part + 1) / parts, std::nextafter(stop, start));
            if (part == 0 && std::abs(ground.at(before)) > level)
            {
                return before;
            }
            if (std::abs(ground.at(time)) > level)
            {
                double low = before;
                double high = time;
                while (std::nextafter(low, high) < high)
                {
                    const double middle = 0.5 * (low + high);
                    (std::abs(ground.at(middle)) > level ? high : low) = middle;
                }
                return high;
            }
            before = time;
        }
        start = stop;
    }
    return end;
}

/// A rocking block on its way, piece by piece between kinks of the ground's motion, requested times and
/// impacts.
class RockingPath
{
public:
    RockingPath(const RockingBlock& rockingBlock, const GroundAcceleration& groundAcceleration,
                const RockingRun& rockingRun);
    RockingHistory follow();

private:
    void sampleState();
    RockingVerdict certainVerdict() const;
    void waitForUplift();
    EventProblem problem();
    void rock();
    void meetGround(double passed);

    const RockingBlock& block;
    const GroundAcceleration& ground;
    const RockingRun& run;
    const double alpha;  ///< slenderness [rad]
    const double p;      ///< frequency parameter [1/s]
    const double ratio;  ///< of angular velocities, after an impact over before
    const double uplift; ///< acceleration of the ground at which a block at rest begins to rock [m/s2]
    const std::vector<double> kinks;
    const double still; ///< when the ground has stopped for good [s]

    RockingHistory history;
    RockingState state;
    bool isResting;
    double side; ///< +1 on the left corner, -1 on the right one
    double pieceEnd = 0;
    bool pieceEndsInJump = true;
    std::size_t kink = 0;   ///< the next of `kinks`
    std::size_t sample = 0; ///< the next of the requested times
};

double timeOfStillness(const GroundAcceleration& ground, const std::vector<double>& kinks)
{
    constexpr double never = std::numeric_limits<double>::infinity();
    return kinks.empty() ? (ground.peak() > 0 ? never : -never) : kinks.back();
}

RockingPath::RockingPath(const RockingBlock& rockingBlock, const GroundAcceleration& groundAcceleration,
                         const RockingRun& rockingRun)
    : block(rockingBlock),
      ground(groundAcceleration),
      run(rockingRun),
      alpha(block.slenderness()),
      p(block.frequencyParameter()),
      ratio(run.restitution < 0 ? block.restitution() : run.restitution),
      uplift(block.gravity * std::tan(alpha)),
      kinks(ground.kinks()),
      still(timeOfStillness(ground, kinks)),
      state(run.start),
      isResting(state.rotation == 0 && state.angularVelocity == 0),
      side(std::copysign(1.0, state.rotation != 0 ? state.rotation : state.angularVelocity))
{
}

/// The requested times that have been reached.
void RockingPath::sampleState()
{
    for (; sample < run.sampleTimes.size() && run.sampleTimes[sample] <= state.time; ++sample)
    {
        history.samples.push_back({run.sampleTimes[sample], state.rotation, state.angularVelocity});
    }
}

RockingVerdict RockingPath::certainVerdict() const
{
    if (state.time < still || std::abs(ground.at(state.time)) > 0)
    {
        return RockingVerdict::rocks;
    }
    // kinetic energy over m g R: w^2/(2 p^2); potential: cos(alpha - |theta|), 1 at the crest
    const double w = state.angularVelocity / p;
    const double energy = 0.5 * w * w + std::cos(alpha - std::abs(state.rotation));
    return std::abs(state.rotation) < alpha && energy < 1 ? RockingVerdict::stands : RockingVerdict::rocks;
}

/// Until the ground makes the block rock, or the next requested time.
void RockingPath::waitForUplift()
{
    const double end =
        sample < run.sampleTimes.size() ? std::min(run.sampleTimes[sample], run.endTime) : run.endTime;
    state = {firstTimeAbove(ground, uplift, state.time, end), 0, 0};
    if (state.time < end)
    {
        isResting = false;
        side = std::copysign(1.0, ground.at(state.time));
    }
}

EventProblem RockingPath::problem()
{
    EventProblem result;
    result.rate = [this](double time, const double* y, double* rate)
    {
        // within a smooth piece the value at its end is that before the jump
        const double instant = pieceEndsInJump ? std::min(time, std::nextafter(pieceEnd, -1e300)) : time;
        const double tilt = alpha - side * y[0];
        rate[0] = y[1];
        rate[1] = -p * p * (side * std::sin(tilt) - ground.at(instant) / block.gravity * std::cos(tilt));
    };
    result.event = [this](double, const double* y)
    {
        history.largestRotation =
            std::max(history.largestRotation, std::min(std::abs(y[0]), std::numbers::pi / 2));
        // upright again, or on its side
        return std::min(side * y[0], std::numbers::pi / 2 - side * y[0]);
    };
    return result;
}

/// To the end of a smooth piece, the next requested time or the next event.
void RockingPath::rock()
{
    pieceEndsInJump = kink < kinks.size() && kinks[kink] <= run.endTime;
    pieceEnd = pieceEndsInJump ? kinks[kink] : run.endTime;
    double end = pieceEnd;
    if (sample < run.sampleTimes.size())
    {
        end = std::min(end, run.sampleTimes[sample]);
    }
    // Before the ground is still the verdict is not certain; afterwards it is checked about every second.
    if (run.untilVerdict)
    {
        end = std::min(end, state.time + 1);
    }
    const EventOutcome outcome =
        integrateToEvent(problem(), state.time, {state.rotation, state.angularVelocity}, end);
    const double passed = outcome.time - state.time;
    state = {outcome.time, outcome.state[0], outcome.state[1]};
    if (outcome.happened)
    {
        meetGround(passed);
    }
}

/// \param passed since the last event or the start of the piece [s]
void RockingPath::meetGround(double passed)
{
    if (side * state.rotation > alpha)
    {
        history.verdict = RockingVerdict::overturns;
        return;
    }
    const RockingImpact impact{state.time, state.angularVelocity, ratio * state.angularVelocity};
    history.impacts.push_back(impact);
    state.rotation = 0;
    state.angularVelocity = impact.velocityAfter;
    side = state.angularVelocity != 0 ? std::copysign(1.0, state.angularVelocity) : -side;
    const double slowest = 1e-10 * p;
    if (std::abs(state.angularVelocity) < slowest || passed < 1e-13)
    {
        state.angularVelocity = 0;
        isResting = true;
    }
}

RockingHistory RockingPath::follow()
{
    while (state.time < run.endTime && history.verdict == RockingVerdict::rocks)
    {
        while (kink < kinks.size() && kinks[kink] <= state.time)
        {
            ++kink;
        }
        sampleState();
        if (run.untilVerdict && sample == run.sampleTimes.size())
        {
            history.verdict = certainVerdict();
            if (history.verdict != RockingVerdict::rocks)
            {
                break;
            }
        }
        if (isResting)
        {
            waitForUplift();
        }
        else
        {
            rock();
        }
    }
    if (history.verdict == RockingVerdict::rocks)
    {
        history.verdict = certainVerdict();
    }
    if (history.verdict != RockingVerdict::overturns)
    {
        sampleState();
    }
    history.last = state;
    return std::move(history);
}

} // namespace

RockingHistory rockingMotion(const RockingBlock& block, const GroundAcceleration& ground,
                             const RockingRun& run)
{
    return RockingPath(block, ground, run).follow();
}

double rockingPeriod(const RockingBlock& block, double rotation)
{
    if (!(rotation > 0 && rotation < block.slenderness()))
    {
        throw std::domain_error("a block rocks freely from a rotation between zero and its slenderness");
    }
    RockingRun run;
    run.start.rotation = rotation;
    run.untilVerdict = false;
    run.restitution = 0;
    // the linearised quarter period is close; the exact one is longer by less than a factor of two
    run.endTime = rockingPeriodLinearised(block, rotation);
    const RockingHistory history = rockingMotion(block, ConstantAcceleration(0), run);
    return 4 * history.impacts.at(0).time;
}

double rockingPeriodLinearised(const RockingBlock& block, double rotation)
{
    return 4 / block.frequencyParameter() * std::acosh(1 / (1 - rotation / block.slenderness()));
}

double
overturningThreshold(const RockingBlock& block,
                     const std::function<std::unique_ptr<GroundAcceleration>(double amplitude)>& ground,
                     double low, double high)
{
    const auto overturns = [&](double amplitude)
    { return rockingMotion(block, *ground(amplitude), {}).verdict == RockingVerdict::overturns; };
    const bool lowOverturns = overturns(low);
    if (overturns(high) == lowOverturns)
    {
        throw std::domain_error("the verdict on the block is the same at both amplitudes");
    }
    while (high - low > 1e-9 * high)
    {
        const double middle = 0.5 * (low + high);
        (overturns(middle) == lowOverturns ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double slidingDistance(double velocity, double frictionCoefficient, double gravity)
{
    return velocity * velocity / (2 * frictionCoefficient * gravity);
}

double newmarkPulseDistance(double amplitude, double duration, double frictionCoefficient, double gravity)
{
    // The base gains on the block by A - mu g during the pulse, and loses by mu g after it until both are as
    // fast:
    //     (A - mu g) T^2/2 + ((A - mu g) T)^2/(2 mu g)
    const double resistance = frictionCoefficient * gravity;
    if (amplitude <= resistance)
    {
        return 0;
    }
    return amplitude * (amplitude - resistance) * duration * duration / (2 * resistance);
}

std::vector<SlidingState> slidingMotion(const GroundAcceleration& ground, double frictionCoefficient,
                                        const std::vector<double>& sampleTimes, double gravity)
{
    const double strength = frictionCoefficient * gravity;
    double side = 0; // of the velocity; 0 at rest
    double pieceEnd = 0;
    EventProblem problem;
    problem.rate = [&](double time, const double* y, double* rate)
    {
        const double instant = std::min(time, std::nextafter(pieceEnd, -1e300)); // before the jump at its end
        rate[0] = y[1];
        rate[1] = -ground.at(instant) - side * strength;
    };
    problem.event = [&](double, const double* y) { return side * y[1]; };

    const std::vector<double> kinks = ground.kinks();
    std::vector<SlidingState> samples;
    SlidingState state;
    while (samples.size() < sampleTimes.size())
    {
        const double target = sampleTimes[samples.size()];
        if (state.time >= target)
        {
            samples.push_back(state);
            continue;
        }
        if (side == 0)
        {
            state.time = firstTimeAbove(ground, strength, state.time, target);
            if (state.time < target)
            {
                side = -std::copysign(1.0, ground.at(state.time));
            }
            continue;
        }
        const auto next = std::upper_bound(kinks.begin(), kinks.end(), state.time);
        pieceEnd = next == kinks.end() ? HUGE_VAL : *next;
        const EventOutcome outcome = integrateToEvent(
            problem, state.time, {state.displacement, state.velocity}, std::min(pieceEnd, target));
        state = {outcome.time, outcome.state[0], outcome.state[1]};
        if (outcome.happened)
        {
            state.velocity = 0;
            side = 0;
        }
    }
    return samples;
}

double bouncingTime(double height, double restitution, double gravity)
{
    if (!(restitution >= 0 && restitution < 1))
    {
        throw std::domain_error("a restitution from which a bounce comes to rest is at least 0 and below 1");
    }
    // the fall, and then hops that last 2 e, 2 e^2, 2 e^3 ... falls
    return std::sqrt(2 * height / gravity) * (1 + restitution) / (1 - restitution);
}

double bouncingHeight(double height, double restitution, double time, double gravity)
{
    if (time >= bouncingTime(height, restitution, gravity))
    {
        return 0;
    }
    // as if thrown up at -fall: each hop is shorter than the one before by the restitution
    double fall = std::sqrt(2 * height / gravity);
    double since = time + fall;
    while (since > 2 * fall)
    {
        since -= 2 * fall;
        fall *= restitution;
    }
    return 0.5 * gravity * since * (2 * fall - since);
}

} // namespace drystone
