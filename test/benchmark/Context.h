// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What benchmarks know of the process that runs them.
#pragma once

namespace drystone
{

/// Largest resident memory so far [GB].
double peakMemory();

} // namespace drystone
