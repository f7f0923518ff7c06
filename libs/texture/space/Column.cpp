// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `column` from its settings.
#include "texture/space/Column.h"

#include "texture/Limits.h"
#include "texture/space/Ring.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace drystone
{

namespace
{

/// The axes at both ends of a row of columns, whatever the order in which they are given.
std::pair<Vector<2>, Vector<2>> endsOf(const std::vector<Vector<2>>& row)
{
    const auto farthestFrom = [&row](const Vector<2>& place)
    {
        return *std::max_element(row.begin(), row.end(),
                                 [&place](const Vector<2>& a, const Vector<2>& b)
                                 { return (a - place).norm() < (b - place).norm(); });
    };
    const Vector<2> one = farthestFrom(row.front());
    const Vector<2> other = farthestFrom(one);
    const bool isForward = std::pair(one.x(), one.y()) < std::pair(other.x(), other.y());
    return isForward ? std::pair(one, other) : std::pair(other, one);
}

} // namespace

void declare(Options& options, Architrave& architrave)
{
    options.required("width", architrave.width, "across the row of columns")
        .unit("m")
        .above(0)
        .example("0.6");
    options.required("height", architrave.height, "of the beam").unit("m").above(0).example("0.5");
    options.optional("overhang", architrave.overhang, "past the axes of the outermost columns")
        .unit("m")
        .atLeast(0);
}

void declare(Options& options, Column& column)
{
    options.required("radius", column.radius, "of the corners at the foot").unit("m").above(0).example("0.3");
    options.optional("sides", column.sides, "of its section; one of them faces along x")
        .atLeast(3)
        .atMost(1000);
    options.required("drums", column.drums, "of each column")
        .atLeast(1)
        .atMost(maximumBlocks / 1000)
        .example("5");
    options.required("drumHeight", column.drumHeight, "of each").unit("m").above(0).example("0.4");
    options.optional("taper", column.taper, "by which part the radius is smaller at the top than at the foot")
        .atLeast(0)
        .below(1);
    options.optional("at", column.at, "axes of the columns in plan").unit("m");
    options.optional("architrave", column.architrave,
                     "one beam over all columns, at least two, which stand in one line; absent: none");
    options.check("at",
                  [&column]
                  {
                      return countFault(
                          static_cast<double>(column.at.size()) * column.drums,
                          fmt::format("A row of {} columns of {} drums", column.at.size(), column.drums));
                  });
    options.check("at",
                  [&column]() -> std::string
                  {
                      if (column.at.empty())
                      {
                          return "There is no column: give the place of one at least, as ((0 0)).";
                      }
                      if (!column.architrave)
                      {
                          return {};
                      }
                      const auto [first, last] = endsOf(column.at);
                      const Vector<2> along = last - first;
                      const auto isOff = [&, origin = first](const Vector<2>& place)
                      {
                          const double beside = std::abs(cross(along, place - origin));
                          return beside > 1e-9 * along.squaredNorm();
                      };
                      if (column.at.size() < 2 || along.norm() == 0
                          || std::any_of(column.at.begin(), column.at.end(), isOff))
                      {
                          return "An architrave lies on two columns at least, which stand in one line.";
                      }
                      return {};
                  });
}

Assembly<3> makeAssembly(const Column& column)
{
    Assembly<3> assembly;
    const auto section = [&](const Vector<2>& axis, int level)
    {
        const double radius = column.radius * (1 - column.taper * level / column.drums);
        std::vector<Vector<3>> corners;
        for (int k = 0; k < column.sides; ++k)
        {
            const Vector<2> corner = axis + ringPoint(column.sides, k + 0.5, radius);
            corners.emplace_back(corner.x(), corner.y(), level * column.drumHeight);
        }
        return corners;
    };
    for (const Vector<2>& axis : column.at)
    {
        for (int drum = 0; drum < column.drums; ++drum)
        {
            assembly.blocks.push_back({makePrism(section(axis, drum), section(axis, drum + 1))});
        }
    }
    if (column.architrave)
    {
        const auto [first, last] = endsOf(column.at);
        const Vector<2> along = (last - first).normalized();
        const Vector<2> across = column.architrave->width / 2 * perpendicular(along);
        const Vector<2> from = first - column.architrave->overhang * along;
        const Vector<2> to = last + column.architrave->overhang * along;
        std::vector<Vector<3>> below;
        std::vector<Vector<3>> above;
        for (const Vector<2>& corner : {Vector<2>(from - across), Vector<2>(to - across),
                                        Vector<2>(to + across), Vector<2>(from + across)})
        {
            const double lower = column.drums * column.drumHeight;
            below.emplace_back(corner.x(), corner.y(), lower);
            above.emplace_back(corner.x(), corner.y(), lower + column.architrave->height);
        }
        assembly.blocks.push_back({makePrism(below, above)});
    }
    return assembly;
}

} // namespace drystone
