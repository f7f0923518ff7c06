// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Outlines of stones have no holes: what is in one belongs to the stone.
#pragma once

#include "import/plane/Picture.h"

namespace drystone
{

/// What a stone surrounds becomes part of it, other stones too: an outline has no hole.
/// \param isFilled is set for these pixels
void fillHoles(Raster<int>& labels, Raster<std::uint8_t>& isFilled);

} // namespace drystone
