// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Drawings as SVG, for web pages and for programs that go on drawing.
#pragma once

#include "io/Canvas.h"

#include <string>

namespace drystone
{

/// The drawing as an SVG document. Coordinates are rounded to 0.01 px, those of many polygons or lines in one
/// shape to 0.1 px.
std::string svgText(const Canvas& canvas);

} // namespace drystone
