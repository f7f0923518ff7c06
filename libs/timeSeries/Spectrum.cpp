// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The oscillator's exponential by its series, which loses no digits in short steps; GSL's fast transform.
#include "timeSeries/Spectrum.h"

#include <Eigen/Core>
#include <gsl/gsl_fft_real.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace drystone
{

namespace
{

/// Exact propagation of an oscillator over a time h: (u, u', a, slope of a) at its end from the same at its
/// start.
///
/// The acceleration is linear in time, so that it and the oscillator u'' + 2 z w u' + w^2 u = -a are one
/// linear system with constant coefficients, y' = M y, whose solution exp(M h) holds the recurrence of Nigam
/// & Jennings (1969), eq. 7. The series of the exponential is summed rather than their closed form: w h is at
/// most 0.16 here, so that sixteen terms reach the last digit, while the closed form loses digits as (w
/// h)^-3.
Eigen::Matrix4d propagation(double w, double z, double h)
{
    Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
    M(0, 1) = 1;
    M(1, 0) = -w * w;
    M(1, 1) = -2 * z * w;
    M(1, 2) = -1;
    M(2, 3) = 1;
    Eigen::Matrix4d sum = Eigen::Matrix4d::Identity();
    Eigen::Matrix4d term = sum;
    for (int k = 1; k <= 16; ++k)
    {
        term = term * M * (h / k);
        sum += term;
    }
    return sum;
}

double largestDisplacement(const Record& record, double period, double damping)
{
    const double w = 2 * std::numbers::pi / period;
    double largest = 0;
    double lastInterval = -1;
    Eigen::Vector4d state = Eigen::Vector4d::Zero();
    Eigen::Matrix4d step = Eigen::Matrix4d::Identity();
    const auto advance = [&](double interval, double a0, double a1)
    {
        const int parts = std::max(1, static_cast<int>(std::ceil(40 * interval / period)));
        if (interval != lastInterval)
        {
            step = propagation(w, damping, interval / parts);
        }
        lastInterval = interval;
        state(2) = a0;
        state(3) = (a1 - a0) / interval;
        for (int part = 0; part < parts; ++part)
        {
            state = step * state;
            largest = std::max(largest, std::abs(state(0)));
        }
    };
    for (std::size_t i = 0; i + 1 < record.times.size(); ++i)
    {
        // differences of equally spaced times vary in the last digits: do not recompute the matrices for that
        double interval = record.times[i + 1] - record.times[i];
        if (std::abs(interval - lastInterval) < 1e-9 * interval)
        {
            interval = lastInterval;
        }
        advance(interval, record.accelerations[i], record.accelerations[i + 1]);
    }
    advance(period, 0, 0);
    return largest;
}

} // namespace

ResponseSpectrum responseSpectrum(const Record& record, const std::vector<double>& periods,
                                  double dampingRatio)
{
    if (!(dampingRatio >= 0 && dampingRatio < 1))
    {
        throw std::domain_error("the damping ratio of a response spectrum is at least 0 and below 1");
    }
    ResponseSpectrum spectrum;
    spectrum.dampingRatio = dampingRatio;
    spectrum.periods = periods;
    for (const double period : periods)
    {
        if (!(period >= 0))
        {
            throw std::domain_error("a period of a response spectrum cannot be negative");
        }
        if (period == 0)
        {
            spectrum.displacements.push_back(0);
            spectrum.pseudoVelocities.push_back(0);
            spectrum.pseudoAccelerations.push_back(figures(record).peakAcceleration);
            continue;
        }
        const double displacement = largestDisplacement(record, period, dampingRatio);
        const double w = 2 * std::numbers::pi / period;
        spectrum.displacements.push_back(displacement);
        spectrum.pseudoVelocities.push_back(w * displacement);
        spectrum.pseudoAccelerations.push_back(w * w * displacement);
    }
    return spectrum;
}

FourierSpectrum fourierSpectrum(const Record& record)
{
    if (record.times.size() < 2)
    {
        throw std::domain_error("a Fourier spectrum needs a record of two values or more");
    }
    const double step =
        (record.times.back() - record.times.front()) / static_cast<double>(record.times.size() - 1);
    for (std::size_t i = 0; i + 1 < record.times.size(); ++i)
    {
        if (std::abs(record.times[i + 1] - record.times[i] - step) > 1e-6 * step)
        {
            throw std::domain_error("a Fourier spectrum needs equal intervals: resample the record first");
        }
    }

    std::size_t size = 2;
    while (size < record.times.size())
    {
        size *= 2;
    }
    std::vector<double> data(size, 0.0);
    std::copy(record.accelerations.begin(), record.accelerations.end(), data.begin());
    gsl_fft_real_radix2_transform(data.data(), 1, size);

    // half-complex order: real parts in 0 .. size/2, imaginary part of k in size - k
    FourierSpectrum spectrum;
    for (std::size_t k = 0; k <= size / 2; ++k)
    {
        const double imaginary = k == 0 || k == size / 2 ? 0 : data[size - k];
        spectrum.frequencies.push_back(static_cast<double>(k) / (static_cast<double>(size) * step));
        spectrum.amplitudes.push_back(step * std::hypot(data[k], imaginary));
    }
    return spectrum;
}

} // namespace drystone
