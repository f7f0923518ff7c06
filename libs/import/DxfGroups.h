// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// The groups that a DXF file consists of. Internal to the reader of DXF.
#pragma once

#include "import/ImportedFile.h"

#include <string_view>

namespace drystone
{

/// Two lines of the file: what a value means, and the value.
struct DxfGroup
{
    int code = 0;
    std::string_view value;
    int line = 0;
};

/// A file of groups, one after the other. The file is not owned.
class DxfGroups
{
public:
    explicit DxfGroups(const ImportedFile& source) : file(source), lines(source.bytes) { advance(); }

    const DxfGroup& current() const { return group; }
    bool isEnd() const { return isAtEnd; }
    /// To the next group that is no comment.
    void advance()
    {
        constexpr int comment = 999;
        do
        {
            readGroup();
        } while (group.code == comment);
    }
    /// Whether an entity, or a section of the file, of this name begins here.
    bool starts(std::string_view name) const { return group.code == 0 && group.value == name; }
    /// Its value as a number. \throws FatalIOError where it is none
    double number() const { return numberOf(file, group.line + 1, group.value); }
    int integer() const { return integerOf(file, group.line + 1, group.value); }

private:
    void readGroup();

    const ImportedFile& file;
    LineReader lines;
    DxfGroup group;
    bool isAtEnd = false;
};

} // namespace drystone
