// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Axes, ticks, curves and legend, laid out without a plotting library.
#include "io/PlotAxis.h"

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
            look.marker = curve.x.size() > 60 && curve.line != CurveLine::none
                              ? CurveMarker::none
                              : curveMarkers[i % curveMarkers.size()];
        }
        result.push_back(look);
    }
    return result;
}

struct Frame
{
    double left, top, width, height; ///< of the area of the curves [px]
    AxisRange x, y;

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

/// Between a text and the edge of the picture [px].
constexpr double edge = 8;

/// Visits the values between the powers of ten of an axis of less than eight.
template<class Visit>
void visitMinorValues(const AxisRange& range, const Visit& visit)
{
    if (range.scale != AxisScale::logarithmic || std::log10(range.upper / range.lower) > 8)
    {
        return;
    }
    for (double power = std::pow(10, std::floor(std::log10(range.lower))); power < range.upper; power *= 10)
    {
        for (int factor = 2; factor < 10; ++factor)
        {
            if (factor * power > range.lower && factor * power < range.upper)
            {
                visit(factor * power);
            }
        }
    }
}

void paintGrid(Canvas& drawing, const Frame& frame, const std::vector<double>& xTicks,
               const std::vector<double>& yTicks)
{
    const ShapeStyle grid{.stroke = "#e2e2e2", .strokeWidth = 1};
    const ShapeStyle faint{.stroke = "#f3f3f3", .strokeWidth = 1};
    const double bottom = frame.top + frame.height;
    const double right = frame.left + frame.width;
    visitMinorValues(frame.x,
                     [&](double value)
                     {
                         const double x = frame(value, frame.y.lower).x();
                         drawing.line({x, frame.top}, {x, bottom}, faint);
                     });
    visitMinorValues(frame.y,
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
}

void paintAxes(Canvas& drawing, const Plot& plot, const Frame& frame, const std::vector<double>& xTicks,
               const std::vector<double>& yTicks, double yLabelRoom)
{
    paintGrid(drawing, frame, xTicks, yTicks);
    drawing.rectangle({frame.left, frame.top}, frame.width, frame.height,
                      {.stroke = "#555555", .strokeWidth = 1});
    drawing.textWithin(frame.width, {frame.left + frame.width / 2, frame.top + frame.height + 43},
                       plot.x.label, {.size = 13.5, .anchor = TextAnchor::middle});
    const double room = drawing.height - 2 * edge;
    const double half = std::min(room, textWidth(plot.y.label, 13.5)) / 2;
    const double middle = std::clamp(frame.top + frame.height / 2, edge + half, drawing.height - edge - half);
    drawing.textWithin(room, {frame.left - yLabelRoom - 16, middle}, plot.y.label,
                       {.size = 13.5, .anchor = TextAnchor::middle, .rotation = -90});
}

/// Between the axis and what stands next to it [px].
constexpr double leastRoom = 24;
constexpr double lengthOfKey = 28;
constexpr double textOfKey = 36;
constexpr double lineOfKey = 20;
constexpr double sizeOfText = 12.5;

const ShapeStyle& styleOfReferences()
{
    static const ShapeStyle style{.stroke = "#222222", .strokeWidth = 1.3, .dash = {3, 3}};
    return style;
}

ShapeStyle styleOf(const PlotCurve& curve, const Look& look)
{
    return {.stroke = look.colour, .strokeWidth = 1.9, .dash = dash(curve.line)};
}

AxisRange rangeOf(const Plot& plot, ReferenceDirection along)
{
    const bool isX = along == ReferenceDirection::vertical;
    std::vector<double> values;
    for (const PlotCurve& curve : plot.curves)
    {
        const std::vector<double>& own = isX ? curve.x : curve.y;
        values.insert(values.end(), own.begin(), own.end());
    }
    for (const PlotReference& reference : plot.references)
    {
        if (reference.direction == along)
        {
            values.push_back(reference.value);
        }
    }
    return chooseRange(isX ? plot.x : plot.y, values);
}

/// Width that the legend takes next to the frame [px].
double roomOfLegend(const Plot& plot)
{
    constexpr double beforeText = 16 + textOfKey + 6;
    double room = 0;
    for (const PlotCurve& curve : plot.curves)
    {
        if (!curve.name.empty())
        {
            room = std::max(room, beforeText + textWidth(curve.name, sizeOfText));
        }
    }
    for (const PlotReference& reference : plot.references)
    {
        room = std::max(room, beforeText + textWidth(reference.name, sizeOfText));
    }
    return std::max(leastRoom, room + 8);
}

void paintTitles(Canvas& drawing, const Plot& plot, const Frame& frame)
{
    const double room = drawing.width - frame.left - edge;
    if (!plot.title.empty())
    {
        drawing.textWithin(room, {frame.left, 30}, plot.title, {.size = 16, .weight = "bold"});
    }
    if (!plot.subtitle.empty())
    {
        drawing.textWithin(room, {frame.left, plot.title.empty() ? 24 : 50}, plot.subtitle,
                           {.size = sizeOfText, .fill = "#555555"});
    }
}

void paintLines(Canvas& drawing, const Plot& plot, const Frame& frame, const std::vector<Look>& look)
{
    // As wide as half a line beyond the frame, so that a curve along an axis keeps its width.
    drawing.beginClip("curves", {frame.left - 1, frame.top - 1}, frame.width + 2, frame.height + 2);
    for (const PlotReference& reference : plot.references)
    {
        const bool isHorizontal = reference.direction == ReferenceDirection::horizontal;
        drawing.line(
            isHorizontal ? frame(frame.x.lower, reference.value) : frame(reference.value, frame.y.lower),
            isHorizontal ? frame(frame.x.upper, reference.value) : frame(reference.value, frame.y.upper),
            styleOfReferences());
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
            drawing.polyline(path, styleOf(curve, look[i]));
        }
    }
    drawing.endClip();
}

void paintMarkers(Canvas& drawing, const Plot& plot, const Frame& frame, const std::vector<Look>& look)
{
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
}

void paintLegend(Canvas& drawing, const Plot& plot, const Frame& frame, const std::vector<Look>& look)
{
    const double x = frame.left + frame.width + 16;
    const double middle = x + lengthOfKey / 2;
    double y = frame.top + 12;
    const auto paintName = [&](const std::string& name)
    {
        drawing.text({x + textOfKey, y + 4.4}, name, {.size = sizeOfText});
        y += lineOfKey;
    };
    for (std::size_t i = 0; i < plot.curves.size(); ++i)
    {
        const PlotCurve& curve = plot.curves[i];
        if (curve.name.empty())
        {
            continue;
        }
        if (curve.line != CurveLine::none)
        {
            drawing.line({x, y}, {x + lengthOfKey, y}, styleOf(curve, look[i]));
        }
        paintMarker(drawing, {middle, y}, look[i].marker, look[i].colour);
        paintName(curve.name);
    }
    for (const PlotReference& reference : plot.references)
    {
        const bool isHorizontal = reference.direction == ReferenceDirection::horizontal;
        drawing.line(isHorizontal ? Vector<2>(x, y) : Vector<2>(middle, y - 8),
                     isHorizontal ? Vector<2>(x + lengthOfKey, y) : Vector<2>(middle, y + 8),
                     styleOfReferences());
        paintName(reference.name);
    }
}

} // namespace

