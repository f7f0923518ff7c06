// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Views of structures in space by name or direction.
#include "io/space/View.h"

#include "core/Error.h"
#include "io/MechanismPicture.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

namespace drystone
{

View axonometricView(const Vector<3>& towardsViewer)
{
    View view;
    view.towardsViewer = towardsViewer;
    const Vector<2> level = towardsViewer.head<2>();
    view.right =
        level.norm() < 1e-9 ? Vector<3>(1, 0, 0) : Vector<3>(-level.y(), level.x(), 0) / level.norm();
    view.up = momentOf(view.towardsViewer, view.right); // the cross product
    return view;
}

Vector<3> usualView()
{
    const double azimuth = -55 * std::numbers::pi / 180;
    const double elevation = 25 * std::numbers::pi / 180;
    return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
            std::sin(elevation)};
}

Vector<3> viewFrom(const std::string& text)
{
    static constexpr std::array<std::pair<std::string_view, std::array<int, 3>>, 5> sides{
        {{"front", {0, -1, 0}},
         {"back", {0, 1, 0}},
         {"left", {-1, 0, 0}},
         {"right", {1, 0, 0}},
         {"top", {0, 0, 1}}}};
    for (const auto& [name, direction] : sides)
    {
        if (text == name)
        {
            return {double(direction[0]), double(direction[1]), double(direction[2])};
        }
    }
    std::istringstream stream(text);
    char open = 0;
    char close = 0;
    Vector<3> direction = Vector<3>::Zero();
    stream >> open >> direction.x() >> direction.y() >> direction.z() >> close;
    std::string rest;
    if (!stream || open != '(' || close != ')' || stream >> rest || !direction.allFinite()
        || !(direction.norm() > 0))
    {
        throw FatalError(
            fmt::format("There is no view \"{}\". Write front, back, left, right or top, or the direction "
                        "to the viewer, for instance \"(1 -1.4 0.8)\".",
                        text));
    }
    return direction.normalized();
}

} // namespace drystone
