// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Rows of results that are kept for later, with what shows whether they have been changed since: a disk or
/// an editor that changes a digit leaves a number as good as any.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace drystone
{

/// `1 0.5 #0123456789abcdef` of `1 0.5`.
std::string withFingerprint(const std::string& row);

/// The other way. Rows of older versions have no fingerprint and are taken as they are. \return nothing where
/// it is that of something else
std::optional<std::string> withoutFingerprint(const std::string& row);

/// Numbers of a text that has nothing else, or none.
std::vector<double> numbersOf(const std::string& text);

} // namespace drystone
