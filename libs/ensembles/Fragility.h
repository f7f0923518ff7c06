// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Fragility curves: P(failure | intensity x) = Phi(ln(x/theta)/beta), by maximum likelihood (Baker 2015,
/// Efficient analytical fragility function fitting using dynamic structural analysis).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace drystone
{

/// Runs at one intensity.
struct Stripe
{
    double intensity = 0; ///< above 0
    long runs = 0;
    long exceeded = 0; ///< of them
};

/// Median and dispersion, with the standard errors of their logarithms, from the observed information.
struct FragilityFit
{
    double theta = 0;
    double beta = 0;
    double logThetaError = 0;
    double logBetaError = 0;

    double probability(double intensity) const;
};

/// Structures whose intensity was raised, each a curve.
struct TruncatedCurves
{
    std::vector<double> failing;  ///< lowest intensity at which each fails that does
    std::vector<double> standing; ///< highest intensity at which each of the others was tried

    std::size_t count() const { return failing.size() + standing.size(); }
};

/// Binomial likelihood of stripes (Baker's equation 11). \return nothing where it has no maximum: no run that
/// failed lies below one that stood, or failures do not grow with the intensity
std::optional<FragilityFit> fitStripes(const std::vector<Stripe>& stripes);

/// Likelihood of intensities at which structures failed, and of others that stood at the highest one at which
/// they were tried (Baker's equation 6, where that is one for all). \param failing intensities, above 0
/// \param standing highest intensity of each that stood. \return nothing where it has no maximum: none
/// failed, or all at one intensity and none stood
std::optional<FragilityFit> fitTruncated(const std::vector<double>& failing,
                                         const std::vector<double>& standing);

/// Each run of a stripe drawn again with replacement; where a stripe is one run, which drawn again is always
/// itself, as many runs as there are from those of all stripes, as pairs of intensity and outcome (Efron &
/// Tibshirani 1993, section 9.5). \param replicate number of the drawing
std::vector<Stripe> resampled(const std::vector<Stripe>& stripes, std::uint64_t seed,
                              std::uint32_t replicate);

/// As many curves as there are, each one of them by chance. \param replicate likewise
TruncatedCurves resampled(const TruncatedCurves& curves, std::uint64_t seed, std::uint32_t replicate);

/// The part of the curves that have failed up to each intensity at which some do, where others were not tried
/// as far (Kaplan & Meier 1958). \return pairs of intensity and part, ascending
std::vector<std::pair<double, double>> failedParts(TruncatedCurves curves);

} // namespace drystone
