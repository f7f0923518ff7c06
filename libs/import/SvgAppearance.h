// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Whether elements of SVG are seen.
#pragma once

#include <string_view>

namespace drystone
{

/// Attributes of an element that say whether it is seen; empty where it has none.
struct SvgVisibility
{
    std::string_view display;
    std::string_view visibility;
    std::string_view style; ///< `name: value; ...`, which comes before the other two
};

/// Whether and how the elements of a group are seen. Who is not displayed hides all inside; who is not
/// visible does not.
struct SvgAppearance
{
    bool isDisplayed = true;
    bool isVisible = true;

    bool isSeen() const { return isDisplayed && isVisible; }
    /// That of an element within.
    SvgAppearance of(const SvgVisibility& own) const;
};

/// What a style says of a property, empty where it does not.
std::string_view styleProperty(std::string_view style, std::string_view name);

} // namespace drystone
