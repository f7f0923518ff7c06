// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The input of a case as readers of a report want it: each value with its unit and what it is, from the
/// declarations of the keys.
#pragma once

#include "dictionary/Options.h"

#include <string>
#include <vector>

namespace drystone
{

/// Rows `key, value, unit, what it is` for each value of a dictionary, keys of sub-dictionaries as
/// `friction/mu`; without the header. A key that no declaration describes has its value alone.
std::vector<std::vector<std::string>> inputRows(const Dictionary& dictionary,
                                                const std::vector<OptionDescription>& options);

} // namespace drystone
