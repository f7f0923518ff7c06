// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Scalable vector graphics; pugixml reads the XML.
#include "import/Drawing.h"
#include "import/SvgAppearance.h"
#include "import/SvgOutlines.h"
#include "import/SvgTransform.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>

namespace drystone
{

namespace
{

class SvgReader
{
public:
    explicit SvgReader(const ImportedFile& source) : file(source) {}

    Drawing read()
    {
        pugi::xml_document document;
        const pugi::xml_parse_result result =
            document.load_buffer(file.bytes.data(), file.bytes.size(), pugi::parse_default);
        if (!result)
        {
            refuse(file, lineAt(result.offset), fmt::format("This is no SVG: {}.", result.description()));
        }
        const pugi::xml_node root = document.child("svg");
        if (!root)
        {
            refuse(file, 0, "This is no SVG: it has no element `svg`.");
        }
        // y points downwards in SVG.
        SvgTransform upwards;
        upwards.matrix(1, 1) = -readUnit(root);
        readChildren(root, upwards);
        for (const auto& [name, count] : others)
        {
            drawing.ignored.push_back(fmt::format("{} elements {}", count, name));
        }
        if (hidden > 0)
        {
            drawing.ignored.push_back(fmt::format("{} shapes that are hidden (display, visibility)", hidden));
        }
        drawing.rounding = largestFactor * digits.unit();
        return std::move(drawing);
    }

private:
    static constexpr double pixel = 0.0254 / 96; ///< of CSS [m]: what a unit of the file is within it

    enum class PixelIs
    {
        length,
        noLength
    };

    int lineAt(std::ptrdiff_t offset)
    {
        // Elements come in the order of the file, so that lines are counted once.
        const auto to = static_cast<std::size_t>(
            std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(file.bytes.size())));
        if (to < counted)
        {
            counted = 0;
            lines = 1;
        }
        lines += static_cast<int>(std::count(file.bytes.begin() + static_cast<std::ptrdiff_t>(counted),
                                             file.bytes.begin() + static_cast<std::ptrdiff_t>(to), '\n'));
        counted = to;
        return lines;
    }

    /// A length in metres; nothing where it has no unit of the world, or is a part of something.
    std::optional<double> lengthOf(std::string_view text, int line, PixelIs pixelIs) const
    {
        text = trimmed(text);
        using Unit = std::pair<std::string_view, double>;
        for (const auto& [ending, metres] : {Unit{"mm", 0.001}, Unit{"cm", 0.01}, Unit{"in", 0.0254},
                                             Unit{"m", 1}, Unit{"pt", 0.0254 / 72}, Unit{"pc", 0.0254 / 6}})
        {
            const std::string_view number =
                trimmed(text.substr(0, text.size() - std::min(text.size(), ending.size())));
            // `60em` and `5vmin` are no metres and inches.
            const bool isWhole =
                !number.empty() && std::string_view("0123456789.").find(number.back()) != number.npos;
            if (text.ends_with(ending) && isWhole)
            {
                return metres * numberOf(file, line, number);
            }
        }
        const bool isNumber = !text.empty() && text.back() >= '0' && text.back() <= '9';
        if (pixelIs == PixelIs::noLength || !(isNumber || text.ends_with("px")))
        {
            return {};
        }
        return pixel * numberOf(file, line, trimmed(isNumber ? text : text.substr(0, text.size() - 2)));
    }

    /// Metres a unit: of width="120mm" height="60mm" and viewBox="0 0 120 60". Where they have other shapes
    /// preserveAspectRatio decides. \return height over width of what is a square in the file
    double readUnit(const pugi::xml_node& root)
    {
        const std::string_view box = root.attribute("viewBox").value();
        const int line = lineAt(root.offset_debug());
        const std::optional<double> width =
            lengthOf(root.attribute("width").value(), line, PixelIs::noLength);
        if (box.empty() || !width)
        {
            return 1;
        }
        SvgScanner scanner(file, line, box);
        scanner.number();
        scanner.number();
        const double columns = scanner.number();
        const double rows = scanner.number();
        const std::optional<double> height =
            lengthOf(root.attribute("height").value(), line, PixelIs::length);
        if (!(*width > 0 && columns > 0 && rows > 0 && height.value_or(1) > 0))
        {
            refuse(file, line, "width, height and viewBox give no size of the drawing.");
        }
        const double x = *width / columns;
        const double y = height ? *height / rows : x; // without one it is as the width
        const std::string_view fit = root.attribute("preserveAspectRatio").value();
        if (trimmed(fit) == "none")
        {
            drawing.unit = x;
            return y / x;
        }
        drawing.unit = fit.find("slice") != fit.npos ? std::max(x, y) : std::min(x, y);
        return 1;
    }

