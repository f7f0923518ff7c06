// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Names of zones.
#include "import/Zones.h"

#include "core/Error.h"

#include <fmt/format.h>

#include <algorithm>
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
    if (!key.empty() && key.front() >= '0' && key.front() <= '9')
    {
        key.insert(key.begin(), '_');
        key.resize(std::min(key.size(), longest));
    }
    else if (!key.empty() && !isLetter(key.front()))
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
        names.push_back(name);
        others.emplace_back();
    }
    else if (names[place->second] != name)
    {
        others[place->second] = name;
    }
    std::vector<int>& blocks = zones[place->second].blocks;
    if (blocks.empty() || blocks.back() != block)
    {
        blocks.push_back(block);
    }
}

std::vector<Zone> ZoneList::take(const ImportedFile& file)
{
    for (std::size_t i = 0; i < zones.size(); ++i)
    {
        if (!others[i].empty())
        {
            printWarningOnce(
                fmt::format("The names {} and {} have become one zone, {}: other characters than "
                            "letters, digits, `_`, `-` and `.` become `_`, and at most 60 count. "
                            "Rename one of them where their blocks differ.",
                            shown(names[i]), shown(others[i]), zones[i].name),
                {file.name, "", 0});
        }
    }
    indexOf.clear();
    names.clear();
    others.clear();
    return std::exchange(zones, {});
}

} // namespace drystone
