// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Where the entries of a dictionary stand: kept with settings, so that a later check can name the file and
/// line without reading it again.
#pragma once

#include "dictionary/Dictionary.h"

#include <map>
#include <string>
#include <string_view>

namespace drystone
{

/// The places of all entries of a dictionary, sub-dictionaries included. Empty where settings were not read
/// from a file: all places are then empty, too.
class EntryLocations
{
public:
    EntryLocations() = default;
    explicit EntryLocations(const Dictionary& dictionary);

    /// Whether there is an entry of exactly this path, as `joints/3-7/tension`.
    bool has(std::string_view path) const { return entries.find(path) != entries.end(); }

    /// Where to point a user: that entry, or the nearest dictionary around it that is there.
    SourceLocation of(std::string_view path) const;

private:
    void add(const Dictionary& dictionary, const std::string& prefix);

    SourceLocation whole;
    std::map<std::string, SourceLocation, std::less<>> entries;
};

} // namespace drystone
