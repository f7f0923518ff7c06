// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// To how many digits coordinates were written: what their rounding may have moved corners by.
#pragma once

#include "assembly/Assembly.h"

namespace drystone
{

/// The unit of the last digit that the coordinates of an assembly were written to [m], by `%.6f` (the same
/// number of decimals) or `%.6g` (the same number of significant digits; then that of the largest
/// coordinates). 0 where a third of the coordinates or more have another number of digits, or all of a
/// double, 15 or more: then rounding does not explain where they are.
///
/// Only corners of faces (edges of the plane) that are not parallel to the axes are looked at, and of these
/// the coordinates that place them across the face: corners on one line along an axis round alike, so that
/// their rounding opens no joint, and coordinates like 0.5 say nothing of rounding. A coordinate counts with
/// its shortest decimal text that reads back as the same double.
template<int Dim>
double writtenRounding(const Assembly<Dim>& assembly);

} // namespace drystone
