// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The last word of a style wins over attributes; visibility is inherited, `display: none` is final.
#include "import/SvgAppearance.h"

#include "import/ImportedFile.h"

#include <algorithm>

namespace drystone
{

std::string_view styleProperty(std::string_view style, std::string_view name)
{
    std::string_view found;
    while (!style.empty())
    {
        const std::string_view one = style.substr(0, style.find(';'));
        style.remove_prefix(std::min(one.size() + 1, style.size()));
        const std::size_t colon = one.find(':');
        if (colon != one.npos && trimmed(one.substr(0, colon)) == name)
        {
            const std::string_view value = one.substr(colon + 1);
            found = trimmed(value.substr(0, value.find('!'))); // !important
        }
    }
    return found;
}

namespace
{

/// What an element says of a property: in its style, or else by its attribute.
std::string_view propertyOf(std::string_view style, std::string_view name, std::string_view attribute)
{
    const std::string_view ofStyle = styleProperty(style, name);
    return ofStyle.empty() ? trimmed(attribute) : ofStyle;
}

} // namespace

SvgAppearance SvgAppearance::of(const SvgVisibility& own) const
{
    const std::string_view display = propertyOf(own.style, "display", own.display);
    const std::string_view visibility = propertyOf(own.style, "visibility", own.visibility);
    return {isDisplayed && display != "none",
            visibility.empty() || visibility == "inherit" ? isVisible : visibility == "visible"};
}

} // namespace drystone
