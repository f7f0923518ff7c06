// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Mehler's series of Hermite polynomials, for two step functions Plackett's formula; then bisection.
#include "ensembles/NatafCorrelation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace drystone
{
namespace
{

constexpr double largest = 0.9999; // correlation of normal variables
constexpr std::size_t terms = 60;  // of series of Hermite polynomials

double normalDensity(double z)
{
    return std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
}

/// Where a function of a normal variable jumps, and by how much.
struct Jump
{
    double at = 0;
    double by = 0;
};

/// A variable as a function of a standard normal one: smooth, or of steps.
struct NormalFunction
{
    std::vector<double> hermite; ///< coefficients in normalised Hermite polynomials
    double variance = 0;
    std::vector<Jump> jumps; ///< none of a smooth function
};

/// Calls use(n, h_n(z)) of normalised Hermite polynomials: h_n+1 sqrt(n+1) = z h_n - sqrt(n) h_n-1.
template<class Use>
void forHermitePolynomials(double z, const Use& use)
{
    double before = 0;
    double polynomial = 1;
    for (std::size_t n = 0; n < terms; ++n)
    {
        use(n, polynomial);
        const double next = (z * polynomial - std::sqrt(static_cast<double>(n)) * before)
                            / std::sqrt(static_cast<double>(n + 1));
        before = polynomial;
        polynomial = next;
    }
}

NormalFunction smoothFunction(const Distribution& distribution)
{
    // The trapezium rule converges faster than any power for a smooth function times the normal density.
    constexpr int points = 4001;
    constexpr double end = 8.2;
    const double step = 2 * end / (points - 1);
    NormalFunction function{std::vector<double>(terms, 0.0), 0, {}};
    for (int i = 0; i < points; ++i)
    {
        const double z = -end + step * i;
        const double probability = std::clamp(normalProbability(z), 1e-16, 1 - 0x1p-53);
        const double value = step * normalDensity(z) * valueAt(distribution, probability).number;
        forHermitePolynomials(z, [&](std::size_t n, double polynomial)
                              { function.hermite[n] += value * polynomial; });
    }
    for (std::size_t n = 1; n < terms; ++n)
    {
        function.variance += function.hermite[n] * function.hermite[n];
    }
    return function;
}

/// Of steps the Hermite coefficients are known, the integral of h_n phi from a being phi(a) h_n-1(a)/sqrt(n);
/// but their sum of squares comes near the variance as slowly as 1/sqrt(n).
NormalFunction stepFunction(const Distribution& distribution)
{
    NormalFunction function{std::vector<double>(terms, 0.0), 0, {}};
    double mean = 0;
    double before = 0;
    for (std::size_t i = 0; i < distribution.choices.size(); ++i)
    {
        mean += (distribution.cumulative[i] - before) * distribution.choices[i].number;
        before = distribution.cumulative[i];
    }
    before = 0;
    for (std::size_t i = 0; i < distribution.choices.size(); ++i)
    {
        const double value = distribution.choices[i].number;
        function.variance += (distribution.cumulative[i] - before) * std::pow(value - mean, 2);
        before = distribution.cumulative[i];
        if (i + 1 < distribution.choices.size() && before > 0 && before < 1)
        {
            function.jumps.push_back({normalQuantile(before), distribution.choices[i + 1].number - value});
        }
    }
    for (const Jump& jump : function.jumps)
    {
        const double density = normalDensity(jump.at);
        forHermitePolynomials(jump.at,
                              [&](std::size_t n, double polynomial)
                              {
                                  if (n + 1 < terms)
                                  {
                                      function.hermite[n + 1] += jump.by * density * polynomial
                                                                 / std::sqrt(static_cast<double>(n + 1));
                                  }
                              });
    }
    return function;
}

/// Mehler's formula: the covariance is a power series of the correlation of the normal variables, which ends
/// soon if one of the functions is smooth.
double covarianceBySeries(const NormalFunction& first, const NormalFunction& second, double rho)
{
    double sum = 0;
    double power = 1;
    for (std::size_t n = 1; n < terms; ++n)
    {
        power *= rho;
        sum += first.hermite[n] * second.hermite[n] * power;
    }
    return sum;
}

/// Plackett's formula (1954): the derivative by rho of the probability that both are above s and t is the
/// density of both at (s, t). With rho = sin(angle) the integrand is smooth.
double covarianceOfSteps(const NormalFunction& first, const NormalFunction& second, double rho)
{
    constexpr int intervals = 200; // of Simpson's rule
    const double step = std::asin(rho) / intervals;
    double sum = 0;
    for (int i = 0; i <= intervals; ++i)
    {
        const double sine = std::sin(step * i);
        const double cosine = std::cos(step * i);
        const double weight = (i == 0 || i == intervals ? 1 : i % 2 == 1 ? 4 : 2) * step / 3;
        for (const Jump& one : first.jumps)
        {
            for (const Jump& other : second.jumps)
            {
                const double square = one.at * one.at + other.at * other.at - 2 * one.at * other.at * sine;
                sum += weight * one.by * other.by * std::exp(-square / (2 * cosine * cosine))
                       / (2 * std::numbers::pi);
            }
        }
    }
    return sum;
}

} // namespace

std::optional<double> natafCorrelation(const Distribution& first, const Distribution& second, double wanted)
{
    const auto functionOf = [](const Distribution& distribution)
    { return distribution.choices.empty() ? smoothFunction(distribution) : stepFunction(distribution); };
    const NormalFunction one = functionOf(first);
    const NormalFunction other = functionOf(second);
    const bool areSteps = !first.choices.empty() && !second.choices.empty();
    const auto correlation = [&](double rho)
    {
        return (areSteps ? covarianceOfSteps(one, other, rho) : covarianceBySeries(one, other, rho))
               / std::sqrt(one.variance * other.variance);
    };
    double low = -largest;
    double high = largest;
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
