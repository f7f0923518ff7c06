// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Collects the shapes of a drawing.
#include "io/Canvas.h"

#include "core/Error.h"

#include <algorithm>
#include <cmath>

namespace drystone
{

namespace
{

void requireFinite(double value)
{
    if (!std::isfinite(value))
    {
        throw FatalError("A coordinate of a picture is not a finite number.");
    }
}

void requireFinite(const Vector<2>& point)
{
    requireFinite(point.x());
    requireFinite(point.y());
}

CanvasPath pathOf(CanvasPath::Kind kind, std::vector<std::vector<Vector<2>>> pieces, const ShapeStyle& style)
{
    for (const std::vector<Vector<2>>& piece : pieces)
    {
        for (const Vector<2>& point : piece)
        {
            requireFinite(point);
        }
    }
    requireFinite(style.strokeWidth);
    return {kind, std::move(pieces), style};
}

} // namespace

Canvas::Canvas(double pageWidth, double pageHeight) : width(pageWidth), height(pageHeight)
{
    rectangle({0, 0}, width, height, {.fill = "#ffffff"});
}

void Canvas::polygon(std::vector<Vector<2>> points, const ShapeStyle& style)
{
    shapes.emplace_back(pathOf(CanvasPath::Kind::polygon, {std::move(points)}, style));
}

void Canvas::polyline(std::vector<Vector<2>> points, const ShapeStyle& style)
{
    shapes.emplace_back(pathOf(CanvasPath::Kind::polyline, {std::move(points)}, style));
}

void Canvas::line(const Vector<2>& from, const Vector<2>& to, const ShapeStyle& style)
{
    shapes.emplace_back(pathOf(CanvasPath::Kind::line, {{from, to}}, style));
}

void Canvas::polygons(std::vector<std::vector<Vector<2>>> outlines, const ShapeStyle& style)
{
    shapes.emplace_back(pathOf(CanvasPath::Kind::polygons, std::move(outlines), style));
}

void Canvas::lines(const std::vector<std::pair<Vector<2>, Vector<2>>>& ends, const ShapeStyle& style)
{
    std::vector<std::vector<Vector<2>>> pieces;
    for (const auto& [from, to] : ends)
    {
        pieces.push_back({from, to});
    }
    shapes.emplace_back(pathOf(CanvasPath::Kind::lines, std::move(pieces), style));
}

void Canvas::rectangle(const Vector<2>& corner, double rectangleWidth, double rectangleHeight,
                       const ShapeStyle& style)
{
    requireFinite(corner);
    requireFinite({rectangleWidth, rectangleHeight});
    shapes.emplace_back(CanvasRectangle{corner, rectangleWidth, rectangleHeight, style});
}

void Canvas::circle(const Vector<2>& centre, double radius, const ShapeStyle& style)
{
    requireFinite(centre);
    requireFinite(radius);
    shapes.emplace_back(CanvasCircle{centre, radius, style});
}

void Canvas::text(const Vector<2>& at, std::string_view content, const TextStyle& style)
{
    requireFinite(at);
    shapes.emplace_back(CanvasText{at, std::string(content), style});
}

void Canvas::textWithin(double room, const Vector<2>& at, std::string_view content, TextStyle style)
{
    const double wider = style.weight == "bold" ? 1.15 : 1; // its letters
    const FittedText fitted = fittedText(content, style.size, room / wider);
    style.size = fitted.size;
    text(at, fitted.content, style);
}

void Canvas::defineHatch(std::string_view name, std::string_view colour, double spacing)
{
    shapes.emplace_back(CanvasHatch{std::string(name), std::string(colour), spacing});
}

void Canvas::beginClip(std::string_view name, const Vector<2>& corner, double clipWidth, double clipHeight)
{
    requireFinite(corner);
    requireFinite({clipWidth, clipHeight});
    shapes.emplace_back(CanvasClip{std::string(name), corner, clipWidth, clipHeight});
}

void Canvas::endClip()
{
    shapes.emplace_back(CanvasClipEnd{});
}

double textWidth(std::string_view content, double size)
{
    // Of the widest usual typeface, DejaVu Sans: digits 0.64, letters 0.56 in the mean. Continuation bytes of
    // a UTF-8 character have no width of their own.
    double width = 0;
    for (const char c : content)
    {
        width += c >= '0' && c <= '9' ? 0.64 : (c & 0xC0) != 0x80 ? 0.56 : 0;
    }
    return size * width;
}

FittedText fittedText(std::string_view content, double size, double room)
{
    constexpr double smallest = 8;
    const double fitting = size * std::min(1.0, room / textWidth(content, size));
    if (content.empty() || fitting >= smallest)
    {
        return {std::string(content), content.empty() ? size : fitting};
    }
    const auto isContinued = [&](std::size_t at)
    { return at < content.size() && (content[at] & 0xC0) == 0x80; };
    std::size_t kept = content.size();
    while (kept > 0
           && (isContinued(kept) // no part of a character stays
               || textWidth(content.substr(0, kept), smallest) + textWidth("...", smallest) > room))
    {
        --kept;
    }
    return {std::string(content.substr(0, kept)) + "...", smallest};
}

} // namespace drystone
