// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Writes SVG elements as text.
#include "io/Svg.h"

#include "core/Error.h"

#include <fmt/format.h>

#include <algorithm>
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
    if (!std::isfinite(value))
    {
        throw FatalError("A coordinate of a picture is not a finite number.");
    }
    const double rounded = std::round(value * 100) / 100;
    return fmt::format("{}", rounded == 0 ? 0.0 : rounded); // not "-0"
}

/// Text with the characters reserved by XML replaced.
std::string escaped(std::string_view text)
{
    std::string result;
    for (const char c : text)
    {
        switch (c)
        {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default: // XML 1.0 has no other control characters than these
            if (static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n')
            {
                result += c;
            }
        }
    }
    return result;
}

} // namespace

SvgDrawing::SvgDrawing(double width, double height) : pageWidth(width), pageHeight(height)
{
    rectangle({0, 0}, width, height, {.fill = "#ffffff"});
}

void SvgDrawing::points(const std::vector<Vector<2>>& points)
{
    body += " points=\"";
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        fmt::format_to(std::back_inserter(body), "{}{},{}", i == 0 ? "" : " ", pixels(points[i].x()),
                       pixels(points[i].y()));
    }
    body += '"';
}

void SvgDrawing::paint(const SvgStyle& style)
{
    fmt::format_to(std::back_inserter(body), " fill=\"{}\"", escaped(style.fill));
    if (style.stroke != "none")
    {
        fmt::format_to(std::back_inserter(body), " stroke=\"{}\" stroke-width=\"{}\"", escaped(style.stroke),
                       pixels(style.strokeWidth));
    }
    if (!style.dash.empty())
    {
        fmt::format_to(std::back_inserter(body), " stroke-dasharray=\"{}\"", escaped(style.dash));
    }
    if (style.opacity < 1)
    {
        fmt::format_to(std::back_inserter(body), " opacity=\"{}\"", pixels(style.opacity));
    }
    body += "/>\n";
}

void SvgDrawing::polygon(const std::vector<Vector<2>>& outline, const SvgStyle& style)
{
    body += "<polygon";
    points(outline);
    paint(style);
}

void SvgDrawing::polyline(const std::vector<Vector<2>>& path, const SvgStyle& style)
{
    body += "<polyline stroke-linejoin=\"round\"";
    points(path);
    paint(style);
}

void SvgDrawing::line(const Vector<2>& from, const Vector<2>& to, const SvgStyle& style)
{
    fmt::format_to(std::back_inserter(body), "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"",
                   pixels(from.x()), pixels(from.y()), pixels(to.x()), pixels(to.y()));
    paint(style);
}

/// One piece of a path: where it begins, and its steps. The steps are between rounded points, so that their
/// rounding does not add up.
void SvgDrawing::run(const std::vector<Vector<2>>& points)
{
    std::array<long long, 2> last{};
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        pixels(points[i].x() + points[i].y()); // refuses what is not finite
        const std::array<long long, 2> at{std::llround(10 * points[i].x()), std::llround(10 * points[i].y())};
        body += i == 0 ? "M" : i == 1 ? "l" : "";
        for (std::size_t axis = 0; axis < 2; ++axis)
        {
            const std::string number = pixels(static_cast<double>(at[axis] - last[axis]) / 10);
            // A sign parts two numbers as well as a blank.
            body += (i > 1 || axis > 0) && number.front() != '-' ? " " : "";
            body += number;
        }
        last = at;
    }
}

void SvgDrawing::polygons(const std::vector<std::vector<Vector<2>>>& outlines, const SvgStyle& style)
{
    body += "<path d=\"";
    for (const std::vector<Vector<2>>& outline : outlines)
    {
        run(outline);
        body += 'z';
    }
    body += '"';
    paint(style);
}

void SvgDrawing::lines(const std::vector<std::pair<Vector<2>, Vector<2>>>& ends, const SvgStyle& style)
{
    body += "<path d=\"";
    for (const auto& [from, to] : ends)
    {
        run({from, to});
    }
    body += '"';
    paint(style);
}

void SvgDrawing::rectangle(const Vector<2>& corner, double width, double height, const SvgStyle& style)
{
    fmt::format_to(std::back_inserter(body), "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"",
                   pixels(corner.x()), pixels(corner.y()), pixels(width), pixels(height));
    paint(style);
}

void SvgDrawing::circle(const Vector<2>& centre, double radius, const SvgStyle& style)
{
    fmt::format_to(std::back_inserter(body), "<circle cx=\"{}\" cy=\"{}\" r=\"{}\"", pixels(centre.x()),
                   pixels(centre.y()), pixels(radius));
    paint(style);
}

void SvgDrawing::text(const Vector<2>& at, std::string_view content, const SvgText& style)
{
    const char* anchor = style.anchor == TextAnchor::start    ? "start"
                         : style.anchor == TextAnchor::middle ? "middle"
                                                              : "end";
    fmt::format_to(std::back_inserter(body),
                   "<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\"", pixels(at.x()),
                   pixels(at.y()), pixels(style.size), anchor, escaped(style.fill));
    if (!style.weight.empty())
    {
        fmt::format_to(std::back_inserter(body), " font-weight=\"{}\"", escaped(style.weight));
    }
    if (style.rotation != 0)
    {
        fmt::format_to(std::back_inserter(body), " transform=\"rotate({} {} {})\"", pixels(style.rotation),
                       pixels(at.x()), pixels(at.y()));
    }
    fmt::format_to(std::back_inserter(body), ">{}</text>\n", escaped(content));
}

void SvgDrawing::defineHatch(std::string_view name, std::string_view colour, double spacing)
{
    fmt::format_to(
        std::back_inserter(body),
        "<defs><pattern id=\"{0}\" width=\"{1}\" height=\"{1}\" patternUnits=\"userSpaceOnUse\" "
        "patternTransform=\"rotate(45)\"><line x1=\"0\" y1=\"0\" x2=\"0\" y2=\"{1}\" stroke=\"{2}\" "
        "stroke-width=\"1.6\"/></pattern></defs>\n",
        escaped(name), pixels(spacing), escaped(colour));
}

void SvgDrawing::beginClip(std::string_view name, const Vector<2>& corner, double width, double height)
{
    fmt::format_to(
        std::back_inserter(body),
        "<clipPath id=\"{0}\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/></clipPath>\n"
        "<g clip-path=\"url(#{0})\">\n",
        escaped(name), pixels(corner.x()), pixels(corner.y()), pixels(width), pixels(height));
}

void SvgDrawing::endClip()
{
    body += "</g>\n";
}

std::string SvgDrawing::document() const
{
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
        "font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif\">\n{2}</svg>\n",
        pixels(pageWidth), pixels(pageHeight), body);
}

double textWidth(std::string_view content, double size)
{
    // Continuation bytes of a UTF-8 character have no width of their own.
    const auto characters =
        std::count_if(content.begin(), content.end(), [](char c) { return (c & 0xC0) != 0x80; });
    return 0.56 * size * static_cast<double>(characters);
}

} // namespace drystone