std::string curveColour(std::size_t index)
{
    return palette[index % palette.size()];
}

Canvas drawnPlot(const Plot& plot)
{
    checkValues(plot);
    Frame frame{0,
                0,
                0,
                0,
                rangeOf(plot, ReferenceDirection::vertical),
                rangeOf(plot, ReferenceDirection::horizontal)};
    const std::vector<double> xTicks = axisTicks(frame.x.lower, frame.x.upper, frame.x.scale);
    const std::vector<double> yTicks = axisTicks(frame.y.lower, frame.y.upper, frame.y.scale);
    double yLabelRoom = 0;
    for (const double value : yTicks)
    {
        yLabelRoom = std::max(yLabelRoom, textWidth(tickLabel(value, frame.y.scale), sizeOfText));
    }
    const double legendRoom = roomOfLegend(plot);
    frame.left = 44 + yLabelRoom;
    frame.top = 22 + (plot.title.empty() ? 0 : 26) + (plot.subtitle.empty() ? 0 : 20);
    frame.width = std::max(160.0, plot.width - frame.left - legendRoom);
    frame.height = std::max(120.0, plot.height - frame.top - 60);

    Canvas drawing(frame.left + frame.width + legendRoom, frame.top + frame.height + 60);
    const std::vector<Look> look = looks(plot);
    paintTitles(drawing, plot, frame);
    paintAxes(drawing, plot, frame, xTicks, yTicks, yLabelRoom);
    paintLines(drawing, plot, frame, look);
    paintMarkers(drawing, plot, frame, look);
    paintLegend(drawing, plot, frame, look);
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
