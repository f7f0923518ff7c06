// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// How much a texture may ask for.
#pragma once

namespace drystone
{

/// More blocks than this are taken for a slip of the pen, before memory runs out.
inline constexpr int mostBlocks = 10'000'000;

} // namespace drystone
