// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Paints the shapes of a drawing with cairo, as SvgText.cpp writes them for other programs to paint.
#include "io/CairoPicture.h"

#include "core/Error.h"
#include "core/LoadedLibrary.h"

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

/// The functions used here, by their names in cairo.h without the prefix. They are loaded when the first PNG
/// or PDF is drawn: cairo brings 19 libraries with it (X11, fontconfig, freetype), and to load them takes as
/// long as all else that a program does before it begins.
struct Cairo
{
    LoadedLibrary library{DRYSTONE_CAIRO_NAME, DRYSTONE_CAIRO_FOLDER};
    decltype(&::cairo_append_path) append_path = library.symbol("cairo_append_path");
    decltype(&::cairo_arc) arc = library.symbol("cairo_arc");
    decltype(&::cairo_clip) clip = library.symbol("cairo_clip");
    decltype(&::cairo_clip_extents) clip_extents = library.symbol("cairo_clip_extents");
    decltype(&::cairo_clip_preserve) clip_preserve = library.symbol("cairo_clip_preserve");
    decltype(&::cairo_close_path) close_path = library.symbol("cairo_close_path");
    decltype(&::cairo_copy_path) copy_path = library.symbol("cairo_copy_path");
    decltype(&::cairo_create) create = library.symbol("cairo_create");
    decltype(&::cairo_destroy) destroy = library.symbol("cairo_destroy");
    decltype(&::cairo_fill) fill = library.symbol("cairo_fill");
    decltype(&::cairo_fill_preserve) fill_preserve = library.symbol("cairo_fill_preserve");
    decltype(&::cairo_get_scaled_font) get_scaled_font = library.symbol("cairo_get_scaled_font");
    decltype(&::cairo_glyph_free) glyph_free = library.symbol("cairo_glyph_free");
    decltype(&::cairo_image_surface_create) image_surface_create =
        library.symbol("cairo_image_surface_create");
    decltype(&::cairo_line_to) line_to = library.symbol("cairo_line_to");
    decltype(&::cairo_move_to) move_to = library.symbol("cairo_move_to");
    decltype(&::cairo_new_path) new_path = library.symbol("cairo_new_path");
    decltype(&::cairo_new_sub_path) new_sub_path = library.symbol("cairo_new_sub_path");
    decltype(&::cairo_paint) paint = library.symbol("cairo_paint");
    decltype(&::cairo_paint_with_alpha) paint_with_alpha = library.symbol("cairo_paint_with_alpha");
    decltype(&::cairo_path_destroy) path_destroy = library.symbol("cairo_path_destroy");
    decltype(&::cairo_pdf_surface_create_for_stream) pdf_surface_create_for_stream =
        library.symbol("cairo_pdf_surface_create_for_stream");
    decltype(&::cairo_pdf_surface_set_metadata) pdf_surface_set_metadata =
        library.symbol("cairo_pdf_surface_set_metadata");
    decltype(&::cairo_pop_group_to_source) pop_group_to_source = library.symbol("cairo_pop_group_to_source");
    decltype(&::cairo_push_group) push_group = library.symbol("cairo_push_group");
    decltype(&::cairo_rectangle) rectangle = library.symbol("cairo_rectangle");
    decltype(&::cairo_restore) restore = library.symbol("cairo_restore");
    decltype(&::cairo_rotate) rotate = library.symbol("cairo_rotate");
    decltype(&::cairo_save) save = library.symbol("cairo_save");
    decltype(&::cairo_scale) scale = library.symbol("cairo_scale");
    decltype(&::cairo_scaled_font_text_to_glyphs) scaled_font_text_to_glyphs =
        library.symbol("cairo_scaled_font_text_to_glyphs");
    decltype(&::cairo_select_font_face) select_font_face = library.symbol("cairo_select_font_face");
    decltype(&::cairo_set_dash) set_dash = library.symbol("cairo_set_dash");
    decltype(&::cairo_set_font_size) set_font_size = library.symbol("cairo_set_font_size");
    decltype(&::cairo_set_line_join) set_line_join = library.symbol("cairo_set_line_join");
    decltype(&::cairo_set_line_width) set_line_width = library.symbol("cairo_set_line_width");
    decltype(&::cairo_set_miter_limit) set_miter_limit = library.symbol("cairo_set_miter_limit");
    decltype(&::cairo_set_source_rgb) set_source_rgb = library.symbol("cairo_set_source_rgb");
    decltype(&::cairo_set_source_rgba) set_source_rgba = library.symbol("cairo_set_source_rgba");
    decltype(&::cairo_show_text) show_text = library.symbol("cairo_show_text");
    decltype(&::cairo_status) status = library.symbol("cairo_status");
    decltype(&::cairo_status_to_string) status_to_string = library.symbol("cairo_status_to_string");
    decltype(&::cairo_stroke_preserve) stroke_preserve = library.symbol("cairo_stroke_preserve");
    decltype(&::cairo_surface_destroy) surface_destroy = library.symbol("cairo_surface_destroy");
    decltype(&::cairo_surface_finish) surface_finish = library.symbol("cairo_surface_finish");
    decltype(&::cairo_surface_status) surface_status = library.symbol("cairo_surface_status");
    decltype(&::cairo_surface_write_to_png_stream) surface_write_to_png_stream =
        library.symbol("cairo_surface_write_to_png_stream");
    decltype(&::cairo_text_extents) text_extents = library.symbol("cairo_text_extents");
    decltype(&::cairo_translate) translate = library.symbol("cairo_translate");
};

