// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How the ground accelerates along one direction, as a function of time.
#pragma once

#include "timeSeries/Record.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

namespace drystone
{

/// What a history requires of steps that begin at some time; infinite where it requires nothing.
struct StepBounds
{
    double longest = std::numeric_limits<double>::infinity();    ///< that follows it [s]
    double nextChange = std::numeric_limits<double>::infinity(); ///< when it or its slope jumps next [s]

    void tighten(const StepBounds& other)
    {
        longest = std::min(longest, other.longest);
        nextChange = std::min(nextChange, other.nextChange);
    }
};

/// A table of this many stretches of time or more is sampled: its points are those of waves that they follow.
/// One of fewer draws pulses and ramps, of which each is followed.
constexpr std::size_t fewestSamples = 10;

/// An acceleration history, defined at every time and integrated exactly. Immutable, so that threads may
/// share it.
///
/// A time step needs the impulse of the ground over the step and not its acceleration at an instant: the
/// momentum that a pulse gives must not depend on where its edge falls within a step. Hence `integral`.
class GroundAcceleration
{
public:
    virtual ~GroundAcceleration() = default;

    /// [m/s2] at a time; at a jump, the value after it.
    virtual double at(double time) const = 0;

    /// Exact integral from one time to a later one [m/s].
    virtual double integral(double from, double to) const = 0;

    /// Instants at which the function or its slope jumps, increasing [s]. An integrator of high order must
    /// stop there.
    virtual std::vector<double> kinks() const = 0;

    /// Largest absolute value [m/s2].
    virtual double peak() const = 0;

    /// For steps that choose their lengths: the next of the kinks after `time`, and within pulses a twentieth
    /// of a pulse or of a wave. A table that is not sampled has pulses too: what lies between its jumps, and
    /// times at which it is or becomes zero.
    virtual StepBounds stepBounds(double time) const;

    /// When the history ends, after which it is constant; infinite when it is so from the beginning [s].
    double end() const;

    /// Mean over a step [m/s2]; the value at its beginning when the step has no length.
    double mean(double from, double to) const
    {
        return to > from ? integral(from, to) / (to - from) : at(from);
    }
};

class ConstantAcceleration final : public GroundAcceleration
{
public:
    double value = 0; ///< at all times [m/s2]

    explicit ConstantAcceleration(double acceleration) : value(acceleration) {}
    double at(double) const override { return value; }
    double integral(double from, double to) const override { return value * (to - from); }
    std::vector<double> kinks() const override { return {}; }
    double peak() const override;
};

/// What the three pulses have in common. Outside [start, start + duration) they are zero.
struct PulseShape
{
    double amplitude = 0; ///< [m/s2], negative to begin the other way
    double duration = 0;  ///< of the whole pulse, positive [s]
    double start = 0;     ///< [s]
};

/// The amplitude, from start to start + duration.
class RectangularPulse final : public GroundAcceleration
{
public:
    PulseShape pulse;

    explicit RectangularPulse(const PulseShape& shape) : pulse(shape) {}
    double at(double time) const override;
    double integral(double from, double to) const override;
    std::vector<double> kinks() const override { return {pulse.start, pulse.start + pulse.duration}; }
    double peak() const override;
    StepBounds stepBounds(double time) const override;
};

/// amplitude sin(pi halfWaves (t - start)/duration), from start to start + duration: one half wave is the
/// half-sine pulse, two are the one-sine pulse.
class SinePulse final : public GroundAcceleration
{
public:
    PulseShape pulse;
    double halfWaves = 1; ///< within the duration, positive; need not be whole

    SinePulse(const PulseShape& shape, double halfWaveCount) : pulse(shape), halfWaves(halfWaveCount) {}
    double at(double time) const override;
    double integral(double from, double to) const override;
    std::vector<double> kinks() const override { return {pulse.start, pulse.start + pulse.duration}; }
    double peak() const override;
    StepBounds stepBounds(double time) const override;
};

/// What a table says before its first and after its last time.
enum class OutOfBounds
{
    zero,
    clamp ///< the first and last values go on
};

/// Names in dictionaries.
constexpr std::array<std::pair<std::string_view, OutOfBounds>, 2> namesOf(OutOfBounds)
{
    return {{{"zero", OutOfBounds::zero}, {"clamp", OutOfBounds::clamp}}};
}

/// How a table is read between its points.
enum class Interpolation
{
    linear,
    cubic,  ///< natural cubic spline: smooth, overshoots at sudden changes
    akima,  ///< Akima's spline: less overshoot
    steffen ///< Steffen's spline: monotone between points, so that no peak is higher than the table's
};

/// Names in dictionaries.
constexpr std::array<std::pair<std::string_view, Interpolation>, 4> namesOf(Interpolation)
{
    return {{{"linear", Interpolation::linear},
             {"cubic", Interpolation::cubic},
             {"akima", Interpolation::akima},
             {"steffen", Interpolation::steffen}}};
}

/// An acceleration given at instants. Times must not decrease; with linear interpolation a time may stand
/// twice, and the function jumps there. \throws std::domain_error when the sizes differ, a number is not
/// finite, times decrease, or there are fewer points
///         than the interpolation needs (1 linear, 3 cubic and steffen, 5 akima)
std::unique_ptr<GroundAcceleration> tabulatedAcceleration(std::vector<double> times,
                                                          std::vector<double> accelerations,
                                                          Interpolation interpolation,
                                                          OutOfBounds outOfBounds);

} // namespace drystone
