// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Drawings that would run on the page of a report: a report is read of cases that came from elsewhere.
#pragma once

#include <string>

namespace drystone
{

/// Whether an SVG drawing would do something on a page: those that Drystone writes have neither scripts nor
/// attributes for events nor pages of others within.
bool isActive(const std::string& drawing);

} // namespace drystone
