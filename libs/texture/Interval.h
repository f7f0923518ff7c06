// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// A piece of a line: of a course between openings, of a wall that a brick takes.
#pragma once

namespace drystone
{

struct Interval
{
    double from; ///< [m], or in units of the bond
    double to;   ///< likewise, beyond `from`
};

} // namespace drystone