const Cairo& cairo()
{
    try
    {
        static const Cairo functions;
        return functions;
    }
    catch (const FatalError& error)
    {
        throw FatalError(
            fmt::format("PNG and PDF pictures are drawn by cairo. {}\n\nInstall it (Debian: libcairo2), "
                        "or write SVG alone: `pictureFormats (svg);` in system/controlDict.",
                        error.what()));
    }
}

struct DestroySurface
{
    void operator()(cairo_surface_t* surface) const { cairo().surface_destroy(surface); }
};
using Surface = std::unique_ptr<cairo_surface_t, DestroySurface>;

struct DestroyContext
{
    void operator()(cairo_t* context) const { cairo().destroy(context); }
};
using Context = std::unique_ptr<cairo_t, DestroyContext>;

void requireSuccess(cairo_status_t status)
{
    if (status != CAIRO_STATUS_SUCCESS)
    {
        throw FatalError(
            fmt::format("A picture cannot be drawn: {} (cairo).", cairo().status_to_string(status)));
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
    void operator()(const CanvasClipEnd&) const { cairo().restore(context); }

    void paint(const ShapeStyle& style);
    void fillWithHatch(const CanvasHatch& hatch) const;
    void setColour(const std::string& colour, double opacity) const;
};

void CairoPainter::setColour(const std::string& colour, double opacity) const
{
    const auto [red, green, blue] = rgbOf(colour);
    cairo().set_source_rgba(context, red, green, blue, opacity);
}

/// Stripes across the current path: of each line of the hatch the half that lies in its tile, as SVG cuts it.
void CairoPainter::fillWithHatch(const CanvasHatch& hatch) const
{
    constexpr double stripe = 0.8;
    cairo().save(context);
    cairo().clip_preserve(context);
    cairo_path_t* path = cairo().copy_path(context);
    cairo().rotate(context, std::numbers::pi / 4);
    double left = 0;
    double top = 0;
    double right = 0;
    double bottom = 0;
    cairo().clip_extents(context, &left, &top, &right, &bottom);
    cairo().new_path(context);
    for (double k = std::floor(left / hatch.spacing); k * hatch.spacing < right; ++k)
    {
        cairo().rectangle(context, k * hatch.spacing, top, stripe, bottom - top);
    }
    setColour(hatch.colour, 1);
    cairo().fill(context);
    cairo().restore(context);
    cairo().new_path(context);
    cairo().append_path(context, path);
    cairo().path_destroy(path);
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
        cairo_path_t* path = cairo().copy_path(context);
        cairo().push_group(context);
        cairo().append_path(context, path);
        cairo().path_destroy(path);
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
        cairo().fill_preserve(context);
    }
    if (isStroked)
    {
        setColour(style.stroke, opacity);
        cairo().set_line_width(context, style.strokeWidth);
        cairo().set_dash(context, style.dash.data(), static_cast<int>(style.dash.size()), 0);
        cairo().stroke_preserve(context);
    }
    cairo().new_path(context);
    if (isGroup)
    {
        cairo().pop_group_to_source(context);
        cairo().paint_with_alpha(context, style.opacity);
    }
}

void CairoPainter::operator()(const CanvasPath& path)
{
    const bool isClosed = path.kind == CanvasPath::Kind::polygon || path.kind == CanvasPath::Kind::polygons;
    for (const std::vector<Vector<2>>& piece : path.pieces)
    {
        cairo().new_sub_path(context);
        for (const Vector<2>& point : piece)
        {
            cairo().line_to(context, point.x(), point.y());
        }
        if (isClosed)
        {
            cairo().close_path(context);
        }
    }
    const bool isRound = path.kind == CanvasPath::Kind::polyline;
    cairo().set_line_join(context, isRound ? CAIRO_LINE_JOIN_ROUND : CAIRO_LINE_JOIN_MITER);
    paint(path.style);
}

