// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of outlines.
#include "assembly/Outlines.h"

#include "geometry/PolygonShape.h"

#include <fmt/format.h>

#include <algorithm>

namespace drystone
{

void read(TokenCursor& cursor, Outlines& outlines)
{
    outlines = {};
    const TokenCursor::ListStart start = cursor.openList();
    while (!cursor.isNext(')'))
    {
        const TokenCursor beginning = cursor;
        Polygon polygon;
        read(cursor, polygon);
        const std::string fault = outlineFault(polygon);
        if (!fault.empty())
        {
            beginning.fail(fmt::format(
                "Outline {} {}.\n\nA block is a simple polygon: give its corners in their order round it.",
                outlines.polygons.size(), fault));
        }
        if (areaProperties(polygon).area < 0)
        {
            std::reverse(polygon.begin() + 1, polygon.end());
        }
        outlines.polygons.push_back(std::move(polygon));
        outlines.places.push_back(cursor.entry().locationOf(beginning.peek()));
    }
    cursor.closeList(start, outlines.polygons.size());
}

} // namespace drystone
