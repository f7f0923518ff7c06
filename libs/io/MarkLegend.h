// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Colours of hinges and sliding joints, the same in pictures of the plane and of space, and what they mean.
#pragma once

#include "io/Canvas.h"
#include "io/JointMarks.h"

#include <vector>

namespace drystone
{

inline constexpr const char* hingeColour = "#c2185b";
inline constexpr const char* slidingColour = "#1f5fa8";

/// What the colours of those marks mean that there are. \return the x at which it ends [px]
double paintMarkLegend(Canvas& drawing, const std::vector<JointMark>& marks, const Vector<2>& corner);

} // namespace drystone
