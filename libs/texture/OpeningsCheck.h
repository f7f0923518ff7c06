// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The checks of a texture's openings, of walls in the plane and in space alike: the first that does not fit
/// is named by its place in the list.
#pragma once

#include "dictionary/Options.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace drystone
{

/// \param openings kept by reference, as the options keep what they fill in \param fault of one of them, as a
/// predicate that continues "Opening 3 "; empty where there is none
template<class Opening, class Fault>
void checkOpenings(Options& options, const std::vector<Opening>& openings, const Fault& fault)
{
    options.check("openings",
                  [&openings, fault]() -> std::string
                  {
                      for (std::size_t i = 0; i < openings.size(); ++i)
                      {
                          const std::string found = fault(openings[i]);
                          if (!found.empty())
                          {
                              return fmt::format("Opening {} {}", i, found);
                          }
                      }
                      return {};
                  });
}

/// `(1 2)-(3 4)`.
template<class Opening>
std::string cornersOf(const Opening& opening)
{
    return fmt::format("({:g} {:g})-({:g} {:g})", opening.from.x(), opening.from.y(), opening.to.x(),
                       opening.to.y());
}

/// `(1 2)-(3 4) has a lintel from 0.5 to 3.5 units in course 4`. \param unit of lengths along the wall, in
/// the plural
template<class Opening>
std::string lintelText(const Opening& opening, std::string_view unit)
{
    return fmt::format("{} has a lintel from {:g} to {:g} {} in course {:g}", cornersOf(opening),
                       opening.from.x() - *opening.lintel, opening.to.x() + *opening.lintel, unit,
                       opening.to.y());
}

/// What keeps the lintel of an opening from being one block with its bearings: an opening or a lintel of the
/// same wall in its course. As a predicate that continues "Opening 3 "; empty where there is none. \param
/// isInSameWall of any two openings of the list
template<class Opening, class IsInSameWall>
std::string lintelFault(const std::vector<Opening>& openings, const Opening& opening, std::string_view unit,
                        const IsInSameWall& isInSameWall)
{
    constexpr double rounding = 1e-9;
    const double course = opening.to.y();
    for (std::size_t i = 0; opening.lintel && i < openings.size(); ++i)
    {
        const Opening& other = openings[i];
        if (&other == &opening || !isInSameWall(opening, other))
        {
            continue;
        }
        const bool isLintel = other.lintel && other.to.y() == course;
        const bool isOpen = other.from.y() <= course && course < other.to.y();
        const double bearing = isLintel ? *other.lintel : 0;
        const double from = other.from.x() - bearing;
        const double to = other.to.x() + bearing;
        if ((!isLintel && !isOpen)
            || std::min(to, opening.to.x() + *opening.lintel)
                       - std::max(from, opening.from.x() - *opening.lintel)
                   <= rounding)
        {
            continue;
        }
        return lintelText(opening, unit)
               + (isLintel ? fmt::format(", and that of opening {} is from {:g} to {:g}: they overlap. "
                                         "Shorten the bearings, or move the openings apart.",
                                         i, from, to)
                           : fmt::format(", and opening {} is cut there from {:g} to {:g}: the lintel would "
                                         "not be one block. Move one of the openings, or remove the lintel.",
                                         i, from, to));
    }
    return {};
}

} // namespace drystone
