// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Paints the shapes of a drawing with cairo, as SvgText.cpp writes them for other programs to paint.
#include "io/CairoPicture.h"

#include "core/Error.h"

#include <cairo-pdf.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <vector>

namespace drystone
{

namespace
{

struct DestroySurface
{
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using Surface = std::unique_ptr<cairo_surface_t, DestroySurface>;

struct DestroyContext
{
    void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Context = std::unique_ptr<cairo_t, DestroyContext>;

void requireSuccess(cairo_status_t status)
{
    if (status != CAIRO_STATUS_SUCCESS)
    {
        throw FatalError(
            fmt::format("A picture cannot be drawn: {} (cairo).", cairo_status_to_string(status)));
    }
}

/// Red, green and blue of `#rrggbb`, each from 0 to 1.
std::array<double, 3> rgbOf(const std::string& colour)
{
    std::array<double, 3> rgb{};
    if (colour.size() != 7 || colour.front() != '#'
        || colour.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
    {
        throw FatalError(fmt::format("A picture has the colour '{}': only #rrggbb can be drawn.", colour));
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
        rgb[i] = std::stoi(colour.substr(1 + 2 * i, 2), nullptr, 16) / 255.0;
    }
    return rgb;
}

/// Paints shapes one after the other.
struct CairoPainter
{
    cairo_t* context;
    std::map<std::string, CanvasHatch> hatches = {};

    void operator()(const CanvasPath& path);
    void operator()(const CanvasRectangle& rectangle);
    void operator()(const CanvasCircle& circle);
    void operator()(const CanvasText& label) const;
    void operator()(const CanvasHatch& hatch) { hatches[hatch.name] = hatch; }
    void operator()(const CanvasClip& clip) const;
    void operator()(const CanvasClipEnd&) const { cairo_restore(context); }

    void paint(const ShapeStyle& style);
    void fillWithHatch(const CanvasHatch& hatch) const;
    void setColour(const std::string& colour, double opacity) const;
};

void CairoPainter::setColour(const std::string& colour, double opacity) const
{
    const auto [red, green, blue] = rgbOf(colour);
    cairo_set_source_rgba(context, red, green, blue, opacity);
}

/// Stripes across the current path: of each line of the hatch the half that lies in its tile, as SVG cuts it.
void CairoPainter::fillWithHatch(const CanvasHatch& hatch) const
{
    constexpr double stripe = 0.8;
    cairo_save(context);
    cairo_clip_preserve(context);
    cairo_path_t* path = cairo_copy_path(context);
    cairo_rotate(context, std::numbers::pi / 4);
    double left = 0;
    double top = 0;
    double right = 0;
    double bottom = 0;
    cairo_clip_extents(context, &left, &top, &right, &bottom);
    cairo_new_path(context);
    for (double k = std::floor(left / hatch.spacing); k * hatch.spacing < right; ++k)
    {
        cairo_rectangle(context, k * hatch.spacing, top, stripe, bottom - top);
    }
    setColour(hatch.colour, 1);
    cairo_fill(context);
    cairo_restore(context);
    cairo_new_path(context);
    cairo_append_path(context, path);
    cairo_path_destroy(path);
}

/// Fills and strokes the current path, and ends it.
void CairoPainter::paint(const ShapeStyle& style)
{
    const bool isFilled = style.fill != "none";
    const bool isStroked = style.stroke != "none";
    // Where a stroke lies over a fill of its own, both are blended with what is below as one.
    const bool isGroup = style.opacity < 1 && isFilled && isStroked;
    const double opacity = isGroup ? 1 : style.opacity;
    if (isGroup)
    {
        cairo_path_t* path = cairo_copy_path(context);
        cairo_push_group(context);
        cairo_append_path(context, path);
        cairo_path_destroy(path);
    }
    if (isFilled && style.fill.starts_with("url(#"))
    {
        const auto hatch = hatches.find(style.fill.substr(5, style.fill.size() - 6));
        if (hatch == hatches.end())
        {
            throw FatalError(
                fmt::format("A picture has the fill '{}', which it does not define.", style.fill));
        }
        fillWithHatch(hatch->second);
    }
    else if (isFilled)
    {
        setColour(style.fill, opacity);
        cairo_fill_preserve(context);
    }
    if (isStroked)
    {
        setColour(style.stroke, opacity);
        cairo_set_line_width(context, style.strokeWidth);
        cairo_set_dash(context, style.dash.data(), static_cast<int>(style.dash.size()), 0);
        cairo_stroke_preserve(context);
    }
    cairo_new_path(context);
    if (isGroup)
    {
        cairo_pop_group_to_source(context);
        cairo_paint_with_alpha(context, style.opacity);
    }
}

void CairoPainter::operator()(const CanvasPath& path)
{
    const bool isClosed = path.kind == CanvasPath::Kind::polygon || path.kind == CanvasPath::Kind::polygons;
    for (const std::vector<Vector<2>>& piece : path.pieces)
    {
        cairo_new_sub_path(context);
        for (const Vector<2>& point : piece)
        {
            cairo_line_to(context, point.x(), point.y());
        }
        if (isClosed)
        {
            cairo_close_path(context);
        }
    }
    const bool isRound = path.kind == CanvasPath::Kind::polyline;
    cairo_set_line_join(context, isRound ? CAIRO_LINE_JOIN_ROUND : CAIRO_LINE_JOIN_MITER);
    paint(path.style);
}

void CairoPainter::operator()(const CanvasRectangle& rectangle)
{
    cairo_rectangle(context, rectangle.corner.x(), rectangle.corner.y(), rectangle.width, rectangle.height);
    paint(rectangle.style);
}

void CairoPainter::operator()(const CanvasCircle& circle)
{
    cairo_new_sub_path(context);
    cairo_arc(context, circle.centre.x(), circle.centre.y(), circle.radius, 0, 2 * std::numbers::pi);
    cairo_close_path(context);
    paint(circle.style);
}

/// Whether the font that is set has a glyph for each character.
bool hasAllGlyphs(cairo_t* context, const std::string& text)
{
    cairo_glyph_t* glyphs = nullptr;
    int count = 0;
    const cairo_status_t status = cairo_scaled_font_text_to_glyphs(
        cairo_get_scaled_font(context), 0, 0, text.c_str(), static_cast<int>(text.size()), &glyphs, &count,
        nullptr, nullptr, nullptr);
    const bool isComplete =
        status != CAIRO_STATUS_SUCCESS
        || std::all_of(glyphs, glyphs + count, [](const cairo_glyph_t& glyph) { return glyph.index != 0; });
    cairo_glyph_free(glyphs);
    return isComplete;
}

void CairoPainter::operator()(const CanvasText& label) const
{
    const TextStyle& style = label.style;
    std::string content = label.content; // control characters have no glyph, and are not in the SVG either
    std::erase_if(content, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
    cairo_save(context);
    cairo_translate(context, label.at.x(), label.at.y());
    cairo_rotate(context, style.rotation * std::numbers::pi / 180);
    cairo_set_font_size(context, style.size);
    // The second has superscripts and Greek letters, which many fonts have not.
    for (const char* family : {"Helvetica", "DejaVu Sans"})
    {
        cairo_select_font_face(context, family, CAIRO_FONT_SLANT_NORMAL,
                               style.weight == "bold" ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
        if (hasAllGlyphs(context, content))
        {
            break;
        }
    }
    cairo_text_extents_t extents;
    cairo_text_extents(context, content.c_str(), &extents);
    const double before = style.anchor == TextAnchor::start    ? 0
                          : style.anchor == TextAnchor::middle ? extents.x_advance / 2
                                                               : extents.x_advance;
    setColour(style.fill, 1);
    cairo_move_to(context, -before, 0);
    cairo_show_text(context, content.c_str());
    cairo_new_path(context);
    cairo_restore(context);
}

void CairoPainter::operator()(const CanvasClip& clip) const
{
    cairo_save(context);
    cairo_rectangle(context, clip.corner.x(), clip.corner.y(), clip.width, clip.height);
    cairo_clip(context);
}

/// Paints all shapes. \param scale units of the surface for a pixel of the drawing
void paintCanvas(cairo_surface_t* surface, const Canvas& canvas, double scale)
{
    requireSuccess(cairo_surface_status(surface));
    const Context context(cairo_create(surface));
    cairo_scale(context.get(), scale, scale);
    cairo_set_miter_limit(context.get(), 4); // SVG's
    // The last row and column of pixels may be part of the page only.
    cairo_set_source_rgb(context.get(), 1, 1, 1);
    cairo_paint(context.get());
    CairoPainter painter{context.get()};
    for (const CanvasShape& shape : canvas.shapes)
    {
        std::visit(painter, shape);
    }
    requireSuccess(cairo_status(context.get()));
}

/// Takes what cairo writes. \param content a std::string
cairo_status_t append(void* content, const unsigned char* bytes, unsigned int count)
{
    static_cast<std::string*>(content)->append(reinterpret_cast<const char*>(bytes), count);
    return CAIRO_STATUS_SUCCESS;
}

} // namespace

std::string pngContent(const Canvas& canvas)
{
    constexpr double scale = 2;
    const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                                     static_cast<int>(std::ceil(scale * canvas.width)),
                                                     static_cast<int>(std::ceil(scale * canvas.height))));
    paintCanvas(surface.get(), canvas, scale);
    std::string content;
    requireSuccess(cairo_surface_write_to_png_stream(surface.get(), append, &content));
    return content;
}

std::string pdfContent(const Canvas& canvas)
{
    constexpr double scale = 0.75; // 72 points are an inch
    std::string content;
    const Surface surface(
        cairo_pdf_surface_create_for_stream(append, &content, scale * canvas.width, scale * canvas.height));
    // Without the time at which it was made, so that results can be compared byte by byte.
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, nullptr);
    paintCanvas(surface.get(), canvas, scale);
    cairo_surface_finish(surface.get());
    requireSuccess(cairo_surface_status(surface.get()));
    return content;
}

} // namespace drystone
