// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Paths of entries within their file, as messages name them: `live/load`.
#pragma once

#include <string>

namespace drystone
{

inline std::string joined(const std::string& path, const std::string& key)
{
    return path.empty() ? key : path + "/" + key;
}

} // namespace drystone
