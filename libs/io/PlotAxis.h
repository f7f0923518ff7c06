// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Axes of plots: what they reach from and to, and the labels of their ticks (`axisTicks` of io/Plot.h).
#pragma once

#include "io/Plot.h"

#include <string>
#include <vector>

namespace drystone
{

/// Ends of an axis, in its own values.
struct AxisRange
{
    double lower;
    double upper;
    AxisScale scale;

    /// Position on the axis, from 0 to 1.
    double part(double value) const;
};

/// From the data, with a margin; a linear axis that comes near zero begins there, a logarithmic one ends at
/// ticks. \throws FatalError where the ends that the axis states do not make one
AxisRange chooseRange(const PlotAxis& axis, const std::vector<double>& values);

/// 0.01, 0.1, 1, 10, 100 as they are, other powers of ten with an exponent.
std::string tickLabel(double value, AxisScale scale);

/// \throws FatalError for values that the axes cannot show
void checkValues(const Plot& plot);

} // namespace drystone
