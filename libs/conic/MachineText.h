// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// What the solvers compute with, for logs.
#pragma once

#include <string>

namespace drystone
{

/// `Threads: 2, dense kernel: avx512`
std::string machineText();

} // namespace drystone
