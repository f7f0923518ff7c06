// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The names that users give the entries of dictionaries.
#pragma once

#include "dictionary/Dictionary.h"

#include <string>
#include <vector>

namespace drystone
{

/// Of one list after the other, each in its order.
template<class... Values>
std::vector<std::string> namesIn(const std::vector<Named<Values>>&... lists)
{
    std::vector<std::string> names;
    const auto add = [&](const auto& list)
    {
        for (const auto& [name, value] : list)
        {
            names.push_back(name);
        }
    };
    (add(lists), ...);
    return names;
}

} // namespace drystone
