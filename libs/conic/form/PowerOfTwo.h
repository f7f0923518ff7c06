// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Scales of programs. Internal to the form and to solvers that have one of their own.
#pragma once

#include <cmath>

namespace drystone
{

/// The power of two next to a value, so that scaling by it changes no digit; 1 for zero.
inline double powerOfTwo(double value)
{
    return value > 0 && std::isfinite(value) ? std::exp2(std::round(std::log2(value))) : 1;
}

} // namespace drystone
