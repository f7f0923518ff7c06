// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What is done with records once they are read: scaling, padding, baselines, figures, spectra.
#include "timeSeries/Record.h"
#include "timeSeries/Spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace drystone;

namespace
{

Record sampled(double (*function)(double), double timeStep, int count)
{
    Record record;
    for (int i = 0; i < count; ++i)
    {
        record.times.push_back(i * timeStep);
        record.accelerations.push_back(function(i * timeStep));
    }
    return record;
}

} // namespace

TEST(Record, FiguresOfATriangleAreThoseOfItsIntegrals)
{
    // 0 -> 2 -> 0 -> -2 -> 0: velocity rises to 2 m/s and returns to zero; the ground ends 4 m away
    Record record;
    record.times = {0, 1, 2, 3, 4};
    record.accelerations = {0, 2, 0, -2, 0};
    const RecordFigures f = figures(record);
    EXPECT_EQ(f.peakAcceleration, 2);
    EXPECT_DOUBLE_EQ(f.peakVelocity, 2);
    EXPECT_DOUBLE_EQ(f.peakDisplacement, 4);
    EXPECT_EQ(f.duration, 4);
    EXPECT_DOUBLE_EQ(f.ariasIntensity, std::numbers::pi / (2 * standardGravity) * 4 * 4 / 3.0);
    // 5% of 16/3 m2/s3: 4 t^3/3 = 0.8/3
    EXPECT_NEAR(f.significantDuration, 4 - 2 * std::cbrt(0.2), 1e-12);
}

TEST(Record, PeakVelocityAndDisplacementBetweenSamplesCount)
{
    Record record; // crosses zero at 0.75 with 0.375 m/s; the velocity is zero again at 1.5
    record.times = {0, 2};
    record.accelerations = {1, -5.0 / 3};
    const RecordFigures f = figures(record);
    EXPECT_NEAR(f.peakVelocity, std::max(0.375, std::abs(2 - 8.0 / 3)), 1e-12);
    record.times.back() = 1.6;
    record.accelerations.back() = 1 - 1.6 * 4 / 3;
    const RecordFigures shorter = figures(record);
    EXPECT_NEAR(shorter.peakVelocity, 0.375, 1e-12);
    EXPECT_NEAR(shorter.peakDisplacement, 1.5 * 1.5 / 2 - 1.5 * 1.5 * 1.5 * 4 / 18, 1e-12);
}

TEST(Record, ScalesByFactorOrToAPeak)
{
    Record record;
    record.times = {0, 1};
    record.accelerations = {1, -4};
    EXPECT_EQ(scaled(record, -0.5).accelerations, (std::vector<double>{-0.5, 2}));
    EXPECT_EQ(scaledToPeak(record, 2).accelerations, (std::vector<double>{0.5, -2}));
    record.accelerations = {0, 0};
    EXPECT_THROW(scaledToPeak(record, 2), std::domain_error);
}

TEST(Record, PaddingAddsStillnessAndKeepsTheMotion)
{
    Record record;
    record.times = {0, 0.5, 1};
    record.accelerations = {1, -4, 2};
    const Record longer = padded(record, 2, 3);
    EXPECT_EQ(longer.times, (std::vector<double>{0, 2, 2.5, 3, 3.5, 4, 7}));
    EXPECT_EQ(longer.accelerations, (std::vector<double>{0, 0, 1, -4, 2, 0, 0}));
    record.accelerations = {0, 1, 0};
    EXPECT_EQ(padded(record, 2, 3).times, (std::vector<double>{0, 2, 2.5, 3, 6}));
    EXPECT_THROW(padded(record, -1, 0), std::domain_error);
}

TEST(Record, ResamplingIsLinear)
{
    Record record;
    record.times = {0, 0.3, 1};
    record.accelerations = {0, 3, -4};
    const Record even = resampled(record, 0.1);
    ASSERT_EQ(even.times.size(), 11u);
    EXPECT_NEAR(even.accelerations[1], 1, 1e-14);
    EXPECT_NEAR(even.accelerations[5], 1, 1e-14);
    EXPECT_NEAR(even.accelerations[10], -4, 1e-14);
}