    static SvgVisibility visibilityOf(const pugi::xml_node& node)
    {
        return {node.attribute("display").value(), node.attribute("visibility").value(),
                node.attribute("style").value()};
    }

    /// What a group says of the elements within, and which of them is next.
    struct Level
    {
        pugi::xml_node next;
        SvgTransform transform;
        std::string layer; ///< name of the outermost group that has one
        SvgAppearance appearance;
    };

    /// Without recursion: a hostile file may nest deeper than the stack is.
    void readChildren(const pugi::xml_node& root, const SvgTransform& upwards)
    {
        std::vector<Level> levels{{root.first_child(), upwards, "", SvgAppearance().of(visibilityOf(root))}};
        while (!levels.empty())
        {
            const pugi::xml_node node = levels.back().next;
            if (!node)
            {
                levels.pop_back();
                continue;
            }
            levels.back().next = node.next_sibling();
            if (node.type() == pugi::node_element)
            {
                readElement(node, levels);
            }
        }
    }

    /// \param levels of the groups around the element; a group is added to them
    void readElement(const pugi::xml_node& node, std::vector<Level>& levels)
    {
        const Level& around = levels.back();
        const std::string_view name = node.name();
        const int line = lineAt(node.offset_debug());
        const bool isGroup = name == "g" || name == "a" || name == "switch";
        const bool isShape = name == "path" || name == "polygon" || name == "polyline" || name == "rect";
        if (!isGroup && !isShape)
        {
            countOther(node);
            return;
        }
        const SvgAppearance appearance = around.appearance.of(visibilityOf(node));
        if (isShape && !appearance.isSeen())
        {
            ++hidden;
            return;
        }
        const std::string_view moved = styleProperty(node.attribute("style").value(), "transform");
        if (appearance.isDisplayed && !moved.empty() && moved != "none")
        {
            refuse(file, line,
                   "The style of this element has a transform, which is not read here: write it as an "
                   "attribute, `transform=\"...\"`, without units.");
        }
        const SvgTransform transform =
            around.transform * svgTransform(SvgScanner(file, line, node.attribute("transform").value()));
        if (isShape)
        {
            readShape(node, transform, around.layer, line);
            return;
        }
        constexpr std::size_t deepest = 200;
        if (levels.size() >= deepest)
        {
            refuse(file, line, fmt::format("Groups are nested deeper than {} levels.", deepest));
        }
        std::string layer = around.layer.empty() ? nameOf(node) : around.layer;
        levels.push_back({node.first_child(), transform, std::move(layer), appearance});
    }

    /// Of a group: the one that Inkscape shows, or else its identifier; empty where it has none.
    static std::string nameOf(const pugi::xml_node& group)
    {
        return group.attribute("inkscape:label") ? group.attribute("inkscape:label").value()
                                                 : group.attribute("id").value();
    }

    /// An element that is no outline, for the report of what was ignored.
    void countOther(const pugi::xml_node& node)
    {
        const std::string_view name = node.name();
        const std::string_view sheet = name == "style" ? node.text().get() : "";
        const auto says = [&](std::string_view property) { return sheet.find(property) != sheet.npos; };
        if (says("display") || says("visibility"))
        {
            ++others["style, whose `display` and `visibility` are not read"];
        }
        if (says("transform"))
        {
            ++others["style, whose `transform` is not read"];
        }
        constexpr std::size_t mostNames = 100;
        static constexpr std::array<std::string_view, 6> silent{"title",    "desc",  "defs",
                                                                "metadata", "style", "sodipodi:namedview"};
        if (std::find(silent.begin(), silent.end(), name) == silent.end())
        {
            const std::string known = shown(name);
            ++others[others.size() < mostNames || others.contains(known) ? known : "of other names"];
        }
    }

