// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The registry of intensity plans, and the conclusion from their trials.
#include "ensembles/Intensity.h"

#include "timeSeries/DescribedAcceleration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// More runs than this are taken for a mistake in the dictionary.
constexpr int mostIntensities = 100000;

/// Of a step: how much steps may miss the end of their range by.
constexpr double missedByRounding = 1e-6;

/// Number of steps from one intensity to another, rounded up; a very small remainder is rounding.
long stepsBetween(double from, double to, double step)
{
    return std::lround(std::ceil((to - from) / step - missedByRounding));
}

void declareUnit(Options& options, IntensityUnit& unit)
{
    options.optional("unit", unit, "of the intensities; g is the gravity of constant/g");
}

/// Of the highest intensity: whether no earthquake has it, as where m/s2 are read as multiples of g.
std::string doubtOfHighest(double highest, IntensityUnit unit)
{
    constexpr double gravity = 9.81; // that of constant/g is not known here
    const bool isInG = unit == IntensityUnit::g;
    if (highest * (isInG ? gravity : 1) <= strongestGround)
    {
        return "";
    }
    return fmt::format("An intensity of {:g} {} is unusual: usual is up to {:g} m/s2. {}It is used as it "
                       "stands.",
                       highest, isInG ? "g" : "m/s2", strongestGround,
                       isInG ? "Were m/s2 meant, write `unit m/s2;`. " : "");
}

std::string faultOfRange(double lowest, double highest, double step, const char* names)
{
    if (!(highest > lowest))
    {
        return fmt::format("{}: the range is empty.", names);
    }
    return (highest - lowest) / step > mostIntensities
               ? fmt::format("{} make more than {} intensities.", names, mostIntensities)
               : "";
}

struct EqualStepsSettings
{
    IntensityUnit unit = IntensityUnit::g;
    double from = 0;
    double to = 0;
    double step = 0;

    /// Number of steps up to `to`; a very small remainder is rounding.
    long count() const { return std::lround(std::floor((to - from) / step + missedByRounding)); }
    double at(long i) const { return from + static_cast<double>(i) * step; }
};

void declare(Options& options, EqualStepsSettings& settings)
{
    declareUnit(options, settings.unit);
    options.required("from", settings.from, "the lowest intensity").above(0).example("0.3");
    options.required("to", settings.to, "the highest one").above(0).example("0.4");
    options.required("step", settings.step, "between them").above(0).example("0.001");
    options.check("step", [&settings]
                  { return faultOfRange(settings.from, settings.to, settings.step, "from, to and step"); });
    options.question("to", [&settings] { return doubtOfHighest(settings.to, settings.unit); });
    options.question(
        "step",
        [&settings]() -> std::string
        {
            const double length = settings.to - settings.from;
            const double last = settings.at(settings.count());
            if (settings.to - last <= missedByRounding * settings.step)
            {
                return "";
            }
            const auto steps = static_cast<double>(stepsBetween(settings.from, settings.to, settings.step));
            return fmt::format("The highest intensity that is tried is {:g}, and not to {:g}: steps "
                               "of {:g} do not divide the range from {:g}. Usual is a step that "
                               "does, such as {:g}.",
                               last, settings.to, settings.step, settings.from, length / steps);
        });
}

IntensityPlan planSteps(const EqualStepsSettings& settings)
{
    return {settings.unit,
            [settings](const std::vector<Trial>& trials)
            {
                std::vector<double> intensities;
                if (trials.empty())
                {
                    for (long i = 0; i <= settings.count(); ++i)
                    {
                        intensities.push_back(settings.at(i));
                    }
                }
                return intensities;
            },
            1 + settings.count(), false, settings.step};
}

struct BisectionSettings
{
    IntensityUnit unit = IntensityUnit::g;
    double low = 0;
    double high = 0;
    double tolerance = 0;
};

void declare(Options& options, BisectionSettings& settings)
{
    declareUnit(options, settings.unit);
    options.required("low", settings.low, "an intensity that does not meet the criterion")
        .above(0)
        .example("0.3");
    options.required("high", settings.high, "one that does").above(0).example("0.4");
    options.question("high", [&settings] { return doubtOfHighest(settings.high, settings.unit); });
    options
        .required("tolerance", settings.tolerance,
                  "width of the bracket at the end: only multiples of it above low are tried")
        .above(0)
        .example("0.001");
    options.check(
        "tolerance",
        [&settings]
        {
            const std::string fault =
                faultOfRange(settings.low, settings.high, settings.tolerance, "low, high and tolerance");
            const double width = settings.high - settings.low;
            return !fault.empty() || settings.tolerance <= width * (1 + 1e-6) // 0.35 - 0.3 is below 0.05
                       ? fault
                       : fmt::format(
                           "The tolerance {:g} is wider than the bracket from low {:g} to high {:g}: "
                           "there is nothing to halve.\n\nGive a tolerance below {:g}.",
                           settings.tolerance, settings.low, settings.high, width);
        });
}

