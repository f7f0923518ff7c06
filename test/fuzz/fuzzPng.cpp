// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Any bytes, read as a photograph of stones: rejected with a FatalError, or outlines for each stone.
#include "ImportedBlocks.h"

#include "import/plane/Picture.h"
#include "import/plane/StoneBorders.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace drystone;
    fuzz::tryReading(
        [&]
        {
            const Raster<std::uint8_t> picture = readPng(fuzz::imported(data, size));
            constexpr std::size_t most = 100'000; // pixels: speed
            if (picture.pixels.size() > most)
            {
                return;
            }
            StoneSettings settings;
            settings.leastArea = 3;
            settings.mortar = 4;
            settings.base = 2;
            const StoneRaster stones = labelStones(picture, settings);
            for (const Polygon& outline : stoneOutlines(stones.labels, stones.count, 1))
            {
                if (outline.size() < 2)
                {
                    std::abort();
                }
            }
            for (const Polygon& outline : stoneOutlines(stones.labels, stones.count, 0))
            {
                if (!(areaProperties(outline).area > 0))
                {
                    std::abort();
                }
            }
        });
    return 0;
}
