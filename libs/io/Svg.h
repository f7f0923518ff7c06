// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A small SVG writer, the common base of pictures and plots: shapes and text in pixels, y downwards as in
/// SVG.
#pragma once

#include "geometry/Polygon.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drystone
{

/// How a shape is painted. Colours are CSS colours or `none`.
struct SvgStyle
{
    std::string fill = "none";
    std::string stroke = "none";
    double strokeWidth = 1;
    std::string dash = ""; ///< `stroke-dasharray`, for instance "4 3"; solid when empty
    double opacity = 1;
};

enum class TextAnchor
{
    start,
    middle,
    end
};

struct SvgText
{
    double size = 13; ///< [px]
    TextAnchor anchor = TextAnchor::start;
    std::string fill = "#222222";
    double rotation = 0;     ///< clockwise about the anchor [degrees]
    std::string weight = ""; ///< `bold`, or normal when empty
};

/// Shapes collected in drawing order. Coordinates are rounded to 0.01 px. Every function throws FatalError on
/// a coordinate that is not finite, so that no unreadable picture is written.
class SvgDrawing
{
public:
    SvgDrawing(double width, double height);

    void polygon(const std::vector<Vector<2>>& points, const SvgStyle& style);
    void polyline(const std::vector<Vector<2>>& points, const SvgStyle& style);
    void line(const Vector<2>& from, const Vector<2>& to, const SvgStyle& style);
    /// Many polygons, or many lines, of one style as one element, in a quarter of the size; coordinates are
    /// rounded to 0.1 px.
    void polygons(const std::vector<std::vector<Vector<2>>>& outlines, const SvgStyle& style);
    void lines(const std::vector<std::pair<Vector<2>, Vector<2>>>& ends, const SvgStyle& style);
    void rectangle(const Vector<2>& corner, double width, double height, const SvgStyle& style);
    void circle(const Vector<2>& centre, double radius, const SvgStyle& style);
    void text(const Vector<2>& at, std::string_view content, const SvgText& style);

    /// Defines a fill of parallel slanted strokes, used as fill `url(#name)`.
    void defineHatch(std::string_view name, std::string_view colour, double spacing);
    /// Shapes between begin and end are clipped at the rectangle.
    void beginClip(std::string_view name, const Vector<2>& corner, double width, double height);
    void endClip();

    /// The whole document.
    std::string document() const;

private:
    void points(const std::vector<Vector<2>>& points);
    void run(const std::vector<Vector<2>>& points);
    void paint(const SvgStyle& style);

    double pageWidth;
    double pageHeight;
    std::string body;
};

/// Approximate width of a text in a sans-serif font [px], rather too large, because it is used to keep texts
/// apart.
double textWidth(std::string_view content, double size);

} // namespace drystone
