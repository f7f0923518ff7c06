// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Points that fill a cube evenly, each a function of its number alone: a design of ensembles.
#pragma once

#include <cstdint>

namespace drystone
{

/// A point of the Sobol' sequence (direction numbers of Joe and Kuo 2008), 32 bits.
/// \param dimension 0 to sobolDimensions - 1
std::uint32_t sobolBits(std::uint32_t index, int dimension);
inline constexpr int sobolDimensions = 21;

} // namespace drystone
