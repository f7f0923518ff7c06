// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The texture `image`: blocks from a photograph of a wall, or a drawing of it in two colours.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Options.h"
#include "import/plane/Picture.h"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace drystone
{

/// What is brighter.
enum class Stones
{
    dark, ///< mortar is
    light ///< stones are
};

inline std::array<std::pair<std::string_view, Stones>, 2> namesOf(Stones)
{
    return {{{"dark", Stones::dark}, {"light", Stones::light}}};
}

struct Photograph
{
    std::string file; ///< PNG, relative to the case directory
    Stones stones = Stones::dark;
    StoneSettings labels;
    std::pair<Vector<2>, Vector<2>> points = {Vector<2>::Zero(),
                                              Vector<2>::Zero()}; ///< from the top left [pixels]
    double distance = 1;                                          ///< of these points [m]
    double tolerance = 1.5; ///< of borders from the sides of pixels [pixels]
    double thickness = 1;   ///< out of plane [m]
};

void declare(Options& options, Photograph& photograph);

/// The stones, all free; the lowest stands on y = 0, the leftmost begins at x = 0. Neighbours share their
/// joints. Where an outline would be no block, or overlap another, the tolerance of all borders is halved, up
/// to three times, and after that 0: borders are then the sides of pixels. \throws FatalIOError at `place`,
/// that of the entry `file`, when there is no such file, at `placeOfPoints` when these are not in the
/// picture, and in the file when it has no stone
Assembly<2> makeAssembly(const Photograph& photograph, const std::filesystem::path& caseDirectory,
                         const SourceLocation& place, const SourceLocation& placeOfPoints = {});

} // namespace drystone