    /// A radius of the corners of a rectangle, in whatever unit; nothing where there is none.
    static std::optional<double> radiusOf(const pugi::xml_node& node, const char* name)
    {
        const std::string_view text = trimmed(node.attribute(name).value());
        const std::string_view plain = text.substr(text.starts_with('+') ? 1 : 0);
        double value = 0;
        const bool isRadius =
            std::from_chars(plain.data(), plain.data() + plain.size(), value).ec == std::errc();
        return isRadius ? std::optional(value) : std::nullopt; // auto
    }

    void readShape(const pugi::xml_node& node, const SvgTransform& transform, const std::string& layer,
                   int line)
    {
        const std::string_view name = node.name();
        SvgOutlines outlines;
        if (name == "rect")
        {
            outlines.closed.push_back(rectangleOf(node, line));
        }
        else if (name == "path")
        {
            outlines = svgPath(SvgScanner(file, line, node.attribute("d").value()), digits);
        }
        else
        {
            Polygon corners = svgPoints(SvgScanner(file, line, node.attribute("points").value()), digits);
            if (name == "polyline" && !endsMeet(corners))
            {
                ++outlines.open;
                outlines.openOfThree += corners.size() > 2 ? 1 : 0;
            }
            else
            {
                outlines.closed.push_back(std::move(corners));
            }
        }
        if (outlines.open > 0)
        {
            others[fmt::format("{} that is open", name)] += outlines.open;
            drawing.open.insert(drawing.open.end(), static_cast<std::size_t>(outlines.openOfThree),
                                {{}, layer, line});
        }
        for (Polygon& corners : outlines.closed)
        {
            add(std::move(corners), transform, layer, line);
        }
    }

    Polygon rectangleOf(const pugi::xml_node& node, int line)
    {
        const double x = coordinateOf(node, "x", line);
        const double y = coordinateOf(node, "y", line);
        const double width = coordinateOf(node, "width", line);
        const double height = coordinateOf(node, "height", line);
        if (width < 0 || height < 0)
        {
            refuse(file, line, "The width and height of a rectangle are not negative.");
        }
        // One of the radii alone counts for both.
        const double rx = radiusOf(node, "rx").value_or(radiusOf(node, "ry").value_or(0));
        const double ry = radiusOf(node, "ry").value_or(rx);
        if (rx > 0 && ry > 0)
        {
            refuse(file, line,
                   "The rectangle has round corners, rx and ry: blocks have straight edges. Set rx and "
                   "ry to 0, or convert it to a path of lines in the program that drew it.");
        }
        return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
    }

    /// An attribute of a rectangle in units of the file; 0 where it has none.
    double coordinateOf(const pugi::xml_node& node, const char* key, int line)
    {
        const std::string_view text = trimmed(node.attribute(key).value());
        if (text.empty())
        {
            return 0;
        }
        if (const std::optional<double> length = lengthOf(text, line, PixelIs::noLength))
        {
            return *length / pixel;
        }
        const std::string_view number = trimmed(text.substr(0, text.size() - (text.ends_with("px") ? 2 : 0)));
        digits.add(number);
        return numberOf(file, line, number);
    }

    void add(Polygon corners, const SvgTransform& transform, const std::string& layer, int line)
    {
        for (Vector<2>& corner : corners)
        {
            corner = transform.matrix * corner + transform.shift;
        }
        largestFactor = std::max(largestFactor, transform.matrix.colwise().norm().maxCoeff());
        drawing.outlines.push_back({std::move(corners), layer, line});
    }

    const ImportedFile& file;
    std::size_t counted = 0; ///< bytes whose line ends are counted
    int lines = 1;
    std::map<std::string, int> others;
    int hidden = 0;           ///< shapes
    double largestFactor = 0; ///< by which transforms scale an outline
    DigitCount digits;
    Drawing drawing;
};

} // namespace

Drawing readSvg(const ImportedFile& file)
{
    return SvgReader(file).read();
}

} // namespace drystone
