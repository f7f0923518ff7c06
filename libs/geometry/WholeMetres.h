// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Vectors in whole metres, for messages on structures far from the origin. In this library since import and
/// dynamics write them.
#pragma once

#include "geometry/Vector.h"

#include <fmt/format.h>

#include <string>

namespace drystone
{

/// `(-512345 -4649877 0)`: the nearest whole numbers with all their digits, 0 without a sign.
template<int Dim>
std::string inWholeMetres(const Vector<Dim>& vector)
{
    const Vector<Dim> plain = vector.array().round() + 0.0; // turns -0 into 0
    return fmt::format("({:.0f})", fmt::join(plain.data(), plain.data() + Dim, " "));
}

} // namespace drystone