TEST(Record, BaselineCorrectionTakesAwayWhatItNamesAndNothingElse)
{
    const auto drift = [](double t) { return 0.3 - 0.2 * t + 0.01 * t * t; };
    const Record record = sampled(drift, 0.01, 2001);
    for (const double value : baselineCorrected(record, Baseline::quadratic).accelerations)
    {
        EXPECT_NEAR(value, 0, 1e-13);
    }
    EXPECT_EQ(baselineCorrected(record, Baseline::none).accelerations, record.accelerations);
    // what is left of a parabola after a straight line is fitted over [0, 20]: 0.01 ((t - 10)^2 - 100/3)
    // nearly
    const Record left = baselineCorrected(record, Baseline::linear);
    EXPECT_NEAR(left.accelerations[1000], -1.0 / 3, 1e-3);
    double mean = 0;
    for (const double value : baselineCorrected(record, Baseline::constant).accelerations)
    {
        mean += value / 2001;
    }
    EXPECT_NEAR(mean, 0, 1e-14);
}

TEST(ResponseSpectrum, SuddenAccelerationDoublesTheStaticDisplacement)
{
    Record step;
    step.times = {0, 10};
    step.accelerations = {3, 3};
    const ResponseSpectrum spectrum = responseSpectrum(step, {0, 0.2, 1, 4}, 0);
    EXPECT_EQ(spectrum.pseudoAccelerations[0], 3);
    for (std::size_t i = 1; i < 4; ++i)
    {
        EXPECT_NEAR(spectrum.pseudoAccelerations[i], 6, 1e-9);
    }
}

TEST(ResponseSpectrum, DampingReducesTheOvershootAsInTheClosedForm)
{
    Record step;
    step.times = {0, 30};
    step.accelerations = {1, 1};
    for (const double z : {0.02, 0.05, 0.2, 0.7})
    {
        const double overshoot = std::exp(-z * std::numbers::pi / std::sqrt(1 - z * z));
        // the peak lies between two of at least forty points a period
        EXPECT_NEAR(responseSpectrum(step, {1.3}, z).pseudoAccelerations[0], 1 + overshoot, 4e-3);
    }
}

TEST(ResponseSpectrum, ResonanceGrowsLinearly)
{
    // undamped, driven at its own frequency from rest: u = -(a/(2 w^2)) (sin wt - wt cos wt)
    const double w = 2 * std::numbers::pi;
    const Record record = sampled([](double t) { return std::sin(2 * std::numbers::pi * t); }, 0.001, 10001);
    EXPECT_NEAR(responseSpectrum(record, {1}, 0).displacements[0], 10 * std::numbers::pi / (w * w), 1e-4);
}

TEST(ResponseSpectrum, SoftOscillatorStaysBehindByTheWholeGroundDisplacement)
{
    Record record;
    record.times = {0, 1, 2, 3, 4};
    record.accelerations = {0, 2, 0, -2, 0};
    EXPECT_NEAR(responseSpectrum(record, {1e4}, 0).displacements[0] / 4, 1, 1e-2);
}

TEST(ResponseSpectrum, UnevenIntervalsOfTheSameMotionGiveTheSame)
{
    Record record;
    record.times = {0, 1, 2, 3, 4};
    record.accelerations = {0, 2, 0, -2, 0};
    Record uneven = record;
    uneven.times.insert(uneven.times.begin() + 1, 0.3);
    uneven.accelerations.insert(uneven.accelerations.begin() + 1, 0.6);
    EXPECT_NEAR(responseSpectrum(record, {0.8}).displacements[0],
                responseSpectrum(uneven, {0.8}).displacements[0],
                4e-3 * responseSpectrum(record, {0.8}).displacements[0]);
    EXPECT_THROW(responseSpectrum(record, {-1}), std::domain_error);
    EXPECT_THROW(responseSpectrum(record, {1}, 1), std::domain_error);
}

TEST(FourierSpectrum, AWaveStandsAtItsFrequencyWithHalfItsAmplitudeTimesItsLength)
{
    // 1024 samples of 8 whole waves
    const Record record =
        sampled([](double t) { return 3 * std::sin(2 * std::numbers::pi * 8 * t / 10.24); }, 0.01, 1024);
    const FourierSpectrum spectrum = fourierSpectrum(record);
    ASSERT_EQ(spectrum.frequencies.size(), 513u);
    EXPECT_NEAR(spectrum.frequencies[8], 8 / 10.24, 1e-12);
    EXPECT_NEAR(spectrum.amplitudes[8], 3 * 10.24 / 2, 1e-10);
    EXPECT_NEAR(spectrum.amplitudes[9], 0, 1e-10);
    EXPECT_NEAR(spectrum.frequencies.back(), 50, 1e-10);
}

TEST(FourierSpectrum, RefusesUnevenIntervals)
{
    Record record;
    record.times = {0, 1, 3};
    record.accelerations = {0, 1, 0};
    EXPECT_THROW(fourierSpectrum(record), std::domain_error);
}
