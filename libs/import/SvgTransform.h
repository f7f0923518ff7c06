// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where elements of SVG are moved to.
#pragma once

#include "geometry/Vector.h"
#include "import/SvgScanner.h"

namespace drystone
{

/// A point x of an element is at matrix x + shift in what is around it.
struct SvgTransform
{
    Eigen::Matrix2d matrix = Eigen::Matrix2d::Identity();
    Vector<2> shift = Vector<2>::Zero();
};

/// The inner one first, then the outer one.
SvgTransform operator*(const SvgTransform& outer, const SvgTransform& inner);

/// All transforms of an attribute, `translate(3 4) rotate(30)`, the last one first; none where it is empty.
/// \throws FatalIOError where one is not of SVG or has another number of values
SvgTransform svgTransform(SvgScanner attribute);

} // namespace drystone
