// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Groups of a DXF file, read line by line.
#include "import/DxfGroups.h"

namespace drystone
{

void DxfGroups::readGroup()
{
    std::string_view line;
    if (!lines.next(line))
    {
        if (!isAtEnd && group.value != "EOF")
        {
            refuse(file, lines.number(), "The file ends without `EOF`: get a complete copy of it.");
        }
        isAtEnd = true;
        group = {0, "EOF", lines.number()};
        return;
    }
    group.line = lines.number();
    group.code = integerOf(file, group.line, trimmed(line));
    if (!lines.next(line))
    {
        refuse(file, group.line, "The file ends after a group code: get a complete copy of it.");
    }
    group.value = trimmed(line);
}

} // namespace drystone
