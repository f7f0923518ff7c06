// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What a record holds at each period: response and Fourier spectra.
#pragma once

#include "timeSeries/Record.h"

namespace drystone
{

/// Largest response of damped oscillators whose ground moves like a record; one entry a period.
struct ResponseSpectrum
{
    double dampingRatio = 0;
    std::vector<double> periods;             ///< [s]
    std::vector<double> displacements;       ///< largest displacement relative to the ground [m]
    std::vector<double> pseudoVelocities;    ///< circular frequency times displacement [m/s]
    std::vector<double> pseudoAccelerations; ///< circular frequency squared times displacement [m/s2]
};

/// Response spectrum by the recurrence of Nigam and Jennings (1969), which is exact for an acceleration that
/// is linear between samples. Intervals longer than a fortieth of the period are divided, so that no peak is
/// missed by more than 0.4%, and each oscillator is followed for one period after the end of the record. At
/// period 0 the oscillator is rigid and its pseudo-acceleration is the peak acceleration of the ground.
/// \throws std::domain_error when a period is negative or the damping ratio is not in [0, 1)
ResponseSpectrum responseSpectrum(const Record& record, const std::vector<double>& periods,
                                  double dampingRatio = 0.05);

/// Amplitude of the Fourier transform of a record: |integral of a(t) exp(-2 pi i f t) dt|.
struct FourierSpectrum
{
    std::vector<double> frequencies; ///< [Hz], from 0 to the Nyquist frequency
    std::vector<double> amplitudes;  ///< [m/s]
};

/// Fourier spectrum of a record with equal intervals, through the fast transform and followed by zeros up to
/// a power of two. \throws std::domain_error when the intervals are not equal: resample the record first
FourierSpectrum fourierSpectrum(const Record& record);

} // namespace drystone