/// Halves the bracket on the grid low + i tolerance, whose last interval is shorter where high is no point of
/// it: the answer is the one that `step` finds if the verdict changes only once.
IntensityPlan planBisection(const BisectionSettings& settings)
{
    const long last = stepsBetween(settings.low, settings.high, settings.tolerance);
    const auto at = [settings, last](long i)
    { return i == last ? settings.high : settings.low + static_cast<double>(i) * settings.tolerance; };
    // Of the two ends of the short interval the nearer one is meant.
    const auto indexOf = [settings, last, at](double intensity)
    {
        return intensity > 0.5 * (at(last - 1) + at(last))
                   ? last
                   : std::lround((intensity - settings.low) / settings.tolerance);
    };
    return {settings.unit,
            [at, indexOf, last](const std::vector<Trial>& trials) -> std::vector<double>
            {
                long below = 0;
                long above = last;
                if (trials.empty())
                {
                    return {at(below), at(above)};
                }
                bool lowestMeets = false;
                bool highestMeets = false;
                for (const Trial& trial : trials)
                {
                    const long i = indexOf(trial.intensity);
                    if (trial.verdict == Verdict::meets)
                    {
                        above = std::min(above, i);
                        lowestMeets = lowestMeets || i == 0;
                        highestMeets = highestMeets || i == last;
                    }
                    else if (trial.verdict == Verdict::stands)
                    {
                        below = std::max(below, i);
                    }
                    else
                    {
                        return {}; // the half to be searched next is unknown
                    }
                }
                if (lowestMeets || !highestMeets || above - below <= 1)
                {
                    return {};
                }
                return {at(below + (above - below) / 2)};
            },
            // Both ends, then halves until one step is left.
            2 + static_cast<long>(std::ceil(std::log2(static_cast<double>(last)))), true, settings.tolerance};
}

struct IntensityList
{
    IntensityUnit unit = IntensityUnit::g;
    std::vector<double> values;
};

void declare(Options& options, IntensityList& settings)
{
    declareUnit(options, settings.unit);
    options.required("values", settings.values, "the intensities").above(0).example("(0.1 0.2 0.5)");
    options.check("values",
                  [&settings]
                  {
                      std::vector<double> sorted = settings.values;
                      std::sort(sorted.begin(), sorted.end());
                      return sorted.empty() ? "The list of intensities is empty."
                             : std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()
                                 ? "An intensity occurs twice in the list."
                                 : "";
                  });
    options.question("values",
                     [&settings]
                     {
                         const auto highest =
                             std::max_element(settings.values.begin(), settings.values.end());
                         return doubtOfHighest(*highest, settings.unit);
                     });
}

double widestInterval(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    double widest = 0;
    for (std::size_t i = 1; i < values.size(); ++i)
    {
        widest = std::max(widest, values[i] - values[i - 1]);
    }
    return widest;
}

IntensityPlan planList(const IntensityList& settings)
{
    return {settings.unit,
            [settings](const std::vector<Trial>& trials)
            { return trials.empty() ? settings.values : std::vector<double>{}; },
            static_cast<long>(settings.values.size()), false, widestInterval(settings.values)};
}

} // namespace

void read(TokenCursor& cursor, IntensityUnit& unit)
{
    const TokenCursor before = cursor;
    std::string word;
    while (!cursor.atEnd()) // m / s2 are three tokens
    {
        word += cursor.take().text;
    }
    std::vector<std::string> names;
    for (const auto& [name, named] : namesOf(unit))
    {
        if (word == name)
        {
            unit = named;
            return;
        }
        names.emplace_back(name);
    }
    if (before.atEnd())
    {
        before.failExpected("a unit, g or m/s2,");
    }
    detail::failUnknownWord(before, word, names);
}

std::string_view nameOf(IntensityUnit unit)
{
    return unit == IntensityUnit::g ? "g" : "m/s2";
}

const Registry<IntensityPlan>& intensityTypes()
{
    static const Registry<IntensityPlan> registry{
        "intensity",
        {model<IntensityPlan, EqualStepsSettings>("step", "equal steps", planSteps),
         model<IntensityPlan, BisectionSettings>(
             "bisection",
             "halves a bracket, which finds the least that meets it if the verdict changes "
             "once only",
             planBisection),
         model<IntensityPlan, IntensityList>("list", "these", planList)}};
    return registry;
}

LeastIntensity leastIntensity(std::vector<Trial> trials)
{
    std::sort(trials.begin(), trials.end(),
              [](const Trial& a, const Trial& b) { return a.intensity < b.intensity; });
    const auto first = std::find_if(trials.begin(), trials.end(),
                                    [](const Trial& trial) { return trial.verdict == Verdict::meets; });
    const bool isKnown = std::all_of(trials.begin(), first,
                                     [](const Trial& trial) { return trial.verdict == Verdict::stands; });
    LeastIntensity least;
    if (first == trials.end())
    {
        least.kind = isKnown ? LeastIntensity::Kind::aboveRange : LeastIntensity::Kind::notConverged;
        least.value = trials.back().intensity;
        return least;
    }
    least.value = first->intensity;
    least.kind = !isKnown                  ? LeastIntensity::Kind::notConverged
                 : first == trials.begin() ? LeastIntensity::Kind::belowRange
                                           : LeastIntensity::Kind::found;
    least.below = first == trials.begin() ? 0 : std::prev(first)->intensity;
    least.isMonotone = std::none_of(first, trials.end(),
                                    [](const Trial& trial) { return trial.verdict == Verdict::stands; });
    return least;
}

} // namespace drystone
