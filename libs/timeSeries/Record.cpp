// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What can be done with a record, and its figures. The readers are in PeerRecord.cpp and CsvRecord.cpp.
#include "timeSeries/Record.h"

#include "core/Bisection.h"

#include <gsl/gsl_multifit.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace drystone
{

namespace
{

double largestAbsolute(const std::vector<double>& values)
{
    double largest = 0;
    for (const double value : values)
    {
        largest = std::max(largest, std::abs(value));
    }
    return largest;
}

/// Roots in (0, 1) of the velocity within an interval: v0 + h (a0 s + (a1 - a0) s^2 / 2) = 0, s the fraction
/// of it.
std::vector<double> standstills(double v0, double h, double a0, double a1)
{
    const double a = 0.5 * h * (a1 - a0);
    const double b = h * a0;
    std::vector<double> roots;
    const double discriminant = b * b - 4 * a * v0;
    if (discriminant < 0)
    {
        return roots;
    }
    // the root that does not cancel first, the other one from their product
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    if (a != 0)
    {
        roots.push_back(q / a);
    }
    if (q != 0)
    {
        roots.push_back(v0 / q);
    }
    std::erase_if(roots, [](double s) { return !(s > 0 && s < 1); });
    return roots;
}

/// Integral of the squared acceleration over the first fraction s of an interval of length h.
double squareIntegral(double h, double a0, double a1, double s)
{
    const double end = a0 + (a1 - a0) * s;
    return h * s * (a0 * a0 + a0 * end + end * end) / 3;
}

/// Time at which the integral of the squared acceleration reaches a value.
double timeOfSquareIntegral(const Record& record, double target)
{
    double sum = 0;
    for (std::size_t i = 0; i + 1 < record.times.size(); ++i)
    {
        const double h = record.times[i + 1] - record.times[i];
        const double a0 = record.accelerations[i];
        const double a1 = record.accelerations[i + 1];
        const double whole = squareIntegral(h, a0, a1, 1);
        if (sum + whole >= target)
        {
            constexpr int halvings = 60;
            const auto isBefore = [&](double part) { return sum + squareIntegral(h, a0, a1, part) < target; };
            return record.times[i] + bisected(0, 1, isBefore, halvings) * h; // a monotone cubic
        }
        sum += whole;
    }
    return record.times.empty() ? 0 : record.times.back();
}

struct FreeFit
{
    void operator()(gsl_matrix* object) const { gsl_matrix_free(object); }
    void operator()(gsl_vector* object) const { gsl_vector_free(object); }
    void operator()(gsl_multifit_linear_workspace* object) const { gsl_multifit_linear_free(object); }
};

} // namespace

double acceleration(const Record& record, double time)
{
    const auto& times = record.times;
    if (times.empty() || !(time >= times.front() && time <= times.back()))
    {
        return 0;
    }
    const auto next = std::upper_bound(times.begin(), times.end(), time);
    if (next == times.end())
    {
        return record.accelerations.back();
    }
    const std::size_t i = static_cast<std::size_t>(next - times.begin()) - 1;
    const double s = (time - times[i]) / (times[i + 1] - times[i]);
    return record.accelerations[i] + s * (record.accelerations[i + 1] - record.accelerations[i]);
}

Record scaled(Record record, double factor)
{
    for (double& value : record.accelerations)
    {
        value *= factor;
    }
    return record;
}

Record scaledToPeak(Record record, double peak)
{
    const double own = largestAbsolute(record.accelerations);
    if (own == 0)
    {
        throw std::domain_error(
            "a record that is zero throughout cannot be scaled to a peak acceleration; correct the "
            "file, or remove peakAcceleration");
    }
    return scaled(std::move(record), peak / own);
}

Record padded(const Record& record, double before, double after)
{
    if (!(before >= 0 && after >= 0))
    {
        throw std::domain_error("the stillness before and after a record cannot be negative");
    }
    if (before == 0 && after == 0)
    {
        return record;
    }
    if (record.times.size() < 2)
    {
        throw std::domain_error("a record of fewer than two values cannot be padded");
    }
    Record result = record;
    auto& times = result.times;
    auto& values = result.accelerations;
    if (after > 0)
    {
        const double last = times.back();
        const double ramp = values.back() != 0 ? last - times[times.size() - 2] : 0;
        if (ramp > 0)
        {
            times.push_back(last + ramp);
            values.push_back(0);
        }
        times.push_back(last + ramp + after);
        values.push_back(0);
    }
    if (before > 0)
    {
        const double first = times.front();
        const double ramp = values.front() != 0 ? times[1] - first : 0;
        for (double& time : times)
        {
            time += before + ramp;
        }
        if (ramp > 0)
        {
            times.insert(times.begin(), first + before);
            values.insert(values.begin(), 0);
        }
        times.insert(times.begin(), first);
        values.insert(values.begin(), 0);
    }
    return result;
}

Record resampled(const Record& record, double timeStep)
{
    if (!(timeStep > 0) || record.times.empty())
    {
        throw std::domain_error("a record is resampled at a positive time step, and has at least one value");
    }
    Record result = record;
    const double length = record.times.back() - record.times.front();
    // a last interval that is whole but for rounding counts as whole
    const auto count = static_cast<std::size_t>(std::floor(length / timeStep * (1 + 1e-12))) + 1;
    result.times.resize(count);
    result.accelerations.resize(count);
    for (std::size_t i = 0; i < count; ++i)
    {
        result.times[i] = record.times.front() + static_cast<double>(i) * timeStep;
        result.accelerations[i] = acceleration(record, std::min(result.times[i], record.times.back()));
    }
    return result;
}

Record baselineCorrected(Record record, Baseline baseline)
{
    if (baseline == Baseline::none)
    {
        return record;
    }
    const std::size_t count = record.times.size();
    const std::size_t coefficients = static_cast<std::size_t>(baseline);
    if (count < coefficients)
    {
        throw std::domain_error("a record has fewer values than its baseline has coefficients");
    }

    // times mapped to [-1, 1], where the powers are far from parallel and the fit is well conditioned
    const double middle = 0.5 * (record.times.front() + record.times.back());
    const double half = std::max(0.5 * (record.times.back() - record.times.front()), 1e-300);
    const std::unique_ptr<gsl_matrix, FreeFit> powers(gsl_matrix_alloc(count, coefficients));
    for (std::size_t i = 0; i < count; ++i)
    {
        const double s = (record.times[i] - middle) / half;
        double power = 1;
        for (std::size_t j = 0; j < coefficients; ++j, power *= s)
        {
            gsl_matrix_set(powers.get(), i, j, power);
        }
    }
    const auto values = gsl_vector_view_array(record.accelerations.data(), count);
    const std::unique_ptr<gsl_vector, FreeFit> fit(gsl_vector_alloc(coefficients));
    const std::unique_ptr<gsl_matrix, FreeFit> covariance(gsl_matrix_alloc(coefficients, coefficients));
    const std::unique_ptr<gsl_multifit_linear_workspace, FreeFit> workspace(
        gsl_multifit_linear_alloc(count, coefficients));
    double squares = 0;
    gsl_multifit_linear(powers.get(), &values.vector, fit.get(), covariance.get(), &squares, workspace.get());

    for (std::size_t i = 0; i < count; ++i)
    {
        for (std::size_t j = 0; j < coefficients; ++j)
        {
            record.accelerations[i] -= gsl_matrix_get(powers.get(), i, j) * gsl_vector_get(fit.get(), j);
        }
    }
    return record;
}

RecordFigures figures(const Record& record)
{
    RecordFigures result;
    if (record.times.empty())
    {
        return result;
    }
    result.peakAcceleration = largestAbsolute(record.accelerations);
    result.duration = record.times.back() - record.times.front();

    double velocity = 0;
    double displacement = 0;
    double squares = 0;
    for (std::size_t i = 0; i + 1 < record.times.size(); ++i)
    {
        const double h = record.times[i + 1] - record.times[i];
        const double a0 = record.accelerations[i];
        const double a1 = record.accelerations[i + 1];
        // at the fraction s of the interval, from a(s) = a0 + (a1 - a0) s integrated once and twice
        const auto velocityAt = [&](double s) { return velocity + h * s * (a0 + 0.5 * s * (a1 - a0)); };
        const auto displacementAt = [&](double s)
        { return displacement + h * s * velocity + h * h * s * s * (0.5 * a0 + s * (a1 - a0) / 6); };

        if (a0 * a1 < 0)
        { // the velocity is extreme where the acceleration is zero
            result.peakVelocity = std::max(result.peakVelocity, std::abs(velocityAt(a0 / (a0 - a1))));
        }
        for (const double s : standstills(velocity, h, a0, a1))
        {
            result.peakDisplacement = std::max(result.peakDisplacement, std::abs(displacementAt(s)));
        }
        squares += squareIntegral(h, a0, a1, 1);

        const double endDisplacement = displacementAt(1);
        velocity = velocityAt(1);
        displacement = endDisplacement;
        result.peakVelocity = std::max(result.peakVelocity, std::abs(velocity));
        result.peakDisplacement = std::max(result.peakDisplacement, std::abs(displacement));
    }
    result.ariasIntensity = std::numbers::pi / (2 * standardGravity) * squares;
    if (squares > 0)
    {
        result.significantDuration =
            timeOfSquareIntegral(record, 0.95 * squares) - timeOfSquareIntegral(record, 0.05 * squares);
    }
    return result;
}

} // namespace drystone
