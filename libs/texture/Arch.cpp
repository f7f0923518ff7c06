// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the blocks of the texture `arch` from its settings.
#include "texture/Arch.h"

#include "texture/Limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace drystone
{

namespace
{

Vector<2> mirrored(const Vector<2>& point)
{
    return {-point.x(), point.y()};
}

/// Unit vectors along the joints, from the left springing to the right one.
std::vector<Vector<2>> jointDirections(const Arch& arch)
{
    const int count = arch.voussoirs;
    const double step = arch.angle / 180 * EIGEN_PI / count;
    std::vector<Vector<2>> directions(count + 1);
    for (int k = 0; 2 * k <= count; ++k)
    {
        // From the crown down to the right: sine and cosine of the angle from the vertical. The springings of
        // a semicircle are set level, which rounding would miss.
        const double fromCrown = step * (0.5 * count - k);
        const bool isLevel = k == 0 && arch.angle == 180;
        const Vector<2> right =
            isLevel ? Vector<2>(1, 0) : Vector<2>(std::sin(fromCrown), std::cos(fromCrown));
        directions[count - k] = right;
        directions[k] = 2 * k == count ? Vector<2>(0, 1) : mirrored(right);
    }
    return directions;
}

} // namespace

void declare(Options& options, Arch& arch)
{
    declareSection(options, arch);
    options.optional("depth", arch.depth, "out of plane").unit("m").above(0);
}

void declareSection(Options& options, Arch& arch)
{
    options.optional("profile", arch.profile, "shape of the centreline");
    options.required("radius", arch.radius, "of the centreline").unit("m").above(0).example("1");
    options.required("thickness", arch.thickness, "in the radial direction")
        .unit("m")
        .above(0)
        .example("0.15");
    options.required("voussoirs", arch.voussoirs, "their number")
        .atLeast(1)
        .atMost(maximumBlocks)
        .example("27");
    options.optional("angle", arch.angle, "from springing to springing, in degrees").above(0).atMost(270);
    options.check("thickness",
                  [&arch]() -> std::string
                  {
                      return arch.thickness >= 2 * arch.radius ? fmt::format(
                                 "An arch of radius {:g} m cannot be {:g} m thick: the thickness must be "
                                 "below twice the radius.",
                                 arch.radius, arch.thickness)
                                                               : "";
                  });
    options.check("voussoirs",
                  [&arch]() -> std::string
                  {
                      return arch.angle / arch.voussoirs >= 180
                                 ? "A single voussoir cannot span 180 degrees or more: give more voussoirs."
                                 : "";
                  });
}

Assembly<2> makeAssembly(const Arch& arch, Abutments abutments)
{
    const double inner = arch.radius - arch.thickness / 2;
    const double outer = arch.radius + arch.thickness / 2;
    const std::vector<Vector<2>> directions = jointDirections(arch);

    Assembly<2> assembly;
    for (int i = 0; i < arch.voussoirs; ++i)
    {
        const Vector<2>& left = directions[i];
        const Vector<2>& right = directions[i + 1];
        assembly.blocks.push_back({{inner * left, inner * right, outer * right, outer * left}, arch.depth});
    }
    if (abutments == Abutments::none)
    {
        return assembly;
    }
    // On the inner side the face ends before the centre of the circle, where it would meet the face of the
    // other abutment.
    const double margin = std::min(arch.thickness, inner / 2);
    const Vector<2>& radius = directions.back();
    const Vector<2> away = -arch.thickness * perpendicular(radius); // along the circle, out of the arch
    const Polygon right{(inner - margin) * radius, (inner - margin) * radius + away,
                        (outer + arch.thickness) * radius + away, (outer + arch.thickness) * radius};
    Polygon left;
    std::transform(right.rbegin(), right.rend(), std::back_inserter(left), mirrored);
    assembly.supports = {{"left", "abutments"}, {"right", "abutments"}};
    assembly.blocks.push_back({std::move(left), arch.depth, 0});
    assembly.blocks.push_back({right, arch.depth, 1});
    return assembly;
}

} // namespace drystone
