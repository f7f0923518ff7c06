// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Points and vectors as a user writes them, for messages. In this library since every reader of points sees
/// it.
#pragma once

#include "geometry/Vector.h"

#include <fmt/format.h>

#include <string>

namespace drystone
{

/// `(0.5 1.2)`, in space `(0 0 -9.81)`: six significant digits, 0 without a sign.
template<int Dim>
std::string asWritten(const Vector<Dim>& vector)
{
    const Vector<Dim> plain = vector + Vector<Dim>::Zero(); // turns -0 into 0
    return fmt::format("({:g})", fmt::join(plain.data(), plain.data() + Dim, " "));
}

} // namespace drystone
