// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A drawing as plain data, the common base of pictures and plots: shapes and text in pixels, y downwards.
/// SvgText.h writes it as SVG, CairoPicture.h as PNG and PDF.
#pragma once

#include "geometry/Polygon.h"

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace drystone
{

/// How a shape is painted. Colours are `#rrggbb` or `none`; a fill may be `url(#name)` of a hatch.
struct ShapeStyle
{
    std::string fill = "none";
    std::string stroke = "none";
    double strokeWidth = 1;
    std::vector<double> dash = {}; ///< lengths of dashes and gaps in turn [px]; solid when empty
    double opacity = 1;
};

enum class TextAnchor
{
    start,
    middle,
    end
};

struct TextStyle
{
    double size = 13; ///< [px]
    TextAnchor anchor = TextAnchor::start;
    std::string fill = "#222222";
    double rotation = 0;     ///< clockwise about the anchor [degrees]
    std::string weight = ""; ///< `bold`, or normal when empty
};

/// Points joined by lines: one path, or many of one style as one shape.
struct CanvasPath
{
    enum class Kind
    {
        polygon,
        polyline, ///< with round corners
        line,
        polygons, ///< many: coordinates may be rounded to 0.1 px
        lines     ///< likewise
    };
    Kind kind = Kind::polygon;
    std::vector<std::vector<Vector<2>>> pieces;
    ShapeStyle style;
};

struct CanvasRectangle
{
    Vector<2> corner = Vector<2>::Zero(); ///< upper left
    double width = 0;
    double height = 0;
    ShapeStyle style;
};

struct CanvasCircle
{
    Vector<2> centre = Vector<2>::Zero();
    double radius = 0;
    ShapeStyle style;
};

struct CanvasText
{
    Vector<2> at = Vector<2>::Zero(); ///< on the base line
    std::string content;
    TextStyle style;
};

/// A fill of parallel slanted strokes with a name.
struct CanvasHatch
{
    std::string name;
    std::string colour;
    double spacing = 0;
};

/// What follows is clipped at the rectangle, up to CanvasClipEnd.
struct CanvasClip
{
    std::string name;
    Vector<2> corner = Vector<2>::Zero();
    double width = 0;
    double height = 0;
};

struct CanvasClipEnd
{
};

using CanvasShape = std::variant<CanvasPath, CanvasRectangle, CanvasCircle, CanvasText, CanvasHatch,
                                 CanvasClip, CanvasClipEnd>;

/// Shapes in drawing order on a white page. Every function throws FatalError on a coordinate that is not
/// finite, so that no unreadable picture is written.
struct Canvas
{
    Canvas(double pageWidth, double pageHeight);

    void polygon(std::vector<Vector<2>> points, const ShapeStyle& style);
    void polyline(std::vector<Vector<2>> points, const ShapeStyle& style);
    void line(const Vector<2>& from, const Vector<2>& to, const ShapeStyle& style);
    /// Many polygons, or many lines, of one style as one shape, which makes small files.
    void polygons(std::vector<std::vector<Vector<2>>> outlines, const ShapeStyle& style);
    void lines(const std::vector<std::pair<Vector<2>, Vector<2>>>& ends, const ShapeStyle& style);
    void rectangle(const Vector<2>& corner, double width, double height, const ShapeStyle& style);
    void circle(const Vector<2>& centre, double radius, const ShapeStyle& style);
    void text(const Vector<2>& at, std::string_view content, const TextStyle& style);
    /// A text that is no longer than a room [px], see fittedText.
    void textWithin(double room, const Vector<2>& at, std::string_view content, TextStyle style);

    /// Defines a hatch, used as fill `url(#name)`.
    void defineHatch(std::string_view name, std::string_view colour, double spacing);
    /// Shapes between begin and end are clipped at the rectangle.
    void beginClip(std::string_view name, const Vector<2>& corner, double width, double height);
    void endClip();

    double width;  ///< [px]
    double height; ///< [px]
    std::vector<CanvasShape> shapes;
};

/// Approximate width of a text in a sans-serif font [px], rather too large, because it is used to keep texts
/// apart.
double textWidth(std::string_view content, double size);

/// A text made to fit.
struct FittedText
{
    std::string content;
    double size = 0; ///< [px]
};
/// A text in letters of this size, or where it is longer than the room in smaller ones; what does not fit
/// with the smallest that can be read is left out, with `...` in its place.
FittedText fittedText(std::string_view content, double size, double room);

} // namespace drystone
