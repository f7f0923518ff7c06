// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Writes the shapes of a drawing as elements of SVG.
#include "io/SvgText.h"

#include "core/MarkupText.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>

namespace drystone
{

namespace
{

/// Pixels with at most two decimals and no trailing zeros.
std::string pixels(double value)
{
    const double rounded = std::round(value * 100) / 100;
    return fmt::format("{}", rounded == 0 ? 0.0 : rounded); // not "-0"
}

/// The elements written so far.
struct SvgBody
{
    std::string text;

    void points(const std::vector<Vector<2>>& points);
    void run(const std::vector<Vector<2>>& points);
    void paint(const ShapeStyle& style);

    void operator()(const CanvasPath& path);
    void operator()(const CanvasRectangle& rectangle);
    void operator()(const CanvasCircle& circle);
    void operator()(const CanvasText& label);
    void operator()(const CanvasHatch& hatch);
    void operator()(const CanvasClip& clip);
    void operator()(const CanvasClipEnd& end);
};

void SvgBody::points(const std::vector<Vector<2>>& points)
{
    text += " points=\"";
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        fmt::format_to(std::back_inserter(text), "{}{},{}", i == 0 ? "" : " ", pixels(points[i].x()),
                       pixels(points[i].y()));
    }
    text += '"';
}

void SvgBody::paint(const ShapeStyle& style)
{
    fmt::format_to(std::back_inserter(text), " fill=\"{}\"", markupText(style.fill));
    if (style.stroke != "none")
    {
        fmt::format_to(std::back_inserter(text), " stroke=\"{}\" stroke-width=\"{}\"",
                       markupText(style.stroke), pixels(style.strokeWidth));
    }
    if (!style.dash.empty())
    {
        std::vector<std::string> lengths;
        for (const double length : style.dash)
        {
            lengths.push_back(pixels(length));
        }
        fmt::format_to(std::back_inserter(text), " stroke-dasharray=\"{}\"", fmt::join(lengths, " "));
    }
    if (style.opacity < 1)
    {
        fmt::format_to(std::back_inserter(text), " opacity=\"{}\"", pixels(style.opacity));
    }
    text += "/>\n";
}

/// One piece of a path: where it begins, and its steps. The steps are between rounded points, so that their
/// rounding does not add up.
void SvgBody::run(const std::vector<Vector<2>>& points)
{
    std::array<long long, 2> last{};
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const std::array<long long, 2> at{std::llround(10 * points[i].x()), std::llround(10 * points[i].y())};
        text += i == 0 ? "M" : i == 1 ? "l" : "";
        for (std::size_t axis = 0; axis < 2; ++axis)
        {
            const std::string number = pixels(static_cast<double>(at[axis] - last[axis]) / 10);
            // A sign parts two numbers as well as a blank.
            text += (i > 1 || axis > 0) && number.front() != '-' ? " " : "";
            text += number;
        }
        last = at;
    }
}

void SvgBody::operator()(const CanvasPath& path)
{
    switch (path.kind)
    {
    case CanvasPath::Kind::polygon:
        text += "<polygon";
        points(path.pieces.front());
        break;
    case CanvasPath::Kind::polyline:
        text += "<polyline stroke-linejoin=\"round\"";
        points(path.pieces.front());
        break;
    case CanvasPath::Kind::line:
    {
        const Vector<2>& from = path.pieces.front().front();
        const Vector<2>& to = path.pieces.front().back();
        fmt::format_to(std::back_inserter(text), "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"",
                       pixels(from.x()), pixels(from.y()), pixels(to.x()), pixels(to.y()));
        break;
    }
    case CanvasPath::Kind::polygons:
    case CanvasPath::Kind::lines:
        text += "<path d=\"";
        for (const std::vector<Vector<2>>& piece : path.pieces)
        {
            run(piece);
            text += path.kind == CanvasPath::Kind::polygons ? "z" : "";
        }
        text += '"';
        break;
    }
    paint(path.style);
}

void SvgBody::operator()(const CanvasRectangle& rectangle)
{
    fmt::format_to(std::back_inserter(text), "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"",
                   pixels(rectangle.corner.x()), pixels(rectangle.corner.y()), pixels(rectangle.width),
                   pixels(rectangle.height));
    paint(rectangle.style);
}

void SvgBody::operator()(const CanvasCircle& circle)
{
    fmt::format_to(std::back_inserter(text), "<circle cx=\"{}\" cy=\"{}\" r=\"{}\"",
                   pixels(circle.centre.x()), pixels(circle.centre.y()), pixels(circle.radius));
    paint(circle.style);
}

void SvgBody::operator()(const CanvasText& label)
{
    const TextStyle& style = label.style;
    const char* anchor = style.anchor == TextAnchor::start    ? "start"
                         : style.anchor == TextAnchor::middle ? "middle"
                                                              : "end";
    fmt::format_to(
        std::back_inserter(text), "<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\"",
        pixels(label.at.x()), pixels(label.at.y()), pixels(style.size), anchor, markupText(style.fill));
    if (!style.weight.empty())
    {
        fmt::format_to(std::back_inserter(text), " font-weight=\"{}\"", markupText(style.weight));
    }
    if (style.rotation != 0)
    {
        fmt::format_to(std::back_inserter(text), " transform=\"rotate({} {} {})\"", pixels(style.rotation),
                       pixels(label.at.x()), pixels(label.at.y()));
    }
    fmt::format_to(std::back_inserter(text), ">{}</text>\n", markupText(label.content));
}

void SvgBody::operator()(const CanvasHatch& hatch)
{
    fmt::format_to(
        std::back_inserter(text),
        "<defs><pattern id=\"{0}\" width=\"{1}\" height=\"{1}\" patternUnits=\"userSpaceOnUse\" "
        "patternTransform=\"rotate(45)\"><line x1=\"0\" y1=\"0\" x2=\"0\" y2=\"{1}\" stroke=\"{2}\" "
        "stroke-width=\"1.6\"/></pattern></defs>\n",
        markupText(hatch.name), pixels(hatch.spacing), markupText(hatch.colour));
}

void SvgBody::operator()(const CanvasClip& clip)
{
    fmt::format_to(
        std::back_inserter(text),
        "<clipPath id=\"{0}\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/></clipPath>\n"
        "<g clip-path=\"url(#{0})\">\n",
        markupText(clip.name), pixels(clip.corner.x()), pixels(clip.corner.y()), pixels(clip.width),
        pixels(clip.height));
}

void SvgBody::operator()(const CanvasClipEnd&)
{
    text += "</g>\n";
}

} // namespace

std::string svgText(const Canvas& canvas)
{
    SvgBody body;
    for (const CanvasShape& shape : canvas.shapes)
    {
        std::visit(body, shape);
    }
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
        "font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif\">\n{2}</svg>\n",
        pixels(canvas.width), pixels(canvas.height), body.text);
}

} // namespace drystone
