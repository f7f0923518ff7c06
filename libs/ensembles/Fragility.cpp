// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Newton's method on two concave likelihoods.
#include "ensembles/Fragility.h"

#include "ensembles/Distribution.h"
#include "ensembles/Philox.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace drystone
{
namespace
{

/// ln Phi(x), also far on the left.
double logProbability(double x)
{
    if (x > -30)
    {
        return std::log(0.5 * std::erfc(-x / std::sqrt(2.0)));
    }
    return -x * x / 2 - std::log(-x * std::sqrt(2 * std::numbers::pi)) - 1 / (x * x);
}

/// phi(x)/Phi(x), the derivative of ln Phi(x). That derivative's own is -r (r + x).
double millsRatio(double x)
{
    return std::exp(-x * x / 2 - logProbability(x)) / std::sqrt(2 * std::numbers::pi);
}

/// Value, gradient and curvature of a concave function of two parameters.
struct Likelihood
{
    double value = 0;
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();

    /// ln Phi(sign (direction . parameters)), `count` times.
    void addProbability(double count, double sign, const Eigen::Vector2d& direction,
                        const Eigen::Vector2d& at)
    {
        if (count == 0)
        {
            return;
        }
        const double x = sign * direction.dot(at);
        const double ratio = millsRatio(x);
        value += count * logProbability(x);
        gradient += count * sign * ratio * direction;
        hessian -= count * ratio * (ratio + x) * direction * direction.transpose();
    }
};

using LikelihoodFunction = std::function<Likelihood(const Eigen::Vector2d&)>;

/// The maximum, by Newton steps that are halved until the value grows.
/// \return nothing when it is not found, as where the function only approaches its supremum
std::optional<Eigen::Vector2d> maximum(const LikelihoodFunction& function, Eigen::Vector2d at)
{
    Likelihood here = function(at);
    for (int iteration = 0; iteration < 200; ++iteration)
    {
        const Eigen::Vector2d step = -here.hessian.ldlt().solve(here.gradient);
        if (!step.allFinite())
        {
            return {};
        }
        double share = 1;
        Likelihood next = function(at + step);
        while (!(next.value >= here.value - 1e-13 * std::abs(here.value)) && share > 1e-10)
        {
            share /= 2;
            next = function(at + share * step);
        }
        at += share * step;
        here = next;
        if ((share * step).norm() <= 1e-12 * (1 + at.norm()))
        {
            return at;
        }
        if (at.norm() > 1e8)
        {
            return {};
        }
    }
    return {};
}

/// Of the covariance of (a, b), where ln theta = -a/b and ln beta = -ln b. At a maximum the observed
/// information follows a change of parameters like a matrix of second derivatives.
FragilityFit fitOf(const Eigen::Vector2d& parameters, const Eigen::Matrix2d& hessian)
{
    const double a = parameters[0];
    const double b = parameters[1];
    Eigen::Matrix2d jacobian;
    jacobian << -1 / b, a / (b * b), 0, -1 / b;
    const Eigen::Matrix2d covariance = jacobian * (-hessian).inverse() * jacobian.transpose();
    return {std::exp(-a / b), 1 / b, std::sqrt(covariance(0, 0)), std::sqrt(covariance(1, 1))};
}

} // namespace

double FragilityFit::probability(double intensity) const
{
    return intensity > 0 ? normalProbability(std::log(intensity / theta) / beta) : 0;
}

std::optional<FragilityFit> fitStripes(const std::vector<Stripe>& stripes)
{
    // There is a maximum just where the runs that failed and those that stood overlap.
    double lowestFailed = std::numeric_limits<double>::infinity();
    double highestStanding = 0;
    double highestFailed = 0;
    double lowestStanding = lowestFailed;
    for (const Stripe& stripe : stripes)
    {
        if (stripe.exceeded > 0)
        {
            lowestFailed = std::min(lowestFailed, stripe.intensity);
            highestFailed = std::max(highestFailed, stripe.intensity);
        }
        if (stripe.exceeded < stripe.runs)
        {
            highestStanding = std::max(highestStanding, stripe.intensity);
            lowestStanding = std::min(lowestStanding, stripe.intensity);
        }
    }
    if (!(lowestFailed < highestStanding) || !(lowestStanding < highestFailed))
    {
        return {};
    }
    const LikelihoodFunction likelihood = [&](const Eigen::Vector2d& at)
    {
        Likelihood sum;
        for (const Stripe& stripe : stripes)
        {
            const Eigen::Vector2d direction(1, std::log(stripe.intensity));
            sum.addProbability(static_cast<double>(stripe.exceeded), 1, direction, at);
            sum.addProbability(static_cast<double>(stripe.runs - stripe.exceeded), -1, direction, at);
        }
        return sum;
    };
    // Where all stripes have failed in the same part the slope 1/beta is zero but for rounding, and theta
    // anything.
    constexpr double leastSlope = 1e-6;
    const std::optional<Eigen::Vector2d> best = maximum(likelihood, Eigen::Vector2d::Zero());
    if (!best || !((*best)[1] > leastSlope))
    {
        return {};
    }
    return fitOf(*best, likelihood(*best).hessian);
}

std::optional<FragilityFit> fitTruncated(const std::vector<double>& failing,
                                         const std::vector<double>& standing)
{
    if (failing.empty())
    {
        return {};
    }
    const auto [least, most] = std::minmax_element(failing.begin(), failing.end());
    if (standing.empty() && *least == *most)
    {
        return {};
    }
    // In a = -ln(theta)/beta and b = 1/beta: sum of ln b - (a + b ln x)^2/2 and of ln Phi(-(a + b ln s)), s
    // stood at.
    const LikelihoodFunction likelihood = [&](const Eigen::Vector2d& at)
    {
        Likelihood sum;
        const double b = at[1];
        if (!(b > 0))
        {
            sum.value = -std::numeric_limits<double>::infinity();
            return sum;
        }
        for (const double intensity : failing)
        {
            const Eigen::Vector2d direction(1, std::log(intensity));
            const double z = direction.dot(at);
            sum.value += std::log(b) - z * z / 2;
            sum.gradient += Eigen::Vector2d(0, 1 / b) - z * direction;
            sum.hessian -= direction * direction.transpose();
            sum.hessian(1, 1) -= 1 / (b * b);
        }
        for (const double intensity : standing)
        {
            sum.addProbability(1, -1, {1, std::log(intensity)}, at);
        }
        return sum;
    };
    double mean = 0;
    for (const double intensity : failing)
    {
        mean += std::log(intensity) / static_cast<double>(failing.size());
    }
    const std::optional<Eigen::Vector2d> best = maximum(likelihood, {-mean, 1});
    return best ? std::optional(fitOf(*best, likelihood(*best).hessian)) : std::nullopt;
}

namespace
{

/// As many runs as there are, each one of those of all stripes.
std::vector<Stripe> resampledRuns(const std::vector<Stripe>& stripes, std::uint64_t seed,
                                  std::uint32_t replicate)
{
    std::vector<Stripe> drawn;
    std::vector<std::pair<std::size_t, bool>> runs; // stripe, and whether it exceeded
    for (std::size_t i = 0; i < stripes.size(); ++i)
    {
        drawn.push_back({stripes[i].intensity, 0, 0});
        for (long run = 0; run < stripes[i].runs; ++run)
        {
            runs.emplace_back(i, run < stripes[i].exceeded);
        }
    }
    for (std::size_t number = 0; number < runs.size(); ++number)
    {
        const double place =
            uniform(seed, Stream::bootstrap, replicate, number) * static_cast<double>(runs.size());
        const auto& [stripe, exceeded] = runs[static_cast<std::size_t>(place)];
        ++drawn[stripe].runs;
        drawn[stripe].exceeded += exceeded;
    }
    drawn.erase(
        std::remove_if(drawn.begin(), drawn.end(), [](const Stripe& stripe) { return stripe.runs == 0; }),
        drawn.end());
    return drawn;
}

} // namespace

std::vector<Stripe> resampled(const std::vector<Stripe>& stripes, std::uint64_t seed, std::uint32_t replicate)
{
    if (std::any_of(stripes.begin(), stripes.end(), [](const Stripe& stripe) { return stripe.runs == 1; }))
    {
        return resampledRuns(stripes, seed, replicate);
    }
    std::vector<Stripe> drawn = stripes;
    std::uint64_t number = 0;
    for (Stripe& stripe : drawn)
    {
        const double part = static_cast<double>(stripe.exceeded) / static_cast<double>(stripe.runs);
        const long runs = stripe.runs;
        stripe.exceeded = 0;
        for (long run = 0; run < runs; ++run)
        {
            stripe.exceeded += uniform(seed, Stream::bootstrap, replicate, number++) < part;
        }
    }
    return drawn;
}

TruncatedCurves resampled(const TruncatedCurves& curves, std::uint64_t seed, std::uint32_t replicate)
{
    TruncatedCurves drawn;
    for (std::size_t i = 0; i < curves.count(); ++i)
    {
        const double place =
            uniform(seed, Stream::bootstrap, replicate, i) * static_cast<double>(curves.count());
        const auto chosen = static_cast<std::size_t>(place);
        if (chosen < curves.failing.size())
        {
            drawn.failing.push_back(curves.failing[chosen]);
        }
        else
        {
            drawn.standing.push_back(curves.standing[chosen - curves.failing.size()]);
        }
    }
    return drawn;
}

std::vector<std::pair<double, double>> failedParts(TruncatedCurves curves)
{
    std::sort(curves.failing.begin(), curves.failing.end());
    std::sort(curves.standing.begin(), curves.standing.end());
    std::vector<std::pair<double, double>> parts;
    double standing = 1;
    for (std::size_t i = 0; i < curves.failing.size(); ++i)
    {
        const double intensity = curves.failing[i];
        const auto triedSoFar = curves.standing.end()
                                - std::lower_bound(curves.standing.begin(), curves.standing.end(), intensity);
        const double left = static_cast<double>(curves.failing.size() - i) + static_cast<double>(triedSoFar);
        standing *= 1 - 1 / left;
        parts.emplace_back(intensity, 1 - standing);
    }
    return parts;
}

} // namespace drystone
