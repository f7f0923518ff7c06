// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Words of files that other programs made, in messages.
#pragma once

#include <string>
#include <string_view>

namespace drystone
{

/// A word for a message: shortened, and without bytes that a terminal would act on.
std::string shown(std::string_view word);

} // namespace drystone
