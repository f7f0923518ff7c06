// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Chooses what the axes of a plot reach from and to.
#include "io/PlotAxis.h"

#include "core/Error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace drystone
{

namespace
{

double toScale(double value, AxisScale scale)
{
    return scale == AxisScale::logarithmic ? std::log10(value) : value;
}

void checkValue(double value, const PlotAxis& axis, const std::string& owner, std::size_t index)
{
    if (!std::isfinite(value))
    {
        throw FatalError(
            fmt::format("Point {} of {} in a plot has a value that is not finite.", index, owner));
    }
    if (axis.scale == AxisScale::logarithmic && value <= 0)
    {
        throw FatalError(
            fmt::format("Point {} of {} in a plot is {}: a logarithmic axis ({}) shows positive values only.",
                        index, owner, value, axis.label));
    }
}

double tickStep(double span)
{
    const double raw = span / 7;
    const double power = std::pow(10, std::floor(std::log10(raw)));
    for (const double factor : {1.0, 2.0, 5.0})
    {
        if (raw <= factor * power * 1.001)
        {
            return factor * power;
        }
    }
    return 10 * power;
}

/// Values from the least to the largest.
struct Span
{
    double lower = 0;
    double upper = 0;
};

Span widenedByDecades(const Span& values)
{
    const double decades = std::log10(values.upper / values.lower);
    if (decades < 0.1)
    {
        return {values.lower / 2, values.upper * 2};
    }
    return {values.lower * std::pow(10, -0.06 * decades), values.upper * std::pow(10, 0.06 * decades)};
}

/// With room at both ends but at zero, down to which values go on that are not far above.
Span widened(Span values)
{
    if (values.lower > 0 && values.lower < 0.4 * values.upper)
    {
        values.lower = 0;
    }
    double span = values.upper - values.lower;
    const bool isFlat = !(span > 1e-12 * std::max(std::abs(values.lower), std::abs(values.upper)));
    if (isFlat)
    {
        span = values.upper == 0 ? 10 : 10 * std::abs(values.upper);
    }
    if (values.lower != 0 || isFlat)
    {
        values.lower -= 0.05 * span;
    }
    if (values.upper != 0 || isFlat)
    {
        values.upper += 0.05 * span;
    }
    return values;
}

} // namespace

double AxisRange::part(double value) const
{
    return (toScale(value, scale) - toScale(lower, scale)) / (toScale(upper, scale) - toScale(lower, scale));
}

AxisRange chooseRange(const PlotAxis& axis, const std::vector<double>& values)
{
    Span span{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
    for (const double value : values)
    {
        span.lower = std::min(span.lower, value);
        span.upper = std::max(span.upper, value);
    }
    const bool logarithmic = axis.scale == AxisScale::logarithmic;
    if (span.lower > span.upper)
    {
        span = logarithmic ? Span{1, 10} : Span{0, 1};
    }
    span = logarithmic ? widenedByDecades(span) : widened(span);
    const AxisRange range{axis.lower.value_or(span.lower), axis.upper.value_or(span.upper), axis.scale};
    if (!std::isfinite(range.lower) || !std::isfinite(range.upper) || !(range.lower < range.upper)
        || (logarithmic && range.lower <= 0))
    {
        throw FatalError(fmt::format("The axis '{}' of a plot cannot run from {} to {}.", axis.label,
                                     range.lower, range.upper));
    }
    return range;
}

std::string tickLabel(double value, AxisScale scale)
{
    const double magnitude = std::abs(value);
    if (value == 0 || (magnitude >= 0.00999 && magnitude < 1e4)
        || (scale == AxisScale::linear && magnitude >= 0.000999 && magnitude < 1e6))
    {
        return fmt::format("{:.6g}", value);
    }
    constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    const int exponent = static_cast<int>(std::floor(std::log10(magnitude) + 1e-9));
    const double mantissa = value / std::pow(10, exponent);
    std::string label = fmt::format("{:.4g}", mantissa);
    label = label == "1" ? "" : label == "-1" ? "-" : label + "·";
    label += "10";
    if (exponent < 0)
    {
        label += "⁻";
    }
    for (const char digit : std::to_string(std::abs(exponent)))
    {
        label += digits[static_cast<std::size_t>(digit - '0')];
    }
    return label;
}

std::vector<double> axisTicks(double lower, double upper, AxisScale scale)
{
    std::vector<double> ticks;
    if (scale == AxisScale::linear)
    {
        const double step = tickStep(upper - lower);
        for (double i = std::ceil(lower / step - 1e-9); i <= upper / step + 1e-9; ++i)
        {
            ticks.push_back(i == 0 ? 0 : i * step);
        }
        return ticks;
    }
    const double decades = std::log10(upper / lower);
    const int every = std::max(1, static_cast<int>(std::ceil(decades / 9)));
    const auto inside = [&](double value)
    { return value >= lower * (1 - 1e-9) && value <= upper * (1 + 1e-9); };
    for (double exponent = std::floor(std::log10(lower)); exponent <= std::ceil(std::log10(upper));
         ++exponent)
    {
        for (const double factor : {1.0, 2.0, 5.0})
        {
            if ((factor == 1 ? std::fmod(exponent, every) == 0 : decades < 2)
                && inside(factor * std::pow(10, exponent)))
            {
                ticks.push_back(factor * std::pow(10, exponent));
            }
        }
    }
    if (ticks.size() < 2) // less than a factor of two: as a linear axis
    {
        return axisTicks(lower, upper, AxisScale::linear);
    }
    return ticks;
}

void checkValues(const Plot& plot)
{
    for (const PlotCurve& curve : plot.curves)
    {
        const std::string owner = "the curve '" + curve.name + "'";
        if (curve.x.size() != curve.y.size())
        {
            throw FatalError(
                fmt::format("{} in a plot has {} x and {} y values.", owner, curve.x.size(), curve.y.size()));
        }
        for (std::size_t i = 0; i < curve.x.size(); ++i)
        {
            checkValue(curve.x[i], plot.x, owner, i);
            checkValue(curve.y[i], plot.y, owner, i);
        }
    }
    for (const PlotReference& reference : plot.references)
    {
        checkValue(reference.value, reference.direction == ReferenceDirection::horizontal ? plot.y : plot.x,
                   "the reference '" + reference.name + "'", 0);
    }
}

} // namespace drystone
