// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Sorts samples by intensity, or by the curve that they are points of.
#include "ensembles/FragilityObservations.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace drystone
{

Observations observationsOf(const FragilityNames& names, const SampleTable& table, FailedAs failedAs)
{
    Observations found;
    const std::vector<double> intensities = valuesOf(names.intensity, table);
    const std::vector<double> exceeded = valuesOf(names.exceeded, table);
    const std::size_t curve =
        names.curve ? static_cast<std::size_t>(std::find(table.names.begin(), table.names.end(), *names.curve)
                                               - table.names.begin())
                    : 0;
    for (std::size_t row = 0; row < table.rows(); ++row)
    {
        if (!std::isfinite(intensities[row]))
        {
            ++found.unplaced;
            continue;
        }
        const bool isUnknown = table.isFailed[row] || std::isnan(exceeded[row]);
        found.failures += isUnknown;
        found.undefined += isUnknown && !table.isFailed[row];
        found.numbers += !isUnknown && exceeded[row] != 0 && exceeded[row] != 1;
        found.intensity.push_back(intensities[row]);
        found.exceeded.push_back(isUnknown ? failedAs == FailedAs::fallen : exceeded[row] != 0);
        if (names.curve)
        {
            found.curve.push_back(table.texts[curve][row]);
        }
    }
    return found;
}

std::vector<Stripe> stripesOf(const Observations& observations)
{
    std::map<double, Stripe> stripes;
    for (std::size_t i = 0; i < observations.intensity.size(); ++i)
    {
        Stripe& stripe = stripes[observations.intensity[i]];
        stripe.intensity = observations.intensity[i];
        ++stripe.runs;
        stripe.exceeded += observations.exceeded[i] != 0;
    }
    std::vector<Stripe> sorted;
    for (const auto& [intensity, stripe] : stripes)
    {
        sorted.push_back(stripe);
    }
    return sorted;
}

CurvesOfSamples curvesOf(const Observations& observations)
{
    struct Tried
    {
        double failing = HUGE_VAL;
        double highest = 0;
        std::set<double> intensities;
    };
    CurvesOfSamples result;
    std::map<std::string, Tried> curves;
    for (std::size_t i = 0; i < observations.intensity.size(); ++i)
    {
        const double intensity = observations.intensity[i];
        Tried& curve = curves[observations.curve[i]];
        result.repeated += !curve.intensities.insert(intensity).second;
        curve.highest = std::max(curve.highest, intensity);
        curve.failing = observations.exceeded[i] ? std::min(curve.failing, intensity) : curve.failing;
    }
    for (const auto& [name, curve] : curves)
    {
        const bool fails = std::isfinite(curve.failing);
        (fails ? result.failing : result.standing).push_back(fails ? curve.failing : curve.highest);
    }
    return result;
}

} // namespace drystone
