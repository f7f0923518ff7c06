// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures as numbers, and what is distinguished in them: the user of libpng.
#pragma once

#include "import/ImportedFile.h"
#include "import/plane/Raster.h"

#include <cstdint>
#include <vector>

namespace drystone
{

/// The brightness of a PNG, 0 black to 255 white; transparent parts are white. \throws FatalIOError when it
/// is none, or has more than 50 million pixels
Raster<std::uint8_t> readPng(const ImportedFile& file);

/// No stone: mortar, or a void.
inline constexpr int noStone = -1;

struct StoneSettings
{
    bool areLight = false; ///< stones are lighter than mortar
    int threshold = 128;   ///< of the brightness between the two
    int leastArea = 30;    ///< of a stone [pixels]; smaller spots are mortar
    int mortar = 12;       ///< widest joint that stones grow into [pixels]
    int base = 0;          ///< height above the lowest stone to which the lowest stones reach down [pixels]
};

/// Which stone each pixel belongs to.
struct StoneRaster
{
    Raster<int> labels;      ///< from 0, or noStone
    int count = 0;           ///< of stones
    std::vector<int> filled; ///< of each stone: the pixels that were a hole in it
};

/// The stones of a picture, numbered from 0 as they appear from the top left: connected areas of their
/// brightness, grown into the mortar between them, each pixel to the nearest stone. Mortar that is wider, and
/// what is around the stones, stays free: what is grown is the closing of the stones by half the widest
/// joint. What a stone surrounds becomes part of it, other stones too, and stones do not touch at corners of
/// pixels alone.
StoneRaster labelStones(const Raster<std::uint8_t>& brightness, const StoneSettings& settings);

} // namespace drystone
