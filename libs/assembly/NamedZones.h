// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Zones of an assembly by the names and patterns that dictionaries have: in this library because materials
/// and loads on faces both need them.
#pragma once

#include "assembly/Assembly.h"
#include "dictionary/Option.h"

#include <vector>

namespace drystone
{

/// Warns of a name within the pattern, as in `pillars|parapet`, that no zone has while another one is found.
/// \param location of the pattern, for messages
/// \throws FatalIOError where it matches no zone at all
void requireZone(const NamePattern& pattern, const std::vector<Zone>& zones, const SourceLocation& location);

} // namespace drystone
