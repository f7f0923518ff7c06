// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Looks for scripts, and for what calls them, in a drawing.
#include "report/ActiveDrawing.h"

#include "core/LowerCase.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace drystone
{
namespace
{

/// Elements that run, or show, what is not in the drawing, and addresses that do.
constexpr std::array<std::string_view, 6> activeMarks{"<script", "<foreignobject", "<iframe",
                                                      "<object", "<embed",         "javascript:"};

constexpr std::string_view space = " \t\r\n";

/// Whether a name that begins with `on` is that of an attribute: `onload = ...`. \param at where it begins
bool isEvent(std::string_view element, std::size_t at)
{
    const bool isBegin = at > 0 && std::string_view(" \t\r\n/\"'").find(element[at - 1]) != element.npos;
    std::size_t end = at;
    while (end < element.size() && element[end] >= 'a' && element[end] <= 'z')
    {
        ++end;
    }
    end = std::min(element.find_first_not_of(space, end), element.size());
    return isBegin && end < element.size() && element[end] == '=';
}

/// \param element from `<` to before `>`
bool hasEvent(std::string_view element)
{
    for (std::size_t at = element.find("on"); at != element.npos; at = element.find("on", at + 1))
    {
        if (isEvent(element, at))
        {
            return true;
        }
    }
    return false;
}

} // namespace

bool isActive(const std::string& drawing)
{
    const std::string text = lowerCase(drawing);
    const std::string_view all = text;
    bool isAny = std::any_of(activeMarks.begin(), activeMarks.end(),
                             [all](std::string_view mark) { return all.find(mark) != all.npos; });
    for (std::size_t tag = all.find('<'); !isAny && tag != all.npos; tag = all.find('<', tag + 1))
    {
        isAny = hasEvent(all.substr(tag, all.find('>', tag) - tag));
    }
    return isAny;
}

} // namespace drystone
