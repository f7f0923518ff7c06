// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Integrals in closed form, by running sums of a table, or of GSL's splines without an accelerator.
#include "timeSeries/GroundAcceleration.h"

#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_spline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace drystone
{
namespace
{

/// Of a pulse or a wave: steps of that length follow a sine to some percent of its peak.
constexpr double partOfWave = 1.0 / 20;

/// The first of ascending times after one; infinite where there is none.
template<typename Iterator>
double firstAfter(Iterator begin, Iterator end, double time)
{
    const Iterator next = std::upper_bound(begin, end, time);
    return next == end ? std::numeric_limits<double>::infinity() : *next;
}

/// \param wave within the pulse [s]
StepBounds boundsOfPulse(const PulseShape& pulse, double wave, double time)
{
    const std::array<double, 2> times{pulse.start, pulse.start + pulse.duration};
    StepBounds bounds;
    bounds.nextChange = firstAfter(times.begin(), times.end(), time);
    if (time >= times[0] && time < times[1])
    {
        bounds.longest = partOfWave * wave;
    }
    return bounds;
}

/// A time during which a table has one sign.
struct TablePulse
{
    double from = 0; ///< [s]
    double to = 0;   ///< [s]
};

/// What a table that is not sampled draws: from one jump, zero or change of sign to the next.
std::vector<TablePulse> pulsesOf(const std::vector<double>& times, std::vector<double> values)
{
    constexpr double nothing = 1e-3; // of the peak: what is left of rounding and corrections is no pulse
    double peak = 0;
    std::size_t stretches = 0;
    for (std::size_t i = 0; i < times.size(); ++i)
    {
        peak = std::max(peak, std::abs(values[i]));
        stretches += i > 0 && times[i] > times[i - 1] ? 1 : 0;
    }
    if (stretches >= fewestSamples)
    {
        return {};
    }
    for (double& value : values)
    {
        value = std::abs(value) < nothing * peak ? 0 : value;
    }
    std::vector<TablePulse> pulses;
    bool goesOn = false; // the last of them, into the next stretch
    for (std::size_t i = 0; i + 1 < times.size(); ++i)
    {
        const bool isJump = times[i + 1] == times[i];
        if (isJump || (values[i] == 0 && values[i + 1] == 0))
        {
            goesOn = false;
            continue;
        }
        if (!goesOn)
        {
            pulses.push_back({times[i], times[i]});
        }
        pulses.back().to = times[i + 1];
        goesOn = values[i + 1] != 0;
        if ((values[i] < 0) != (values[i + 1] < 0) && values[i] != 0 && goesOn)
        {
            const double zero =
                times[i]
                + (times[i + 1] - times[i]) / (1 - values[i + 1] / values[i]); // of the straight line
            pulses.back().to = zero;
            pulses.push_back({zero, times[i + 1]});
        }
    }
    return pulses;
}

/// \param firstTime, lastTime of the table, increasing; behind the last one
StepBounds boundsOfTable(const double* firstTime, const double* lastTime,
                         const std::vector<TablePulse>& pulses, double time)
{
    StepBounds bounds;
    bounds.nextChange = firstAfter(firstTime, lastTime, time);
    for (const TablePulse& pulse : pulses)
    {
        if (time >= pulse.from && time < pulse.to)
        {
            bounds.longest = partOfWave * (pulse.to - pulse.from);
        }
    }
    return bounds;
}

} // namespace

StepBounds GroundAcceleration::stepBounds(double time) const
{
    const std::vector<double> times = kinks();
    StepBounds bounds;
    bounds.nextChange = firstAfter(times.begin(), times.end(), time);
    return bounds;
}

double GroundAcceleration::end() const
{
    const std::vector<double> times = kinks();
    return times.empty() ? std::numeric_limits<double>::infinity() : times.back();
}

double ConstantAcceleration::peak() const
{
    return std::abs(value);
}

double RectangularPulse::at(double time) const
{
    return time >= pulse.start && time < pulse.start + pulse.duration ? pulse.amplitude : 0;
}

double RectangularPulse::integral(double from, double to) const
{
    const double begin = std::max(from, pulse.start);
    const double end = std::min(to, pulse.start + pulse.duration);
    return end > begin ? pulse.amplitude * (end - begin) : 0;
}

double RectangularPulse::peak() const
{
    return std::abs(pulse.amplitude);
}

StepBounds RectangularPulse::stepBounds(double time) const
{
    return boundsOfPulse(pulse, pulse.duration, time);
}

StepBounds SinePulse::stepBounds(double time) const
{
    return boundsOfPulse(pulse, std::min(1.0, 2 / halfWaves) * pulse.duration, time);
}

double SinePulse::at(double time) const
{
    if (!(time >= pulse.start && time < pulse.start + pulse.duration))
    {
        return 0;
    }
    return pulse.amplitude * std::sin(std::numbers::pi * halfWaves * (time - pulse.start) / pulse.duration);
}

double SinePulse::integral(double from, double to) const
{
    const double begin = std::max(from, pulse.start);
    const double end = std::min(to, pulse.start + pulse.duration);
    if (!(end > begin))
    {
        return 0;
    }
    // (cos w x0 - cos w x1)/w = 2/w sin(w (x0 + x1)/2) sin(w (x1 - x0)/2): exact for the shortest step too
    const double w = std::numbers::pi * halfWaves / pulse.duration;
    return pulse.amplitude * 2 / w * std::sin(w * (0.5 * (begin + end) - pulse.start))
           * std::sin(0.5 * w * (end - begin));
}

double SinePulse::peak() const
{
    const double phase = std::numbers::pi * halfWaves;
    return std::abs(pulse.amplitude) * (phase >= std::numbers::pi / 2 ? 1 : std::sin(phase));
}

namespace
{

class LinearTable final : public GroundAcceleration
{
public:
    LinearTable(std::vector<double> instants, std::vector<double> accelerations, OutOfBounds beyond)
        : times(std::move(instants)),
          values(std::move(accelerations)),
          outOfBounds(beyond),
          sums(times.size(), 0.0),
          pulses(pulsesOf(times, values))
    {
        for (std::size_t i = 1; i < times.size(); ++i)
        {
            sums[i] = sums[i - 1] + 0.5 * (values[i - 1] + values[i]) * (times[i] - times[i - 1]);
        }
    }

    double at(double time) const override
    {
        if (!(time >= times.front()))
        {
            return outOfBounds == OutOfBounds::clamp ? values.front() : 0;
        }
        if (time >= times.back())
        {
            return outOfBounds == OutOfBounds::clamp ? values.back() : 0;
        }
        return within(interval(time), time);
    }

    double integral(double from, double to) const override
    {
        if (!(to > from))
        {
            return 0;
        }
        double sum = 0;
        if (outOfBounds == OutOfBounds::clamp)
        {
            sum += values.front() * std::max(0.0, std::min(to, times.front()) - from);
            sum += values.back() * std::max(0.0, to - std::max(from, times.back()));
        }
        const double begin = std::max(from, times.front());
        const double end = std::min(to, times.back());
        if (!(end > begin))
        {
            return sum;
        }
        const std::size_t i = interval(begin);
        const std::size_t j = end >= times.back() ? times.size() - 2 : interval(end);
        if (i == j)
        {
            return sum + 0.5 * (within(i, begin) + within(i, end)) * (end - begin);
        }
        // a part, whole intervals, a part: differences of the running sum only where whole intervals lie
        // between
        sum += 0.5 * (within(i, begin) + values[i + 1]) * (times[i + 1] - begin);
        sum += sums[j] - sums[i + 1];
        sum += 0.5 * (values[j] + within(j, end)) * (end - times[j]);
        return sum;
    }

    std::vector<double> kinks() const override
    {
        std::vector<double> result = times;
        result.erase(std::unique(result.begin(), result.end()), result.end());
        return result;
    }

    StepBounds stepBounds(double time) const override
    {
        return boundsOfTable(times.data(), times.data() + times.size(), pulses, time);
    }

    double peak() const override
    {
        double largest = 0;
        for (const double value : values)
        {
            largest = std::max(largest, std::abs(value));
        }
        return largest;
    }

private:
    std::vector<double> times;
    std::vector<double> values;
    OutOfBounds outOfBounds;
    std::vector<double> sums; ///< integral from the first time to each
    std::vector<TablePulse> pulses;

    /// The interval that holds a time, which must not be before the first nor at or after the last.
    std::size_t interval(double time) const
    {
        return static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin())
               - 1;
    }

    double within(std::size_t i, double time) const
    {
        const double length = times[i + 1] - times[i];
        const double s = length > 0 ? (time - times[i]) / length : 1;
        return values[i] + s * (values[i + 1] - values[i]);
    }
};

struct FreeSpline
{
    void operator()(gsl_spline* spline) const { gsl_spline_free(spline); }
};

/// GSL's splines. Evaluated without an accelerator object, which is what keeps them shareable between
/// threads.
class SplineTable final : public GroundAcceleration
{
public:
    SplineTable(const std::vector<double>& times, const std::vector<double>& values,
                const gsl_interp_type* type, OutOfBounds beyond)
        : spline(gsl_spline_alloc(type, times.size())), outOfBounds(beyond), pulses(pulsesOf(times, values))
    {
        gsl_spline_init(spline.get(), times.data(), values.data(), times.size());
        constexpr int parts =
            16; // of an interval: a peak between them is higher by less than 0.2% of the swing
        for (std::size_t i = 0; i + 1 < times.size(); ++i)
        {
            for (int part = 0; part <= parts; ++part)
            {
                const double time =
                    std::min(times[i] + (times[i + 1] - times[i]) * part / parts, times[i + 1]);
                largest = std::max(largest, std::abs(gsl_spline_eval(spline.get(), time, nullptr)));
            }
        }
    }

    double at(double time) const override
    {
        if (!(time >= first()))
        { // NaN too: GSL would abort
            return outOfBounds == OutOfBounds::clamp ? spline->y[0] : 0;
        }
        if (time >= last())
        {
            return outOfBounds == OutOfBounds::clamp ? spline->y[spline->size - 1] : 0;
        }
        return gsl_spline_eval(spline.get(), time, nullptr);
    }

    double integral(double from, double to) const override
    {
        if (!(to > from))
        {
            return 0;
        }
        double sum = 0;
        if (outOfBounds == OutOfBounds::clamp)
        {
            sum += spline->y[0] * std::max(0.0, std::min(to, first()) - from);
            sum += spline->y[spline->size - 1] * std::max(0.0, to - std::max(from, last()));
        }
        const double begin = std::max(from, first());
        const double end = std::min(to, last());
        return end > begin ? sum + gsl_spline_eval_integ(spline.get(), begin, end, nullptr) : sum;
    }

    std::vector<double> kinks() const override { return {spline->x, spline->x + spline->size}; }

    double peak() const override { return largest; }

    StepBounds stepBounds(double time) const override
    {
        return boundsOfTable(spline->x, spline->x + spline->size, pulses, time);
    }

private:
    std::unique_ptr<gsl_spline, FreeSpline> spline;
    OutOfBounds outOfBounds;
    std::vector<TablePulse> pulses;
    double largest = 0;

    double first() const { return spline->x[0]; }
    double last() const { return spline->x[spline->size - 1]; }
};

const gsl_interp_type* splineType(Interpolation interpolation)
{
    if (interpolation == Interpolation::akima)
    {
        return gsl_interp_akima;
    }
    return interpolation == Interpolation::steffen ? gsl_interp_steffen : gsl_interp_cspline;
}

} // namespace

