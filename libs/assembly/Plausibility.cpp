// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Mean size and plane thickness against bounds within which small models and slices of dams lie.
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

/// What is improbable of the thickness of plane blocks; blocks in space have none of their own.
std::string doubtAboutThickness(const Assembly<2>& assembly)
{
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

std::string doubtAboutThickness(const Assembly<3>&)
{
    return {};
}

} // namespace

template<int Dim>
std::string doubtAboutSizes(const Assembly<Dim>& assembly)
{
    const double size = meanBlockSize(assembly);
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
    return assembly.blocks.empty() ? std::string() : doubtAboutThickness(assembly);
}

template<int Dim>
void questionSizes(const Assembly<Dim>& assembly, const SourceLocation& place)
{
    if (const std::string doubt = doubtAboutSizes(assembly); !doubt.empty())
    {
        printWarningOnce(doubt, place);
    }
}

template std::string doubtAboutSizes(const Assembly<2>& assembly);
template std::string doubtAboutSizes(const Assembly<3>& assembly);
template void questionSizes(const Assembly<2>& assembly, const SourceLocation& place);
template void questionSizes(const Assembly<3>& assembly, const SourceLocation& place);

} // namespace drystone
