// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "ensembles/NatafCorrelation.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace drystone
{
namespace
{

/// Coefficients of a function of a standard normal variable in normalised Hermite polynomials.
std::vector<double> hermiteCoefficients(const Distribution& distribution)
{
    // The trapezium rule converges faster than any power for a smooth function times the normal density.
    constexpr int points = 4001;
    constexpr double end = 8.2;
    constexpr std::size_t terms = 60;
    std::vector<double> coefficients(terms, 0.0);
    const double step = 2 * end / (points - 1);
    for (int i = 0; i < points; ++i)
    {
        const double z = -end + step * i;
        const double probability = std::clamp(normalProbability(z), 1e-16, 1 - 0x1p-53);
        const double weight = step * std::exp(-z * z / 2) / std::sqrt(2 * M_PI);
        const double value = weight * valueAt(distribution, probability).number;
        double before = 0;
        double polynomial = 1; // h(n+1) sqrt(n+1) = z h(n) - sqrt(n) h(n-1)
        for (std::size_t n = 0; n < terms; ++n)
        {
            coefficients[n] += value * polynomial;
            const double next = (z * polynomial - std::sqrt(static_cast<double>(n)) * before)
                                / std::sqrt(static_cast<double>(n + 1));
            before = polynomial;
            polynomial = next;
        }
    }
    return coefficients;
}

} // namespace

std::optional<double> natafCorrelation(const Distribution& first, const Distribution& second, double wanted)
{
    const std::vector<double> a = hermiteCoefficients(first);
    const std::vector<double> b = hermiteCoefficients(second);
    double varianceA = 0;
    double varianceB = 0;
    for (std::size_t n = 1; n < a.size(); ++n)
    {
        varianceA += a[n] * a[n];
        varianceB += b[n] * b[n];
    }
    // Mehler's formula: the correlation is a power series of that of the normal variables.
    const auto correlation = [&](double rho)
    {
        double sum = 0;
        double power = 1;
        for (std::size_t n = 1; n < a.size(); ++n)
        {
            power *= rho;
            sum += a[n] * b[n] * power;
        }
        return sum / std::sqrt(varianceA * varianceB);
    };
    double low = -0.9999;
    double high = 0.9999;
    if (!(correlation(low) <= wanted && wanted <= correlation(high)))
    {
        return {};
    }
    while (high - low > 1e-13)
    {
        const double middle = (low + high) / 2;
        (correlation(middle) > wanted ? high : low) = middle;
    }
    return (low + high) / 2;
}

} // namespace drystone
