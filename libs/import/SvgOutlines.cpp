// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The commands of paths that draw straight lines: SVG 1.1, sections 8.3.2 to 8.3.4.
#include "import/SvgOutlines.h"

#include <fmt/format.h>

namespace drystone
{
namespace
{

/// A pen that draws the outlines of one path.
class SvgPen
{
public:
    SvgPen(SvgScanner& path, DigitCount& digitsOfFile) : scanner(path), digits(digitsOfFile) {}

    /// One command with its numbers. \return the command that further numbers belong to
    char draw(char command)
    {
        const bool isRelative = command >= 'a' && command <= 'z';
        const Vector<2> origin = isRelative ? place : Vector<2>::Zero();
        switch (isRelative ? static_cast<char>(command - 'a' + 'A') : command)
        {
        case 'M':
            end();
            place = start = point(origin);
            corners.push_back(place);
            return isRelative ? 'l' : 'L';
        case 'L':
            lineTo(point(origin));
            break;
        case 'H':
            lineTo({origin.x() + scanner.number(&digits), place.y()});
            break;
        case 'V':
            lineTo({place.x(), origin.y() + scanner.number(&digits)});
            break;
        case 'Z':
            close();
            break;
        default:
            scanner.fail(
                fmt::format("The path has the command `{}`: blocks have straight edges, paths of M, L, H, "
                            "V and Z. Convert its curves to lines in the program that drew them.",
                            shown(std::string_view(&command, 1))));
        }
        return command;
    }

    /// What has been drawn and not closed, if anything, is an outline where its ends meet.
    void end()
    {
        if (corners.size() > 1 && !endsMeet(corners))
        {
            ++outlines.open;
            outlines.openOfThree += corners.size() > 2 ? 1 : 0;
            corners.clear();
        }
        takeOutline();
    }

    SvgOutlines outlines;

private:
    Vector<2> point(const Vector<2>& origin)
    {
        const double x = scanner.number(&digits);
        return origin + Vector<2>(x, scanner.number(&digits));
    }

    void lineTo(const Vector<2>& to)
    {
        if (corners.empty())
        {
            corners.push_back(place); // goes on where the last outline was closed
        }
        place = to;
        corners.push_back(to);
    }

    void close()
    {
        takeOutline();
        place = start;
        if (scanner.isNumber())
        {
            scanner.fail("Numbers follow the `Z` of a path.");
        }
    }

    void takeOutline()
    {
        if (corners.size() > 1)
        {
            outlines.closed.push_back(corners);
        }
        corners.clear();
    }

    SvgScanner& scanner;
    DigitCount& digits;
    Polygon corners;
    Vector<2> place = Vector<2>::Zero();
    Vector<2> start = Vector<2>::Zero(); ///< of the outline
};

} // namespace

bool endsMeet(const Polygon& corners)
{
    return corners.size() > 3 && corners.front() == corners.back();
}

Polygon svgPoints(SvgScanner points, DigitCount& digits)
{
    Polygon corners;
    while (!points.isEnd())
    {
        const double x = points.number(&digits);
        corners.emplace_back(x, points.number(&digits));
    }
    return corners;
}

SvgOutlines svgPath(SvgScanner path, DigitCount& digits)
{
    SvgPen pen(path, digits);
    char command = '\0';
    while (!path.isEnd())
    {
        if (!path.isNumber())
        {
            command = path.letter();
        }
        else if (command == '\0')
        {
            path.fail("A path begins with a command, as `M`.");
        }
        command = pen.draw(command);
    }
    pen.end();
    return std::move(pen.outlines);
}

} // namespace drystone
