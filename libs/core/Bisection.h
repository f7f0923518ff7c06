// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where a condition changes between two numbers, for curves, records and probabilities alike.
#pragma once

#include <limits>

namespace drystone
{

/// The least number above `low` for which isBelow is false, by bisection to the last bit; `high` where there
/// is none. Where isBelow changes more than once, one of the changes. \param isBelow bool(double) \param
/// mostHalvings of the interval
template<typename IsBelow>
double bisected(double low, double high, const IsBelow& isBelow,
                int mostHalvings = std::numeric_limits<int>::max())
{
    double middle = low + (high - low) / 2;
    for (int halving = 0; halving < mostHalvings && low < middle && middle < high; ++halving)
    {
        (isBelow(middle) ? low : high) = middle;
        middle = low + (high - low) / 2;
    }
    return high;
}

} // namespace drystone
