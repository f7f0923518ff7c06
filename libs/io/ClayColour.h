// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The colours of displaced blocks in pictures of the plane and of space, and their legend.
#pragma once

#include "io/Canvas.h"

#include <string>

namespace drystone
{

/// Fill colour from light to dark clay, darker with increasing displacement: 0 to 1. \param light factor on
/// the brightness, of a face in space
std::string clayColour(double value, double light = 1);

/// `at rest`, a bar of the colours, `moves most`. \return where it ends, in x [px]
double paintClayLegend(Canvas& drawing, const Vector<2>& corner);

} // namespace drystone