void CairoPainter::operator()(const CanvasRectangle& rectangle)
{
    cairo().rectangle(context, rectangle.corner.x(), rectangle.corner.y(), rectangle.width, rectangle.height);
    paint(rectangle.style);
}

void CairoPainter::operator()(const CanvasCircle& circle)
{
    cairo().new_sub_path(context);
    cairo().arc(context, circle.centre.x(), circle.centre.y(), circle.radius, 0, 2 * std::numbers::pi);
    cairo().close_path(context);
    paint(circle.style);
}

/// Whether the font that is set has a glyph for each character.
bool hasAllGlyphs(cairo_t* context, const std::string& text)
{
    cairo_glyph_t* glyphs = nullptr;
    int count = 0;
    const cairo_status_t status = cairo().scaled_font_text_to_glyphs(
        cairo().get_scaled_font(context), 0, 0, text.c_str(), static_cast<int>(text.size()), &glyphs, &count,
        nullptr, nullptr, nullptr);
    const bool isComplete =
        status != CAIRO_STATUS_SUCCESS
        || std::all_of(glyphs, glyphs + count, [](const cairo_glyph_t& glyph) { return glyph.index != 0; });
    cairo().glyph_free(glyphs);
    return isComplete;
}

void CairoPainter::operator()(const CanvasText& label) const
{
    const TextStyle& style = label.style;
    std::string content = label.content; // control characters have no glyph, and are not in the SVG either
    std::erase_if(content, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
    cairo().save(context);
    cairo().translate(context, label.at.x(), label.at.y());
    cairo().rotate(context, style.rotation * std::numbers::pi / 180);
    cairo().set_font_size(context, style.size);
    // The second has superscripts and Greek letters, which many fonts have not.
    for (const char* family : {"Helvetica", "DejaVu Sans"})
    {
        cairo().select_font_face(context, family, CAIRO_FONT_SLANT_NORMAL,
                                 style.weight == "bold" ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
        if (hasAllGlyphs(context, content))
        {
            break;
        }
    }
    cairo_text_extents_t extents;
    cairo().text_extents(context, content.c_str(), &extents);
    const double before = style.anchor == TextAnchor::start    ? 0
                          : style.anchor == TextAnchor::middle ? extents.x_advance / 2
                                                               : extents.x_advance;
    setColour(style.fill, 1);
    cairo().move_to(context, -before, 0);
    cairo().show_text(context, content.c_str());
    cairo().new_path(context);
    cairo().restore(context);
}

void CairoPainter::operator()(const CanvasClip& clip) const
{
    cairo().save(context);
    cairo().rectangle(context, clip.corner.x(), clip.corner.y(), clip.width, clip.height);
    cairo().clip(context);
}

/// Paints all shapes. \param scale units of the surface for a pixel of the drawing
void paintCanvas(cairo_surface_t* surface, const Canvas& canvas, double scale)
{
    requireSuccess(cairo().surface_status(surface));
    const Context context(cairo().create(surface));
    cairo().scale(context.get(), scale, scale);
    cairo().set_miter_limit(context.get(), 4); // SVG's
    // The last row and column of pixels may be part of the page only.
    cairo().set_source_rgb(context.get(), 1, 1, 1);
    cairo().paint(context.get());
    CairoPainter painter{context.get()};
    for (const CanvasShape& shape : canvas.shapes)
    {
        std::visit(painter, shape);
    }
    requireSuccess(cairo().status(context.get()));
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
    const Surface surface(cairo().image_surface_create(CAIRO_FORMAT_RGB24,
                                                       static_cast<int>(std::ceil(scale * canvas.width)),
                                                       static_cast<int>(std::ceil(scale * canvas.height))));
    paintCanvas(surface.get(), canvas, scale);
    std::string content;
    requireSuccess(cairo().surface_write_to_png_stream(surface.get(), append, &content));
    return content;
}

std::string pdfContent(const Canvas& canvas)
{
    constexpr double scale = 0.75; // 72 points are an inch
    std::string content;
    const Surface surface(
        cairo().pdf_surface_create_for_stream(append, &content, scale * canvas.width, scale * canvas.height));
    // Without the time at which it was made, so that results can be compared byte by byte.
    cairo().pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, nullptr);
    paintCanvas(surface.get(), canvas, scale);
    cairo().surface_finish(surface.get());
    requireSuccess(cairo().surface_status(surface.get()));
    return content;
}

} // namespace drystone
