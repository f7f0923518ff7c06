// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The registry of distributions, and those of all numbers in a range; their inverse functions are GSL's.
#include "ensembles/Distribution.h"

#include "core/Bisection.h"
#include "ensembles/DistributionTypes.h"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace drystone
{
namespace
{

using Function = std::function<double(double)>;

/// Where a distribution is cut off.
struct Limits
{
    std::optional<double> minimum;
    std::optional<double> maximum;
};

void declareLimits(Options& options, Limits& limits)
{
    options.optional("minimum", limits.minimum, "the distribution is truncated there").example("0.2");
    options.optional("maximum", limits.maximum, "likewise").example("1.2");
    options.check("minimum",
                  [&limits]
                  {
                      return limits.minimum && limits.maximum && !(*limits.minimum < *limits.maximum)
                                 ? "Between minimum and maximum there is nothing: give the lower one first."
                                 : "";
                  });
}

std::string textOf(const Limits& limits)
{
    return (limits.minimum ? fmt::format(", above {:g}", *limits.minimum) : "")
           + (limits.maximum ? fmt::format(", below {:g}", *limits.maximum) : "");
}

/// The inverse of the distribution between the limits: its probabilities are the part in between.
Function truncated(Function inverse, const Function& probability, const Limits& limits,
                   const Dictionary& dictionary)
{
    if (!limits.minimum && !limits.maximum)
    {
        return inverse;
    }
    const double lowest = limits.minimum ? probability(*limits.minimum) : 0;
    const double highest = limits.maximum ? probability(*limits.maximum) : 1;
    if (!(highest - lowest > 1e-9))
    {
        throw FatalIOError("Hardly anything of the distribution lies between minimum and maximum: its "
                           "probability there is below 1e-9.",
                           dictionary.locationOf("minimum"));
    }
    return [inverse = std::move(inverse), lowest, highest, limits](double at)
    {
        const double value = inverse(lowest + (highest - lowest) * at);
        return std::clamp(value, limits.minimum.value_or(value), limits.maximum.value_or(value));
    };
}

struct NormalSettings
{
    double mean = 0;
    double standardDeviation = 0;
    Limits limits;
};
void declare(Options& options, NormalSettings& settings)
{
    options.required("mean", settings.mean, "of the distribution without its limits").example("0.4");
    options.required("standardDeviation", settings.standardDeviation, "likewise").above(0).example("0.02");
    declareLimits(options, settings.limits);
}
Distribution makeNormal(const NormalSettings& settings, const Dictionary& dictionary)
{
    const double mean = settings.mean;
    const double deviation = settings.standardDeviation;
    Distribution made;
    made.summary =
        fmt::format("normal, mean {:g}, standard deviation {:g}{}", mean, deviation, textOf(settings.limits));
    made.inverse = truncated([=](double at) { return mean + deviation * normalQuantile(at); },
                             [=](double value) { return normalProbability((value - mean) / deviation); },
                             settings.limits, dictionary);
    return made;
}

struct LognormalSettings
{
    double median = 0;
    double beta = 0;
    Limits limits;
};
void declare(Options& options, LognormalSettings& settings)
{
    options.required("median", settings.median, "of the distribution without its limits")
        .above(0)
        .example("0.65");
    options.required("beta", settings.beta, "standard deviation of the natural logarithm")
        .above(0)
        .example("0.15");
    declareLimits(options, settings.limits);
    options.check("maximum",
                  [&settings]
                  {
                      return settings.limits.maximum && !(*settings.limits.maximum > 0)
                                 ? "A lognormal distribution is above 0."
                                 : "";
                  });
}
Distribution makeLognormal(const LognormalSettings& settings, const Dictionary& dictionary)
{
    const double median = settings.median;
    const double beta = settings.beta;
    Distribution made;
    made.summary = fmt::format("lognormal, median {:g}, beta {:g}{}", median, beta, textOf(settings.limits));
    made.inverse = truncated([=](double at) { return median * std::exp(beta * normalQuantile(at)); },
                             [=](double value)
                             { return value > 0 ? normalProbability(std::log(value / median) / beta) : 0; },
                             settings.limits, dictionary);
    return made;
}

struct UniformSettings
{
    double minimum = 0;
    double maximum = 1;
};
void declare(Options& options, UniformSettings& settings)
{
    options.required("minimum", settings.minimum, "smallest value").example("0.35");
    options.required("maximum", settings.maximum, "largest value").example("0.45");
    options.check("maximum",
                  [&settings]
                  {
                      return settings.minimum < settings.maximum
                                 ? ""
                                 : "Between minimum and maximum there is nothing: give the lower one first.";
                  });
}
Distribution makeUniform(const UniformSettings& settings)
{
    Distribution made;
    made.summary = fmt::format("uniform from {:g} to {:g}", settings.minimum, settings.maximum);
    made.inverse = [settings](double at)
    { return settings.minimum + (settings.maximum - settings.minimum) * at; };
    return made;
}

struct BetaSettings
{
    double alpha = 1;
    double beta = 1;
    UniformSettings range;
};
void declare(Options& options, BetaSettings& settings)
{
    options.required("alpha", settings.alpha, "first shape parameter").above(0).example("2");
    options.required("beta", settings.beta, "second shape parameter").above(0).example("3");
    options.check(
        "alpha",
        [&settings]
        {
            const double mean = settings.alpha / (settings.alpha + settings.beta);
            return std::isfinite(gsl_cdf_beta_P(mean, settings.alpha, settings.beta))
                       ? ""
                       : "The distribution is too narrow for its probabilities: take `type normal;` "
                         "with its mean and standard deviation.";
        });
    declare(options, settings.range);
}
/// Without GSL's inverse, which does not converge where the distribution is narrow, or nearly all at its
/// ends.
double betaQuantile(double probability, double alpha, double beta)
{
    const auto isBelow = [=](double value)
    {
        return probability < 0.5 ? gsl_cdf_beta_P(value, alpha, beta) < probability
                                 : gsl_cdf_beta_Q(value, alpha, beta) > 1 - probability;
    };
    return bisected(0, 1, isBelow);
}

Distribution makeBeta(const BetaSettings& settings)
{
    Distribution made;
    made.summary = fmt::format("beta, alpha {:g}, beta {:g}, from {:g} to {:g}", settings.alpha,
                               settings.beta, settings.range.minimum, settings.range.maximum);
    made.inverse = [settings](double at)
    {
        return settings.range.minimum
               + (settings.range.maximum - settings.range.minimum)
                     * betaQuantile(at, settings.alpha, settings.beta);
    };
    return made;
}

struct TruncatedSettings
{
    Distribution of;
    double minimum = 0;
    double maximum = 0;
};
void declare(Options& options, TruncatedSettings& settings)
{
    options.required("of", settings.of, distributionTypes(), "the distribution without the limits");
    options.required("minimum", settings.minimum, "smallest value").example("0.2");
    options.required("maximum", settings.maximum, "largest value").example("1.2");
    options.check("maximum",
                  [&settings]
                  {
                      return settings.minimum < settings.maximum
                                 ? ""
                                 : "Between minimum and maximum there is nothing: give the lower one first.";
                  });
}
Distribution makeTruncated(const TruncatedSettings& settings, const Dictionary& dictionary)
{
    if (!settings.of.inverse)
    {
        throw FatalIOError("Only a distribution of numbers that are not listed can be truncated: normal, "
                           "lognormal, uniform or beta.",
                           dictionary.locationOf("of"));
    }
    // The probability of a value: the inverse is monotone.
    const auto probability = [inverse = settings.of.inverse](double value)
    {
        constexpr int halvings = 60; // more would change samples that exist, where truncation leaves little
        return bisected(
            0, 1, [&](double at) { return !(inverse(at) > value); }, halvings);
    };
    Distribution made;
    const Limits limits{settings.minimum, settings.maximum};
    made.summary = settings.of.summary + textOf(limits);
    made.inverse = truncated(settings.of.inverse, probability, limits, dictionary);
    return made;
}

struct SeedSettings
{
};
void declare(Options&, SeedSettings&) {}

Distribution makeSeed(const SeedSettings&)
{
    Distribution made;
    made.isSeed = true;
    made.summary = "a seed of each sample's own";
    return made;
}

} // namespace

SampleValue valueOf(double number)
{
    return {fmt::format("{}", number), number};
}

SampleValue valueOf(const std::string& word)
{
    return {word, std::nan("")};
}

SampleValue valueAt(const Distribution& distribution, double probability)
{
    if (distribution.inverse)
    {
        return valueOf(distribution.inverse(probability));
    }
    const auto chosen =
        std::upper_bound(distribution.cumulative.begin(), distribution.cumulative.end() - 1, probability);
    return distribution.choices[static_cast<std::size_t>(chosen - distribution.cumulative.begin())];
}

double normalQuantile(double probability)
{
    return gsl_cdf_ugaussian_Pinv(probability);
}

double normalProbability(double value)
{
    return gsl_cdf_ugaussian_P(value);
}

const Registry<Distribution>& distributionTypes()
{
    static const Registry<Distribution> registry{
        "distribution",
        {model<Distribution, NormalSettings>("normal", "Gauss", makeNormal),
         model<Distribution, LognormalSettings>("lognormal", "its logarithm is normal", makeLognormal),
         model<Distribution, UniformSettings>("uniform", "all values between two are as likely", makeUniform),
         {"truncated", "another one between two limits", // describes itself: not by declared settings
          [](const Dictionary& dictionary)
          {
              TruncatedSettings settings;
              Options options;
              options.readElsewhere({"type"});
              declare(options, settings);
              options.readFrom(dictionary);
              return makeTruncated(settings, dictionary);
          },
          []
          {
              std::vector<OptionDescription> members = describeOptions<UniformSettings>();
              OptionDescription of;
              of.key = "of";
              of.doc = "the distribution without the limits: { type beta; ... }, ...";
              of.form = OptionDescription::Form::elsewhere;
              members.insert(members.begin(), of);
              return members;
          }},
         model<Distribution, BetaSettings>("beta", "between two values, two shape parameters", makeBeta),
         discreteDistribution(),
         listDistribution(),
         model<Distribution, SeedSettings>("seed", "an integer of each sample's own, for random textures",
                                           makeSeed),
         tableDistribution()}};
    return registry;
}

} // namespace drystone
