// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Scalable vector graphics; pugixml reads the XML.
#include "import/Drawing.h"
#include "import/SvgAppearance.h"
#include "import/SvgScanner.h"

#include <Eigen/LU>
#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace drystone
{

namespace
{

struct SvgTransform
{
    Eigen::Matrix2d matrix = Eigen::Matrix2d::Identity();
    Vector<2> shift = Vector<2>::Zero();
};

SvgTransform operator*(const SvgTransform& outer, const SvgTransform& inner)
{
    return {outer.matrix * inner.matrix, outer.matrix * inner.shift + outer.shift};
}

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

    /// Without recursion: a hostile file may nest deeper than the stack is.
    void readChildren(const pugi::xml_node& root, const SvgTransform& upwards)
    {
        struct Level
        {
            pugi::xml_node next;
            SvgTransform transform;
            std::string layer;
            SvgAppearance appearance;
        };
        std::vector<Level> levels{{root.first_child(), upwards, "", SvgAppearance().of(visibilityOf(root))}};
        constexpr std::size_t deepest = 200;
        while (!levels.empty())
        {
            Level& level = levels.back();
            const pugi::xml_node node = level.next;
            if (!node)
            {
                levels.pop_back();
                continue;
            }
            level.next = node.next_sibling();
            if (node.type() != pugi::node_element)
            {
                continue;
            }
            const std::string_view name = node.name();
            const int line = lineAt(node.offset_debug());
            const bool isGroup = name == "g" || name == "a" || name == "switch";
            const bool isShape = name == "path" || name == "polygon" || name == "polyline" || name == "rect";
            if (!isGroup && !isShape)
            {
                const std::string_view sheet = name == "style" ? node.text().get() : "";
                const auto says = [&](std::string_view property)
                { return sheet.find(property) != sheet.npos; };
                if (says("display") || says("visibility"))
                {
                    ++others["style, whose `display` and `visibility` are not read"];
                }
                if (says("transform"))
                {
                    ++others["style, whose `transform` is not read"];
                }
                constexpr std::size_t mostNames = 100;
                static constexpr std::array<std::string_view, 6> silent{
                    "title", "desc", "defs", "metadata", "style", "sodipodi:namedview"};
                if (std::find(silent.begin(), silent.end(), name) == silent.end())
                {
                    const std::string known = shown(name);
                    ++others[others.size() < mostNames || others.contains(known) ? known : "of other names"];
                }
                continue;
            }
            const SvgAppearance appearance = level.appearance.of(visibilityOf(node));
            if (isShape && !appearance.isSeen())
            {
                ++hidden;
                continue;
            }
            const std::string_view moved = styleProperty(node.attribute("style").value(), "transform");
            if (appearance.isDisplayed && !moved.empty() && moved != "none")
            {
                refuse(file, line,
                       "The style of this element has a transform, which is not read here: write it as an "
                       "attribute, `transform=\"...\"`, without units.");
            }
            const SvgTransform transform = level.transform * transformOf(node, line);
            if (isGroup)
            {
                if (levels.size() >= deepest)
                {
                    refuse(file, line, fmt::format("Groups are nested deeper than {} levels.", deepest));
                }
                std::string layer = level.layer;
                if (layer.empty())
                {
                    layer = node.attribute("inkscape:label") ? node.attribute("inkscape:label").value()
                                                             : node.attribute("id").value();
                }
                levels.push_back({node.first_child(), transform, std::move(layer), appearance});
            }
            else
            {
                readShape(node, transform, level.layer, line);
            }
        }
    }

    SvgTransform transformOf(const pugi::xml_node& node, int line) const
    {
        SvgTransform whole;
        SvgScanner scanner(file, line, node.attribute("transform").value());
        while (!scanner.isEnd())
        {
            const std::string_view name = scanner.word();
            if (scanner.letter() != '(')
            {
                scanner.fail(fmt::format("The transform `{}` has no `(`.", shown(name)));
            }
            std::vector<double> values;
            while (scanner.isNumber() && values.size() < 6)
            {
                values.push_back(scanner.number());
            }
            if (scanner.letter() != ')')
            {
                scanner.fail(fmt::format("The transform `{}` has no `)` after its numbers.", shown(name)));
            }
            const auto has = [&](std::string_view wanted, std::initializer_list<std::size_t> counts) {
                return name == wanted
                       && std::find(counts.begin(), counts.end(), values.size()) != counts.end();
            };
            SvgTransform one;
            if (has("matrix", {6}))
            {
                one.matrix << values[0], values[2], values[1], values[3];
                one.shift = {values[4], values[5]};
            }
            else if (has("translate", {1, 2}))
            {
                one.shift = {values[0], values.size() > 1 ? values[1] : 0};
            }
            else if (has("scale", {1, 2}))
            {
                one.matrix = Vector<2>(values[0], values.back()).asDiagonal();
            }
            else if (has("rotate", {1, 3}))
            {
                const double angle = values[0] * std::numbers::pi / 180;
                one.matrix << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
                const Vector<2> centre =
                    values.size() > 1 ? Vector<2>(values[1], values[2]) : Vector<2>::Zero();
                one.shift = centre - one.matrix * centre;
            }
            else if (has("skewX", {1}) || has("skewY", {1}))
            {
                one.matrix(name == "skewX" ? 0 : 1, name == "skewX" ? 1 : 0) =
                    std::tan(values[0] * std::numbers::pi / 180);
            }
            else
            {
                scanner.fail(fmt::format("The transform `{}` with {} numbers is not known.", shown(name),
                                         values.size()));
            }
            whole = whole * one;
        }
        return whole;
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
        if (name == "rect")
        {
            const auto value = [&](const char* key)
            {
                const std::string_view text = trimmed(node.attribute(key).value());
                if (text.empty())
                {
                    return 0.;
                }
                if (const std::optional<double> length = lengthOf(text, line, PixelIs::noLength))
                {
                    return *length / pixel;
                }
                const std::string_view number =
                    trimmed(text.substr(0, text.size() - (text.ends_with("px") ? 2 : 0)));
                digits.add(number);
                return numberOf(file, line, number);
            };
            const double x = value("x");
            const double y = value("y");
            const double width = value("width");
            const double height = value("height");
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
            add({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, transform, layer, line);
        }
        else if (name == "polygon" || name == "polyline")
        {
            SvgScanner scanner(file, line, node.attribute("points").value());
            Polygon corners;
            while (!scanner.isEnd())
            {
                const double x = scanner.number(&digits);
                corners.emplace_back(x, scanner.number(&digits));
            }
            if (name == "polyline" && !endsMeet(corners))
            {
                ++others["polyline that is open"];
                return;
            }
            add(std::move(corners), transform, layer, line);
        }
        else
        {
            readPath(SvgScanner(file, line, node.attribute("d").value()), transform, layer, line);
        }
    }

    static bool endsMeet(const Polygon& corners)
    {
        return corners.size() > 3 && corners.front() == corners.back();
    }

    void readPath(SvgScanner scanner, const SvgTransform& transform, const std::string& layer, int line)
    {
        Polygon corners;
        Vector<2> place = Vector<2>::Zero();
        Vector<2> start = Vector<2>::Zero();
        char command = '\0';
        const auto close = [&](bool isClosed)
        {
            if (corners.size() > 1 && !isClosed && !endsMeet(corners))
            {
                ++others["path that is open"];
            }
            else if (corners.size() > 1)
            {
                add(corners, transform, layer, line);
            }
            corners.clear();
        };
        const auto lineTo = [&](const Vector<2>& to)
        {
            if (corners.empty())
            {
                corners.push_back(place); // goes on where the last outline was closed
            }
            place = to;
            corners.push_back(to);
        };
        while (!scanner.isEnd())
        {
            if (!scanner.isNumber())
            {
                command = scanner.letter();
            }
            else if (command == '\0')
            {
                scanner.fail("A path begins with a command, as `M`.");
            }
            const bool isRelative = command >= 'a' && command <= 'z';
            const Vector<2> origin = isRelative ? place : Vector<2>::Zero();
            switch (isRelative ? static_cast<char>(command - 'a' + 'A') : command)
            {
            case 'M':
            {
                close(false);
                const double x = scanner.number(&digits);
                place = origin + Vector<2>(x, scanner.number(&digits));
                start = place;
                corners.push_back(place);
                command = isRelative ? 'l' : 'L'; // what further numbers are
                break;
            }
            case 'L':
            {
                const double x = scanner.number(&digits);
                lineTo(origin + Vector<2>(x, scanner.number(&digits)));
                break;
            }
            case 'H':
                lineTo({origin.x() + scanner.number(&digits), place.y()});
                break;
            case 'V':
                lineTo({place.x(), origin.y() + scanner.number(&digits)});
                break;
            case 'Z':
                close(true);
                place = start;
                if (scanner.isNumber())
                {
                    scanner.fail("Numbers follow the `Z` of a path.");
                }
                break;
            default:
                scanner.fail(fmt::format(
                    "The path has the command `{}`: blocks have straight edges, paths of M, L, H, "
                    "V and Z. Convert its curves to lines in the program that drew them.",
                    shown(std::string_view(&command, 1))));
            }
        }
        close(false);
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