std::unique_ptr<GroundAcceleration> tabulatedAcceleration(std::vector<double> times,
                                                          std::vector<double> accelerations,
                                                          Interpolation interpolation,
                                                          OutOfBounds outOfBounds)
{
    if (times.size() != accelerations.size() || times.empty())
    {
        throw std::domain_error("a table of accelerations has one value a time, and at least one");
    }
    for (std::size_t i = 0; i < times.size(); ++i)
    {
        if (!std::isfinite(times[i]) || !std::isfinite(accelerations[i]))
        {
            throw std::domain_error("a table of accelerations holds a number that is not finite");
        }
        const bool jump = i > 0 && times[i] == times[i - 1];
        if (jump && interpolation != Interpolation::linear)
        {
            throw std::domain_error(fmt::format(
                "the table jumps at {:g} s, where two values stand, and smooth interpolation needs "
                "one value a time; choose `interpolation linear;`, or move one of the two",
                times[i]));
        }
        if (i > 0 && times[i] < times[i - 1])
        {
            throw std::domain_error("the times of a table of accelerations must increase");
        }
    }
    if (times.size() == 1) // one value, held (clamp) or of no effect (zero)
    {
        const double value = outOfBounds == OutOfBounds::clamp ? accelerations.front() : 0;
        return std::make_unique<ConstantAcceleration>(value);
    }
    if (interpolation == Interpolation::linear)
    {
        return std::make_unique<LinearTable>(std::move(times), std::move(accelerations), outOfBounds);
    }
    const gsl_interp_type* type = splineType(interpolation);
    if (times.size() < type->min_size)
    {
        throw std::domain_error(fmt::format(
            "this interpolation needs {} points or more, and the table has {}; use `interpolation "
            "linear;`",
            type->min_size, times.size()));
    }
    return std::make_unique<SplineTable>(times, accelerations, type, outOfBounds);
}

} // namespace drystone
