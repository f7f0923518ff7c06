// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The largest structure that a texture generates, one limit for all of them.
#pragma once

namespace drystone
{

/// More blocks than this are taken for a typing error, before memory is exhausted.
inline constexpr int maximumBlocks = 10'000'000;

} // namespace drystone
