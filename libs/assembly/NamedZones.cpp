// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Compares patterns with the names of all zones, in this library because it has the zones.
#include "assembly/NamedZones.h"

#include "core/Error.h"
#include "dictionary/DictionaryPattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace drystone
{

void requireZone(const NamePattern& pattern, const std::vector<Zone>& zones, const SourceLocation& location)
{
    std::vector<std::string> names;
    for (const Zone& zone : zones)
    {
        names.push_back(zone.name);
    }
    if (std::none_of(names.begin(), names.end(),
                     [&](const std::string& name) { return pattern.matches(name); }))
    {
        throw FatalIOError(unknownWordMessage("zone", pattern.text, names), location);
    }
    const std::string mistyped = alternativeWithoutName(pattern.text, names);
    if (!mistyped.empty())
    {
        printWarningOnce(
            fmt::format("In the pattern {}: {}", pattern.text, unknownWordMessage("zone", mistyped, names)),
            location);
    }
}

} // namespace drystone
