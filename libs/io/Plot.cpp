// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Axes, ticks, curves and legend, laid out without a plotting library.
#include "io/Plot.h"

#include "core/Error.h"
#include "io/SvgText.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace drystone
{

namespace
{

/// The palette of Okabe and Ito, distinguishable with colour vision deficiency; without its yellow, which is
/// too light for lines.
constexpr std::array palette{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#444444"};
constexpr std::array markers{CurveMarker::circle, CurveMarker::square, CurveMarker::diamond,
                             CurveMarker::triangle};

double toScale(double value, AxisScale scale)
{
    return scale == AxisScale::logarithmic ? std::log10(value) : value;
}

/// Ends of an axis, in its own values.
struct Range
{
    double lower;
    double upper;
    AxisScale scale;

    /// Position on the axis, from 0 to 1.
    double part(double value) const
    {
        return (toScale(value, scale) - toScale(lower, scale))
               / (toScale(upper, scale) - toScale(lower, scale));
    }
};

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

void check(const Plot& plot)
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

/// From the data, with a margin; a linear axis that comes near zero begins there, a logarithmic one ends at
/// ticks.
Range chooseRange(const PlotAxis& axis, const std::vector<double>& values)
{
    double lower = std::numeric_limits<double>::max();
    double upper = std::numeric_limits<double>::lowest();
    for (const double value : values)
    {
        lower = std::min(lower, value);
        upper = std::max(upper, value);
    }
    const bool logarithmic = axis.scale == AxisScale::logarithmic;
    if (lower > upper)
    {
        lower = logarithmic ? 1 : 0;
        upper = logarithmic ? 10 : 1;
    }
    if (logarithmic)
    {
        const double decades = std::log10(upper / lower);
        if (decades < 0.1)
        {
            lower /= 2;
            upper *= 2;
        }
        else
        {
            lower *= std::pow(10, -0.06 * decades);
            upper *= std::pow(10, 0.06 * decades);
        }
    }
    else
    {
        if (lower > 0 && lower < 0.4 * upper)
        {
            lower = 0;
        }
        double span = upper - lower;
        const bool isFlat = !(span > 1e-12 * std::max(std::abs(lower), std::abs(upper)));
        if (isFlat)
        {
            span = upper == 0 ? 10 : 10 * std::abs(upper);
        }
        if (lower != 0 || isFlat)
        {
            lower -= 0.05 * span;
        }
        if (upper != 0 || isFlat)
        {
            upper += 0.05 * span;
        }
    }
    const Range range{axis.lower.value_or(lower), axis.upper.value_or(upper), axis.scale};
    if (!std::isfinite(range.lower) || !std::isfinite(range.upper) || !(range.lower < range.upper)
        || (logarithmic && range.lower <= 0))
    {
        throw FatalError(fmt::format("The axis '{}' of a plot cannot run from {} to {}.", axis.label,
                                     range.lower, range.upper));
    }
    return range;
}

/// 0.01, 0.1, 1, 10, 100 as they are, other powers of ten with an exponent.
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

void paintMarker(Canvas& drawing, const Vector<2>& at, CurveMarker marker, const std::string& colour)
{
    const ShapeStyle style{.fill = colour, .stroke = "#ffffff", .strokeWidth = 0.8};
    const auto shape = [&](const std::vector<Vector<2>>& corners)
    {
        std::vector<Vector<2>> moved;
        for (const Vector<2>& corner : corners)
        {
            moved.push_back(at + corner);
        }
        drawing.polygon(moved, style);
    };
    switch (marker)
    {
    case CurveMarker::circle:
        return drawing.circle(at, 4, style);
    case CurveMarker::square:
        return shape({{-3.6, -3.6}, {3.6, -3.6}, {3.6, 3.6}, {-3.6, 3.6}});
    case CurveMarker::diamond:
        return shape({{0, -5}, {5, 0}, {0, 5}, {-5, 0}});
    case CurveMarker::triangle:
        return shape({{0, -4.8}, {4.6, 3.6}, {-4.6, 3.6}});
    case CurveMarker::automatic:
    case CurveMarker::none:
        return;
    }
}

std::vector<double> dash(CurveLine line)
{
    using Lengths = std::vector<double>;
    return line == CurveLine::dashed ? Lengths{7, 4} : line == CurveLine::dotted ? Lengths{2, 3} : Lengths{};
}

/// A curve with its colour, line and marker chosen.
struct Look
{
    std::string colour;
    CurveMarker marker;
};

std::vector<Look> looks(const Plot& plot)
{
    std::vector<Look> result;
    for (std::size_t i = 0; i < plot.curves.size(); ++i)
    {
        const PlotCurve& curve = plot.curves[i];
        Look look{curve.colour.empty() ? curveColour(i) : curve.colour, curve.marker};
        if (look.marker == CurveMarker::automatic) // markers at very many points are illegible
        {
            look.marker = curve.x.size() > 60 && curve.line != CurveLine::none ? CurveMarker::none
                                                                               : markers[i % markers.size()];
        }
        result.push_back(look);
    }
    return result;
}

struct Frame
{
    double left, top, width, height; ///< of the area of the curves [px]
    Range x, y;

    Vector<2> operator()(double px, double py) const
    {
        // Values far outside a given range end just outside the frame, where they are clipped.
        return {left + width * std::clamp(x.part(px), -9.0, 10.0),
                top + height * (1 - std::clamp(y.part(py), -9.0, 10.0))};
    }

    bool holds(const Vector<2>& at) const
    {
        constexpr double rounding = 0.01;
        return at.x() >= left - rounding && at.x() <= left + width + rounding && at.y() >= top - rounding
               && at.y() <= top + height + rounding;
    }
};

void paintAxes(Canvas& drawing, const Plot& plot, const Frame& frame, const std::vector<double>& xTicks,
               const std::vector<double>& yTicks, double yLabelRoom)
{
    const ShapeStyle grid{.stroke = "#e2e2e2", .strokeWidth = 1};
    const ShapeStyle faint{.stroke = "#f3f3f3", .strokeWidth = 1};
    const double bottom = frame.top + frame.height;
    const double right = frame.left + frame.width;
    const auto minor = [&](const Range& range, const auto& paint)
    {
        if (range.scale != AxisScale::logarithmic || std::log10(range.upper / range.lower) > 8)
        {
            return;
        }
        for (double power = std::pow(10, std::floor(std::log10(range.lower))); power < range.upper;
             power *= 10)
        {
            for (int factor = 2; factor < 10; ++factor)
            {
                if (factor * power > range.lower && factor * power < range.upper)
                {
                    paint(factor * power);
                }
            }
        }
    };
    minor(frame.x,
          [&](double value)
          {
              const double x = frame(value, frame.y.lower).x();
              drawing.line({x, frame.top}, {x, bottom}, faint);
          });
    minor(frame.y,
          [&](double value)
          {
              const double y = frame(frame.x.lower, value).y();
              drawing.line({frame.left, y}, {right, y}, faint);
          });
    for (const double value : xTicks)
    {
        const double x = frame(value, frame.y.lower).x();
        drawing.line({x, frame.top}, {x, bottom}, grid);
        drawing.text({x, bottom + 19}, tickLabel(value, frame.x.scale),
                     {.size = 12.5, .anchor = TextAnchor::middle});
    }
    for (const double value : yTicks)
    {
        const double y = frame(frame.x.lower, value).y();
        drawing.line({frame.left, y}, {right, y}, grid);
        drawing.text({frame.left - 8, y + 4.4}, tickLabel(value, frame.y.scale),
                     {.size = 12.5, .anchor = TextAnchor::end});
    }
    drawing.rectangle({frame.left, frame.top}, frame.width, frame.height,
                      {.stroke = "#555555", .strokeWidth = 1});
    drawing.text({frame.left + frame.width / 2, bottom + 43}, plot.x.label,
                 {.size = 13.5, .anchor = TextAnchor::middle});
    drawing.text({frame.left - yLabelRoom - 16, frame.top + frame.height / 2}, plot.y.label,
                 {.size = 13.5, .anchor = TextAnchor::middle, .rotation = -90});
}

} // namespace

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

std::string curveColour(std::size_t index)
{
    return palette[index % palette.size()];
}

Canvas drawnPlot(const Plot& plot)
{
    check(plot);
    std::vector<double> allX;
    std::vector<double> allY;
    for (const PlotCurve& curve : plot.curves)
    {
        allX.insert(allX.end(), curve.x.begin(), curve.x.end());
        allY.insert(allY.end(), curve.y.begin(), curve.y.end());
    }
    for (const PlotReference& reference : plot.references)
    {
        (reference.direction == ReferenceDirection::horizontal ? allY : allX).push_back(reference.value);
    }

    Frame frame{0, 0, 0, 0, chooseRange(plot.x, allX), chooseRange(plot.y, allY)};
    const std::vector<double> xTicks = axisTicks(frame.x.lower, frame.x.upper, frame.x.scale);
    const std::vector<double> yTicks = axisTicks(frame.y.lower, frame.y.upper, frame.y.scale);
    double yLabelRoom = 0;
    for (const double value : yTicks)
    {
        yLabelRoom = std::max(yLabelRoom, textWidth(tickLabel(value, frame.y.scale), 12.5));
    }
    double legendRoom = 0;
    for (const PlotCurve& curve : plot.curves)
    {
        if (!curve.name.empty())
        {
            legendRoom = std::max(legendRoom, 58 + textWidth(curve.name, 12.5));
        }
    }
    for (const PlotReference& reference : plot.references)
    {
        legendRoom = std::max(legendRoom, 58 + textWidth(reference.name, 12.5));
    }

    frame.left = 44 + yLabelRoom;
    frame.top = 22 + (plot.title.empty() ? 0 : 26) + (plot.subtitle.empty() ? 0 : 20);
    frame.width = std::max(160.0, plot.width - frame.left - std::max(24.0, legendRoom + 8));
    frame.height = std::max(120.0, plot.height - frame.top - 60);
    Canvas drawing(frame.left + frame.width + std::max(24.0, legendRoom + 8), frame.top + frame.height + 60);

    if (!plot.title.empty())
    {
        drawing.text({frame.left, 30}, plot.title, {.size = 16, .weight = "bold"});
    }
    if (!plot.subtitle.empty())
    {
        drawing.text({frame.left, plot.title.empty() ? 24 : 50}, plot.subtitle,
                     {.size = 12.5, .fill = "#555555"});
    }
    paintAxes(drawing, plot, frame, xTicks, yTicks, yLabelRoom);

    const std::vector<Look> look = looks(plot);
    // As wide as half a line beyond the frame, so that a curve along an axis keeps its width.
    drawing.beginClip("curves", {frame.left - 1, frame.top - 1}, frame.width + 2, frame.height + 2);
    for (const PlotReference& reference : plot.references)
    {
        const ShapeStyle style{.stroke = "#222222", .strokeWidth = 1.3, .dash = {3, 3}};
        if (reference.direction == ReferenceDirection::horizontal)
        {
            drawing.line(frame(frame.x.lower, reference.value), frame(frame.x.upper, reference.value), style);
        }
        else
        {
            drawing.line(frame(reference.value, frame.y.lower), frame(reference.value, frame.y.upper), style);
        }
    }
    for (std::size_t i = 0; i < plot.curves.size(); ++i)
    {
        const PlotCurve& curve = plot.curves[i];
        std::vector<Vector<2>> path;
        for (std::size_t k = 0; k < curve.x.size(); ++k)
        {
            path.push_back(frame(curve.x[k], curve.y[k]));
        }
        if (curve.line != CurveLine::none && path.size() > 1)
        {
            drawing.polyline(path, {.stroke = look[i].colour, .strokeWidth = 1.9, .dash = dash(curve.line)});
        }
    }
    drawing.endClip();
    for (std::size_t i = 0; i < plot.curves.size(); ++i)
    {
        const PlotCurve& curve = plot.curves[i];
        for (std::size_t k = 0; k < curve.x.size(); ++k)
        {
            const Vector<2> at = frame(curve.x[k], curve.y[k]);
            if (frame.holds(at)) // whole, also on the frame
            {
                paintMarker(drawing, at, look[i].marker, look[i].colour);
            }
        }
    }

    const double x = frame.left + frame.width + 16;
    double y = frame.top + 12;
    for (std::size_t i = 0; i < plot.curves.size(); ++i)
    {
        const PlotCurve& curve = plot.curves[i];
        if (curve.name.empty())
        {
            continue;
        }
        if (curve.line != CurveLine::none)
        {
            drawing.line({x, y}, {x + 28, y},
                         {.stroke = look[i].colour, .strokeWidth = 1.9, .dash = dash(curve.line)});
        }
        paintMarker(drawing, {x + 14, y}, look[i].marker, look[i].colour);
        drawing.text({x + 36, y + 4.4}, curve.name, {.size = 12.5});
        y += 20;
    }
    for (const PlotReference& reference : plot.references)
    {
        if (reference.direction == ReferenceDirection::horizontal)
        {
            drawing.line({x, y}, {x + 28, y}, {.stroke = "#222222", .strokeWidth = 1.3, .dash = {3, 3}});
        }
        else
        {
            drawing.line({x + 14, y - 8}, {x + 14, y + 8},
                         {.stroke = "#222222", .strokeWidth = 1.3, .dash = {3, 3}});
        }
        drawing.text({x + 36, y + 4.4}, reference.name, {.size = 12.5});
        y += 20;
    }
    return drawing;
}

std::string plotSvg(const Plot& plot)
{
    return svgText(drawnPlot(plot));
}

void writePlot(const std::filesystem::path& name, const Plot& plot, const PictureFormats& formats)
{
    writePicture(name, drawnPlot(plot), formats);
}

} // namespace drystone
