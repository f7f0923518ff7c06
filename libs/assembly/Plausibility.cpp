// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/Plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drystone
{
namespace
{

/// From blocks of models on a table to large stones and slices of dams: a brick in millimetres has 100.
constexpr double smallestUsual = 0.005;
constexpr double largestUsual = 10;
/// Out of the plane whole vaults are one slice.
constexpr double thickestUsual = 50;

/// Square root of the mean area of the free blocks; 0 when there are none.
double meanFreeSize(const Assembly<2>& assembly)
{
    double area = 0;
    int count = 0;
    for (const Block<2>& block : assembly.blocks)
    {
        if (block.support < 0)
        {
            area += blockMass(block).volume / block.thickness;
            ++count;
        }
    }
    return count > 0 ? std::sqrt(area / count) : 0;
}

} // namespace

std::string doubtAboutSizes(const Assembly<2>& assembly)
{
    const double size = meanFreeSize(assembly);
    if (size > 0 && (size < smallestUsual || size > largestUsual))
    {
        return fmt::format(
            "The blocks have a mean size of {:.4g} m, which is unusual: usual is from {:g} to "
            "{:g} m. Lengths are in metres{}. They are used as they stand.",
            size, smallestUsual, largestUsual,
            size > largestUsual ? fmt::format(
                "; were they written in millimetres, the mean size would be {:.4g} m", size / 1000)
                                : "");
    }
    if (assembly.blocks.empty())
    {
        return {};
    }
    const auto [least, most] =
        std::minmax_element(assembly.blocks.begin(), assembly.blocks.end(),
                            [](const auto& a, const auto& b) { return a.thickness < b.thickness; });
    if (least->thickness < smallestUsual || most->thickness > thickestUsual)
    {
        return fmt::format("A thickness of {:g} m is unusual: usual is from {:g} to {:g} m. Lengths are in "
                           "metres. It is used as it stands.",
                           most->thickness > thickestUsual ? most->thickness : least->thickness,
                           smallestUsual, thickestUsual);
    }
    return {};
}

void questionSizes(const Assembly<2>& assembly, const SourceLocation& place)
{
    if (const std::string doubt = doubtAboutSizes(assembly); !doubt.empty())
    {
        printWarningOnce(doubt, place);
    }
}

} // namespace drystone
