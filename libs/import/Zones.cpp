// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Names of zones.
#include "import/Zones.h"

#include <utility>

namespace drystone
{

std::string zoneName(const std::string& name)
{
    constexpr std::size_t longest = 60;
    const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    std::string key = name.substr(0, longest);
    for (char& c : key)
    {
        if (!isLetter(c) && !(c >= '0' && c <= '9') && c != '-' && c != '.')
        {
            c = '_';
        }
    }
    if (!key.empty() && !isLetter(key.front()))
    {
        key.front() = '_';
    }
    return key;
}

void ZoneList::add(const std::string& name, int block)
{
    const std::string key = zoneName(name);
    if (key.empty())
    {
        return;
    }
    const auto [place, isNew] = indexOf.emplace(key, zones.size());
    if (isNew)
    {
        zones.push_back({key, {}});
    }
    std::vector<int>& blocks = zones[place->second].blocks;
    if (blocks.empty() || blocks.back() != block)
    {
        blocks.push_back(block);
    }
}

std::vector<Zone> ZoneList::take()
{
    indexOf.clear();
    return std::exchange(zones, {});
}

} // namespace drystone
