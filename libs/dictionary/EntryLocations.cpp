// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Collects the places of entries.
#include "dictionary/EntryLocations.h"

namespace drystone
{

EntryLocations::EntryLocations(const Dictionary& dictionary) : whole(dictionary.location())
{
    add(dictionary, "");
}

void EntryLocations::add(const Dictionary& dictionary, const std::string& prefix)
{
    for (const Entry& entry : dictionary.entries())
    {
        const std::string path = prefix + entry.keyword();
        entries.emplace(path, entry.location());
        if (entry.isDictionary())
        {
            add(entry.dictionary(), path + "/");
        }
    }
}

SourceLocation EntryLocations::of(std::string_view path) const
{
    while (!path.empty())
    {
        if (const auto found = entries.find(path); found != entries.end())
        {
            return found->second;
        }
        const auto end = path.rfind('/');
        path = path.substr(0, end == std::string_view::npos ? 0 : end);
    }
    return whole;
}

} // namespace drystone
