// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Zones from the names that other programs give to layers, materials and objects.
#pragma once

#include "assembly/Assembly.h"
#include "import/ImportedFile.h"

#include <string>
#include <unordered_map>
#include <vector>

namespace drystone
{

/// A name that a dictionary can have as a key: other characters than letters, digits, `_`, `-` and `.` become
/// `_`, as does a first one that is neither letter nor digit; a `_` comes before a first digit, so that no
/// zone is taken for the index of a block. Of at most 60 characters. Empty for an empty name.
std::string zoneName(const std::string& name);

/// Zones in the order in which their names appear.
class ZoneList
{
public:
    /// Puts a block into the zone of a name, see zoneName; into none for an empty name, once for a name that
    /// is there twice. \pre blocks come in their order
    void add(const std::string& name, int block);
    /// Warns of names that have become one zone. \post the list is empty
    std::vector<Zone> take(const ImportedFile& file);

private:
    std::vector<Zone> zones;
    std::vector<std::string> names;  ///< of the file: the first of each zone
    std::vector<std::string> others; ///< another one of the zone; empty: none
    std::unordered_map<std::string, std::size_t> indexOf;
};

} // namespace drystone
